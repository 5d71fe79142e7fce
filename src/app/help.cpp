// The help of the program: the commands to begin with, all commands, and one command with its options.

#include "app/command_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace carom::cli {

namespace {

constexpr std::size_t line_width = 90;     ///< in characters
constexpr std::size_t option_column = 30;  ///< where descriptions of options begin

constexpr std::string_view program_title = "carom: event-driven molecular dynamics of hard disks\n";

/// Returns a left column of its own width, and the words beside it, broken at the end of a line.
std::string beside(const std::string& left, std::size_t column, std::string_view words) {
  std::string text = "  " + left;
  std::size_t at = text.size();
  if (at + 2 > column) {
    text += "\n";
    at = 0;
  }
  text += std::string(column - at, ' ');
  at = column;
  std::istringstream stream{std::string(words)};
  for (std::string word; stream >> word;) {
    if (at > column && at + 1 + word.size() > line_width) {
      text += "\n" + std::string(column, ' ');
      at = column;
    }
    if (at > column) {
      text += " ";
      ++at;
    }
    text += word;
    at += word.size();
  }
  return text + "\n";
}

std::string left_column(const OptionInfo& option) {
  if (option.is_argument()) return option.value;
  const std::string names =
      fmt::format("{}{}", option.names.front().starts_with("--") ? "    " : "", fmt::join(option.names, ", "));
  return option.value.empty() ? names : names + " " + option.value;
}

std::string usage_line(const CommandInfo& command) {
  std::string text = "usage: carom " + command.name;
  bool has_options = false;
  for (const OptionInfo& option : command.options) {
    has_options = has_options || !option.is_argument();
    if (!option.is_argument()) continue;
    const std::string many = option.value + (option.is_many ? "..." : "");
    text += option.is_required ? " " + many : " [" + many + "]";
  }
  return text + (has_options ? " [OPTIONS]\n" : "\n");
}

std::string examples_text(std::span<const Example> lines) {
  std::size_t longest = 0;
  for (const Example& example : lines) longest = std::max(longest, example.line.size());
  std::string text = "\nFor example:\n";
  const bool one_line = longest <= 52;
  for (const Example& example : lines) {
    text += one_line ? fmt::format("  {:<{}}   # {}\n", example.line, longest, example.what)
                     : fmt::format("  # {}\n  {}\n", example.what, example.line);
  }
  return text;
}

std::string command_rows(std::span<const CommandInfo> commands, std::string_view group) {
  std::string text;
  for (const CommandInfo& command : commands)
    if (command.group == group) text += beside(command.name, 14, command.description);
  return text;
}

}  // namespace

std::string in_small(std::string words) {
  if (!words.empty()) words.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(words.front())));
  return words;
}

std::string overview(std::span<const CommandInfo> commands) {
  constexpr std::array<std::string_view, 5> to_begin_with = {"init", "run", "play", "report", "sweep"};
  std::string text = fmt::format("{}\nusage: carom COMMAND [OPTIONS]\n\n", program_title);
  for (const std::string_view name : to_begin_with)
    if (const CommandInfo* command = find_command(commands, name)) text += beside(command->name, 14, command->description);
  const auto listed = std::ranges::count_if(commands, [](const CommandInfo& command) { return !command.group.empty(); });
  return text + fmt::format(
                    "\nFor example:\n"
                    "  carom init              # write box.toml, a scene to start from\n"
                    "  carom run box.toml      # run it and write box/\n"
                    "  carom report box        # write box/report.html, a page about the run\n\n"
                    "carom help lists all {} commands, carom help run explains one.\n",
                    listed);
}

std::string list_of_commands(std::span<const CommandInfo> commands) {
  std::string text = fmt::format("{}\nusage: carom COMMAND [OPTIONS]\n", program_title);
  std::vector<std::string> groups;
  for (const CommandInfo& command : commands)
    if (!command.group.empty() && std::ranges::find(groups, command.group) == groups.end()) groups.push_back(command.group);
  for (const std::string& group : groups) text += fmt::format("\n{}:\n{}", group, command_rows(commands, group));
  return text +
         "\nFor example:\n"
         "  carom init              # write box.toml, a scene to start from\n"
         "  carom run box.toml      # run it and write box/\n"
         "  carom report box        # write box/report.html, a page about the run\n\n"
         "carom help COMMAND, or carom COMMAND --help, explains a command; carom --version names the build.\n";
}

std::string help_of(const CommandInfo& command) {
  std::string text = fmt::format("carom {}: {}\n\n{}", command.name, in_small(command.description), usage_line(command));
  std::string arguments;
  for (const OptionInfo& option : command.options)
    if (option.is_argument()) arguments += beside(left_column(option), option_column, option.description);
  if (!arguments.empty()) text += "\nArguments:\n" + arguments;
  for (const std::string_view heading : headings()) {
    std::string options;
    for (const OptionInfo& option : command.options)
      if (!option.is_argument() && heading_of(option) == heading)
        options += beside(left_column(option), option_column, option.description);
    if (!options.empty()) text += fmt::format("\n{}:\n{}", heading, options);
  }
  if (!command.examples.empty()) text += examples_text(command.examples);
  if (!command.note.empty()) text += "\n" + command.note + "\n";
  return text;
}

}  // namespace carom::cli
