#pragma once

#include <string_view>

namespace carom::cli {

/// Brings all that was printed to standard output. Throws std::runtime_error with a sentence where some of it has not reached it,
/// as on a full disk behind a redirection.
void flush_output();

/// Prints `text` to standard output, all of it. Throws as flush_output().
void print_whole(std::string_view text);

}  // namespace carom::cli
