#include "observe/wall_reach.hpp"

#include "scene/changes.hpp"
#include "scene/walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace carom {

namespace {

/// One wall while the run goes on; displacements are outward from the side of the box.
class Reach {
 public:
  Reach(double sign, double displacement, bool equilibrated)
      : sign_(sign), at_(displacement), furthest_(std::max(displacement, 0.0)), equilibrated_(equilibrated) {}

  [[nodiscard]] double furthest() const { return furthest_; }

  /// The wall moves with these properties for some time, which may be infinite.
  void go_on(const WallProperties& wall, double time) {
    if (wall.oscillation && wall.oscillation->moves()) return vibrate(*wall.oscillation, time);
    oscillation_.reset();
    equilibrated_ = false;
    const double velocity = sign_ * wall.velocity.value_or(0.0), displacement = velocity == 0.0 ? at_ : at_ + velocity * time;
    if (wall.mass || !std::isfinite(displacement)) return;
    at_ = displacement;
    furthest_ = std::max(furthest_, at_);
  }

 private:
  void vibrate(const Oscillation& oscillation, double time) {
    if (!(oscillation_ == oscillation)) {
      oscillation_ = oscillation;
      elapsed_ = 0.0;
      begun_at_ = equilibrated_ ? 0.0 : at_;  // one that vibrated before the measured run began at the side of the box
      elapsed_known_ = !equilibrated_;
      equilibrated_ = false;
    }
    const double outermost = begun_at_ + (2.0 * oscillation.amplitude - inward_reach(oscillation));
    furthest_ = std::max(furthest_, outermost);
    elapsed_ += time;
    at_ = elapsed_known_ && std::isfinite(elapsed_) ? begun_at_ - inward_after(oscillation, elapsed_) : outermost;
  }

  double sign_;  ///< of the outward direction
  double at_, furthest_;
  bool equilibrated_;                            ///< the wall has moved before the measured run as it does now
  std::optional<Oscillation> oscillation_ = {};  ///< that goes on
  double begun_at_ = 0.0, elapsed_ = 0.0;        ///< where and how long ago it began
  bool elapsed_known_ = true;
};

}  // namespace

Box reach_of_walls(const ObservedRun& run, const State& start) {
  Box box = run.scene.box;
  if (box.is_circle) return box;
  std::array<std::optional<Reach>, 4> walls;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (box.periodic(axis_of_wall(w))) continue;
    const double sign = is_upper_wall(w) ? 1.0 : -1.0;
    const double displacement = start.walls.size() == walls.size() ? sign * (start.walls[w].position - edge_of(box, w)) : 0.0;
    walls[w].emplace(sign, displacement, run.scene.run.equilibrate.has_value());
  }
  const double end = run.time.value_or(std::numeric_limits<double>::infinity());
  Effects acting = *run.acting;
  double now = start.time;
  const auto go_on_until = [&](double time) {
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (walls[w]) walls[w]->go_on(acting.walls[w], time - now);
    now = time;
  };
  for (const Change& change : std::span(run.scene.changes).subspan(run.changes_made)) {
    if (change.time >= end) break;
    go_on_until(change.time);
    acting = effects_after(acting, change);
  }
  go_on_until(end);
  for (std::size_t w = 0; w < walls.size(); ++w)
    if (walls[w]) edge_of(box, w) += (is_upper_wall(w) ? 1.0 : -1.0) * walls[w]->furthest();
  return box;
}

}  // namespace carom
