// carom info FILE: what a file that Carom wrote holds, or how to make a run again.

#include "app/commands.hpp"
#include "app/info.hpp"
#include "terminal/reading_process.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace carom::cli {

ExitCode info(const InfoOptions& options, const Invocation& invocation) {
  if (options.reproduce) {
    fmt::print("{}", reproduction(options.file, invocation));
    return exit_done;
  }
  return in_reading_process(options.file, [&] {
    const ReadingLimit limit(options.file);
    fmt::print("{}", as_usage_error([&] { return describe_file(options.file); }));
    return exit_done;
  });
}

}  // namespace carom::cli
