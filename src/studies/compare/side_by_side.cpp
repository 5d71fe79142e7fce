#include "studies/compare/side_by_side.hpp"

#include "observe/mechanics.hpp"
#include "studies/state_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {

namespace {

constexpr std::size_t most_distances = 1000;  ///< a plot shows no more

/// Returns the method that runs for the fixed-step side: guarded and grid have one trajectory to the last bit, and grid is O(N).
FixedStep as_flown(const FixedStep& step) { return {step.method == "guarded" ? "grid" : step.method, step.dt, step.stiffness}; }

class Flight {
 public:
  Flight(const Scene& scene, const State& start, const SideBySideOptions& options)
      : scene_(scene),
        options_(options),
        exact_(make_simulation(scene, start, options.engine)),
        stepped_(make_simulation(scene, start, as_flown(options.step))),
        overlaps_(scene.box, exact_.disks()),
        velocities_(start.velocities),
        dt_(options.step.dt) {
    shown_.step = options.step;
    shown_.engine = exact_.engine();
    shown_.start = exact_.state();
    shown_.disks = exact_.disks();
    shown_.sigma = options.sigma;
    shown_.free_time = options.free_time;
    exact_.record_events(true);
  }

  SideBySide operator()() {
    until_ = options_.until;
    energy_ = kinetic_energy(shown_.disks, shown_.start);
    stepped_.run_until_sample(0, dt_);  // the first step is at 0
    before_ = stepped_.state();
    note_distance(0);
    for (std::uint64_t k = 0; at(k) < until_ * (1.0 - rounding); ++k) {
      if (!goes_on(k) || !fly_exactly(k)) break;
      fly_steps(k);
      shown_.until = ends_with_a_step(k) ? at(k + 1) : until_;
      if (!ends_with_a_step(k) || (k + 1) % stride_ != 0) continue;
      note_distance(k + 1);
      if (shown_.because == ShownUntil::end) look_for_parting();
    }
    shown_.overlaps = overlaps_.found();
    return std::move(shown_);
  }

 private:
  static constexpr double rounding = 1e-12;  // of times and places: a few thousand operations

  [[nodiscard]] double at(std::uint64_t k) const { return static_cast<double>(k) * dt_; }
  /// The last stretch may be shorter than a step.
  [[nodiscard]] bool ends_with_a_step(std::uint64_t k) const { return at(k + 1) <= until_ * (1.0 + rounding); }

  /// Returns whether another step from step k is wanted and fits.
  bool goes_on(std::uint64_t k) {
    const auto disks = static_cast<double>(shown_.disks.count());
    const bool is_naive = options_.step.method.starts_with("naive");
    const double work = static_cast<double>(k) * (1e4 + 300.0 * disks + (is_naive ? 5.0 * disks * disks : 0.0));
    const std::size_t numbers = 6 * shown_.events.size() + 3 * shown_.turns.size() + 3 * overlaps_.found().size();
    std::optional<ShownUntil> why_not;
    if (numbers > options_.limits.numbers) why_not = ShownUntil::numbers;
    if (work > options_.limits.work) why_not = ShownUntil::work;
    if (k % 16 == 0 && options_.proceed && !options_.proceed(at(k) / until_)) why_not = ShownUntil::stopped;
    if (why_not) shown_.because = *why_not;
    return !why_not;
  }

  bool fly_exactly(std::uint64_t k) {
    const StopReason reason = ends_with_a_step(k) ? exact_.run_until_sample(k + 1, dt_) : exact_.run_until(until_);
    if (reason != StopReason::time) {
      shown_.because = ShownUntil::stuck;
      return false;
    }
    exact_.take_events(batch_);
    shown_.events.insert(shown_.events.end(), batch_.begin(), batch_.end());
    return true;
  }

