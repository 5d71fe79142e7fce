#include "app/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <vector>

namespace carom::cli {

namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// Text that begins no macro and means itself.
std::string plain(const std::string& text) {
  std::string safe;
  for (const char sign : text) {
    if (sign == '\\') {
      safe += "\\e";
    } else if (sign == '-') {
      safe += "\\-";
    } else if (sign == '\'' || (sign == '.' && safe.empty())) {
      safe += sign == '\'' ? "\\(aq" : "\\&.";
    } else {
      safe += sign;
    }
  }
  return safe;
}

/// Returns text such as "-q, --quiet" or "--out DIR"; for what is no option, its place: "SCENE"
std::string usage_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("\\fB" + plain("-" + name) + "\\fR");
  for (const std::string& name : option.get_lnames()) names.push_back("\\fB" + plain("--" + name) + "\\fR");
  const std::string type = option.get_type_name().empty() ? "" : "\\fI" + plain(option.get_type_name()) + "\\fR";
  if (names.empty()) return type;
  return fmt::format("{}{}{}", fmt::join(names, ", "), type.empty() ? "" : " ", type);
}

std::string command_text(const CLI::App& command) {
  std::string text = fmt::format(".SS \\fBcarom {}\\fR\n{}.\n", plain(command.get_name()), plain(command.get_description()));
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty() && option != command.get_help_ptr())
      text += fmt::format(".TP\n{}\n{}\n", usage_of(*option), plain(option->get_description()));
  return text;
}

}  // namespace

std::string manual_page(const CLI::App& program, const std::string& version) {
  std::string text = fmt::format(
      ".TH CAROM 1 \"\" \"carom {}\" \"User Commands\"\n.SH NAME\ncarom \\- event\\-driven molecular dynamics of hard disks\n"
      ".SH SYNOPSIS\n.B carom\n.I COMMAND\n.RI [ OPTIONS ]\n.SH DESCRIPTION\n\\fBcarom\\fR \\fICOMMAND\\fR \\fB\\-\\-help\\fR "
      "says the same of one command.\n.SH COMMANDS\n",
      version);
  for (const CLI::App* command : commands_of(program)) text += command_text(*command);
  text +=
      ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nfailed while running, or two runs differ (diff)\n.TP\n2\nthe command line, the "
      "scene or the place for results "
      "is wrong; "
      "nothing was run\n.TP\n3\nthe state is invalid: disks overlap\n.TP\n4\na check of the physics failed, or a run repeated "
      "differs (verify)\n.TP\n130\ninterrupted; "
      "what was done until then is saved\n"
      ".SH SIGNALS\nSIGINT (Ctrl\\-C), SIGTERM, SIGHUP, SIGXCPU and SIGUSR1 ask a run or a study to stop: it saves what was "
      "done, and ends with exit status 130. A second SIGINT or SIGTERM, half a second or more after the first, ends it at once. "
      "What is ignored when the program is started, as SIGHUP is by\n.BR nohup (1),\nstays ignored.\n"
      ".SH FILES\nExample scenes are in the directory share/carom/scenes of the installation; \\fBcarom init \\-\\-list\\fR "
      "names those that it can write.\n";
  return text;
}

std::string bash_completion(const CLI::App& program) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* command : commands_of(program)) {
    names.push_back(command->get_name());
    std::vector<std::string> options;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    cases += fmt::format("    {}) options=\"{}\" ;;\n", command->get_name(), fmt::join(options, " "));
  }
  return fmt::format(R"(# bash completion for carom
_carom() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} options=""
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "{} --help --version" -- "$word")
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F _carom carom
)",
                     fmt::join(names, " "), cases);
}

}  // namespace carom::cli
