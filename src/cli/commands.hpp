#pragma once
// The program's commands. Each registers its options with the parser; the one that the user names puts what it will do
// into `chosen`, so that nothing runs before the whole command line has been read and found right.

#include <functional>
#include <stdexcept>
#include <string>

namespace CLI {
class App;
}

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

using Command = std::function<ExitCode()>;

void add_run_command(CLI::App& program, Command& chosen, const Invocation& invocation);
void add_check_command(CLI::App& program, Command& chosen);
void add_init_command(CLI::App& program, Command& chosen, const Invocation& invocation);
void add_info_command(CLI::App& program, Command& chosen);

}  // namespace carom::cli
