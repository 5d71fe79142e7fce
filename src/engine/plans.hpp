#pragma once
// The plans of all disks, one each, with its next events; and the order of simultaneous events.

#include "core/large_memory.hpp"
#include "core/prefetch.hpp"
#include "core/real.hpp"
#include "queue/future_event.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace carom {

/// The edge of the neighbourhood of a disk, in the place of a wall or an obstacle.
inline constexpr std::int32_t neighbourhood_edge = -100;

/// The next events of one disk: the earliest collision that its last prediction found, and the earliest of leaving its
/// neighbourhood and meeting a wall or an obstacle. Half a cache line.
struct alignas(32) Plan {
  double pair_time;  ///< of the collision, since the epoch; infinity for none
  double edge_time;  ///< of the other, since the epoch
  std::int32_t partner;
  std::int32_t edge;            ///< `neighbourhood_edge`, a Wall, or an obstacle
  std::uint32_t predicted_at;   ///< stamp of the last collision before the prediction that found the partner
  std::uint32_t last_collided;  ///< stamp of the last collision of the disk itself

  /// Whether the disk leaves its neighbourhood or meets a wall or an obstacle before it meets its partner.
  [[nodiscard]] bool edge_first() const { return edge_time <= pair_time; }
  /// The time of the earlier of the two.
  [[nodiscard]] double time() const { return std::min(pair_time, edge_time); }
  /// Returns the other side of the event at that time: the partner, or `edge`.
  [[nodiscard]] std::int32_t other() const {
    const std::int32_t first = -static_cast<std::int32_t>(edge_first());  // all bits or none: a branch would be guessed wrong
    return (edge & first) | (partner & ~first);
  }
  /// Plans an event at a wall or an obstacle in the place of a later one, or of leaving the neighbourhood at the same time.
  void consider_edge(double when, std::int32_t what) {
    if (when < edge_time || (when == edge_time && edge == neighbourhood_edge)) edge_time = when, edge = what;
  }
};

/// The plans of all disks by slot, as the future event list asks for them.
class Plans {
 public:
  /// `ids` has the id of the disk in each slot, which decides ties; it must outlive the plans.
  Plans(std::size_t disks, const LargeVector<std::int32_t>& ids) : plans_(disks), ids_(ids) {}

  [[nodiscard]] Plan& operator[](std::int32_t i) { return plans_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Plan& operator[](std::int32_t i) const { return plans_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::size_t bytes() const { return plans_.capacity() * sizeof(Plan); }

  /// Whether the partner has collided since the collision with it was planned. (A plan keeps a stamp of its own and not one of
  /// the partner: to read that would be one more access to memory for every prediction.)
  [[nodiscard]] bool is_stale(const Plan& plan) const { return (*this)[plan.partner].last_collided > plan.predicted_at; }

  /// Whether a collision of disk i with `partner` at a time comes before the one that is planned: at the same time the partner
  /// with the lower id does.
  [[nodiscard]] bool precedes_planned(std::int32_t i, double time, std::int32_t partner) const {
    const Plan& mine = (*this)[i];
    return time < mine.pair_time || (time == mine.pair_time && time < infinity<double> && id(partner) < id(mine.partner));
  }
  /// Lets disk i, where it meets a wall or an obstacle and a partner with a lower id at one time, plan the partner alone: the
  /// wall is found again after the collision.
  void resolve_wall_pair_tie(std::int32_t i) {
    Plan& mine = (*this)[i];
    if (mine.edge_time == mine.pair_time && mine.edge != neighbourhood_edge && mine.partner >= 0 && id(mine.partner) < id(i))
      mine.edge_time = infinity<double>;
  }

  /// Lets all times and stamps count from `now`: stamp 1 stands for every collision before, 0 for plans that are stale.
  void rebase(double now) {
    for (Plan& plan : plans_) {
      plan.pair_time = std::max(plan.pair_time - now, 0.0);
      plan.edge_time = std::max(plan.edge_time - now, 0.0);
      plan.predicted_at = plan.partner >= 0 && is_stale(plan) ? 0 : 1;
    }
    for (Plan& plan : plans_) plan.last_collided = 1;
  }

  // The events of FutureEventList.

  [[nodiscard]] double time(std::int32_t i) const { return (*this)[i].time(); }
  [[nodiscard]] std::int32_t other(std::int32_t i) const { return (*this)[i].other(); }
  void prefetch_event(std::int32_t i) const { prefetch_early(&(*this)[i]); }

  /// Whether event a comes before event b at the same time: neighbourhoods are left first, so that no collision is missed; then
  /// comes the event with the lower disk, then that with the lower other disk, where a wall is lower than any disk. Of two plans
  /// for one collision that of the lower disk comes first.
  [[nodiscard]] bool precedes(const FutureEvent& a, const FutureEvent& b) const {
    const auto rank_a = rank(a), rank_b = rank(b);
    return rank_a < rank_b || (rank_a == rank_b && id(a.disk) < id(b.disk));
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(plans_);
  }

 private:
  [[nodiscard]] std::int32_t id(std::int32_t i) const { return ids_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] std::pair<std::int32_t, std::int32_t> rank(const FutureEvent& event) const {
    if (event.other == neighbourhood_edge) return {neighbourhood_edge, id(event.disk)};
    if (event.other < 0) return {id(event.disk), event.other};
    return std::minmax(id(event.disk), id(event.other));
  }

  LargeVector<Plan> plans_;
  const LargeVector<std::int32_t>& ids_;
};

}  // namespace carom
