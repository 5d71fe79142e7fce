#pragma once
// The earliest of some thousands of times by a tournament: disks in groups of thirty-two, the earliest time of each group in
// groups of thirty-two again, until one group is left (Knuth, The Art of Computer Programming 3, 5.4.1). Like core/prediction.hpp
// compiled for every machine, for those with AVX2 and for those with AVX-512, with the same answers.

#include <cstddef>
#include <cstdint>

namespace carom {

inline constexpr std::size_t tournament_group = 32;

/// level[0] has the time of every disk, infinity for none; level[n + 1] the earliest of each group of level[n]; the last level is
/// one group. Each is aligned to 64 bytes, and filled up to whole groups with infinity. Where there are three levels, first[n][k]
/// (n >= 1) is a disk with the time level[n][k], and has the bit tournament_tied where there may be others: nobody has to go down
/// the levels to find it.
struct TournamentTree {
  double* level[3];
  std::uint32_t* first[3];
};
inline constexpr std::uint32_t tournament_tied = 0x80000000;

/// A disk with the earliest time. `others` is not 0 where other disks may have the same time.
struct Winner {
  double time;
  std::int32_t disk;
  std::uint32_t others;
};

struct TournamentKernel {
  Winner (*winner)(const TournamentTree& tree);
  /// Sets the time of disk i to infinity.
  void (*take)(const TournamentTree& tree, std::int32_t i);
  /// Sets the time of disk i, which was infinity.
  void (*enter)(const TournamentTree& tree, std::int32_t i, double time);
  /// Sets the time of disk `out` to infinity, then that of i, which was infinity.
  void (*take_and_enter)(const TournamentTree& tree, std::int32_t out, std::int32_t i, double time);
  /// Sets the time of disk `out` to infinity, then those of i and j, which were infinity.
  void (*take_and_enter_two)(const TournamentTree& tree, std::int32_t out, std::int32_t i, double time_i, std::int32_t j,
                             double time_j);
  /// Returns the members of a group that have that time, a bit for each.
  std::uint32_t (*among)(const double* group, double time);
};

/// Returns the best kernel for this machine and two or three levels.
const TournamentKernel& tournament_kernel(int levels);

}  // namespace carom
