#pragma once
// A simulation on several cores. Its trajectory, totals and states have the bits that one core computes, for any number of
// threads.

#include <cstddef>
#include <cstdint>

namespace carom {

/// The most threads of one process: more would wait for each other longer than they compute.
inline constexpr int most_threads = 32;

/// How a simulation is shared out to several cores. No bit of it depends on any of these numbers, only its speed does: each
/// domain computes the disks of a part of the box and, once more, those in a halo round that part (docs/parallel.md). With one
/// thread and one domain the engine runs alone.
struct Threads {
  std::size_t threads = 1;  ///< threads that compute at the same time, 1 to most_threads
  std::size_t domains = 0;  ///< parts of the box, at most most_threads, or 1024 on several ranks; 0 for one for each thread
  double halo = 0.0;        ///< width of halos, in largest contact distances; 0 for one that suits the density
  double events_per_window = 0.5;  ///< events of each disk in the first window between two exchanges; > 0
};

/// What sharing a simulation out has taken since Simulation::set_threads(), in changed scenes too.
struct ThreadCounts {
  /// Adds what another part of the simulation took. `threads`, `ranks` and `domains` are then those of the part with the most.
  void add(const ThreadCounts& other);
  /// Returns the share of all events that one core computed alone, from 0 to 1.
  [[nodiscard]] double share_alone() const;

  std::size_t threads = 1;  ///< of each rank
  std::size_t ranks = 1;    ///< processes: carom/ranks.hpp
  std::size_t domains = 1;
  std::uint64_t windows = 0;
  std::uint64_t windows_redone = 0;  ///< windows that were void: the engine alone redid their epoch up to their end
  std::uint64_t shared_out = 0;      ///< times that the disks were shared out
  std::uint64_t events = 0;          ///< of any kind, each counted once
  std::uint64_t events_alone = 0;    ///< events that one core computed alone: after void windows, and what does not fit
  std::uint64_t copied_events = 0;   ///< the same events once more, in halos
  std::uint64_t copies = 0;          ///< disks in halos that were compared with what their own domain says, over all windows
  std::uint64_t copies_wrong = 0;    ///< of these: those that had to be corrected
  double processor_seconds = 0.0;    ///< of all domains together, and of what one thread does for all
  /// What would have passed with a free processor for each domain: between two meetings the domain that takes longest counts.
  /// Both seconds leave out what other ranks take.
  double critical_seconds = 0.0;
};

}  // namespace carom
