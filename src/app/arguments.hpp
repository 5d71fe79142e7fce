#pragma once
// The command line, read as a whole before anything is done, and its description as a manual page and for bash, which is made
// from the parser so that it has every option.

#include "app/commands.hpp"

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace carom::cli {

/// Parses the command line. Returns the function that carries the command out. Throws UsageError where the command line is wrong.
std::function<ExitCode()> parse_arguments(int argc, char** argv);

/// Returns the manual page carom(1), in the macros of man(7).
std::string manual_page(const CLI::App& program, const std::string& version);

/// Returns the script by which bash completes commands, options and file names.
std::string bash_completion(const CLI::App& program);

}  // namespace carom::cli
