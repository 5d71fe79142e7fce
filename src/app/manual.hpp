#pragma once
// The program's own description of its command line, as a manual page and for a shell that completes words: made from the parser,
// so that neither leaves an option out.

#include <string>

namespace CLI {
class App;
}

namespace carom::cli {

/// Returns the manual page carom(1), in the macros of man(7).
std::string manual_page(const CLI::App& program, const std::string& version);

/// Returns the script by which bash completes commands, options and file names.
std::string bash_completion(const CLI::App& program);

}  // namespace carom::cli
