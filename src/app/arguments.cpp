// The command line, read as a whole before anything is done.

#include "app/arguments.hpp"

#include "app/command_info.hpp"
#include "app/command_options.hpp"
#include "app/manual_viewer.hpp"
#include "text/numbers.hpp"
#include "text/shell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <carom/version.hpp>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

namespace carom::cli {

namespace {

std::string version() {
  const BuildInfo& build = build_info();
  return fmt::format("carom {} (commit {}; {}; {})", build.version, build.commit, build.compiler, build.flags);
}

/// Returns the program's name as the user typed it, or where that is a long path, its path from here.
Invocation invocation_of(int argc, char** argv) {
  Invocation invocation{.program = argc > 0 ? argv[0] : "carom", .command_line = ""};
  for (int i = 0; i < argc; ++i) invocation.command_line += (i > 0 ? " " : "") + shell_quoted(argv[i]);
  if (invocation.program.find('/') != std::string::npos) {
    std::error_code error;
    const std::string relative = std::filesystem::proximate(invocation.program, error).string();
    if (!error && relative.size() < invocation.program.size()) {
      invocation.program = relative.find('/') == std::string::npos ? "./" + relative : relative;
    }
  }
  invocation.program = shell_quoted(invocation.program);
  return invocation;
}

OptionInfo info_of(const CLI::Option& option) {
  OptionInfo info{.names = {},
                  .value = option.get_type_name(),
                  .description = option.get_description(),
                  .is_required = option.get_required(),
                  .is_many = option.get_items_expected_max() > 1,
                  .is_value_optional = option.get_items_expected_min() == 0 && option.get_items_expected_max() > 0};
  for (const std::string& name : option.get_snames()) info.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames())
    if (name != "output") info.names.push_back("--" + name);  // what --out was called in 0.1
  return info;
}

std::vector<CommandInfo> commands_of(const CLI::App& program) {
  std::vector<CommandInfo> commands;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    CommandInfo info{.name = command->get_name(),
                     .description = command->get_description(),
                     .group = command->get_group(),
                     .note = command->get_footer(),
                     .options = {},
                     .examples = examples_of(command->get_name())};
    for (const CLI::Option* option : command->get_options())
      if (option != command->get_help_ptr()) info.options.push_back(info_of(*option));
    commands.push_back(std::move(info));
  }
  return commands;
}

/// Returns an action that prints the text.
Action printing(std::string text) {
  return [text = std::move(text)] {
    fmt::print("{}", text);
    return exit_done;
  };
}

const CommandInfo& command_called(const std::vector<CommandInfo>& commands, const std::string& name) {
  const CommandInfo* command = find_command(commands, name);
  if (command == nullptr)
    throw UsageError(fmt::format("{}: there is no such command; {}", name, meant_command(commands, {name})));
  return *command;
}

/// Adds the commands that explain the others.
void add_help(CLI::App& program, Action& action) {
  const auto commands = [&program] { return commands_of(program); };
  CLI::App* help = program.add_subcommand("help", "Explain a command, or list all")->group("Help");
  const auto about = std::make_shared<std::string>();
  help->add_option("command", *about, "The command to explain")->type_name("COMMAND");
  help->callback([=, &action] {
    action = printing(about->empty() ? list_of_commands(commands()) : help_of(command_called(commands(), *about)));
  });

  CLI::App* man = program.add_subcommand("man", "Show the manual page of the program, or of a command")->group("Help");
  const auto page = std::make_shared<std::string>();
  const auto directory = std::make_shared<std::string>();
  man->add_option("command", *page, "The command (default: the page of the whole program)")->type_name("COMMAND");
  man->add_option("-o,--out", *directory, "Write all pages to this directory instead, such as carom-run.1")->type_name("DIR");
  man->callback([=, &action] {
    const std::string& version = build_info().version;
    const auto text = [&](const std::string& name) {
      return name.empty() ? manual_page(commands(), version) : manual_page(command_called(commands(), name), version);
    };
    if (directory->empty()) {
      action = [words = text(*page)] { return show_manual_page(words); };
      return;
    }
    std::vector<ManualPage> pages = {{"carom.1", text("")}};
    for (const CommandInfo& command : commands())
      if (!command.group.empty()) pages.push_back({fmt::format("carom-{}.1", command.name), text(command.name)});
    action = [pages, directory] { return write_manual_pages(*directory, pages); };
  });

  CLI::App* completion = program.add_subcommand("completion", "Print what a shell needs to complete words")->group("Help");
  const auto shell = std::make_shared<std::string>("bash");
  completion->add_option("shell", *shell, "bash (default), zsh or fish")->type_name("SHELL");
  completion->callback([=, &action] { action = printing(completion_script(*shell)); });

  program.add_subcommand("version", "Name the build, as --version does")->group("")->callback([&action] {
    action = printing(version() + "\n");
  });
}

