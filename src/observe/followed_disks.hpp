#pragma once

#include <carom/collisions.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// Some disks of many, and where they are in the engine's memory. To ask costs no look far away: two bits for each disk of all.
class FollowedDisks {
 public:
  FollowedDisks() = default;
  /// Disks of which `follows(id)` says true are in rows by their places.
  template <class Follows>
  FollowedDisks(const NotedDisks& disks, Follows follows) : groups_(disks.ids.size() / 32 + 1) {
    for (std::size_t place = 0; place < disks.ids.size(); ++place) {
      Group& group = groups_[place / 32];
      if (place % 32 == 0) group.before = static_cast<std::uint32_t>(ids_.size());
      if (!follows(disks.ids[place])) continue;
      group.bits |= std::uint32_t{1} << place % 32;
      ids_.push_back(disks.ids[place]);
    }
  }

  [[nodiscard]] bool has(std::int32_t place) const { return (shifted(place) & 1U) != 0; }
  /// Without a branch, which would be guessed wrong.
  [[nodiscard]] bool has_either(std::int32_t one, std::int32_t other) const {
    return ((shifted(one) | shifted(other)) & 1U) != 0;
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

  std::vector<Group> groups_;
  std::vector<std::int32_t> ids_;
};

}  // namespace carom
