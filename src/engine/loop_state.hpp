#pragma once
// What the event loop of the fast engine works on: where disks are, what they do next, which are near, and how long the epoch
// lasts. Each part has a header of its own. Here is also what is done to them once per epoch or seldom, before disks are planned
// anew: lists of neighbours, the length of an epoch, checkpoints. event_loop.hpp has what happens.
//
// Three parameters say what acts: Impact (what two disks do to each other), World (what else there is round them) and Layout
// (what a disk carries). Where disks fall, lines are drawn in a frame that falls with them from the epoch on, in which they are
// straight, so that it costs nothing where disks meet; only what bounds the flight is looked for along the parabola
// (engine/boundary_planner.hpp).
//
// engine_impl.hpp has the functions that are only declared here.

#include "core/instant.hpp"
#include "core/large_memory.hpp"
#include "core/pair_step.hpp"
#include "core/prediction.hpp"
#include "core/running_totals.hpp"
#include "core/sides.hpp"
#include "core/vec2.hpp"
#include "effects/plain_world.hpp"
#include "engine/boundary_planner.hpp"
#include "engine/collision_recorder.hpp"
#include "engine/common_motion.hpp"
#include "engine/contact_count.hpp"
#include "engine/disk_sizes.hpp"
#include "engine/flight_frame.hpp"
#include "engine/flight_limits.hpp"
#include "engine/layout.hpp"
#include "engine/plans.hpp"
#include "engine/prefetcher.hpp"
#include "engine/stall_detector.hpp"
#include "neighbours/neighbour_lists.hpp"
#include "neighbours/neighbourhood_tuning.hpp"
#include "queue/future_event_list.hpp"
#include "queue/queue_pacing.hpp"

#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace carom {

template <class Impact, class Layout, class World>
class LoopState {
 public:
  /// Why this engine cannot run these disks, in half a sentence; empty where it can. Periodic boxes must be wide enough for the
  /// nearest image to be the only one that a disk can meet, disks not so small that the resolution of neighbourhoods would show,
  /// and the three parameters the right ones.
  [[nodiscard]] static std::string why_not(const Box& box, const Disks& disks, const Effects& effects = {});

  /// Requires an empty why_not(), disks inside the box, radii and masses > 0, everything finite. `seed` is that of the random
  /// numbers that effects draw.
  LoopState(const Box& box, const Disks& disks, State start, const Effects& effects = {}, std::uint64_t seed = 1);
  /// The engine of a part of the box, with slots for so many disks, all of them empty: parallel/box_domain.hpp fills them.
  /// Everything that does not belong to one disk is as in `whole`.
  LoopState(const LoopState& whole, std::size_t slots);
  LoopState(const LoopState&) = delete;
  LoopState& operator=(const LoopState&) = delete;

  /// Whether nothing will ever happen again: nothing moves, and nothing makes it move.
  [[nodiscard]] bool idle() const { return epoch_length_ == never; }

  /// Whether the engine can go no further, and why.
  [[nodiscard]] const StallDetector& stall() const { return stall_; }

  /// The memory of all that has an entry per disk, in bytes.
  [[nodiscard]] std::size_t bytes() const;
  /// Writes or reads all that decides how the run goes on, for core/archive.hpp. Requires all events to have been taken.
  template <class Archive>
  void serialize(Archive& archive);

 protected:
  using Line = typename Layout::Line;

  /// The stamp at which an epoch ends, if it has not before.
  static constexpr std::uint32_t last_stamp = 0xFFFFFFFF;
  static constexpr double never = infinity<double>;

