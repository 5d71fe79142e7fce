#pragma once
// The earliest of some thousands of times by a tournament: disks in groups of thirty-two, the earliest time of each group in
// groups of thirty-two again, until one group is left (Knuth, The Art of Computer Programming 3, 5.4.1). Like core/prediction.hpp
// compiled for every machine, for those with AVX2 and for those with AVX-512, with the same answers.

#include <cstddef>
#include <cstdint>

namespace carom {

inline constexpr std::size_t tournament_group = 32;

/// level[0] has the time of every disk, infinity for none; level[n + 1] the earliest of each group of level[n]; the last level is
/// one group. Each is aligned to 64 bytes, and filled up to whole groups with infinity.
struct TournamentTree {
  double* level[3];
};

/// A disk with the earliest time. `others`: not 0 where some have the same.
struct Winner {
  double time;
  std::int32_t disk;
  std::uint32_t others;
};

struct TournamentKernel {
  Winner (*winner)(const TournamentTree& tree);
  /// The time of disk i becomes infinity.
  void (*take)(const TournamentTree& tree, std::int32_t i);
  /// Disk i, which had infinity, gets a time.
  void (*enter)(const TournamentTree& tree, std::int32_t i, double time);
  /// The time of disk `out` becomes infinity; then i, which had infinity, gets a time.
  void (*take_and_enter)(const TournamentTree& tree, std::int32_t out, std::int32_t i, double time);
  /// The time of disk `out` becomes infinity; then i and j, which had infinity, get times.
  void (*take_and_enter_two)(const TournamentTree& tree, std::int32_t out, std::int32_t i, double time_i, std::int32_t j,
                             double time_j);
  /// The members of a group that have that time, a bit for each.
  std::uint32_t (*among)(const double* group, double time);
};

/// The best kernel for this machine and two or three levels.
const TournamentKernel& tournament_kernel(int levels);

}  // namespace carom
