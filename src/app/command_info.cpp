#include "app/command_info.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace carom::cli {

namespace {

struct Heading {
  std::string_view title;
  std::string_view options;  ///< between blanks
};

constexpr std::string_view of_the_command = "Options";  ///< for an option that all_headings forgets

constexpr std::array<Heading, 9> all_headings = {{
    {of_the_command, ""},
    {"Scene", " --set --seed --time --accept-overlap --changes --trajectory --every "},
    {"Extent",
     " --collisions --spectrum --seeds --longest --no-costs --disks --large --effects --quick --full --only --family --long "},
    {"How it is computed", " --engine --method --dt --stiffness --threads "},
    {"The picture", " --size --fps --speed --from --to --at --colour --color --trails --trails-of --velocities --dark --bare "},
    {"Results", " --out --force --resume --no-trajectory --xyz --csv --events --unwrapped --report --page --play --open --file "},
    {"Checks", " --verify --verify-horizon "},
    {"Saving", " --checkpoint-every --walltime "},
    {"On the terminal", " --json --markdown --quiet --verbose --watch --pace --progress --list --show --resolved --reproduce "},
}};

using ExamplesOf = std::pair<std::string_view, std::span<const Example>>;

constexpr std::array<Example, 3> init_examples = {{
    {"carom init", "write box.toml, the classic scene"},
    {"carom init --list", "list the scenes that it can write"},
    {"carom init gas -o my.toml", "write the scene gas under a name of your own"},
}};
constexpr std::array<Example, 2> check_examples = {{
    {"carom check box.toml", "say what would be simulated, and what it costs"},
    {"carom check box.toml --resolved > whole.toml", "write the scene with all defaults"},
}};
constexpr std::array<Example, 5> run_examples = {{
    {"carom run box.toml", "run the scene and write box/"},
    {"carom run box.toml --time 1 --seed 2 --out box-2", "another end and another start"},
    {"carom run box.toml --set disks.0.count=100 --events --report --out crowd",
     "more disks; store every collision, and write a page"},
    {"carom run box.toml --method guarded --dt 0.001 --out steps", "by time steps, to compare with"},
    {"carom run box.toml --time 1e6 --walltime 2h --out long", "stop and save after two hours"},
}};
constexpr std::array<Example, 1> resume_examples = {{
    {"carom resume long", "continue the run that was stopped"},
}};
constexpr std::array<Example, 2> extend_examples = {{
    {"carom run box.toml --checkpoint-every 10min --out kept", "a run that can be extended"},
    {"carom extend kept --time 6", "continue it, when it has ended, to the time 6"},
}};
constexpr std::array<Example, 3> info_examples = {{
    {"carom info box", "describe the run"},
    {"carom info box/trajectory.h5md", "describe one of its files"},
    {"carom info box --reproduce", "print the commands that make it again"},
}};
constexpr std::array<Example, 1> verify_examples = {{
    {"carom verify box", "run its scene again and compare every bit"},
}};
constexpr std::array<Example, 2> playground_examples = {{
    {"carom playground --open", "write playground.html and open it"},
    {"carom playground box.toml -o mine.html", "with a scene of your own in front"},
}};
constexpr std::array<Example, 2> analyze_examples = {{
    {"carom analyze box temperature speeds", "measure these observables from the stored samples"},
    {"carom analyze box 'speeds={ bins = 30 }' --out speeds", "with settings, as in [observe]"},
}};
constexpr std::array<Example, 1> diff_examples = {{
    {"carom diff box box-2", "say where the two runs part"},
}};
constexpr std::array<Example, 2> play_examples = {{
    {"carom play box", "write box/player.html"},
    {"carom play box -o box.html --open", "write it elsewhere and open it"},
}};
constexpr std::array<Example, 2> report_examples = {{
    {"carom report box", "write box/report.html"},
    {"carom report box --open", "and open it in a browser"},
}};
constexpr std::array<Example, 3> movie_examples = {{
    {"carom movie box", "write the film box/movie.mp4"},
    {"carom movie box -o box.gif --size 320 --speed 1 --trails 0.2", "a small one with trails, for a page"},
    {"carom movie box -o moment.png --at 1.5", "a picture of one moment"},
}};
constexpr std::array<Example, 1> horizon_examples = {{
    {"carom horizon box.toml", "say how long the trajectory is right"},
}};
constexpr std::array<Example, 3> compare_examples = {{
    {"carom compare box.toml --dt 0.01", "the error of one time step, in some seconds"},
    {"carom compare box.toml --out whole", "the whole study, in a minute or two"},
    {"carom compare box.toml --trajectory mine.npy --every 0.01", "a trajectory of your own"},
}};
constexpr std::array<Example, 3> sweep_examples = {{
    {"carom sweep density.toml", "run all that is not finished, on all processors"},
    {"carom sweep density.toml --threads 1 --json", "one run at a time; print the results as JSON"},
    {"carom sweep density.toml --set run.time=2 --out longer", "with another value at every point"},
}};
constexpr std::array<Example, 2> bench_examples = {{
    {"carom bench", "measure with 1000, 10000 and 100000 disks"},
    {"carom bench --disks 1000 --collisions 20000", "a short measurement"},
}};
constexpr std::array<Example, 3> hardcases_examples = {{
    {"carom hardcases --list", "list the cases"},
    {"carom hardcases wall_and_lower_disk_at_once", "run one in every engine"},
    {"carom hardcases --show wall_and_lower_disk_at_once", "print its text"},
}};
constexpr std::array<Example, 3> validate_examples = {{
    {"carom validate", "all quick checks, in one to two minutes"},
    {"carom validate --list", "list the trials"},
    {"carom validate --only reversal-frozen --out one", "run one of them"},
}};
constexpr std::array<Example, 2> help_examples = {{
    {"carom help", "list all commands"},
    {"carom help run", "explain one of them"},
}};
constexpr std::array<Example, 1> man_examples = {{
    {"carom man run", "show the manual page carom-run(1)"},
}};
constexpr std::array<Example, 3> completion_examples = {{
    {"source <(carom completion bash)", "in ~/.bashrc"},
    {"carom completion zsh > _carom", "in a directory of $fpath"},
    {"carom completion fish > carom.fish", "in ~/.config/fish/completions"},
}};

constexpr std::array<ExamplesOf, 22> all_examples = {{
    {"init", init_examples},         {"check", check_examples},
    {"run", run_examples},           {"resume", resume_examples},
    {"extend", extend_examples},     {"info", info_examples},
    {"verify", verify_examples},     {"playground", playground_examples},
    {"analyze", analyze_examples},   {"diff", diff_examples},
    {"play", play_examples},         {"report", report_examples},
    {"movie", movie_examples},       {"horizon", horizon_examples},
    {"compare", compare_examples},   {"sweep", sweep_examples},
    {"bench", bench_examples},       {"hardcases", hardcases_examples},
    {"validate", validate_examples}, {"help", help_examples},
    {"man", man_examples},           {"completion", completion_examples},
}};

}  // namespace

std::span<const Example> examples_of(std::string_view command) {
  const auto* const found = std::ranges::find(all_examples, command, &ExamplesOf::first);
  return found == all_examples.end() ? std::span<const Example>() : found->second;
}

std::string_view heading_of(const OptionInfo& option) {
  for (const Heading& heading : all_headings)
    if (heading.options.find(" " + option.name() + " ") != std::string_view::npos) return heading.title;
  return of_the_command;
}

std::vector<std::string_view> headings() {
  std::vector<std::string_view> titles;
  for (const Heading& heading : all_headings) titles.push_back(heading.title);
  return titles;
}

const CommandInfo* find_command(std::span<const CommandInfo> commands, std::string_view name) {
  const auto found = std::ranges::find(commands, name, &CommandInfo::name);
  return found == commands.end() ? nullptr : &*found;
}

const OptionInfo* find_option(const CommandInfo& command, std::string_view name) {
  const auto found = std::ranges::find_if(
      command.options, [&](const OptionInfo& option) { return std::ranges::find(option.names, name) != option.names.end(); });
  return found == command.options.end() ? nullptr : &*found;
}

}  // namespace carom::cli
