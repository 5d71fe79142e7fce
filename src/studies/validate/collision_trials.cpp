// Trials of collisions: their rate, the free paths between them, and their impact parameters.

#include "studies/validate/encounters.hpp"
#include "studies/validate/gas.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/goodness_of_fit.hpp"
#include "theory/kinetic.hpp"

#include <fmt/format.h>
#include <boost/math/special_functions/gamma.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

namespace carom::validation {

namespace {

TrialResult rates(const std::string& trial, double eta, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 1024;
  const double rate = theory::disk_collision_rate(eta, disks);
  const Gas gas{.disks = disks,
                .packing_fraction = eta,
                .collisions = effort.collisions(2e6),
                .observe = {{.name = "collision_rate"}, {.name = "free_flight"}, {.name = "velocity_moments"}}};
  Encounters::Seen seen;
  std::vector<std::unique_ptr<Observable>> own;
  own.push_back(std::make_unique<Encounters>(0.5 / rate, 1.0 / rate, seen));
  const Found found = run(scene_of(gas, effort.seed_of(0)), effort, result, std::move(own));
  const std::string what = fmt::format("packing fraction {:.1f}, {} disks", eta, disks);
  const Measured measured = found.measured("collision_rate", "rate");
  const std::string eos = "Kolafa & Rottner, Mol. Phys. 104, 3435 (2006), with the first term in 1/N";
  // Only flights that begin and end within the run count, which leaves out what is before a disk's first collision and behind its
  // last, and one flight of each disk: of the order of a flight in all those of a disk.
  const double ends = 1.0 - (2.0 * theory::path_ahead() - 1.0) * disks / (2.0 * gas.collisions);
  result.checks.push_back({.name = "collisions of a disk per time, " + what,
                           .theory = "(4 / sqrt pi) (Z - 1) v_T / sigma (1 + 1 / 8N), the latter at fixed energy",
                           .source = eos,
                           .expected = rate,
                           .measured = measured,
                           .reference_error = 1e-5 * rate});
  const Measured path = found.measured("free_flight", "mean_free_path"), speed = found.measured("velocity_moments", "speed");
  // Few disks change Z, but not the ratio of mean speed to rate.
  const double expected_path = theory::mean_free_path(eta) * (theory::kolafa_rottner(eta) - 1.0) /
                               (theory::kolafa_rottner_finite(eta, disks) - 1.0) * std::sqrt(1.0 - 1.0 / disks) * ends;
  result.checks.push_back({.name = "mean free path, " + what,
                           .theory = "1 / (2 sqrt2 rho sigma g), minus that of flights at the ends of the run",
                           .source = "kinetic theory; g from the equation of state",
                           .expected = expected_path,
                           .measured = path,
                           .reference_error = 1e-5 * expected_path});
  const double mean = speed.value / measured.value * ends;
  result.checks.push_back({.name = "mean free path times collisions per time, " + what,
                           .theory = "the mean speed, minus that of flights at the ends of the run",
                           .source = "a definition, measured in two ways",
                           .expected = mean,
                           .measured = {path.value, std::hypot(path.error, mean * measured.error / measured.value)},
                           .error_is_bound = true});
  result.checks.push_back({.name = "mean square of the impact parameter over sigma, " + what,
                           .theory = "1/3: b is uniform from 0 to sigma",
                           .source = "molecular chaos, exact in equilibrium",
                           .expected = 1.0 / 3.0,
                           .measured = [&] {
                             const auto found_b = seen.impact_square.estimate();
                             return Measured{found_b->mean, found_b->error.value_or(NAN)};
                           }()});
  double chi = 0.0;
  const double each = static_cast<double>(seen.collisions) / Encounters::parameters;
  Curve impact{.plot = "impact-parameter", .name = what};
  for (std::size_t k = 0; k < Encounters::parameters; ++k) {
    const auto count = static_cast<double>(seen.impact[k]);
    chi += (count - each) * (count - each) / each;
    impact.x.push_back((static_cast<double>(k) + 0.5) / Encounters::parameters);
    impact.y.push_back(count / each);
    impact.error.push_back(std::sqrt(count) / each);
  }
  result.curves.push_back(std::move(impact));
  result.checks.push_back({.name = "distribution of the impact parameter, chi squared of 20 bins, " + what,
                           .theory = "uniform: 19 on average",
                           .source = "molecular chaos, exact in equilibrium",
                           .expected = 19.0,
                           .measured = {chi, std::sqrt(38.0)},
                           .equivalent = theory::standard_errors(boost::math::gamma_q(9.5, 0.5 * chi))});
  Curve by_speed{.plot = "rate-by-speed", .name = what};
  for (std::size_t k = 0; k < Encounters::speeds; ++k) {
    const auto estimate = seen.rate[k].estimate();
    if (!estimate || !estimate->error) continue;
    const double from = static_cast<double>(k) * Encounters::speed_width, to = from + Encounters::speed_width;
    const double rate_there = rate * theory::mean_relative_rate(from, to, disks);
    by_speed.x.push_back(0.5 * (from + to));
    by_speed.y.push_back(estimate->mean / rate);
    by_speed.error.push_back(*estimate->error / rate);
    if (k % 3 != 1) continue;
    result.checks.push_back(
        {.name = fmt::format("collisions per time of disks of speed {:.2f} to {:.2f} v_T, {}", from, to, what),
         .theory = "proportional to the mean of |v - v'| over v' of the others, at fixed energy and momentum",
         .source = "kinetic theory, exact in equilibrium",
         .expected = rate_there,
         .measured = {estimate->mean, *estimate->error},
         .reference_error = 1e-5 * rate_there});
  }
  result.curves.push_back(std::move(by_speed));
  Curve line{.plot = "rate-by-speed", .name = "kinetic theory", .theory = true};
  for (int k = 0; k <= 60; ++k) {
    line.x.push_back(0.05 * k);
    line.y.push_back(theory::relative_rate(0.05 * k));
  }
  result.curves.push_back(std::move(line));
  return result;
}

TrialResult free_times(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  // With so many disks the effect of a fixed energy is 1/4096. Disks that meet again soon contribute in proportion to the
  // density, which a straight line through two densities removes.
  constexpr std::int64_t disks = 4096;
  constexpr std::array<double, 2> densities = {0.001, 0.003};
  const double collisions = effort.collisions(5e5), flights_each = 2.0 * collisions / disks;
  std::array<Encounters::Seen, 2> seen;
  for (std::size_t run_number = 0; run_number < 2; ++run_number) {
    const double rate = theory::disk_collision_rate(densities[run_number], disks);
    const Gas gas{.disks = disks, .packing_fraction = densities[run_number], .collisions = collisions, .equilibrate = 20.0};
    std::vector<std::unique_ptr<Observable>> own;
    own.push_back(std::make_unique<Encounters>(1.0 / rate, 1.0 / rate, seen[run_number]));
    (void)run(scene_of(gas, effort.seed_of(run_number)), effort, result, std::move(own));
  }
  const double far = densities[0] / (densities[1] - densities[0]);
  Curve measured{.plot = "free-times", .name = "at vanishing density"};
  for (std::size_t k = 0; k < Encounters::flights.size(); ++k) {
    const double longer = Encounters::flights[k], expected = theory::flights_longer_within(longer, flights_each);
    const auto low = seen[0].longer[k].estimate(), high = seen[1].longer[k].estimate();
    const Measured share{(1.0 + far) * low->mean - far * high->mean,
                         std::hypot((1.0 + far) * low->error.value_or(NAN), far * high->error.value_or(NAN))};
    result.checks.push_back(
        {.name = fmt::format("fraction of flights longer than {:g} mean free times, at vanishing density", longer),
         .theory = "each speed's own exponential, over the speeds with which disks leave collisions; of flights that "
                   "begin and end within the run",
         .source = "Visco, van Wijland & Trizac, Phys. Rev. E 77, 041117 (2008)",
         .expected = expected,
         .measured = share,
         .allowance = expected / disks,
         .allowance_for = "terms of 1/N"});
    measured.x.push_back(longer);
    measured.y.push_back(share.value);
    measured.error.push_back(share.error);
    if (longer != 4.0) continue;
    result.checks.push_back({.name = fmt::format("the same against exp(-{:g}), one rate for all speeds (must not fit)", longer),
                             .theory = "exp(-t)",
                             .source = "the simplest guess",
                             .expected = std::exp(-longer),
                             .measured = share,
                             .judged = Judged::disagrees});
  }
  Curve theory_line{.plot = "free-times", .name = "Boltzmann", .theory = true};
  for (int k = 0; k <= 50; ++k) {
    theory_line.x.push_back(0.1 * k);
    theory_line.y.push_back(theory::flights_longer_than(0.1 * k));
  }
  result.curves.push_back(std::move(measured));
  result.curves.push_back(std::move(theory_line));
  return result;
}

TrialResult mixture(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr double side = 24.0, big = 0.5, small = 0.3;
  constexpr int bigs = 200, smalls = 200;
  const Scene scene{
      .box = {.upper = {side, side}, .boundary = {Boundary::periodic, Boundary::periodic}},
      .species = {{.name = "big", .count = bigs, .radius = big, .mass = 1.0, .velocities = MaxwellVelocities{1.0}},
                  {.name = "small", .count = smalls, .radius = small, .mass = 0.2, .velocities = MaxwellVelocities{1.0}}},
      .run = run_of(effort.collisions(3e6), 100.0, effort.seed_of(0)),
      .observe = {{.name = "pressure"}, {.name = "collision_rate"}}};
  const Found found = run(scene, effort, result);
  const std::string what = "200 disks of radius 0.5 and 200 of 0.3, masses 1 and 0.2";
  const Measured Z = found.measured("pressure", "Z"), from_rate = found.measured("pressure", "Z_rate");
  result.checks.push_back({.name = "Z from the collision rate, " + what,
                           .theory = "Z from momentum transfer",
                           .source = "omega_ij = n_j sigma_ij g_ij sqrt(2 pi kT / mu_ij), exact for each pair of species",
                           .expected = Z.value,
                           .measured = {from_rate.value, std::hypot(Z.error, from_rate.error)},
                           .error_is_bound = true});
  constexpr double area = side * side;
  const std::array<theory::Component, 2> gas = {{{bigs / area, big, 1.0}, {smalls / area, small, 0.2}}};
  const double expected = 2.0 * theory::collision_rate(gas, 1.0) * area / (bigs + smalls);
  result.checks.push_back({.name = "collisions of a disk per time, " + what,
                           .theory = "the same with contact values of the form of scaled particle theory, an approximation",
                           .source = "Lebowitz, Helfand & Praestgaard, J. Chem. Phys. 43, 774 (1965)",
                           .expected = expected,
                           .measured = found.measured("collision_rate", "rate"),
                           .judged = Judged::shown});
  return result;
}

/// Checks the contact values of two species of two sizes.
TrialResult contact_values(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  const auto kind = [](const char* name, std::int64_t count, double radius, double mass) {
    return Species{.name = name, .count = count, .radius = radius, .mass = mass, .velocities = MaxwellVelocities{1.0}};
  };
  // Two runs of two sizes, so that what is compared is independent.
  constexpr double side = 24.0, large = 0.5, small = 0.3;
  constexpr std::int64_t count = 200;
  constexpr double area = side * side, all = 2.0 * count;
  const std::string what = "200 disks of radius 0.5 and 200 of 0.3";
  const auto found = [&](std::uint64_t k) {
    const Scene scene{.box = {.upper = {side, side}, .boundary = {Boundary::periodic, Boundary::periodic}},
                      .species = {kind("large", count, large, 1.0), kind("small", count, small, 0.2)},
                      .run = run_of(effort.collisions(1e6), 100.0, effort.seed_of(k)),
                      .observe = {{.name = "contact_values"}, {.name = "pressure"}}};
    return run(scene, effort, result);
  };
  const Found one = found(1), other = found(2);
  const std::array<theory::Component, 2> components = {{{count / area, large, 1.0}, {count / area, small, 0.2}}};
  double from_contacts = 1.0, error = 0.0;
  for (const auto& [pair, radius_i, radius_j, number] : {std::tuple("_large_large", large, large, 0.5 * count * (count - 1)),
                                                         std::tuple("_large_small", large, small, 1.0 * count * count),
                                                         std::tuple("_small_small", small, small, 0.5 * count * (count - 1))}) {
    const Measured g = one.measured("contact_values", std::string("g") + pair),
                   by_rate = other.measured("contact_values", std::string("g_rate") + pair);
    result.checks.push_back({.name = fmt::format("g{0} from the collision rate less that from momentum, {1}", pair, what),
                             .theory = "0",
                             .source = "exact: velocities at collisions are those of equilibrium; two runs",
                             .expected = 0.0,
                             .measured = {by_rate.value - g.value, std::hypot(by_rate.error, g.error)}});
    result.checks.push_back({.name = fmt::format("g{}, {}", pair, what),
                             .theory = "contact values of the form of scaled particle theory, an approximation",
                             .source = "Lebowitz, Helfand & Praestgaard, J. Chem. Phys. 43, 774 (1965)",
                             .expected = theory::contact_value(components, radius_i, radius_j),
                             .measured = g,
                             .judged = Judged::shown});
    const double share = std::numbers::pi * number * (radius_i + radius_j) * (radius_i + radius_j) / (area * all);
    from_contacts += share * g.value;
    error += share * g.error;  // the three come from one run
  }
  const Measured Z = other.measured("pressure", "Z");
  result.checks.push_back({.name = "Z from contact values, " + what,
                           .theory = "Z of another run; Z - 1 = (pi / A N) sum over pairs of sigma_ij^2 g_ij",
                           .source = "Lebowitz, Phys. Rev. 133, A895 (1964)",
                           .expected = Z.value,
                           .measured = {from_contacts, std::hypot(error, Z.error)},
                           .error_is_bound = true});
  const Measured widest = one.measured("contact_values", "g_large_large"),
                 narrowest = other.measured("contact_values", "g_small_small");
  result.checks.push_back({.name = "g_large_large, " + what,
                           .theory = "g_small_small, as if one number told how often all disks meet",
                           .source = "the simplest guess",
                           .expected = narrowest.value,
                           .measured = widest,
                           .reference_error = narrowest.error,
                           .judged = Judged::disagrees});
  return result;
}

}  // namespace

void add_collisions(std::vector<Trial>& trials) {
  const std::string group = "collisions";
  for (const double eta : {0.1, 0.4, 0.6}) {
    const std::string name = fmt::format("collisions-{:.1f}", eta);
    trials.push_back({name, group, false, [=](const Effort& effort) { return rates(name, eta, effort); }});
  }
  trials.push_back({"free-times", group, false, [](const Effort& effort) { return free_times("free-times", effort); }});
  trials.push_back(
      {"collisions-mixture", group, false, [](const Effort& effort) { return mixture("collisions-mixture", effort); }});
  trials.push_back(
      {"contact-values", group, false, [](const Effort& effort) { return contact_values("contact-values", effort); }});
}

}  // namespace carom::validation
