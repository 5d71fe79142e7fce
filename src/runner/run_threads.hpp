#pragma once
// How many threads compute the events of a run, and how many processors there are for it.

#include <carom/ranks.hpp>
#include <carom/simulation.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace carom {

/// The number of threads that a run gets where nobody gives one, with the reason.
struct SuggestedThreads {
  int threads = 1;
  std::string words;  ///< "one core: 10,000 disks are fewer than the 50,000 from which on several cores pay"
};

/// Returns one thread where the simulation cannot be shared out or is too small for that to pay, else one for each free
/// processor, 16 at most.
[[nodiscard]] SuggestedThreads suggested_threads(const Simulation& simulation);

/// Returns the same where so many of `processors` are free.
[[nodiscard]] SuggestedThreads suggested_threads(const Simulation& simulation, int free, int processors);

/// Reads the number of threads of a run: 1 to 32, or "auto" for suggested_threads(), which is absent. Throws
/// std::invalid_argument where it is neither.
[[nodiscard]] std::optional<int> threads_in(std::string_view text);

/// Has the simulation compute its events on so many threads; absent: on suggested_threads(). Two threads are right as well where
/// events cannot be shared out and the scene has observables, which the second one measures. Throws std::invalid_argument with a
/// sentence where the simulation cannot be shared out, or the number is out of range.
void set_threads_of_run(Simulation& simulation, std::optional<int> threads);

/// Has the simulation compute its events on so many threads of each rank; absent: on one. The other ranks are in serve_ranks().
/// Throws std::invalid_argument as above.
void set_threads_of_ranks(Simulation& simulation, std::optional<int> threads, Ranks& ranks);

/// Returns the number of processors that this program may use, >= 1.
[[nodiscard]] int processors();

/// Returns how many of these are free as far as the system tells: at least one, which is that of the caller. Takes some
/// milliseconds, for other programs use a processor on and off.
[[nodiscard]] int free_processors();

}  // namespace carom
