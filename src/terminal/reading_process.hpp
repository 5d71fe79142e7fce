#pragma once
// Commands that read what runs have written do it in a child process: on a damaged file the HDF5 library may crash, or go round
// in circles for ever, and then the parent still has a sentence to say.

#include "terminal/command.hpp"

#include <filesystem>
#include <functional>

namespace carom::cli {

/// Does `command`, which reads `file`, in a child process, and returns what it returns. What it throws is thrown in the child,
/// and nothing in the parent, which returns the code with which the child has ended. Throws UsageError in the parent where the
/// child has crashed, or a ReadingLimit has ended it. Requires a process of one thread.
ExitCode in_reading_process(const std::filesystem::path& file, const std::function<ExitCode()>& command);

/// While one of these lives, the process may take 20 seconds of a processor and what a megabyte per second needs for the file or
/// directory; then SIGPROF ends it. There is one at a time.
class ReadingLimit {
 public:
  explicit ReadingLimit(const std::filesystem::path& file);
  ~ReadingLimit();
  ReadingLimit(const ReadingLimit&) = delete;
  ReadingLimit& operator=(const ReadingLimit&) = delete;
};

}  // namespace carom::cli
