#pragma once
// Work that threads take one piece after the other, while one of them asks whether to go on.

#include <cstddef>
#include <functional>

namespace carom::validation {

/// Calls work(k, go_on) for k = 0 to count - 1, each on one of `threads` threads, the calling one among them. `work` asks go_on()
/// now and then; the calling thread alone asks `proceed`, from go_on() and while it waits for the others. Once that is false, or
/// one of the two has thrown, go_on() is false everywhere and no further k is begun. Returns whether all were done. Rethrows the
/// first exception, unless `proceed` was false before it.
bool in_threads(std::size_t count, unsigned threads, const std::function<bool()>& proceed,
                const std::function<void(std::size_t k, const std::function<bool()>& go_on)>& work);

}  // namespace carom::validation
