// Playback of a run from its events or from its samples.

#include "pages/playback.hpp"

#include "pages/replay.hpp"
#include "pages/trails.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace carom {

class Playback::Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;
  virtual void read(double time, Moment& moment) = 0;
};

namespace {

/// Playback from the events.
class ExactSource : public Playback::Source {
 public:
  ExactSource(const Recording& run, ExactRun exact, std::optional<Trails> trails)
      : run_(run), exact_(std::move(exact)), trails_(std::move(trails)) {}

  void read(double time, Moment& moment) override {
    if (!(time >= now_)) begin_anew();
    now_ = time;
    for (; next_ < exact_.events.size() && exact_.events[next_].time <= time; ++next_) apply(exact_.events[next_]);
    const Scene& scene = run_.scene;
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
    for (std::size_t side = 0; side < 4; ++side) moment.sides[side] = replay_->wall_position(side, time);
    moment.collisions = collisions_;
    if (trails_) moment.trails = trails_->until(time);
  }

 private:
  void begin_anew() {
    const std::size_t disks = run_.disks.count();
    replay_.emplace(run_.scene, run_.disks, exact_.start);
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

  const Recording run_;
  ExactRun exact_;
  std::optional<Replay> replay_;
  std::optional<Trails> trails_;
  std::vector<std::uint64_t> collisions_;
  std::size_t next_ = 0;
  double now_ = std::numeric_limits<double>::quiet_NaN();  // nothing was read yet
};

/// Playback from sample to sample: straight lines, the short way where the box is periodic.
class SampleSource : public Playback::Source {
 public:
  SampleSource(const Recording& run, std::optional<Trails> trails)
      : run_(run), times_(run.sample_times()), trails_(std::move(trails)) {}

  void read(double time, Moment& moment) override {
    const auto after = std::upper_bound(times_.begin(), times_.end(), time) - times_.begin();
    go_to(static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0)));
    const Box& box = run_.scene.box;
    const double share = length_ > 0.0 ? (time - from_.time) / length_ : 0.0;
    const auto between = [&](double here, double there) { return here + share * (there - here); };
    moment.time = time;
    moment.velocities = from_.velocities;
    moment.scale = between(from_.scale, to_.scale);
    moment.shear_displacement = from_.shear_displacement + share * slid_;
    moment.positions = from_.positions + share * way_;
    for (Eigen::Index i = 0; i < moment.positions.cols(); ++i)
      moment.positions.col(i) += into_box(box, moment.positions.col(i), moment.shear_displacement);
    const std::array<double, 4> here = sides_of(box, from_), there = sides_of(box, to_);
    for (std::size_t side = 0; side < 4; ++side) moment.sides[side] = between(here[side], there[side]);
    if (trails_) moment.trails = trails_->until(time);
  }

 private:
  void go_to(std::size_t k) {
    if (current_ && k == *current_) return;
    if (trails_) {
      // Trails need every sample of the time before.
      if (!current_ || k < *current_) trails_->forget();
      std::size_t first = current_ && k > *current_ ? *current_ + 1 : 0;
      while (first < k && times_[first + 1] <= times_[k] - trails_->span()) ++first;
      for (std::size_t j = first; j < k; ++j) enter(j);
    }
    enter(k);
  }

  void enter(std::size_t k) {
    const bool is_last = k + 1 >= times_.size();
    from_ = current_ && *current_ + 1 == k ? to_ : run_.sample(k);
    to_ = is_last ? from_ : run_.sample(k + 1);
    length_ = to_.time - from_.time;
    current_ = k;
    const Box& box = run_.scene.box;
    const Eigen::Vector2d lengths = box.lengths();
    slid_ = to_.shear_displacement - from_.shear_displacement;
    slid_ -= std::round(slid_ / lengths.x()) * lengths.x();
    way_ = to_.positions - from_.positions;
    for (Eigen::Index i = 0; i < way_.cols(); ++i) {
      if (box.periodic(1)) {
        const double up = std::round(-way_(1, i) / lengths.y());  // through how many edges
        way_.col(i) += up * Eigen::Vector2d(to_.shear_displacement, lengths.y());
      }
      if (box.periodic(0)) way_(0, i) -= std::round(way_(0, i) / lengths.x()) * lengths.x();
    }
    if (!trails_) return;
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const Eigen::Vector2d velocity = length_ > 0.0 ? Eigen::Vector2d(way_.col(column) / length_) : Eigen::Vector2d::Zero();
      trails_->note(i, from_.time, from_.positions.col(column), velocity, from_.shear_displacement + 0.5 * slid_);
    }
  }

  const Recording run_;
  std::vector<double> times_;
  std::optional<Trails> trails_;
  std::optional<std::size_t> current_;
  State from_, to_;
  Eigen::Matrix2Xd way_;
  double length_ = 0.0, slid_ = 0.0;
};

}  // namespace

Playback::~Playback() = default;

Playback::Playback(const Recording& run, const PlaybackOptions& options) {
  const std::vector<double> times = run.sample_times();
  begin_ = times.front();
  last_sample_ = times.back();
  ExactRun exact = read_exactly(run, options.most_events, "are kept in memory");
  why_not_ = exact.why_not;
  end_ = last_sample_;
  if (this->exact()) end_ = std::max({run.end, last_sample_, exact.events.empty() ? 0.0 : exact.events.back().time});
  std::optional<Trails> trails;
  if (options.trail > 0.0) {
    const Eigen::Vector2d curving = this->exact() ? run.scene.effects.acceleration() : Eigen::Vector2d::Zero();
    trails.emplace(run.scene.box, curving, options.trail);
    for (std::size_t i = 0; i < run.disks.count(); ++i)
      if (!options.trails_of || run.disks.species[i] == *options.trails_of) trails->follow(i);
  }
  if (this->exact())
    source_ = std::make_unique<ExactSource>(run, std::move(exact), std::move(trails));
  else
    source_ = std::make_unique<SampleSource>(run, std::move(trails));
}

const Moment& Playback::at(double time) {
  source_->read(time, moment_);
  return moment_;
}

}  // namespace carom
