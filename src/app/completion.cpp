// Completion: the program itself says which words may follow, so that the scripts of all shells are short and know as much.

#include "app/command_info.hpp"
#include "app/movie_plan.hpp"
#include "scene/document.hpp"
#include "scene/excerpt.hpp"
#include "scene/observables_known.hpp"
#include "scene/presets.hpp"
#include "scene/value_text.hpp"
#include "studies/hard_cases/hard_case.hpp"
#include "studies/validate/trial.hpp"
#include "studies/validate/validation.hpp"

#include <fmt/format.h>
#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <stdexcept>

namespace carom::cli {

namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;

struct Candidate {
  std::string word;
  std::string meaning = {};
};

struct Candidates {
  std::vector<Candidate> words = {};
  std::string files = {};  ///< a line such as ":files toml"; empty where no file is meant
};

template <class Names>
Candidates candidates_of(const Names& names, std::initializer_list<const char*> before = {}) {
  Candidates found;
  for (const char* name : before) found.words.push_back({name});
  for (const auto& name : names) found.words.push_back({std::string(name)});
  return found;
}

Candidates presets() {
  Candidates found;
  for (const std::string& name : preset_names()) found.words.push_back({name, parse_scene(preset(name), name).title});
  return found;
}

Candidates listed_commands(std::span<const CommandInfo> commands) {
  Candidates found;
  for (const CommandInfo& command : commands)
    if (!command.group.empty()) found.words.push_back({command.name, command.description});
  return found;
}

Candidates colour_words() {
  Candidates found;
  for (const auto& [word, colouring] : colourings) found.words.push_back({std::string(word)});
  return found;
}

Candidates trials() {
  Candidates found;
  for (const validation::Trial& trial : validation::all_trials()) {
    const std::string group = group_in_one_word(trial.group);
    if (std::ranges::find(found.words, group, &Candidate::word) == found.words.end())
      found.words.push_back({group, "all trials of this group"});
    found.words.push_back({std::string(trial.name)});
  }
  return found;
}

Candidates cases() {
  Candidates found{.files = ":files toml"};
  for (const HardCase& one : hard_case_corpus()) found.words.push_back({one.name});
  return found;
}

void collect_keys(const toml::node& node, const std::string& path, Candidates& found) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      collect_keys(value, path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str()), found);
    return;
  }
  if (const toml::array* list = node.as_array(); list != nullptr && !list->empty() && list->front().is_table()) {
    for (std::size_t k = 0; k < list->size(); ++k) collect_keys((*list)[k], fmt::format("{}.{}", path, k), found);
    return;
  }
  found.words.push_back({path + "=", "now " + detail::excerpt(detail::value_text(node), 40)});
}

/// The keys of the scene that the words name, with every default, and what each is now.
Candidates keys_of_scene(const Words& words) {
  Candidates found;
  const auto path = std::ranges::find_if(words, [](const std::string& word) { return word.ends_with(".toml"); });
  if (path == words.end()) return found;
  try {
    Scene scene = load_scene(*path);
    for (Species& species : scene.species)
      if (species.count > 1000) return found;  // that many positions are not for a line of the terminal
    collect_keys(detail::parse_toml(resolved_toml(scene), *path), "", found);
  } catch (const std::exception&) {
    found.words.clear();  // a scene with a mistake has no keys to offer
  }
  return found;
}

/// True where carom run has written its files to a directory, or to one within it.
bool may_hold_a_run(const fs::path& directory) {
  std::error_code error;
  for (const char* file : {"summary.json", "checkpoint.h5"})
    if (fs::exists(directory / file, error)) return true;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, fs::directory_options::skip_permission_denied, error))
    if (entry.is_directory(error)) return true;
  return false;
}

/// The directories that begin as `typed` and may hold a run; all of them where there is none, or where the shell knows the place.
Candidates run_directories(const std::string& typed) {
  const std::string before = typed.substr(0, typed.rfind('/') + 1);
  std::vector<std::string> names;
  std::error_code error;
  if (!typed.starts_with('~'))
    for (const fs::directory_entry& entry : fs::directory_iterator(before.empty() ? "." : before, error)) {
      const std::string name = before + entry.path().filename().string();
      const bool is_hidden = entry.path().filename().string().starts_with('.');
      if (name.starts_with(typed) && !is_hidden && entry.is_directory(error) && may_hold_a_run(entry.path()))
        names.push_back(name);
    }
  std::ranges::sort(names);
  std::string lines;
  for (const std::string& name : names) lines += (lines.empty() ? ":directory " : "\n:directory ") + name;
  return {.files = names.empty() ? ":directories" : lines};
}

