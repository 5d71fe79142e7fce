// Pressure: the fluid at twelve densities, small systems without any correction, the virial series, the transition from liquid to
// hexatic, the solid near close packing.

#include "studies/validate/gas.hpp"
#include "studies/validate/in_threads.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/kinetic.hpp"
#include "theory/microcanonical.hpp"

#include <carom/blocking.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <thread>
#include <vector>

namespace carom::validation {

namespace {

constexpr double pi = std::numbers::pi;

/// One density of the fluid: as many disks as correlations ask for, and collisions.
struct Density {
  double eta;
  std::int64_t disks;
  double collisions;  ///< in a quick validation
};
// Beyond 0.63 the first term in 1/N does not hold; systems there are large enough for it to be small.
constexpr std::array<Density, 12> densities = {{{0.01, 256, 1e6},
                                                {0.05, 256, 1e6},
                                                {0.10, 256, 2e6},
                                                {0.20, 256, 2e6},
                                                {0.30, 256, 3e6},
                                                {0.40, 256, 3e6},
                                                {0.50, 256, 3e6},
                                                {0.55, 256, 4e6},
                                                {0.60, 576, 8e6},
                                                {0.63, 1024, 1e7},
                                                {0.66, 4096, 1.2e7},
                                                {0.69, 4096, 1.6e7}}};

/// Z from the rate of collisions less Z from momentum, of a gas of kT = 1: both come from the same collisions, so that the error
/// of their difference is not that of two independent numbers.
class TwoPressures final : public Observable {
 public:
  TwoPressures(double step, std::int64_t disks, Blocking& difference)
      : step_(step),
        disks_(static_cast<double>(disks)),
        speed_factor_(theory::Microcanonical(disks, true).speed_factor()),
        difference_(difference) {}
  [[nodiscard]] std::string name() const override { return "two_pressures"; }
  [[nodiscard]] double step() const override { return step_; }
  void sample(const State&, const Totals& totals) override {
    const double from_rate = 0.5 * std::sqrt(pi) / speed_factor_ * static_cast<double>(totals.pair) / disks_;
    const double now = from_rate - totals.virial / (2.0 * disks_);
    if (begun_) difference_.add((now - before_) / step_);
    begun_ = true;
    before_ = now;
  }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double step_, disks_, speed_factor_, before_ = 0.0;
  Blocking& difference_;
  bool begun_ = false;
};

TrialResult fluid(const std::string& trial, const Density& at, const Effort& effort) {
  TrialResult result{.trial = trial};
  const Gas gas{.disks = at.disks,
                .packing_fraction = at.eta,
                .collisions = effort.collisions(at.collisions),
                .observe = {{.name = "pressure"}},
                .positions = at.eta > 0.64 ? Positions(GrownPositions{at.eta}) : HexagonalLattice{},
                .equilibrate = at.eta > 0.64 ? 3000.0 : 100.0};
  Blocking difference;
  std::vector<std::unique_ptr<Observable>> own;
  const double rate = theory::disk_collision_rate(theory::kolafa_rottner(at.eta));
  own.push_back(std::make_unique<TwoPressures>(16.0 / rate, at.disks, difference));
  const Found found = run(scene_of(gas, effort.seed_of(0)), effort, result, std::move(own));
  const Measured Z = found.measured("pressure", "Z");
  const bool corrected = at.eta <= 0.63;
  const double infinite = theory::kolafa_rottner(at.eta), finite = theory::kolafa_rottner_finite(at.eta, at.disks);
  // Nearer to the transition terms of higher order in 1/N are as large as the first for small systems; for these large ones the
  // first is given, and itself as its error.
  const double reference_error = std::hypot(theory::kolafa_rottner_error(at.eta), corrected ? 0.0 : finite - infinite);
  result.checks.push_back(
      {.name = fmt::format("Z at packing fraction {:.2f}, {} disks", at.eta, at.disks),
       .theory = "the fluid's equation of state with the first term in 1/N",
       .source = "Kolafa & Rottner, Mol. Phys. 104, 3435 (2006); 1/N: Lebowitz & Percus, Phys. Rev. 122, 1675 (1961)",
       .expected = finite,
       .measured = Z,
       .reference_error = reference_error});
  result.checks.push_back({.name = fmt::format("Z from the collision rate, packing fraction {:.2f}, {} disks", at.eta, at.disks),
                           .theory = "Z from momentum transfer",
                           .source = "exact: velocities at collisions are those of equilibrium",
                           .expected = Z.value,
                           .measured = {found.measured("pressure", "Z_rate").value, difference.estimate()->error.value_or(NAN)}});
  if (at.eta <= 0.2) {
    const double series = theory::virial_series(at.eta), last = 12.0 * std::pow(at.eta, 10);
    result.checks.push_back(
        {.name = fmt::format("Z against the virial series at packing fraction {:.2f}, {} disks", at.eta, at.disks),
         .theory = "1 + b_2 eta + ... + b_10 eta^9, with the first term in 1/N",
         .source = "Clisby & McCoy, J. Stat. Phys. 122, 15 (2006)",
         .expected = series + finite - infinite,
         .measured = Z,
         .allowance = last,
         .allowance_for = "the first term left out"});
  }
  result.curves.push_back({.plot = "equation-of-state", .name = "measured", .x = {at.eta}, .y = {Z.value}, .error = {Z.error}});
  result.curves.push_back({.plot = "equation-of-state-residual",
                           .name = "measured",
                           .x = {at.eta},
                           .y = {1e3 * (Z.value / finite - 1.0)},
                           .error = {1e3 * Z.error / finite}});
  return result;
}

TrialResult small(const std::string& trial, const theory::ReferencePressure& known, const Effort& effort) {
  TrialResult result{.trial = trial};
  const Gas gas{.disks = known.disks,
                .packing_fraction = known.packing_fraction,
                .collisions = effort.collisions(8e6),
                .observe = {{.name = "pressure"}},
                .equilibrate = 2000.0};
  const Found found = run(scene_of(gas, effort.seed_of(0)), effort, result);
  result.checks.push_back(
      {.name = fmt::format("P sigma^2 / kT of {} disks at packing fraction {:.2f}", known.disks, known.packing_fraction),
       .theory = "for this number of disks in a square box",
       .source = "Li et al., J. Chem. Phys. 157, 234111 (2022)",
       .expected = known.pressure,
       .measured = found.measured("pressure", "reduced"),
       .reference_error = known.error});
  return result;
}

/// The reduced pressure P sigma^2 / kT of a gas of kT = 1 from momentum, one sample for many collisions of each disk: a sample
/// for each mean free time, as the observable `pressure` takes them, costs a small system as much as its collisions.
class RareMomentum final : public Observable {
 public:
  RareMomentum(double step, double area, std::int64_t disks, Blocking& pressure)
      : step_(step), area_(area), disks_(static_cast<double>(disks)), pressure_(pressure) {}
  [[nodiscard]] std::string name() const override { return "rare_momentum"; }
  [[nodiscard]] double step() const override { return step_; }
  [[nodiscard]] bool needs_positions() const override { return false; }
  void sample(const State& state, const Totals& totals) override {
    if (state.time > 0.0) pressure_.add((disks_ + 0.5 * (totals.virial - before_) / step_) / area_);
    before_ = totals.virial;
  }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double step_, area_, disks_, before_ = 0.0;
  Blocking& pressure_;
};

/// Calls one_run(k, effort) for k = 0 to count - 1, by all processors. Throws Interrupted.
void share_runs(std::size_t count, const Effort& effort, const std::function<void(std::size_t k, const Effort& mine)>& one_run) {
  std::atomic<std::size_t> finished = 0;
  const auto work = [&](std::size_t k, const std::function<bool()>& go_on) {
    one_run(k, {.full = effort.full, .seed = effort.seed, .proceed = go_on});
    effort.has_done(static_cast<double>(++finished) / static_cast<double>(count));
  };
  if (!in_threads(count, std::max(1U, std::thread::hardware_concurrency()), effort.proceed, work)) throw Interrupted{};
}

/// Checks the pressure of a small system to five digits, by independent runs that all processors share.
TrialResult five_digits(const std::string& trial, const theory::ReferencePressure& known, const Effort& effort) {
  constexpr std::size_t runs = 16;
  constexpr double collisions = 1.05e9, digits = 1e-5;
  std::array<Measured, runs> found{};
  std::array<TrialResult, runs> done;
  share_runs(runs, effort, [&](std::size_t k, const Effort& mine) {
    const Gas gas{
        .disks = known.disks, .packing_fraction = known.packing_fraction, .collisions = collisions, .equilibrate = 2000.0};
    const double rate = theory::disk_collision_rate(theory::kolafa_rottner(known.packing_fraction));
    Blocking pressure;
    std::vector<std::unique_ptr<Observable>> own;
    own.push_back(std::make_unique<RareMomentum>(128.0 / rate, square_box(known.disks, known.packing_fraction).area(),
                                                 known.disks, pressure));
    (void)run(scene_of(gas, mine.seed_of(k)), mine, done[k], std::move(own));
    const auto estimate = pressure.estimate();
    found[k] = {estimate->mean, estimate->error.value_or(NAN)};
  });
  TrialResult result{.trial = trial};
  Measured mean{0.0, 0.0};
  double squares = 0.0;
  for (std::size_t k = 0; k < runs; ++k) {
    result.scenes.push_back(done[k].scenes.front());
    mean.value += found[k].value / static_cast<double>(runs);
    squares += found[k].error * found[k].error;
  }
  mean.error = std::sqrt(squares) / static_cast<double>(runs);
  result.checks.push_back({.name = fmt::format("P sigma^2 / kT of {} disks at packing fraction {:.2f}, to five digits",
                                               known.disks, known.packing_fraction),
                           .theory = "for this number of disks in a square box",
                           .source = "Li et al., J. Chem. Phys. 157, 234111 (2022)",
                           .expected = known.pressure,
                           .measured = mean,
                           .reference_error = known.error,
                           .largest_error = std::hypot(digits * known.pressure, known.error)});
  // Errors from blocks within the runs are those with which the runs scatter: chi squared, which is nearly normal as its cube
  // root (Wilson & Hilferty 1931).
  double chi_squared = 0.0;
  for (const Measured& one : found) chi_squared += std::pow((one.value - mean.value) / one.error, 2);
  constexpr double freedom = static_cast<double>(runs - 1), third = 2.0 / (9.0 * freedom);
  result.checks.push_back(
      {.name = fmt::format("scatter of the {} runs of {} disks, chi squared over {}", runs, known.disks, runs - 1),
       .theory = "1, if the errors of the runs are right",
       .source = "chi squared",
       .expected = 1.0,
       .measured = {chi_squared / freedom, std::sqrt(2.0 / freedom)},
       .equivalent = (std::cbrt(chi_squared / freedom) - (1.0 - third)) / std::sqrt(third)});
  return result;
}

/// Returns a crystal of 16 x 18 disks in a box that fits it.
TrialResult solid(const std::string& trial, double alpha, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr int columns = 16, rows = 18, disks = columns * rows;
  // Close packing has eta_cp = pi / 2 sqrt3; lengths are 1 + alpha times as large in area.
  const double spacing = std::sqrt(1.0 + alpha);
  const Scene scene{
      .box = {.upper = {columns * spacing, rows * spacing * 0.5 * std::numbers::sqrt3},
              .boundary = {Boundary::periodic, Boundary::periodic}},
      .species =
          {{.count = disks, .radius = 0.5, .mass = 1.0, .positions = HexagonalLattice{}, .velocities = MaxwellVelocities{1.0}}},
      .run = run_of(effort.collisions(4e6), 500.0, effort.seed_of(0)),
      .observe = {{.name = "pressure"}}};
  const Found found = run(scene, effort, result);
  const double eta = 0.25 * pi * disks / (columns * spacing * rows * spacing * 0.5 * std::numbers::sqrt3);
  result.checks.push_back({.name = fmt::format("Z of a crystal of {} disks at packing fraction {:.6f}", disks, eta),
                           .theory = "2 (1 - 1/N) / alpha + 1.90(1) + 0.67(7) alpha, alpha = eta_cp / eta - 1",
                           .source = "2 / alpha: Salsburg & Wood, J. Chem. Phys. 37, 798 (1962); the rest: Alder, Hoover & "
                                     "Young, J. Chem. Phys. 49, 3688 (1968)",
                           .expected = 2.0 * (1.0 - 1.0 / disks) / alpha + 1.90 + 0.67 * alpha,
                           .measured = found.measured("pressure", "Z"),
                           .reference_error = std::hypot(0.01, 0.07 * alpha)});
  return result;
}

/// Checks the pressure in the transition from liquid to hexatic by independent runs that all processors share: ordered and
/// disordered starts must agree on it. Domains take some 20,000 collisions per disk to form and to dissolve. A run has few of
/// such times, and its blocks say too little of its error, so errors come from the scatter of runs.
TrialResult transition(const std::string& trial, const theory::ReferencePressure& known, const Effort& effort) {
  constexpr std::size_t runs_per_start = 4;
  constexpr double collisions = 4.5e8, equilibrate = 50'000.0;
  std::array<double, 2 * runs_per_start> found{};
  std::array<TrialResult, found.size()> done;
  share_runs(found.size(), effort, [&](std::size_t k, const Effort& mine) {
    Change compressed;
    if (k >= runs_per_start)
      compressed = [&](State& start) {
        const State liquid = compressed_liquid(known.disks, known.packing_fraction, mine, mine.seed_of(found.size() + k));
        start.positions = liquid.positions;
        start.velocities = liquid.velocities;
        start.remainders.resize(2, 0);
      };
    const Gas gas{.disks = known.disks,
                  .packing_fraction = known.packing_fraction,
                  .collisions = collisions,
                  .observe = {{.name = "pressure"}},
                  .equilibrate = equilibrate};
    found[k] = run(scene_of(gas, mine.seed_of(k)), mine, done[k], {}, compressed).measured("pressure", "reduced").value;
  });
  TrialResult result{.trial = trial};
  for (const std::size_t k : {std::size_t{0}, runs_per_start}) result.scenes.push_back(done[k].scenes.front());
  const std::string what = fmt::format("{} disks at packing fraction {:.3f}", known.disks, known.packing_fraction);
  result.checks.push_back({.name = fmt::format("P sigma^2 / kT of {}, mean of both starts", what),
                           .theory = "for this number of disks in a square box",
                           .source = "Li et al., J. Chem. Phys. 157, 234111 (2022)",
                           .expected = known.pressure,
                           .measured = mean_of({found.begin(), found.end()}),
                           .reference_error = known.error,
                           .largest_error = 0.002 * known.pressure});
  const Measured from_lattice = mean_of({found.begin(), found.begin() + runs_per_start}),
                 from_liquid = mean_of({found.begin() + runs_per_start, found.end()});
  result.checks.push_back(
      {.name = fmt::format("P sigma^2 / kT of {}, from a compressed liquid less that from a perfect lattice", what),
       .theory = "0",
       .source = "equilibrium does not depend on the start",
       .expected = 0.0,
       .measured = {from_liquid.value - from_lattice.value, std::hypot(from_lattice.error, from_liquid.error),
                    from_lattice.freedom + from_liquid.freedom},
       .largest_error = 0.004 * known.pressure});
  return result;
}

}  // namespace

void add_equation_of_state(std::vector<Trial>& trials) {
  const std::string group = "equation of state";
  for (const Density& at : densities) {
    const std::string name = fmt::format("pressure-{:.2f}", at.eta);
    trials.push_back({name, group, false, [=](const Effort& effort) { return fluid(name, at, effort); }});
  }
  for (const theory::ReferencePressure& known : theory::li_2022) {
    const std::string name = fmt::format("pressure-{}-disks-{:.2f}", known.disks, known.packing_fraction);
    trials.push_back({name, group, false, [=](const Effort& effort) { return small(name, known, effort); }});
  }
  {
    const theory::ReferencePressure& known = theory::li_2022.front();
    const std::string name = fmt::format("pressure-{}-disks-{:.2f}-five-digits", known.disks, known.packing_fraction);
    trials.push_back({name, group, true, [=](const Effort& effort) { return five_digits(name, known, effort); }, true, 40.0});
  }
  for (const double alpha : {1e-2, 1e-3}) {
    const std::string name = fmt::format("crystal-{:g}", alpha);
    trials.push_back({name, group, false, [=](const Effort& effort) { return solid(name, alpha, effort); }});
  }
  for (const theory::ReferencePressure& known : theory::li_2022_transition) {
    const std::string name = fmt::format("transition-{:.3f}", known.packing_fraction);
    trials.push_back({name, group, true, [=](const Effort& effort) { return transition(name, known, effort); }, true, 20.0});
  }
}

}  // namespace carom::validation
