#pragma once
// What the page measures.

#include "json.hpp"
#include "live/live_run.hpp"
#include "observe/mechanics.hpp"

#include <carom/blocking.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

namespace carom::playground {

/// Means over the time since the last change of the run, with errors: taken at multiples of a step.
class Measured {
 public:
  void begin(const LiveRun& run, double step) {
    *this = {};
    step_ = step;
    began_ = run.time();
    totals_ = run.simulation().totals();
    const Disks& disks = run.simulation().disks();
    State state;
    run.state(state);
    const double temperature = kinetic_temperature(run.simulation().scene().box, run.simulation().scene().effects, disks, state);
    const double lightest = disks.mass.empty() ? 1.0 : *std::min_element(disks.mass.begin(), disks.mass.end());
    range_ = temperature > 0.0 ? 3.2 * std::sqrt(2.0 * temperature / lightest) : 1.0;
  }
  [[nodiscard]] double next() const { return began_ + static_cast<double>(samples_ + 1) * step_; }

  void sample(const LiveRun& run, const State& state) {
    const Simulation& simulation = run.simulation();
    const Scene& scene = simulation.scene();
    const Disks& disks = simulation.disks();
    const Totals totals = simulation.totals();
    ++samples_;
    const double count = static_cast<double>(disks.count());
    const double heat = count * kinetic_temperature(scene.box, scene.effects, disks, state);
    const Box box = box_of(scene.box, state);
    const double force = heat + (totals.virial - totals_.virial) / (2.0 * step_);
    pressure_.add(force / box.area());
    factor_.add(force, heat);
    integral_ += force / box.area() * step_;
    for (std::size_t k = 0; k < 4; ++k) {
      const double length = box.lengths()[k < 2 ? 1 : 0];
      walls_[k].add(box.is_circle ? (totals.circle_impulse - totals_.circle_impulse) / (step_ * std::numbers::pi * length)
                                  : (totals.wall_impulse[k] - totals_.wall_impulse[k]) / (step_ * length));
    }
    pairs_ += totals.pair - totals_.pair;
    double speeds = 0.0;
    std::uint64_t beyond = 0;
    for (Eigen::Index i = 0; i < state.velocities.cols(); ++i) {
      const double speed = state.velocities.col(i).norm();
      speeds += speed;
      const auto bin = static_cast<std::size_t>(speed / range_ * static_cast<double>(bins));
      if (bin >= bins) ++beyond;
      ++histogram_[std::min(bin, bins - 1)];
    }
    path_ += speeds * step_;
    if (static_cast<double>(beyond) > 0.02 * count) widen();
    totals_ = totals;
  }

  static constexpr std::size_t bins = 60;
  [[nodiscard]] const std::array<double, bins>& histogram() const { return histogram_; }
  [[nodiscard]] double range() const { return range_; }
  [[nodiscard]] double integral() const { return integral_; }
  [[nodiscard]] double covered() const { return static_cast<double>(samples_) * step_; }
  [[nodiscard]] double step() const { return step_; }
  /// Mean free path: the way of all disks over twice the collisions.
  [[nodiscard]] double free_path() const {
    return pairs_ > 0 ? path_ / (2.0 * static_cast<double>(pairs_)) : std::numeric_limits<double>::quiet_NaN();
  }

  [[nodiscard]] std::string json() const {
    const auto estimate = [](const Blocking& blocking, const char* name) {
      const auto result = blocking.estimate();
      return fmt::format("\"{}\":{},\"{}_error\":{}", name, result ? json_number(result->mean) : "null", name,
                         result ? json_number(result->error) : "null");
    };
    std::string text = fmt::format("{},{},\"walls\":[", estimate(pressure_, "pressure"), estimate(factor_, "Z"));
    for (std::size_t k = 0; k < 4; ++k) text += fmt::format("{}{{{}}}", k > 0 ? "," : "", estimate(walls_[k], "pressure"));
    return text + "]";
  }

 private:
  /// Doubles the range of speeds.
  void widen() {
    for (std::size_t b = 0; b < bins; ++b) histogram_[b] = 2 * b + 1 < bins ? histogram_[2 * b] + histogram_[2 * b + 1] : 0.0;
    range_ *= 2.0;
  }

  double step_ = 1.0, began_ = 0.0, range_ = 1.0, integral_ = 0.0, path_ = 0.0;
  std::uint64_t samples_ = 0, pairs_ = 0;
  Totals totals_;
  Blocking pressure_, factor_;
  std::array<Blocking, 4> walls_;
  std::array<double, bins> histogram_{};
};

}  // namespace carom::playground
