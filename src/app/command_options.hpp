#pragma once
// The commands that do something, with their options, for the parser.

#include "app/commands.hpp"

#include <functional>

namespace CLI {
class App;
}

namespace carom::cli {

using Action = std::function<ExitCode()>;

/// Adds the commands to the parser. Parsing sets `action`, which must live as long, to what the command line asks for.
void add_commands(CLI::App& program, Action& action, const Invocation& invocation);

}  // namespace carom::cli
