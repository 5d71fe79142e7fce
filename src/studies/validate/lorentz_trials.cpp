// The Lorentz gas: one ball among fixed disks on a triangular lattice.

#include "studies/validate/gas.hpp"
#include "theory/lorentz_gas.hpp"

#include <carom/blocking.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace carom::validation {

namespace {

/// What the ball does between samples: hits, and ways, of which the sum of Green and Kubo is made.
class BallFollower final : public Observable {
 public:
  struct Means {
    Blocking hits;       ///< hits per time
    Blocking diffusion;  ///< d_0 . (d_0 + 2 sum of those before) / (4 step), over the way d of one step
  };
  /// The sum runs over so many steps before.
  BallFollower(double step, std::size_t memory, const Box& box, Means& means)
      : step_(step), lengths_(box.lengths()), before_(memory, Eigen::Vector2d::Zero()), means_(means) {}
  [[nodiscard]] std::string name() const override { return "ball_follower"; }
  [[nodiscard]] double step() const override { return step_; }
  void sample(const State& state, const Totals& totals) override {
    const Eigen::Vector2d place = state.positions.col(0) + lengths_.cwiseProduct(state.images.col(0).cast<double>());
    if (samples_ > 0) {
      const Eigen::Vector2d way = place - place_;
      means_.hits.add(static_cast<double>(totals.obstacle - hits_) / step_);
      if (samples_ > before_.size()) means_.diffusion.add(way.dot(way + 2.0 * recent_) / (4.0 * step_));
      Eigen::Vector2d& oldest = before_[samples_ % before_.size()];
      recent_ += way - oldest;
      oldest = way;
    }
    ++samples_;
    place_ = place;
    hits_ = totals.obstacle;
  }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double step_;
  Eigen::Vector2d lengths_;
  std::vector<Eigen::Vector2d> before_;  ///< the last ways, in a ring
  Eigen::Vector2d recent_ = Eigen::Vector2d::Zero(), place_ = Eigen::Vector2d::Zero();
  std::uint64_t hits_ = 0;
  std::size_t samples_ = 0;
  Means& means_;
};

/// A ball and two scatterers, all of radius 1/2 so that centres are 1 apart in a hit, and two rows of the lattice.
Scene lorentz_scene(double gap, double time, std::uint64_t seed) {
  const double apart = 2.0 + gap;
  Scene scene{
      .box = {.upper = {apart, apart * std::numbers::sqrt3}, .boundary = {Boundary::periodic, Boundary::periodic}},
      .species = {{.count = 1, .radius = 0.5, .mass = 1.0, .positions = RandomPositions{}, .velocities = FixedSpeed{1.0}}},
      .effects = {},
      .run = {.time = time, .equilibrate = Run::Equilibrate{.time = 100.0}, .seed = seed, .keep_momentum = true}};
  scene.effects.obstacles = {DiskObstacle{{0.0, 0.0}, 0.5}, DiskObstacle{{0.5 * apart, 0.5 * apart * std::numbers::sqrt3}, 0.5}};
  return scene;
}

std::string of_gap(double gap) { return fmt::format("Lorentz gas on a triangular lattice, gap {:g} radii", gap); }

BallFollower::Means follow_ball(double gap, double hits, double step, std::size_t memory, const Effort& effort,
                                TrialResult& result) {
  const Scene scene = lorentz_scene(gap, hits * theory::lorentz_mean_free_path(gap), effort.seed_of(0));
  BallFollower::Means means;
  std::vector<std::unique_ptr<Observable>> own;
  own.push_back(std::make_unique<BallFollower>(step, memory, scene.box, means));
  (void)run(scene, effort, result, std::move(own));
  return means;
}

/// Returns the mean path between hits, from hits per time at speed 1.
Check path_check(double gap, const Blocking& hits, double largest_error) {
  const auto estimate = hits.estimate();
  const double path = 1.0 / estimate->mean;
  return {.name = "mean free path, " + of_gap(gap),
          .theory = "pi A / P = (sqrt(3) / 2 (2 + w)^2 - pi) / 2, exact",
          .source = "geometry; docs/validation.md",
          .expected = theory::lorentz_mean_free_path(gap),
          .measured = {path, path * path * estimate->error.value_or(NAN)},
          .largest_error = largest_error};
}

TrialResult lorentz_path(const std::string& trial, double gap, const Effort& effort) {
  TrialResult result{.trial = trial};
  const BallFollower::Means means = follow_ball(gap, effort.full ? 8e7 : 1e6, 20.0, 1, effort, result);
  result.checks.push_back(path_check(gap, means.hits, effort.full ? 1e-4 * theory::lorentz_mean_free_path(gap) : 0.0));
  return result;
}

TrialResult lorentz_diffusion(const std::string& trial, double gap, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr double step = 1.0;
  const double residence = theory::lorentz_residence_time(gap), largest_error = 1e-3;
  const auto memory = static_cast<std::size_t>(6.0 * residence / step);
  // Of ways without memory, 2 memory / steps is the square of the relative error of the sum; with theirs the error is a twentieth
  // larger, 0.80 of the largest that the check may have. That of the map is 0.41 of it, and both together 0.90.
  const double steps = 2.0 * static_cast<double>(memory) / std::pow(0.76 * largest_error, 2);
  const double hits = steps * step / theory::lorentz_mean_free_path(gap) * (effort.full ? 1.0 : 0.01);
  const BallFollower::Means means = follow_ball(gap, hits, step, memory, effort, result);
  const auto twin_orbits = static_cast<std::int64_t>(effort.full ? 20'000 : 50);
  const theory::LorentzDiffusion twin = theory::lorentz_diffusion(gap, twin_orbits, 20'000, effort.seed_of(1));
  const auto estimate = means.diffusion.estimate();
  const Measured measured{estimate->mean, estimate->error.value_or(NAN)};
  result.checks.push_back({.name = "diffusion coefficient, " + of_gap(gap),
                           .theory = "Green and Kubo's sum for the collision map, by a program without engine",
                           .source = "docs/validation.md",
                           .expected = twin.value,
                           .measured = measured,
                           .reference_error = twin.error,
                           .largest_error = effort.full ? largest_error * twin.value : 0.0});
  result.checks.push_back(path_check(gap, means.hits, 0.0));
  result.checks.push_back({.name = "diffusion coefficient without memory, " + of_gap(gap),
                           .theory = "w (2 + w)^2 / (pi (sqrt(3) (2 + w)^2 - 2 pi)), for a vanishing gap",
                           .source = "Machta & Zwanzig, Phys. Rev. Lett. 50, 1959 (1983)",
                           .expected = theory::machta_zwanzig_diffusion(gap),
                           .measured = measured,
                           .judged = Judged::shown});
  return result;
}

}  // namespace

void add_lorentz_paths(std::vector<Trial>& trials) {
  constexpr double gap = 0.25;
  const std::string name = fmt::format("lorentz-path-{:g}", gap);
  trials.push_back({name, "collisions", false, [=](const Effort& effort) { return lorentz_path(name, gap, effort); }});
}

void add_lorentz_diffusion(std::vector<Trial>& trials) {
  for (const double gap : {0.2, 0.3}) {
    const std::string name = fmt::format("lorentz-diffusion-{:g}", gap);
    trials.push_back(
        {name, "transport", true, [=](const Effort& effort) { return lorentz_diffusion(name, gap, effort); }, false, 10.0});
  }
}

}  // namespace carom::validation
