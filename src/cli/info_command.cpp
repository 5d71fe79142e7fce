// carom info FILE: what a file that Carom wrote holds.

#include "cli/commands.hpp"
#include "io/info.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace carom::cli {

ExitCode info(const InfoOptions& options) {
  try {
    fmt::print("{}", describe_file(options.file));
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
  return exit_done;
}

}  // namespace carom::cli