Candidates values_of(std::span<const CommandInfo> commands, const std::string& kind, const Words& words) {
  if (kind == "SCENE" || kind == "SWEEP" || kind == "FILE.toml") return {.files = ":files toml"};
  if (kind == "RUN_DIR") return run_directories(words.back());
  if (kind == "DIR") return {.files = ":directories"};
  if (kind == "FILE.html") return {.files = ":files html"};
  if (kind == "FILE" || kind == "RUN_A" || kind == "RUN_B") return {.files = ":files"};
  if (kind == "PRESET") return presets();
  if (kind == "ENGINE") return candidates_of(engine_names(), {"auto"});
  if (kind == "METHOD") return candidates_of(fixed_step_names(), {"exact"});
  if (kind == "[METHOD[:DT]]") return candidates_of(fixed_step_names());
  if (kind == "OBSERVABLE[={ every = 0.1 }]") return candidates_of(detail::names_of_observables());
  if (kind == "COLOUR") return colour_words();
  if (kind == "FAMILY") return candidates_of(hard_case_families());
  if (kind == "CASE") return {.words = cases().words};
  if (kind == "CASE|FILE.toml") return cases();
  if (kind == "TRIAL") return trials();
  if (kind == "WHEN") return candidates_of(Words{"auto", "always", "never"});
  if (kind == "COMMAND") return listed_commands(commands);
  if (kind == "SHELL") return candidates_of(completed_shells());
  if (kind == "KEY=VALUE") return keys_of_scene(words);
  return {};
}

Candidates options_of(const CommandInfo& command, const Words& words) {
  Candidates found;
  for (const OptionInfo& option : command.options) {
    if (option.is_argument()) continue;
    const bool given = std::ranges::any_of(
        words, [&](const std::string& word) { return std::ranges::find(option.names, word) != option.names.end(); });
    if (!given || option.is_many) found.words.push_back({option.name(), option.description});
  }
  found.words.push_back({"--help", "Explain this command"});
  return found;
}

/// Returns what may stand where the last of the words is typed. `typed` becomes the part of it that is to be completed.
Candidates candidates_for(std::span<const CommandInfo> commands, const Words& words, std::string& typed) {
  if (words.size() < 2) {
    if (typed.starts_with('-')) return candidates_of(Words{"--help", "--version"});
    return listed_commands(commands);
  }
  const CommandInfo* command = find_command(commands, words.front());
  if (command == nullptr) return {};
  std::size_t arguments = 0;
  const OptionInfo* open = nullptr;  // the option whose value is next
  for (std::size_t k = 1; k + 1 < words.size(); ++k) {
    const OptionInfo* before = open;
    open = nullptr;
    if (words[k].starts_with('-') && words[k].size() > 1) {
      const OptionInfo* option = find_option(*command, words[k]);
      if (option != nullptr && !option->value.empty()) open = option;
    } else if (before == nullptr) {
      ++arguments;
    }
  }
  if (open != nullptr && !(open->is_value_optional && typed.starts_with('-'))) return values_of(commands, open->value, words);
  if (const std::size_t sign = typed.find('='); typed.starts_with("--") && sign != std::string::npos) {
    const OptionInfo* option = find_option(*command, typed.substr(0, sign));
    if (option == nullptr) return {};
    const std::string name = typed.substr(0, sign + 1);
    Candidates found = values_of(commands, option->value, words);
    for (Candidate& candidate : found.words) candidate.word = name + candidate.word;
    return found;
  }
  if (typed.starts_with('-')) return options_of(*command, words);
  for (const OptionInfo& option : command->options) {
    if (!option.is_argument()) continue;
    if (arguments == 0 || option.is_many) return values_of(commands, option.value, words);
    --arguments;
  }
  return {};
}

}  // namespace

