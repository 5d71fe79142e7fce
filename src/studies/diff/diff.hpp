#pragma once
// Two runs of the same disks, side by side: whether they are the same to the last bit, how far their disks are apart at the
// sample times that both have, and the first collision that differs.

#include "studies/state_distance.hpp"

#include <carom/io/run_reader.hpp>
#include <carom/state.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// A run to be compared.
struct DiffRun {
  std::string name;        ///< the path as it was given
  RunReader reader;        ///< its trajectory
  std::string state_hash;  ///< from its summary; empty where there is a trajectory alone
};

/// Opens a run directory or a trajectory file. Throws OutputError where there is none.
[[nodiscard]] DiffRun open_diff_run(const std::filesystem::path& path);

/// The deepest overlap of two disks over the samples of a run.
struct SampledOverlap {
  double relative = 0.0;  ///< in units of the contact distance of the pair; 0 where no pair overlaps
  double time = 0.0;
  std::int32_t first = -1;
  std::int32_t second = -1;
};

/// A collision with its number in its log, counted from 1.
struct Numbered {
  std::uint64_t number = 0;
  Event event;
};

/// The comparison of two event logs.
struct LogDifference {
  std::uint64_t equal = 0;  ///< number of collisions of the same disks in the same order
  /// The next collision of each, which the other does not have; empty where a log has ended before.
  std::optional<std::array<Numbered, 2>> first;
};

/// Returns the next events of a log, as many as it likes; empty at its end.
using NextEvents = std::function<std::vector<Event>()>;

/// Compares the disks and walls of two logs, collision by collision, until the first difference. Collisions at exactly one time
/// of a log may come in any order.
[[nodiscard]] LogDifference first_different_collision(const NextEvents& a, const NextEvents& b);

/// The differences of two runs.
struct RunDifference {
  std::array<std::string, 2> names;
  std::array<std::string, 2> state_hash;
  std::array<std::uint64_t, 2> samples = {};
  std::uint64_t equal_samples = 0;             ///< samples equal to the last bit, from the first on
  double diameter = 1.0;                       ///< mean diameter; 1 without disks
  std::vector<DistanceAt> distances;           ///< at the common times
  std::array<SampledOverlap, 2> overlap = {};  ///< over all samples of each
  std::array<bool, 2> has_events = {};
  std::optional<LogDifference> log;  ///< empty where a run has no event log

  /// Returns whether hashes (where both are known) and all samples are equal.
  [[nodiscard]] bool same() const;
};

/// Compares two runs. Throws OutputError where a file cannot be read, and where the disks, the boxes or all sample times of the
/// two differ: what() names the first difference.
[[nodiscard]] RunDifference difference_of(const DiffRun& a, const DiffRun& b);

/// Returns whether two sample times are the same but for rounding: to 1e-12 of the later one.
[[nodiscard]] bool same_time(double a, double b);

/// Returns the first difference of the disks or boxes of two runs, as the end of a sentence; empty where there is none.
[[nodiscard]] std::string different_system(const Box& box_a, const Disks& a, const Box& box_b, const Disks& b);

}  // namespace carom
