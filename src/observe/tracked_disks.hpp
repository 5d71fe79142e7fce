#pragma once
// Disks that observables follow one by one: a random choice of so many of each species, so that memory stays bounded.

#include "observe/observed_run.hpp"

#include <carom/collisions.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// Returns `count` of these ids at random, or all if there are no more, in the order given; the same for the same seed. Disks at
/// regular distances could all be in one column of a lattice, or of one kind.
[[nodiscard]] std::vector<std::int32_t> sampled_disks(std::span<const std::int32_t> ids, std::size_t count, std::uint64_t seed);

/// Some disks out of many, with their slots in the engine's memory. Testing whether a collision concerns them reads 16 KiB at
/// most, and further memory only where it may.
class FollowedDisks {
 public:
  FollowedDisks() = default;
  /// Disks of which `follows(id)` says true are in rows by their places.
  template <class Follows>
  FollowedDisks(const DiskTable& disks, Follows follows) : rows_(disks.ids.size()) {
    while ((disks.ids.size() >> shift_) >= most_near) ++shift_;
    near_.resize((disks.ids.size() >> shift_) / 64 + 1);
    for (std::size_t place = 0; place < disks.ids.size(); ++place)
      if (follows(disks.ids[place])) {
        near_[(place >> shift_) / 64] |= std::uint64_t{1} << ((place >> shift_) % 64);
        ids_.push_back(disks.ids[place]);
      }
    std::size_t row = 0;
    for (std::size_t place = 0; place < disks.ids.size(); ++place)
      rows_[place] = static_cast<std::uint32_t>(follows(disks.ids[place]) ? row++ : ids_.size());
  }

  /// Returns the row of the disk in a slot; one behind the last for a disk that is not followed.
  [[nodiscard]] std::size_t row(std::int32_t place) const { return rows_[static_cast<std::uint32_t>(place)]; }
  [[nodiscard]] bool has(std::int32_t place) const { return row(place) < ids_.size(); }
  /// Returns the ids of the followed disks, by row.
  [[nodiscard]] const std::vector<std::int32_t>& ids() const { return ids_; }

  /// Finds the records of collisions in which one disk at least is followed: their numbers in `which`, which has room for all.
  /// Returns how many. Without branches, which would be guessed wrong.
  std::size_t find(std::span<const CollisionRecord> records, std::uint32_t* which) const {
    const auto near = [of = near_.data()](std::uint32_t p) { return (of[p / 64] >> (p % 64)) & 1U; };
    const auto place = [records](std::uint32_t n) { return static_cast<std::uint32_t>(records[n].slot_i); };
    const auto partner = [records](std::uint32_t n) { return static_cast<std::uint32_t>(records[n].slot_j); };
    const auto keep = [which](std::size_t count, auto number_of, auto is_kept) {
      std::size_t kept = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t n = number_of(k);
        which[kept] = n;
        kept += static_cast<std::size_t>(is_kept(n));
      }
      return kept;
    };
    const auto itself = [](std::size_t k) { return static_cast<std::uint32_t>(k); };
    if (shift_ == 0) return keep(records.size(), itself, [=](std::uint32_t n) { return near(place(n)) | near(partner(n)); });
    const std::size_t found = keep(records.size(), itself, [=, shift = shift_](std::uint32_t n) {
      return near(place(n) >> shift) | near(partner(n) >> shift);
    });
    return keep(
        found, [which](std::size_t k) { return which[k]; },
        [&](std::uint32_t n) {
          return static_cast<unsigned>(has(records[n].slot_i)) | static_cast<unsigned>(has(records[n].slot_j));
        });
  }

 private:
  static constexpr std::size_t most_near = 131'072;

  unsigned shift_ = 0;
  std::vector<std::uint64_t> near_;  ///< of 2^shift_ places each: 1 where there is one of the disks, else 0
  std::vector<std::uint32_t> rows_;  ///< by place
  std::vector<std::int32_t> ids_;
};

/// The disks of one species whose velocities and displacements are followed through time.
class TrackedDisks {
 public:
  /// Tracks the disks of one species: all, or as many as are asked for.
  TrackedDisks(const ObservableRequest& request, const ObservedRun& run, std::size_t species);

  [[nodiscard]] std::size_t channels() const { return 2 * ids_.size(); }
  /// Returns x and y of each disk, relative to the common motion of all along axes that keep momentum. Valid until the next call.
  [[nodiscard]] std::span<const double> velocities(const Eigen::Matrix2Xd& peculiar);
  /// Returns unwrapped positions, less `drift`, the displacement of the centre of mass.
  [[nodiscard]] std::span<const double> unwrapped(const ObservedRun& run, const State& state, const Eigen::Vector2d& drift);

 private:
  std::vector<std::int32_t> ids_;
  std::vector<double> values_;
};

}  // namespace carom
