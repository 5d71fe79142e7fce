// Playback from sample to sample: straight lines, the short way where the box is periodic.

#include "pages/playback_source.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace carom::detail {

namespace {

class SampleSource : public Playback::Source {
 public:
  SampleSource(const RunReader& run, std::optional<Trails> trails)
      : run_(run), times_(run.sample_times()), trails_(std::move(trails)) {}

  void read(double time, Moment& moment) override {
    const auto after = std::upper_bound(times_.begin(), times_.end(), time) - times_.begin();
    go_to(static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - 1, 0)));
    const Box& box = run_.scene().box;
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
    const Box& box = run_.scene().box;
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
    for (std::size_t i = 0; i < run_.disks().count(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const Eigen::Vector2d velocity = length_ > 0.0 ? Eigen::Vector2d(way_.col(column) / length_) : Eigen::Vector2d::Zero();
      trails_->note(i, from_.time, from_.positions.col(column), velocity, from_.shear_displacement + 0.5 * slid_);
    }
  }

  const RunReader& run_;
  std::vector<double> times_;
  std::optional<Trails> trails_;
  std::optional<std::size_t> current_;
  State from_, to_;
  Eigen::Matrix2Xd way_;
  double length_ = 0.0, slid_ = 0.0;
};

}  // namespace

std::unique_ptr<Playback::Source> sample_source(const RunReader& run, std::optional<Trails> trails) {
  return std::make_unique<SampleSource>(run, std::move(trails));
}

}  // namespace carom::detail
