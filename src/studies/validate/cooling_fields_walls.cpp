// Gases that lose energy, that have weight, that press on walls.

#include "studies/validate/gas.hpp"
#include "theory/barometer.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/kinetic.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <carom/blocking.hpp>

#include <array>
#include <cmath>

namespace carom::validation {

namespace {

/// Mean of v^2 and of v^4, without the motion of all.
std::array<double, 2> moments(const State& state) {
  const Eigen::Vector2d drift = state.velocities.rowwise().mean();
  const Eigen::VectorXd squares = (state.velocities.colwise() - drift).colwise().squaredNorm().transpose();
  return {squares.mean(), squares.squaredNorm() / static_cast<double>(squares.size())};
}

/// Returns an equilibrium of elastic disks, whose state a gas that cools begins with.
State equilibrium(std::int64_t disks, double eta, const Effort& effort, std::uint64_t seed) {
  TrialResult not_kept;
  const Gas gas{.disks = disks, .packing_fraction = eta, .collisions = 1.0, .equilibrate = 20.0};
  State state = run(scene_of(gas, seed), effort, not_kept).simulation.state();
  state.time = 0.0;
  return state;
}

Scene cooling_scene(std::int64_t disks, double eta, double restitution, double time, double step) {
  Scene scene = scene_of({.disks = disks, .packing_fraction = eta}, 1);
  scene.effects.collision.restitution = restitution;
  scene.run = {.time = time, .sample_every = step};
  return scene;
}

/// Looks at a gas while it cools.
class Thermometer final : public Observable {
 public:
  struct Reading {
    double time, square, fourth;
  };
  Thermometer(double step, std::vector<Reading>& readings) : step_(step), readings_(readings) {}
  [[nodiscard]] std::string name() const override { return "thermometer"; }
  [[nodiscard]] double step() const override { return step_; }
  void sample(const State& state, const Totals&) override {
    const auto [square, fourth] = moments(state);
    readings_.push_back({state.time, square, fourth});
  }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double step_;
  std::vector<Reading>& readings_;
};

/// A cooling gas: of so few disks that the longest shear wave of the box decays faster than the gas cools, or of many, where it
/// grows and Haff's law fails.
struct Cooling {
  std::int64_t disks;
  double restitution;
  std::size_t replicas;  ///< in a quick validation
  double end;
  Judged judged;
};

TrialResult haff(const std::string& trial, const Cooling& gas, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr double eta = 0.1;
  const std::int64_t disks = gas.disks;
  const bool control = gas.judged == Judged::disagrees;
  const double e = gas.restitution, limit = theory::shear_instability(e, eta);
  const double end = gas.end, step = end / 10.0, rate = theory::haff_rate(e, eta, disks);
  const std::size_t replicas = effort.full ? 20 * gas.replicas : gas.replicas;
  std::vector<std::vector<double>> inverse(11);
  for (std::size_t r = 0; r < replicas; ++r) {
    const State start = equilibrium(disks, eta, effort, effort.seed_of(r));
    std::vector<Thermometer::Reading> readings;
    std::vector<std::unique_ptr<Observable>> own;
    own.push_back(std::make_unique<Thermometer>(step, readings));
    (void)run(cooling_scene(disks, eta, e, end, end), effort, result, std::move(own), [&](State& state) { state = start; });
    for (std::size_t k = 0; k < inverse.size(); ++k)
      inverse[k].push_back(std::sqrt(readings.front().square / readings.at(k).square));
  }
  result.scenes.resize(1);
  Curve curve{.plot = "haff", .name = fmt::format("{} disks", disks)};
  for (std::size_t k = 0; k < inverse.size(); ++k) {
    const Measured mean = mean_of(inverse[k]);
    const double time = static_cast<double>(k) * step;
    curve.x.push_back(time);
    curve.y.push_back(mean.value);
    curve.error.push_back(mean.error);
    if (control ? k != 10 : k != 2 && k != 5 && k != 10) continue;
    result.checks.push_back(
        {.name = fmt::format("1 / t_H of {} cooling disks of restitution {}, from t = 0 to {:g}{}", disks, e, time,
                             control ? " (must not fit)" : ""),
         .theory = control ? fmt::format("Haff's law, which fails by shear waves in boxes of more than {:.0f} disks", limit)
                           : "(1 - e^2) omega_0 / 4 N / (N - 1) (1 + 3 a2 / 16), with omega_0 and <g^3> of so many disks at "
                             "fixed energy, and for lumps of energy (1 + 3 (1 - e^2) / 2 N)",
         .source = control ? "Brito & Ernst, Europhys. Lett. (1998), arXiv:cond-mat/9807224"
                           : "Haff, J. Fluid Mech. 134, 401 (1983); a2: van Noije & Ernst, Granular Matter 1, 57 (1998)",
         .expected = rate,
         .measured = {(mean.value - 1.0) / time, mean.error / time},
         .allowance = theory::haff_slowing(e, eta, control ? 256 : disks) * rate,
         .allowance_for = control ? "what shear waves take in a box of 256 disks, where they decay"
                                  : fmt::format("shear waves decay little faster than the gas cools: of wave number n they hold "
                                                "1 / (1 - N / {:.0f} n^2) times their share of the energy, which cools nothing",
                                                limit),
         .judged = gas.judged});
  }
  result.curves.push_back(std::move(curve));
  result.curves.push_back({.plot = "haff",
                           .name = fmt::format("Haff's law, {} disks", disks),
                           .theory = true,
                           .x = {0.0, end},
                           .y = {1.0, 1.0 + rate * end}});
  return result;
}

TrialResult kurtosis(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr double e = 0.8, eta = 0.05;
  // So few that the box has no room for shear waves that grow.
  constexpr std::int64_t disks = 100;
  const std::size_t replicas = effort.full ? 4000 : 400;
  const double rate = theory::disk_collision_rate(theory::kolafa_rottner(eta));
  std::vector<double> ratios;
  for (std::size_t r = 0; r < replicas; ++r) {
    const State start = equilibrium(disks, eta, effort, effort.seed_of(r));
    std::vector<Thermometer::Reading> readings;
    std::vector<std::unique_ptr<Observable>> own;
    // Ten collisions per disk at the first rate are some six, enough to forget the elastic start.
    const double step = 10.0 / rate;
    own.push_back(std::make_unique<Thermometer>(step, readings));
    (void)run(cooling_scene(disks, eta, e, 3.0 * step, step), effort, result, std::move(own),
              [&](State& state) { state = start; });
    double mean = 0.0;
    for (std::size_t k = 1; k < readings.size(); ++k)
      mean += readings[k].fourth / (readings[k].square * readings[k].square) / static_cast<double>(readings.size() - 1);
    ratios.push_back(mean);
  }
  result.scenes.resize(1);
  const double N = disks;
  const double expected = theory::cooling_kurtosis(e) * (N - 1.0) / N;
  result.checks.push_back({.name = "kurtosis <v^4> / <v^2>^2 of a homogeneously cooling gas of restitution 0.8",
                           .theory = "2 (1 + a2) (N - 1) / N, a2 = 16 (1 - e) (1 - 2 e^2) / (57 - 25 e + 30 e^2 (1 - e))",
                           .source = "van Noije & Ernst, Granular Matter 1, 57 (1998)",
                           .expected = expected,
                           .measured = mean_of(ratios),
                           .allowance = 0.1 * std::abs(theory::cooling_sonine(e)),
                           .allowance_for = "terms of order a2^2 and a3, left out of a2: 5 % of 2 a2"});
  result.checks.push_back({.name = "the same against Maxwell's 2 (must not fit)",
                           .theory = "2 (N - 1) / N",
                           .source = "Maxwell",
                           .expected = 2.0 * (N - 1.0) / N,
                           .measured = mean_of(ratios),
                           .judged = Judged::disagrees});
  return result;
}

/// Counts disks in layers.
class Layers final : public Observable {
 public:
  static constexpr std::size_t layers = 8;
  Layers(double step, double bottom, double height, std::array<Blocking, layers>& counts)
      : step_(step), bottom_(bottom), height_(height), counts_(counts) {}
  [[nodiscard]] std::string name() const override { return "layers"; }
  [[nodiscard]] double step() const override { return step_; }
  void sample(const State& state, const Totals&) override {
    std::array<double, layers> now = {};
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
      const double at = (state.positions(1, i) - bottom_) / height_;
      if (at >= 0.0 && at < static_cast<double>(layers)) now[static_cast<std::size_t>(at)] += 1.0;
    }
    for (std::size_t k = 0; k < layers; ++k) counts_[k].add(now[k]);
  }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double step_, bottom_, height_;
  std::array<Blocking, layers>& counts_;
};

TrialResult barometer(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr double g = 0.1, radius = 0.1, width = 40.0, height = 60.0, layer = 5.0;
  constexpr int disks = 200;
  Scene scene{
      .box = {.upper = {width, height}, .boundary = {Boundary::periodic, Boundary::walls}},
      .species = {{.count = disks, .radius = radius, .mass = 1.0, .velocities = MaxwellVelocities{1.0}}},
      .effects = {.gravity = Gravity{{0.0, -g}}},
      .run = {
          .time = effort.full ? 200'000.0 : 20'000.0, .equilibrate = Run::Equilibrate{.time = 500.0}, .seed = effort.seed_of(0)}};
  scene.effects.walls[2].temperature = 1.0;  // the bottom
  std::array<Blocking, Layers::layers> counts;
  std::vector<std::unique_ptr<Observable>> own;
  own.push_back(std::make_unique<Layers>(5.0, radius, layer, counts));
  (void)run(scene, effort, result, std::move(own));
  constexpr std::size_t steps = 598;  // of height 0.1
  const std::vector<double> density = theory::barometer(g, disks / width, radius, height - 2.0 * radius, steps);
  constexpr double dy = (height - 2.0 * radius) / static_cast<double>(steps);
  Curve measured{.plot = "barometer", .name = "measured"}, expected{.plot = "barometer", .name = "hydrostatics", .theory = true};
  for (std::size_t k = 0; k < Layers::layers; ++k) {
    double there = 0.0;
    for (std::size_t s = 0; s < steps; ++s)
      if (static_cast<std::size_t>((static_cast<double>(s) + 0.5) * dy / layer) == k) there += density[s] * width * dy;
    const auto estimate = counts[k].estimate();
    const double from = static_cast<double>(k) * layer;
    result.checks.push_back(
        {.name = fmt::format("number of disks {:g} to {:g} above the floor under gravity", from, from + layer),
         .theory = "d ln n / dy = -(m g / kT) / (Z + eta Z')",
         .source = "hydrostatics, with the equation of state",
         .expected = there,
         .measured = {estimate->mean, estimate->error.value_or(NAN)},
         .allowance = 0.001 * there,
         .allowance_for = "density at the floor: 2/3 n^2 sigma^3 more disks per length of it, 0.06 % of the lowest layer; and "
                          "terms of 1/N"});
    measured.x.push_back(from + 0.5 * layer), measured.y.push_back(estimate->mean);
    measured.error.push_back(estimate->error.value_or(0.0));
    expected.x.push_back(from + 0.5 * layer), expected.y.push_back(there);
  }
  result.curves.push_back(std::move(measured));
  result.curves.push_back(std::move(expected));
  return result;
}

TrialResult wall_pressure(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr double eta = 0.3;
  // Z from walls as a + b / sqrt N + c / N: weighted least squares over six sizes.
  constexpr std::array<std::int64_t, 6> sizes = {144, 256, 576, 1024, 2304, 4096};
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero(), cubes = Eigen::Vector3d::Zero();
  Curve measured{.plot = "wall-pressure", .name = "measured"};
  std::uint64_t k = 0;
  for (const std::int64_t disks : sizes) {
    const Gas gas{.disks = disks,
                  .packing_fraction = eta,
                  .collisions = effort.collisions(2e6),
                  .observe = {{.name = "pressure"}},
                  .boundary = Boundary::walls};
    const Found found = run(scene_of(gas, effort.seed_of(k++)), effort, result);
    const Measured Z = found.measured("pressure", "Z_walls");
    const double small = 1.0 / std::sqrt(static_cast<double>(disks));
    const Eigen::Vector3d basis(1.0, small, small * small);
    normal += basis * basis.transpose() / (Z.error * Z.error);
    right += basis * Z.value / (Z.error * Z.error);
    cubes += basis * small * small * small / (Z.error * Z.error);
    measured.x.push_back(small), measured.y.push_back(Z.value), measured.error.push_back(Z.error);
  }
  const Eigen::Matrix3d covariance = normal.inverse();
  const Eigen::Vector3d fit = covariance * right;
  // The contribution of the next term to the fit, with a coefficient as large as that of the last.
  const double next = std::abs((covariance * cubes).x() * fit.z());
  const double Z = theory::kolafa_rottner(eta);
  result.checks.push_back({.name = "Z from the force on walls, fitted for many disks, packing fraction 0.3",
                           .theory = "Z of the fluid; walls add terms of 1 / sqrt N",
                           .source = "Kolafa & Rottner, Mol. Phys. 104, 3435 (2006)",
                           .expected = Z,
                           .measured = {fit.x(), std::sqrt(covariance(0, 0))},
                           .reference_error = theory::kolafa_rottner_error(eta),
                           .allowance = next,
                           .allowance_for = "the next term of the fit, of N^-3/2, with the coefficient of the last"});
  Curve line{.plot = "wall-pressure",
             .name = fmt::format("fit {:.4f} + {:.3f} / sqrt N + {:.2f} / N", fit.x(), fit.y(), fit.z()),
             .theory = true};
  for (int step = 0; step <= 50; ++step) {
    const double small = 0.0025 * step;
    line.x.push_back(small);
    line.y.push_back(fit.x() + fit.y() * small + fit.z() * small * small);
  }
  result.curves.push_back(std::move(measured));
  result.curves.push_back(std::move(line));
  result.curves.push_back({.plot = "wall-pressure", .name = "fluid", .theory = true, .x = {0.0}, .y = {Z}});
  return result;
}

}  // namespace

void add_cooling_fields_walls(std::vector<Trial>& trials) {
  const std::string group = "cooling, weight and walls";
  for (const Cooling& gas : {Cooling{100, 0.98, 256, 250.0, Judged::agrees}, Cooling{256, 0.98, 100, 250.0, Judged::agrees},
                             Cooling{4096, 0.95, 24, 400.0, Judged::disagrees}}) {
    const std::string name = fmt::format("haff-{}-disks", gas.disks);
    trials.push_back({name, group, false, [=](const Effort& effort) { return haff(name, gas, effort); }});
  }
  trials.push_back({"cooling-kurtosis", group, false, [](const Effort& effort) { return kurtosis("cooling-kurtosis", effort); }});
  trials.push_back({"barometer", group, false, [](const Effort& effort) { return barometer("barometer", effort); }});
  trials.push_back({"wall-pressure", group, false, [](const Effort& effort) { return wall_pressure("wall-pressure", effort); }});
}

}  // namespace carom::validation
