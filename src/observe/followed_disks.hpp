#pragma once

#include <carom/collisions.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// Some disks of many, and where they are in the engine's memory. To ask costs no look far away: two bits for each disk of all,
/// and at most 16 KiB to begin with.
class FollowedDisks {
 public:
  FollowedDisks() = default;
  /// Disks of which `follows(id)` says true are in rows by their places.
  template <class Follows>
  FollowedDisks(const NotedDisks& disks, Follows follows) : groups_(disks.ids.size() / 32 + 1) {
    while ((disks.ids.size() >> shift_) >= most_near) ++shift_;
    near_.resize((disks.ids.size() >> shift_) + 1);
    for (std::size_t place = 0; place < disks.ids.size(); ++place) {
      Group& group = groups_[place / 32];
      if (place % 32 == 0) group.before = static_cast<std::uint32_t>(ids_.size());
      if (!follows(disks.ids[place])) continue;
      group.bits |= std::uint32_t{1} << place % 32;
      near_[place >> shift_] = 1;
      ids_.push_back(disks.ids[place]);
    }
  }

  [[nodiscard]] bool has(std::int32_t place) const { return (shifted(place) & 1U) != 0; }
  /// Without a branch, which would be guessed wrong.
  [[nodiscard]] bool has_either(std::int32_t one, std::int32_t other) const {
    return ((shifted(one) | shifted(other)) & 1U) != 0;
  }
  /// Finds the notes of collisions in which has_either(): their numbers in `which`, which has room for all. Returns how many.
  std::size_t find(std::span<const CollisionNote> notes, std::uint32_t* which) const {
    const std::uint8_t* near = near_.data();
    const auto place = [notes](std::uint32_t n) { return static_cast<std::uint32_t>(notes[n].place); };
    const auto partner = [notes](std::uint32_t n) { return static_cast<std::uint32_t>(notes[n].partner); };
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
    if (shift_ == 0) return keep(notes.size(), itself, [=](std::uint32_t n) { return near[place(n)] | near[partner(n)]; });
    const std::size_t found = keep(notes.size(), itself, [=, shift = shift_](std::uint32_t n) {
      return near[place(n) >> shift] | near[partner(n) >> shift];
    });
    return keep(
        found, [which](std::size_t k) { return which[k]; },
        [&](std::uint32_t n) { return has_either(notes[n].place, notes[n].partner); });
  }
  /// Requires has(place).
  [[nodiscard]] std::size_t row(std::int32_t place) const {
    const std::uint32_t earlier = group(place).bits & ((std::uint32_t{1} << bit(place)) - 1);
    return group(place).before + static_cast<std::size_t>(std::popcount(earlier));
  }
  /// By row.
  [[nodiscard]] const std::vector<std::int32_t>& ids() const { return ids_; }

 private:
  struct Group {  ///< of 32 places
    std::uint32_t bits = 0;
    std::uint32_t before = 0;  ///< rows of groups before
  };
  static std::uint32_t bit(std::int32_t place) { return static_cast<std::uint32_t>(place) % 32; }
  [[nodiscard]] std::uint32_t shifted(std::int32_t place) const { return group(place).bits >> bit(place); }
  [[nodiscard]] const Group& group(std::int32_t place) const { return groups_[static_cast<std::uint32_t>(place) / 32]; }

  static constexpr std::size_t most_near = 16'384;

  std::vector<Group> groups_;
  unsigned shift_ = 0;
  std::vector<std::uint8_t> near_;  ///< of 2^shift_ places each: 1 where there is one of the disks, else 0
  std::vector<std::int32_t> ids_;
};

}  // namespace carom