std::string completions(std::span<const CommandInfo> commands, const std::vector<std::string>& words) {
  std::string typed = words.empty() ? "" : words.back();
  const Candidates found = candidates_for(commands, words, typed);
  std::string text = found.files.empty() ? "" : found.files + "\n";
  for (const Candidate& candidate : found.words)
    if (candidate.word.starts_with(typed))
      text += candidate.meaning.empty() ? candidate.word + "\n" : fmt::format("{}\t{}\n", candidate.word, candidate.meaning);
  return text;
}

std::vector<std::string> completed_shells() { return {"bash", "zsh", "fish"}; }

namespace {

// Bash takes = for the end of a word, so that words are put together again for the program, and answers cut.
constexpr const char* for_bash = R"script(# bash completion for carom
_carom() {
  local word typed cut= line kind joined=
  local -a words=() files=()
  add_files() {
    compopt -o filenames 2>/dev/null
    mapfile -t files < <(compgen "$@" -- "${typed#"$cut"}")
    COMPREPLY+=("${files[@]}")
  }
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
    if [[ $word == "=" || $joined ]]; then words[${#words[@]}-1]+=$word; else words+=("$word"); fi
    if [[ $word == "=" ]]; then joined=yes; else joined=; fi
  done
  typed=${words[${#words[@]}-1]}
  if [[ $typed == *=* && $COMP_WORDBREAKS == *=* ]]; then cut=${typed%=*}=; fi
  COMPREPLY=()
  while IFS= read -r line; do
    case $line in
      :directories) add_files -d ;;
      :directory\ *)
        compopt -o filenames 2>/dev/null
        COMPREPLY+=("${line#:directory }") ;;
      :files) add_files -f ;;
      :files\ *)
        add_files -d
        for kind in ${line#:files }; do add_files -f -X "!*.$kind"; done ;;
      *)
        word=${line%%$'\t'*}
        if [[ $word == *= ]]; then compopt -o nospace 2>/dev/null; fi
        COMPREPLY+=("${word#"$cut"}") ;;
    esac
  done < <("${1/#\~/$HOME}" complete "${words[@]}" 2>/dev/null)
  unset -f add_files
}
complete -F _carom carom
)script";

constexpr const char* for_zsh = R"script(#compdef carom
# zsh completion for carom
_carom() {
  local line word
  local -a kinds plain shown open open_shown directories
  for line in "${(@f)$("${(Q)words[1]}" complete "${(@Q)words[2,CURRENT]}" 2>/dev/null)}"; do
    case "$line" in
      ("") ;;
      (:directories) _files -/ ;;
      (:directory *) directories+=("${line#:directory }") ;;
      (:files) _files ;;
      (:files*)
        kinds=(${(s: :)${line#:files }})
        _files -g "*.(${(j:|:)kinds})" ;;
      (*)
        word=${line%%$'\t'*}
        if [[ $word == *= ]]; then
          open+=("$word")
          open_shown+=("${line/$'\t'/  -- }")
        else
          plain+=("$word")
          shown+=("${line/$'\t'/  -- }")
        fi ;;
    esac
  done
  if (( $#directories )); then compadd -f -q -S / -a directories; fi
  if (( $#plain )); then compadd -l -d shown -a plain; fi
  if (( $#open )); then compadd -l -S "" -d open_shown -a open; fi
}
if [[ $funcstack[1] == _carom ]]; then _carom "$@"; else compdef _carom carom; fi
)script";

constexpr const char* for_fish = R"script(# fish completion for carom
function __carom_complete
  set -l typed (commandline -ct)
  set -l words (commandline -opc) $typed
  test (count $typed) -eq 0; and set -a words ''
  for line in (command $words[1] complete $words[2..-1] 2>/dev/null)
    switch "$line"
      case ':directories'
        __fish_complete_directories $typed
      case ':directory *'
        string replace ':directory ' '' -- $line/
      case ':files'
        __fish_complete_path $typed
      case ':files *'
        __fish_complete_directories $typed
        for kind in (string split ' ' -- (string replace ':files ' '' -- $line))
          for file in $typed*.$kind
            echo $file
          end
        end
      case '*'
        echo $line
    end
  end
end
complete -c carom -f -a '(__carom_complete)'
)script";

}  // namespace

std::string completion_script(std::string_view shell) {
  if (shell == "bash") return for_bash;
  if (shell == "zsh") return for_zsh;
  if (shell == "fish") return for_fish;
  throw UsageError(fmt::format("{}: carom completes words for bash, zsh and fish; name one of these", shell));
}

}  // namespace carom::cli