/// Throws UsageError for options that a command does not have: the parser would name only the unknown one.
void require_known_options(const CommandInfo& command, const std::vector<std::string>& words) {
  std::string letters;
  for (const OptionInfo& option : command.options)
    for (const std::string& name : option.names)
      if (name.size() == 2) letters += name[1];
  for (std::size_t k = 1; k < words.size(); ++k) {
    const std::string& word = words[k];
    if (word == "--") return;
    if (word.size() < 2 || word[0] != '-' || std::isdigit(static_cast<unsigned char>(word[1])) != 0 || word[1] == '.') continue;
    const std::string name = word.substr(0, word.find('='));
    const bool known = name == "--help" || name == "--output" || find_option(command, name) != nullptr;
    const bool is_letters = word[1] != '-' && (letters.find(word[1]) != std::string::npos || word[1] == 'h');
    if (known || is_letters) continue;
    throw UsageError(fmt::format("{}: carom {} has no such option; {}", name, command.name,
                                 meant_option(command, name.substr(name[1] == '-' ? 2 : 1))));
  }
}

/// Returns the first line among the command's examples that begins with the command itself.
std::string example_of(const CommandInfo& command) {
  const std::string beginning = "carom " + command.name;
  for (const Example& example : command.examples)
    if (example.line.starts_with(beginning)) return std::string(example.line);
  return beginning;
}

/// Returns the text between two marks of the parser's message; what is behind the first where the second is empty.
std::string between(const std::string& text, std::string_view first, std::string_view second) {
  const std::size_t mark = text.find(first);
  if (mark == std::string::npos) return {};
  const std::size_t begin = mark + first.size();
  return text.substr(begin, second.empty() ? std::string::npos : text.find(second, begin) - begin);
}

/// Returns the first of the words that no argument of the command is left for.
std::string first_extra(const CLI::App& program, const std::vector<std::string>& words) {
  const std::vector<std::string> extras = program.remaining(true);
  const auto found =
      std::ranges::find_if(words, [&](const std::string& word) { return std::ranges::find(extras, word) != extras.end(); });
  return found == words.end() ? std::string() : *found;
}

/// Refuses values that are there and say nothing, as of a variable of a shell that was never set: the parser takes them for
/// options that were not given.
void require_values(const CommandInfo& command, const std::vector<std::string>& words) {
  for (std::size_t k = 1; k < words.size(); ++k) {
    if (words[k] == "--") return;
    const bool ends_at_once = words[k].ends_with('=');
    if (!ends_at_once && (k + 1 == words.size() || !words[k + 1].empty())) continue;
    const std::string name = ends_at_once ? words[k].substr(0, words[k].size() - 1) : words[k];
    if (const OptionInfo* const option = find_option(command, name); option != nullptr && !option->value.empty())
      throw UsageError(fmt::format("{0}: its value is empty; give {0} {1}, or leave {0} out", name, option->value));
  }
}

