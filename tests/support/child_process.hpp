#pragma once
// Runs the program as a user does: as a child process in a directory of its own, with its output and exit code kept. Runs
// other programs too.

#include "support/temporary_directory.hpp"

#include <sys/types.h>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace carom::test {

struct Outcome {
  int exit_code = -1;  ///< 128 + signal where a signal ended it
  std::string out;
  std::string err;
};

/// Runs `carom arguments...` in `directory`. `meanwhile` is called with the child's id while it runs.
Outcome run_carom(const std::filesystem::path& directory, const std::vector<std::string>& arguments,
                  const std::function<void(pid_t)>& meanwhile = {});

/// Runs the program words[0], looked for in PATH, in `directory`. Exit code 127 where there is none.
Outcome run_program(const std::filesystem::path& directory, std::vector<std::string> words,
                    const std::function<void(pid_t)>& meanwhile = {});

/// Returns whether a process has a handler of its own for a signal: the kernel starts it without.
bool handles(pid_t process, int signal);

/// True as soon as `condition` is; false when it is not after half a minute.
bool wait_until(const std::function<bool()>& condition);

/// Returns the outcome of the first of ten runs that does not come to its end before `run`, which starts and kills it, has done
/// so.
Outcome ended_early(const std::function<Outcome()>& run);

}  // namespace carom::test
