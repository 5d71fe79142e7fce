#pragma once
// What every command of the program has to do with: its exit status, how it was called, and errors of use.

#include "io/output_error.hpp"

#include <stdexcept>
#include <string>

namespace carom::cli {

/// What the program's exit status says.
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,         ///< failed while running
  exit_usage = 2,          ///< the command line, the scene or the place for the results is wrong; nothing was run
  exit_invalid_state = 3,  ///< disks overlap
  exit_check_failed = 4,   ///< a physics check failed
  exit_interrupted = 130,  ///< stopped by a signal; what was done until then is saved
};

/// What the user asked for cannot be done as asked. what() is one sentence.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// How the program was called.
struct Invocation {
  std::string program;       ///< as a user at this place would type it
  std::string command_line;  ///< all of it, quoted for a shell
};

/// Does `action`, whose OutputError becomes a UsageError of the same sentence: what cannot be read or written to begin with is
/// the user's to mend.
template <class Action>
auto as_usage_error(Action action) -> decltype(action()) {
  try {
    return action();
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace carom::cli
