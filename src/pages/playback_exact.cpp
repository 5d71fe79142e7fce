// Playback from the events.

#include "pages/playback_source.hpp"
#include "pages/replay.hpp"

#include <limits>
#include <optional>
#include <utility>

namespace carom::detail {

namespace {

class ExactSource : public Playback::Source {
 public:
  ExactSource(const RunReader& run, ExactRun exact, std::optional<Trails> trails)
      : run_(run), exact_(std::move(exact)), trails_(std::move(trails)) {}

  void read(double time, Moment& moment) override {
    if (!(time >= now_)) begin_anew();
    now_ = time;
    for (; next_ < exact_.events.size() && exact_.events[next_].time <= time; ++next_) apply(exact_.events[next_]);
    const Scene& scene = run_.scene();
    moment.time = time;
    moment.positions.resize(2, exact_.start.positions.cols());
    moment.velocities.resize(2, exact_.start.positions.cols());
    for (std::size_t i = 0; i < collisions_.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const Eigen::Vector2d position = replay_->position(i, time);
      moment.positions.col(column) = position + into_box(scene.box, position);
      moment.velocities.col(column) = replay_->velocity(i, time);
    }
    moment.scale = exact_.start.scale;
    moment.scale += scene.effects.growth_rate() * (time - exact_.start.time);
    for (std::size_t side = 0; side < 4; ++side) {
      const Replay::Side& now = replay_->sides()[side];
      const double dt = time - now.time;
      moment.sides[side] = now.position + (now.velocity + 0.5 * now.acceleration * dt) * dt;
    }
    moment.collisions = collisions_;
    if (trails_) moment.trails = trails_->until(time);
  }

 private:
  void begin_anew() {
    const std::size_t disks = run_.disks().count();
    replay_.emplace(run_.scene(), run_.disks(), exact_.start);
    next_ = 0;
    collisions_.assign(disks, 0);
    if (!trails_) return;
    trails_->forget();
    for (std::size_t i = 0; i < disks; ++i) note(i, exact_.start.time);
  }

  void apply(const Event& event) {
    const bool all_turned = replay_->apply(event).has_value();
    const auto disk = static_cast<std::size_t>(event.disk);
    ++collisions_[disk];
    if (event.partner >= 0) ++collisions_[static_cast<std::size_t>(event.partner)];
    if (!trails_) return;
    if (all_turned) {
      for (std::size_t i = 0; i < collisions_.size(); ++i) note(i, event.time);
      return;
    }
    note(disk, event.time);
    if (event.partner >= 0) note(static_cast<std::size_t>(event.partner), event.time);
  }
  void note(std::size_t disk, double time) {
    trails_->note(disk, time, replay_->position(disk, time), replay_->velocity(disk, time));
  }

  const RunReader& run_;
  ExactRun exact_;
  std::optional<Replay> replay_;
  std::optional<Trails> trails_;
  std::vector<std::uint64_t> collisions_;
  std::size_t next_ = 0;
  double now_ = std::numeric_limits<double>::quiet_NaN();  // nothing was read yet
};

}  // namespace

std::unique_ptr<Playback::Source> exact_source(const RunReader& run, ExactRun exact, std::optional<Trails> trails) {
  return std::make_unique<ExactSource>(run, std::move(exact), std::move(trails));
}

}  // namespace carom::detail
