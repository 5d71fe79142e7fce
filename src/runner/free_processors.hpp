#pragma once
// How many processors there are for this program, and how many of them nobody uses.

namespace carom {

/// Returns the number of processors that this program may use, >= 1.
[[nodiscard]] int processors();

/// Returns how many of these are free as far as the system tells: at least one, which is that of the caller. Takes some
/// milliseconds, for other programs use a processor on and off.
[[nodiscard]] int free_processors();

}  // namespace carom
