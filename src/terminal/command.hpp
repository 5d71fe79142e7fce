#pragma once
// The common parts of all commands of the program: exit codes, command line, and errors of use.

#include "io/output_error.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace carom::cli {

/// The exit codes of the program.
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,         ///< failed while running
  exit_usage = 2,          ///< the command line, the scene or the place for the results is wrong; nothing was run
  exit_invalid_state = 3,  ///< disks overlap by more than rounding, or another invariant is broken
  exit_check_failed = 4,   ///< a check of validate, hardcases, verify or bench failed
  exit_interrupted = 130,  ///< stopped by a signal; what was done until then is saved
};

/// Thrown where a command cannot be carried out as it was given. what() is one sentence.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The command line by which the program was called.
struct Invocation {
  std::string program;       ///< name of the program as a user in this directory would type it
  std::string command_line;  ///< all of it, quoted for a shell
};

/// Calls `action` and turns its OutputError into a UsageError of the same sentence: where files cannot be read or written at the
/// beginning of a command, its arguments are wrong.
template <class Action>
auto as_usage_error(Action action) -> decltype(action()) {
  try {
    return action();
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
}

/// Reads `text`, which was given for `option`, by `read`. Its std::invalid_argument becomes a UsageError that names both.
template <class Read>
auto read_option(const char* option, const std::string& text, Read read) -> decltype(read(text)) {
  try {
    return read(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{} {}: {}", option, text, error.what()));
  }
}

}  // namespace carom::cli