  [[nodiscard]] Surroundings surroundings(std::int32_t i) const {
    const NeighbourhoodCentre centre = lists_.centre(i);
    return {{centre.x, centre.y}, lists_.ids(i), lists_.count(i)};
  }
  [[nodiscard]] Prediction predicted(std::int32_t i, const Surroundings& around) const {
    Prediction ahead;
    kernel_.predict(lines_.data(), frame_, i, around, now_, ahead);
    return ahead;
  }
  /// The prediction of disk i against disk j alone.
  [[nodiscard]] Prediction predicted_against(std::int32_t i, std::int32_t j) const;
  [[nodiscard, gnu::noinline, gnu::cold]] std::int32_t lowest_of_tied(std::int32_t i, const Prediction& ahead) const;
  [[gnu::noinline]] void prefetch_calendar(std::int64_t span) const;
  [[nodiscard]] PrefetchedData<Line> data() const { return {lines_, ids_, plans_, lists_, queue_}; }

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(lines_.size()); }
  [[nodiscard]] Line& line(std::int32_t i) { return lines_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Line& line(std::int32_t i) const { return lines_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::int32_t id(std::int32_t i) const { return ids_[static_cast<std::size_t>(i)]; }

  /// Returns whether this is the engine of a part of the box, in which no epoch can begin alone, and ends its run then.
  [[nodiscard]] bool leave_to_whole() { return part_ && (stopped_ = true); }
  /// Ends the run because the velocities of i and j, which may be the same disk, would not be finite: they keep those that they
  /// have.
  void fail_between(std::int32_t i, std::int32_t j);

  /// Lets lines, plans and stamps count from `now`.
  void rebase(double now);
  void rebase_clock(double now);
  void multiply_velocities(double factor);
  void choose_epoch_length();
  void choose_epoch_length(const SpeedSummary& speeds);
  [[nodiscard]] double longest_epoch_of_world() const;
  /// The room along an axis with walls that lines take in an epoch that begins at time t, and all that coordinates have: lengths.
  [[nodiscard]] double layer_of_lines(int axis, double t) const;
  [[nodiscard]] double layer_of_coordinates(int axis) const { return 0x1p63 * flight_.axis(axis).unit * 2.0; }
  /// Whether walls may be so far outside the box at time t that an epoch which begins then makes coordinates coarser. It may say
  /// so where that is not so by a rounding.
  [[nodiscard]] bool may_widen_coordinates(double t) const;
  void reset_falling_frame();

  void make_lists();
  [[nodiscard]] bool outgrow_lists() const;
  void rebuild(double half_width);
  void set_half_width(double half_width);
  [[nodiscard]] std::vector<NeighbourhoodCentre> new_centres() const;
  void find_steps();
  /// Lets predictions read the steps of the potential where the impact has them.
  void point_at_potential() {
    if constexpr (!Impact::plain)
      if (const auto& potential = impact_.potential(); potential.present()) {
        frame_.reach = potential.reach();
        frame_.outside = potential.outside();
        frame_.edges = potential.edges().data();
        frame_.pair_steps = potential.table();
      }
  }
  void update_shear();
  void leave_room_for_shear(const std::vector<NeighbourhoodCentre>& centres);

  Layout layout_;
  Impact impact_;
  World world_;
  FlightFrame<Line, World> flight_;
  BoundaryPlanner<Line, World> boundaries_;
  PredictionFrame frame_;
  const PredictionKernel<Line>& kernel_;

  LargeVector<Line> lines_;
  LargeVector<std::int32_t> ids_;
  Plans plans_;
  NeighbourLists lists_;
  FutureEventList<Plans> queue_;

  bool part_ = false;     ///< of the box: there are other engines for the rest
  bool stopped_ = false;  ///< a part has come to an event that concerns the whole
  Instant epoch_;         ///< the loop's zero of time
  double now_ = 0.0;
  double epoch_length_ = 0.0;
  std::uint32_t stamp_ = 1;  ///< counts collisions with disks and walls since the epoch began; what was before has 0 or 1
  double mean_speed_ = 0.0;  ///< mean of |v_x| + |v_y| when the epoch began
  FlightLimits limits_;
  DiskSizes sizes_;

  NeighbourhoodTuning tuning_;
  QueuePacing pacing_;
  Prefetcher prefetcher_;
  StallDetector stall_;
  CommonMotion<double> common_motion_;
  CollisionRecorder recorder_;
  RunningTotals totals_;
  RunningTotals* counted_ = &totals_;  ///< where events are counted now
  LastInstant last_collision_;
};

}  // namespace carom
