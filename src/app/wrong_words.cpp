// What was meant by words that the command line does not know: a letter too few, the word of another program, or a scene in the
// place of a command.

#include "app/command_info.hpp"
#include "app/commands.hpp"
#include "scene/document.hpp"
#include "scene/known_keys.hpp"
#include "text/numbers.hpp"
#include "text/shell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace carom::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> words_for_commands = {{
    {"run", " start exec execute simulate simulation sim "},
    {"init", " new create template example examples preset presets scene scenes "},
    {"report", " plot plots page html summary results "},
    {"movie", " film video animate animation render draw picture image mp4 gif png "},
    {"play", " player view viewer show replay watch "},
    {"resume", " continue restart recover "},
    {"check", " lint test dry-run "},
    {"info", " describe inspect stat ls list "},
}};

/// Words of other programs for options; what scenes call so, known_keys.hpp knows.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> words_for_options = {{
    {"out", " output output-dir outdir dir directory o "},
    {"quiet", " silent q "},
    {"threads", " jobs j nthreads num-threads cores np nproc "},
    {"force", " overwrite f replace "},
    {"seed", " random-seed rng-seed s "},
    {"verbose", " debug v "},
    {"time", " t T end until t-end tend t-max tmax t-final tfinal end-time duration "},
}};

template <class Table>
std::string_view known_word(const Table& table, std::string_view word) {
  const std::string wanted = fmt::format(" {} ", word);
  for (const auto& [meant, words] : table)
    if (words.find(wanted) != std::string_view::npos) return meant;
  return {};
}

std::string nearest_of(const std::string& word, const std::vector<std::string>& words) {
  return std::string(detail::nearest_word(word, std::vector<std::string_view>(words.begin(), words.end())));
}

bool is_sweep(const std::string& path) {
  try {
    return detail::parse_toml(detail::read_text_file(path), path).contains("scene");
  } catch (const std::exception&) {
    return false;
  }
}

/// Returns what a path may be meant for; empty for a word that is none.
std::string meant_path(const std::vector<std::string>& words) {
  const std::string& word = words.front();
  std::vector<std::string> quoted;
  for (const std::string& each : words) quoted.push_back(shell_quoted(each));
  std::error_code error;
  if (word.ends_with(".toml"))
    return is_sweep(word) ? fmt::format("carom sweep {} runs a sweep", fmt::join(quoted, " "))
                          : fmt::format("carom run {} runs a scene", fmt::join(quoted, " "));
  if (fs::exists(fs::path(word) / "summary.json", error))
    return fmt::format("carom report {} writes a page about a run", quoted[0]);
  if (fs::is_regular_file(word, error)) return fmt::format("carom info {} describes a file", quoted[0]);
  return {};
}

}  // namespace

std::string meant_command(std::span<const CommandInfo> commands, const std::vector<std::string>& words) {
  const std::string& word = words.front();
  if (const std::string path = meant_path(words); !path.empty()) return path;
  if (const std::string_view meant = known_word(words_for_commands, word); !meant.empty())
    return fmt::format("did you mean carom {}?", meant);
  std::vector<std::string> listed;
  for (const CommandInfo& command : commands)
    if (!command.group.empty()) listed.push_back(command.name);
  if (const std::string near = nearest_of(word, listed); !near.empty()) return fmt::format("did you mean carom {}?", near);
  return fmt::format("choose one of: {}", fmt::join(listed, ", "));
}

std::string meant_option(const CommandInfo& command, std::string_view word) {
  std::vector<std::string> known;
  for (const OptionInfo& option : command.options)
    for (const std::string& name : option.names)
      if (name.starts_with("--")) known.push_back(name.substr(2));
  const auto has = [&](std::string_view name) { return std::ranges::find(known, name) != known.end(); };
  if (has(word)) return fmt::format("did you mean --{}?", word);  // with one dash
  if (const std::string_view meant = known_word(words_for_options, word); has(meant))
    return fmt::format("did you mean --{}?", meant);
  const bool changes_scenes = has("set");
  if (changes_scenes) {
    if (const std::string key = detail::dotted_key_for(word); !key.empty())
      return fmt::format("a key of the scene is changed with --set {}=...", key);
    if (const std::string_view clause = detail::meant_by(word); !clause.empty()) return std::string(clause);
  }
  std::vector<std::string> beginning;
  for (const std::string& name : known)
    if (word.size() > 1 && name.starts_with(word)) beginning.push_back(name);
  if (beginning.size() == 1) return fmt::format("did you mean --{}?", beginning.front());
  const std::string near = nearest_of(std::string(word), known);
  if (!near.empty() && 3 * detail::edit_distance(word, near) <= word.size())  // --out is not meant by --count
    return fmt::format("did you mean --{}?", near);
  if (changes_scenes) return "what a scene says is changed with --set, such as --set run.time=5";
  return fmt::format("carom {} --help lists them", command.name);
}

std::string meant_before_a_command(std::span<const CommandInfo> commands, std::string_view word) {
  for (const std::string_view own : {"help", "version"})
    if (word.size() > 1 && (own.starts_with(word) || detail::edit_distance(word, own) <= 2))
      return fmt::format("did you mean carom --{}?", own);
  const CommandInfo* run = find_command(commands, "run");
  std::string option;
  if (run != nullptr) {
    const std::string meant = meant_option(*run, word);
    if (const std::size_t at = meant.find("did you mean --"); at == 0) option = " " + meant.substr(13, meant.size() - 14);
  }
  return fmt::format("name a command first, such as carom run box.toml{}; carom help lists them", option);
}

}  // namespace carom::cli
