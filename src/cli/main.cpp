// The program carom: reads the command line, lets the command run, and turns what went wrong into one sentence on stderr
// and an exit code. Nothing escapes.

#include "cli/commands.hpp"
#include "cli/format.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <carom/scene.hpp>
#include <carom/version.hpp>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

namespace {

using namespace carom;
using namespace carom::cli;

std::string version() {
  const BuildInfo& build = build_info();
  return fmt::format("carom {} (commit {}; {}; {})", build.version, build.commit, build.compiler, build.flags);
}

/// The program's name as the user typed it, or where that is a long path, its path from here.
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

ExitCode complain(ExitCode code, const std::string& sentence) {
  fmt::print(stderr, "carom: {}\n", sentence);
  return code;
}

ExitCode run_program(int argc, char** argv) {
  CLI::App program("Carom: event-driven molecular dynamics of hard disks", "carom");
  const Invocation invocation = invocation_of(argc, argv);
  Command chosen;
  program.set_version_flag("--version", version());
  program.require_subcommand(1);
  add_run_command(program, chosen, invocation);
  add_check_command(program, chosen);
  add_init_command(program, chosen, invocation);
  add_info_command(program, chosen);
  const auto named_so = [&](const CLI::App* command) { return command->check_name(argv[1]); };
  if (argc > 1 && argv[1][0] != '-' && program.get_subcommands(named_so).empty()) {
    throw UsageError(fmt::format("{}: there is no such command; it can be run, check, init or info", argv[1]));
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help or --version
    program.exit(asked);
    return exit_done;
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> named = program.get_subcommands();
    return complain(exit_usage, fmt::format("{} (carom{} --help says what is possible)", error.what(),
                                            named.empty() ? "" : " " + named.front()->get_name()));
  }
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  ExitCode code = exit_failed;
  try {
    code = run_program(argc, argv);
  } catch (const SceneError& error) {
    code = complain(exit_usage, error.what());
  } catch (const UsageError& error) {
    code = complain(exit_usage, error.what());
  } catch (const std::bad_alloc&) {
    code = complain(exit_failed, "there is not enough memory");
  } catch (const std::exception& error) {
    code = complain(exit_failed, error.what());
  } catch (...) {
    code = complain(exit_failed, "an unknown error ended the program");
  }
  // A full disk behind a redirection shows itself only here.
  if (std::fflush(stdout) != 0 && code == exit_done) {
    code = complain(exit_failed, fmt::format("cannot write to standard output: {}", std::strerror(errno)));
  }
  return code;
}
