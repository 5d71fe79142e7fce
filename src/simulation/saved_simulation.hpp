#pragma once
// What is known of a saved simulation before any of it is used.

#include <iosfwd>

namespace carom::detail {

/// Reads the first line of a saved simulation. Throws std::runtime_error where it is none, or another build has written it.
void check_saved_head(std::istream& in);

}  // namespace carom::detail
