#pragma once
// How near a reversed run comes to where it was.

#include "core/nearest_image.hpp"
#include "json.hpp"
#include "live/live_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carom::playground {

/// The past of a run, and how near to it a reversed run comes: moments that are compared when the run passes them again.
class WayBack {
 public:
  void begin(const LiveRun& run, double step) {
    past_.clear();
    mirror_.reset();
    distances_.clear();
    step_ = step;
    began_ = run.time();
    count_ = 0;
    keep(run);
  }
  /// The time at which the run is to be looked at next.
  [[nodiscard]] double next() const {
    if (!mirror_) return began_ + static_cast<double>(count_) * step_;
    return past_.empty() ? std::numeric_limits<double>::infinity() : *mirror_ + (*mirror_ - past_.back().time);
  }
  void look(const LiveRun& run) { mirror_ ? compare(run) : keep(run); }
  /// Velocities have been reversed now.
  void reverse(const LiveRun& run) {
    if (mirror_) {
      begin(run, step_);
      return;
    }
    mirror_ = run.time();
    distances_.clear();
    while (!past_.empty() && past_.back().time >= *mirror_) past_.pop_back();
  }
  [[nodiscard]] std::string json() const {
    std::string text = fmt::format("\"reversed_at\":{},\"return_at\":{},\"way_back\":[", json_number(mirror_),
                                   mirror_ ? json_number(*mirror_ + (*mirror_ - began_)) : "null");
    for (std::size_t k = 0; k < distances_.size(); ++k)
      text += fmt::format("{}[{},{}]", k > 0 ? "," : "", json_number(distances_[k][0]), json_number(distances_[k][1]));
    return text + "]";
  }

 private:
  struct Past {
    double time;
    Eigen::Matrix2Xd positions;
  };
  void keep(const LiveRun& run) {
    State state;
    run.state(state);
    past_.push_back({run.time(), state.positions});
    ++count_;
    constexpr std::size_t most = 128;
    if (past_.size() <= most) return;
    std::vector<Past> half;
    for (std::size_t k = 0; k < past_.size(); k += 2) half.push_back(std::move(past_[k]));
    past_ = std::move(half);
    count_ = (count_ + 1) / 2;
    step_ *= 2.0;
  }
  /// The largest distance of a disk from where it was.
  void compare(const LiveRun& run) {
    State state;
    run.state(state);
    const Box& box = run.simulation().scene().box;
    double largest = 0.0;
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
      largest = std::max(largest, nearest_image(box, state.positions.col(i) - past_.back().positions.col(i)).norm());
    }
    distances_.push_back({run.time() - *mirror_, largest});
    past_.pop_back();
  }

  std::vector<Past> past_;
  std::optional<double> mirror_;
  std::vector<std::array<double, 2>> distances_;
  double step_ = 1.0, began_ = 0.0;
  std::uint64_t count_ = 0;
};

}  // namespace carom::playground
