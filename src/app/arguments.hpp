#pragma once
// The command line, read as a whole before anything is done.

#include "app/commands.hpp"

#include <functional>

namespace carom::cli {

/// What the command line asks for, ready to be done. Throws UsageError where it is wrong.
std::function<ExitCode()> parse_arguments(int argc, char** argv);

}  // namespace carom::cli
