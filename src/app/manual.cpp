// The manual pages, made of the commands so that they leave nothing out.

#include "app/command_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

namespace carom::cli {

namespace {

/// Text that begins no macro and means itself.
std::string plain(std::string_view text) {
  std::string safe;
  for (const char sign : text) {
    if (sign == '\\') {
      safe += "\\e";
    } else if (sign == '-') {
      safe += "\\-";
    } else if (sign == '~') {
      safe += "\\(ti";
    } else if (sign == '\'' || (sign == '.' && safe.empty())) {
      safe += sign == '\'' ? "\\(aq" : "\\&.";
    } else {
      safe += sign;
    }
  }
  return safe;
}

/// Returns text such as "-q, --quiet" or "--out DIR"; for an argument, its place: "SCENE"
std::string usage_of(const OptionInfo& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back("\\fB" + plain(name) + "\\fR");
  const std::string value = option.value.empty() ? "" : "\\fI" + plain(option.value) + "\\fR";
  if (names.empty()) return value;
  return fmt::format("{}{}{}", fmt::join(names, ", "), value.empty() ? "" : " ", value);
}

std::string options_text(const CommandInfo& command, bool arguments, std::string_view heading) {
  std::string text;
  for (const OptionInfo& option : command.options)
    if (option.is_argument() == arguments && (arguments || heading_of(option) == heading))
      text += fmt::format(".TP\n{}\n{}.\n", usage_of(option), plain(option.description));
  return text;
}

std::string title_line(const std::string& name, const std::string& version) {
  std::string capitals;
  for (const char c : name) capitals += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return fmt::format(".TH {} 1 \"\" \"carom {}\" \"User Commands\"\n.SH NAME\n", plain(capitals), version);
}

std::string example_lines(std::span<const Example> examples) {
  std::string text;
  for (const Example& example : examples)
    text += fmt::format("{}:\n.PP\n.nf\n.RS\n{}\n.RE\n.fi\n.PP\n", plain(example.what), plain(example.line));
  return text;
}

constexpr std::string_view exit_status =
    ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nfailed while running, or two runs differ (diff)\n.TP\n2\nthe command line, the "
    "scene or the place for results is wrong; nothing was run\n.TP\n3\nthe state is invalid: disks overlap\n.TP\n4\na check of "
    "the physics failed, or a run repeated differs (verify)\n.TP\n130\ninterrupted; what was done until then is saved\n";

}  // namespace

std::string manual_page(std::span<const CommandInfo> commands, const std::string& version) {
  std::string text =
      title_line("carom", version) +
      "carom \\- event\\-driven molecular dynamics of hard disks\n"
      ".SH SYNOPSIS\n.B carom\n.I COMMAND\n.RI [ OPTIONS ]\n.SH DESCRIPTION\n"
      "Carom moves hard disks in a two\\-dimensional box exactly, from one collision to the next. A scene, which is "
      "a TOML file, says what is simulated; results are written to a directory. Each command has a manual page of "
      "its own, such as\n.BR carom\\-run (1);\n\\fBcarom help\\fR \\fICOMMAND\\fR says the same shorter.\n";
  std::string group, others;
  for (const CommandInfo& command : commands) {
    if (command.group.empty()) continue;
    if (command.group != group) text += fmt::format(".SH {}\n", plain(group = command.group));
    text += fmt::format(".TP\n.BR carom\\-{} (1)\n{}.\n", plain(command.name), plain(command.description));
    others += fmt::format("{}.BR carom\\-{} (1)", others.empty() ? "" : ",\n", plain(command.name));
  }
  text += ".SH EXAMPLES\n";
  for (const char* name : {"init", "run", "report"}) text += example_lines(examples_of(name).first(1));
  text += exit_status;
  text +=
      ".SH SIGNALS\nSIGINT (Ctrl\\-C), SIGTERM, SIGHUP, SIGXCPU and SIGUSR1 ask a run or a study to stop: it saves what was "
      "done, and ends with exit status 130. A second SIGINT or SIGTERM, half a second or more after the first, ends it at once. "
      "What is ignored when the program is started, as SIGHUP is by\n.BR nohup (1),\nstays ignored.\n"
      ".SH FILES\nExample scenes are in the directory share/carom/scenes of the installation; \\fBcarom init \\-\\-list\\fR "
      "names those that it can write.\n";
  return text + ".SH SEE ALSO\n" + others + "\n";
}

std::string manual_page(const CommandInfo& command, const std::string& version) {
  const std::string name = "carom-" + command.name;
  std::string text = title_line(name, version) + fmt::format("{} \\- {}\n.SH SYNOPSIS\n\\fBcarom {}\\fR", plain(name),
                                                             plain(command.description), plain(command.name));
  bool has_options = false;
  for (const OptionInfo& option : command.options) {
    has_options = has_options || !option.is_argument();
    if (!option.is_argument()) continue;
    const std::string value = fmt::format("\\fI{}\\fR{}", plain(option.value), option.is_many ? "..." : "");
    text += option.is_required ? " " + value : " [" + value + "]";
  }
  text += has_options ? " [\\fIOPTIONS\\fR]\n" : "\n";
  if (const std::string arguments = options_text(command, true, ""); !arguments.empty()) text += ".SH ARGUMENTS\n" + arguments;
  if (has_options) text += ".SH OPTIONS\n";
  for (const std::string_view heading : headings())
    if (const std::string options = options_text(command, false, heading); !options.empty())
      text += (heading == headings().front() ? "" : fmt::format(".SS {}\n", plain(heading))) + options;
  if (!command.examples.empty()) text += ".SH EXAMPLES\n" + example_lines(command.examples);
  text += command.note.empty() ? std::string(exit_status) : fmt::format(".SH EXIT STATUS\n{}\n", plain(command.note));
  return text + ".SH SEE ALSO\n.BR carom (1)\n";
}

}  // namespace carom::cli
