#pragma once
// The commands and their options as plain data, of which the help, the manual pages, the completion and the suggestions are made.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom::cli {

struct OptionInfo {
  std::vector<std::string> names;  ///< "-q", "--quiet"; empty for an argument, which is told by its place
  std::string value;               ///< kind of the value, "DIR"; empty for a flag
  std::string description;
  bool is_required = false;
  bool is_many = false;            ///< may be given several times
  bool is_value_optional = false;  ///< the name alone says something too

  [[nodiscard]] bool is_argument() const { return names.empty(); }
  /// Returns the name with two dashes, by which it is called here.
  [[nodiscard]] const std::string& name() const { return names.back(); }
};

struct Example {
  std::string_view line;  ///< "carom run box.toml"
  std::string_view what;  ///< what it does
};

struct CommandInfo {
  std::string name;
  std::string description;
  std::string group;  ///< its heading in the list of commands; empty for one that is not listed
  std::string note;   ///< what follows the options; empty mostly
  std::vector<OptionInfo> options;
  std::span<const Example> examples;
};

/// Returns examples of a command. Each works in a directory where those of `carom init` and `carom run` have been carried out.
[[nodiscard]] std::span<const Example> examples_of(std::string_view command);

/// Returns the heading under which an option stands in the help, the same for every command: "Results" for "--out".
[[nodiscard]] std::string_view heading_of(const OptionInfo& option);
/// All headings, in the order of the help.
[[nodiscard]] std::vector<std::string_view> headings();

/// Returns the command of this name, or null.
[[nodiscard]] const CommandInfo* find_command(std::span<const CommandInfo> commands, std::string_view name);
/// Returns the option of a command with this name, "-o" or "--out", or null.
[[nodiscard]] const OptionInfo* find_option(const CommandInfo& command, std::string_view name);

/// Returns the words with their first letter in small, as a clause of a sentence.
[[nodiscard]] std::string in_small(std::string words);

/// Returns what bare `carom` prints: the commands to begin with.
[[nodiscard]] std::string overview(std::span<const CommandInfo> commands);
/// Returns what `carom help` prints: all commands by purpose.
[[nodiscard]] std::string list_of_commands(std::span<const CommandInfo> commands);
/// Returns what `carom help COMMAND` prints.
[[nodiscard]] std::string help_of(const CommandInfo& command);

/// Returns the manual page carom(1), in the macros of man(7).
[[nodiscard]] std::string manual_page(std::span<const CommandInfo> commands, const std::string& version);
/// Returns the manual page of one command, such as carom-run(1).
[[nodiscard]] std::string manual_page(const CommandInfo& command, const std::string& version);

/// The shells whose words Carom completes.
[[nodiscard]] std::vector<std::string> completed_shells();
/// Returns the script by which the shell asks `carom complete` for words.
[[nodiscard]] std::string completion_script(std::string_view shell);
/// Returns the words that may stand where the last of `words` is being typed, which follow the name of the program. Each line is
/// a word and, behind a tab, what it means; a word that ends in "=" is continued. A line ":files toml" asks for files of these
/// endings and directories, ":files" for any file, ":directories" for directories; ":directory NAME" is one of them.
[[nodiscard]] std::string completions(std::span<const CommandInfo> commands, const std::vector<std::string>& words);

/// Returns the clause that says what was meant by a word that is no command: "did you mean carom run?"
[[nodiscard]] std::string meant_command(std::span<const CommandInfo> commands, const std::vector<std::string>& words);
/// Returns the clause that says what was meant by an option that the command does not have. `word` has no dashes.
[[nodiscard]] std::string meant_option(const CommandInfo& command, std::string_view word);
/// Returns the clause that says what was meant by an option where a command is expected. `word` has no dashes.
[[nodiscard]] std::string meant_before_a_command(std::span<const CommandInfo> commands, std::string_view word);

}  // namespace carom::cli
