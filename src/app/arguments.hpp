#pragma once
// The command line, read as a whole before anything is done.

#include "app/command_options.hpp"

namespace carom::cli {

/// Parses the command line. Returns the function that carries the command out. Throws UsageError where the command line is wrong.
Action parse_arguments(int argc, char** argv);

}  // namespace carom::cli