  /// The velocity of a flight is that after the step; where a method changes it after the move (naive), it follows from the
  /// displacement.
  void fly_steps(std::uint64_t k) {
    const bool whole = ends_with_a_step(k);
    const double lasting = whole ? dt_ : until_ - at(k);
    if (whole)
      stepped_.run_until_sample(k + 1, dt_);
    else
      stepped_.run_until(until_);
    State after = stepped_.state();
    const Eigen::Vector2d lengths = scene_.box.lengths();
    for (Eigen::Index i = 0; i < velocities_.cols(); ++i) {
      const Eigen::Vector2d round = (after.images.col(i) - before_.images.col(i)).cast<double>().cwiseProduct(lengths);
      const Eigen::Vector2d way = after.positions.col(i) - before_.positions.col(i) + round;
      Eigen::Vector2d flown = before_.velocities.col(i);
      if ((way - lasting * flown).norm() > rounding * (lengths.norm() + way.norm())) flown = way / lasting;
      if (flown == velocities_.col(i)) continue;
      velocities_.col(i) = flown;
      shown_.turns.push_back({static_cast<std::uint32_t>(k), static_cast<std::int32_t>(i), flown});
    }
    overlaps_.fly(before_.positions, velocities_, at(k), lasting);
    before_ = std::move(after);
  }

  /// Once they have parted, as much again is enough.
  void look_for_parting() {
    if (shown_.distance.back() < clearly_parted) return;
    const double enough = std::max(2.0 * shown_.times.back(), 10.0 * options_.free_time);
    if (enough >= until_) return;
    until_ = std::max(enough, shown_.until);
    shown_.because = ShownUntil::parted;
  }

  /// At step k. Of more than enough steps every second one is left out.
  void note_distance(std::uint64_t k) {
    const State exact = exact_.state();
    shown_.times.push_back(at(k));
    shown_.distance.push_back(rms_distance(scene_.box, before_, exact) / shown_.sigma);
    const auto note_change = [&](double& largest, const State& state) {
      if (energy_ > 0.0) largest = std::max(largest, std::abs(kinetic_energy(shown_.disks, state) / energy_ - 1.0));
    };
    note_change(shown_.energy_change_exact, exact);
    note_change(shown_.energy_change_stepped, before_);
    if (shown_.times.size() < most_distances) return;
    stride_ *= 2;
    for (std::size_t kept = 0; 2 * kept < shown_.times.size(); ++kept) {
      shown_.times[kept] = shown_.times[2 * kept];
      shown_.distance[kept] = shown_.distance[2 * kept];
    }
    shown_.times.resize((shown_.times.size() + 1) / 2);
    shown_.distance.resize(shown_.times.size());
  }

  const Scene& scene_;
  const SideBySideOptions& options_;
  Simulation exact_, stepped_;
  FlownOverlaps overlaps_;
  State before_;                 ///< of the fixed steps, at the last one
  Eigen::Matrix2Xd velocities_;  ///< with which they fly
  SideBySide shown_;
  std::vector<Event> batch_;
  std::uint64_t stride_ = 1;  ///< steps from one distance to the next
  double dt_, until_ = 0.0, energy_ = 0.0;
};

}  // namespace

std::optional<double> SideBySide::parted_at() const {
  for (std::size_t k = 0; k < distance.size(); ++k)
    if (distance[k] >= clearly_parted) return times[k];
  return {};
}

SideBySide fly_side_by_side(const Scene& scene, const State& start, const SideBySideOptions& options) {
  return Flight(scene, start, options)();
}

double visible_step(const ComparePlan& plan, const State& start) {
  const auto disks = static_cast<double>(std::max<Eigen::Index>(1, start.velocities.cols()));
  const double speed = std::sqrt(start.velocities.squaredNorm() / (2.0 * disks));  // of one component
  const double wanted = std::min(0.02 * plan.sigma / speed, 0.1 * plan.mean_free_time);
  return *std::min_element(plan.dts.begin(), plan.dts.end(),
                           [&](double a, double b) { return std::abs(std::log(a / wanted)) < std::abs(std::log(b / wanted)); });
}

}  // namespace carom