/// Returns what is wrong with a command line, where the parser does not take it and all its options are known. The parser's own
/// messages name the option and hold the value; everything else in them is for programmers.
std::string sentence_of(const CLI::ParseError& error, const CLI::App& program, const CommandInfo& command,
                        const std::vector<std::string>& words) {
  const std::string message = error.what();
  const auto option_called = [&](const std::string& name) {
    const OptionInfo* const found = find_option(command, name);
    return found == nullptr ? OptionInfo{} : *found;
  };
  const std::string explained = fmt::format("carom help {} explains it", command.name);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    const CLI::Option* missing = program.get_subcommand(command.name)->get_option_no_throw(between(message, "", " is required"));
    if (missing != nullptr)
      return fmt::format("{}: {} is missing, {}; for example: {}", command.name, missing->get_type_name(),
                         in_small(missing->get_description()), example_of(command));
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const std::string extra = first_extra(program, words);
    std::vector<std::string> arguments;
    for (const OptionInfo& option : command.options)
      if (option.is_argument()) arguments.push_back(option.value);
    const std::string takes = arguments.empty() ? "no arguments" : fmt::format("only {}", fmt::join(arguments, " "));
    const bool is_change = extra.find('=') != std::string::npos && !option_called("--set").names.empty();
    return fmt::format("{}: carom {} takes {}; {}", extra, command.name, takes,
                       is_change ? fmt::format("did you mean --set {}?", shell_quoted(extra))
                                 : fmt::format("carom help {} lists its options", command.name));
  }
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
    const std::string name = between(message, "Could not convert: ", " = ");
    const OptionInfo option = option_called(name);
    if (option.value.empty()) return fmt::format("{}: it takes no value; {}", name, explained);
    return fmt::format("{} {}: {} must be a number{}", name, between(message, " = ", ""), option.value,
                       option.value == "N" ? ", such as 10" : ", such as 0.5");
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    const std::string name = between(message, "", ":");
    if (message.find("At Most") != std::string::npos) return fmt::format("{}: it is given more than once; give it once", name);
    const OptionInfo option = option_called(name);
    return fmt::format("{}: its value is missing, {} {}; {}", name, name, option.value, in_small(option.description));
  }
  if (dynamic_cast<const CLI::ValidationError*>(&error) != nullptr && message.find(" not in range ") != std::string::npos) {
    const std::string name = between(message, "", ":");
    return fmt::format("{} {}: {} must be a whole number from {}", name, between(message, "Value ", " not in range "),
                       option_called(name).value, between(message, " not in range ", ""));
  }
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr)
    return fmt::format("{} and {} exclude each other; give one of them", between(message, "", " excludes "),
                       between(message, " excludes ", ""));
  if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr)
    return fmt::format("{}: it is for {} alone; give that too", between(message, "", " requires "),
                       between(message, " requires ", ""));
  return fmt::format("{} ({})", message, explained);
}

}  // namespace

Action parse_arguments(int argc, char** argv) {
  CLI::App program("Carom: event-driven molecular dynamics of hard disks", "carom");
  const Invocation invocation = invocation_of(argc, argv);
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  Action action;
  program.set_version_flag("--version", version());
  program.require_subcommand(1);
  program.formatter_fn([](const CLI::App* of, const std::string&, CLI::AppFormatMode) {
    const std::vector<CommandInfo> commands = commands_of(of->get_parent() == nullptr ? *of : *of->get_parent());
    return of->get_parent() == nullptr ? list_of_commands(commands) : help_of(command_called(commands, of->get_name()));
  });
  add_commands(program, action, invocation);
  add_help(program, action);
  const std::vector<CommandInfo> commands = commands_of(program);
  if (words.empty()) {
    return [text = overview(commands)] {
      fmt::print(stderr, "{}", text);
      return exit_usage;
    };
  }
  if (words.front() == "complete")  // what the shells' scripts ask
    return printing(completions(commands, {words.begin() + 1, words.end()}));
  const bool is_option = words.front().starts_with('-');
  if (!is_option && find_command(commands, words.front()) == nullptr)
    throw UsageError(fmt::format("{}: there is no such command; {}", words.front(), meant_command(commands, words)));
  if (!is_option) require_values(command_called(commands, words.front()), words);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help or --version
    std::ostringstream text;
    program.exit(asked, text, text);
    return printing(text.str());
  } catch (const CLI::ParseError& error) {
    if (is_option)
      throw UsageError(fmt::format(
          "{}: carom has no such option; {}", words.front(),
          meant_before_a_command(commands, std::string_view(words.front()).substr(words.front().starts_with("--") ? 2 : 1))));
    const CommandInfo& command = command_called(commands, words.front());
    require_known_options(command, words);
    throw UsageError(sentence_of(error, program, command, words));
  }
  return action;
}

}  // namespace carom::cli
