// Transport: viscosity and heat conductivity at once, exactly; the growth of the diffusion coefficient that slow modes of the
// fluid bring about; and how far from simulation Enskog's theory is, which leaves out that collisions are correlated.

#include "studies/validate/gas.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/kinetic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace carom::validation {

namespace {

/// Returns the first row of a table of lags that is not shorter than `time`.
std::size_t row_at(const std::vector<double>& lags, double time) {
  std::size_t row = 0;
  while (row + 1 < lags.size() && lags[row] < time) ++row;
  return row;
}

/// Checks the instantaneous coefficient. With moments G that grow by a in one step h and by b in the next, <a^2> / 2h is their
/// growth at lag h and <(a + b)^2> / 4h that at 2h; a straight line through both extrapolates to <a^2> / 2h - <a b> / 2h at lag
/// 0. The kinetic part has the correlation c exp(-nu t), which bends the line by c nu h^2 / 3 at lag 0, less than 0.1 % of the
/// limit with Enskog's nu.
TrialResult instantaneous(const std::string& trial, double eta, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 256;
  const double step = 0.02 / theory::disk_collision_rate(theory::kolafa_rottner(eta));
  const Gas gas{.disks = disks,
                .packing_fraction = eta,
                .collisions = effort.collisions(4e6),
                .observe = {{.name = "viscosity", .every = step}, {.name = "heat_conductivity", .every = step}}};
  const Found found = run(scene_of(gas, effort.seed_of(0)), effort, result);
  const double density = 4.0 * eta / std::numbers::pi, carried = eta * theory::contact_value(eta);
  const auto held = [&](const std::string& name, const char* observable, double limit, double enskog, double flux,
                        const char* formula) {
    const double expected = limit + flux * flux / (enskog - limit) * step * step / 3.0;  // nu = c / (enskog - limit)
    // The running integral begins with half of the mean square, the correlation at lag 0: <a^2> / 2h.
    const double square = found.column(observable, "green_kubo").at(0);
    const double square_error = found.column(observable, "green_kubo_error").at(0);
    const double scale = square / found.column(observable, "correlation").at(0);
    const double product = scale * found.column(observable, "correlation").at(1);
    const double product_error = scale * found.column(observable, "correlation_error").at(1);
    result.checks.push_back({.name = fmt::format("instantaneous {}, packing fraction {:.1f}, {} disks", name, eta, disks),
                             .theory = formula,
                             .source = "docs/validation.md, from the pressure of Kolafa & Rottner, Mol. Phys. 104, 3435 (2006)",
                             .expected = expected,
                             .measured = {square - product, std::hypot(square_error, product_error)},
                             .reference_error = expected * 1e-5,
                             .largest_error = (effort.full ? 0.001 : 0.003) * expected});
  };
  held("viscosity", "viscosity", theory::instantaneous_viscosity(eta, disks), theory::enskog_viscosity(eta),
       density * std::pow(1.0 + carried, 2), "rho omega m sigma^2 / 8, for N disks");
  held("heat conductivity", "heat_conductivity", theory::instantaneous_conductivity(eta, disks), theory::enskog_conductivity(eta),
       2.0 * density * std::pow(1.0 + 1.5 * carried, 2), "rho omega k sigma^2 / 4, for N disks");
  return result;
}

TrialResult transport(const std::string& trial, double eta, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 256;
  const double rate = theory::disk_collision_rate(theory::kolafa_rottner(eta));
  const Gas gas{
      .disks = disks,
      .packing_fraction = eta,
      .collisions = effort.collisions(2e6),
      .observe = {
          {.name = "velocity_autocorrelation", .every = 0.25 / rate}, {.name = "viscosity"}, {.name = "heat_conductivity"}}};
  const Found found = run(scene_of(gas, effort.seed_of(0)), effort, result);
  const auto shown = [&](const std::string& name, const char* plot, double expected, const Measured& measured,
                         const std::string& source) {
    result.checks.push_back({.name = fmt::format("{} at packing fraction {:.1f}", name, eta),
                             .theory = "Enskog, without correlations of collisions and the size of the box",
                             .source = source,
                             .expected = expected,
                             .measured = measured,
                             .judged = Judged::shown});
    result.curves.push_back(
        {.plot = "transport", .name = plot, .x = {eta}, .y = {measured.value / expected}, .error = {measured.error / expected}});
  };
  shown("viscosity (Green-Kubo)", "viscosity", theory::enskog_viscosity(eta), found.measured("viscosity", "green_kubo"),
        "Gass, J. Chem. Phys. 54, 1898 (1971)");
  shown("heat conductivity (Green-Kubo)", "heat conductivity", theory::enskog_conductivity(eta),
        found.measured("heat_conductivity", "green_kubo"), "Gass, J. Chem. Phys. 54, 1898 (1971)");

  const std::vector<double>& until = found.column("velocity_autocorrelation", "integral_to");
  const std::vector<double>& D = found.column("velocity_autocorrelation", "diffusion");
  const std::vector<double>& error = found.column("velocity_autocorrelation", "diffusion_error");
  const double enskog = theory::enskog_diffusion(eta);
  Curve growing{.plot = "diffusion", .name = fmt::format("packing fraction {:.1f}", eta)};
  // Sound comes round the box after about this time; then periodic images are felt.
  const double side = std::sqrt(disks * std::numbers::pi / (4.0 * eta));
  const double longest = 0.5 * side / (1.4 * theory::kolafa_rottner(eta));
  for (std::size_t row = 0; row < until.size() && until[row] < 3.0 * longest; ++row) {
    growing.x.push_back(until[row] * rate);
    growing.y.push_back(D[row] / enskog);
    growing.error.push_back(error[row] / enskog);
  }
  result.curves.push_back(std::move(growing));
  const std::size_t row = row_at(until, 3.0 / rate);
  shown("D(t) at three mean free times", "diffusion at 3 mean free times", enskog * (1.0 - std::exp(-until[row] * rate)),
        {D[row], error[row]}, "Chapman-Enskog; the velocity is still slightly correlated");
  return result;
}

constexpr const char* theory_of_slow_modes =
    "integral of the sum over the shear and sound waves of the box of exp(-(D + nu) k^2 t) and cos(c k t) exp(-(D + Gamma) k^2 "
    "t), "
    "/ 2 N";
constexpr const char* source_of_slow_modes =
    "Ernst, Hauge & van Leeuwen, Phys. Rev. Lett. 25, 1254 (1970), summed as by Erpenbeck & Wood, Phys. Rev. A 26, 1648 (1982)";

/// What replicas of a system, which differ in the seed, have found of the autocorrelation of velocities.
struct Correlations {
  std::vector<double> until;                   ///< upper ends of the integrals
  std::vector<double> lags;                    ///< of the correlations
  std::vector<std::vector<double>> diffusion;  ///< D up to `until`, by replica
  std::vector<std::vector<double>> values;     ///< <v(0).v(t)> / 2, by replica

  /// Returns how much D grows between two rows.
  [[nodiscard]] Measured growth(std::size_t from, std::size_t to) const {
    std::vector<double> growths;
    for (const std::vector<double>& D : diffusion) growths.push_back(D[to] - D[from]);
    return mean_of(growths);
  }
};

Correlations correlations_of(const Gas& gas, std::size_t replicas, const Effort& effort, TrialResult& result) {
  Correlations all;
  for (std::size_t r = 0; r < replicas; ++r) {
    const Found found = run(scene_of(gas, effort.seed_of(r)), effort, result);
    const auto column = [&](const char* name) { return found.column("velocity_autocorrelation", name); };
    all.until = column("integral_to");
    all.lags = column("lag");
    all.diffusion.push_back(column("diffusion"));
    all.values.push_back(column("correlation"));
    for (double& value : all.values.back()) value *= 0.5;
    effort.has_done(static_cast<double>(r + 1) / static_cast<double>(replicas));
  }
  result.scenes.resize(1);  // the others differ in the seed
  return all;
}

/// The number of mean free times from which on the law of slow modes holds: it leaves out terms of the same order as what sound
/// contributes, 3 % of the growth there and 5 % at 20.
constexpr double law_holds = 30.0;

/// Holds the growth of D between two numbers of mean free times against the slow modes of the box: without a verdict where it
/// begins before the law holds, and with an error of at most the allowance where it is known as well as that.
Check growth_check(const Correlations& found, double eta, std::int64_t disks, double from, double to, const Effort& effort) {
  const double rate = theory::disk_collision_rate(theory::kolafa_rottner(eta));
  const std::size_t early = row_at(found.until, from / rate), late = row_at(found.until, to / rate);
  const double expected = theory::diffusion_growth(eta, disks, found.until[early], found.until[late]);
  return {.name = fmt::format("growth of D from {:.1f} to {:.1f} mean free times at packing fraction {:.1f}, {} disks",
                              found.until[early] * rate, found.until[late] * rate, eta, disks),
          .theory = theory_of_slow_modes,
          .source = source_of_slow_modes,
          .expected = expected,
          .measured = found.growth(early, late),
          .allowance = 0.03 * expected,
          .allowance_for = "D + nu after Enskog, which differ from those measured by up to 3 % here",
          .judged = from < law_holds ? Judged::shown : Judged::agrees,
          .largest_error = effort.full ? 0.03 * expected : 0.0};
}

/// Checks the law of long times where it holds, by the modes that the box has room for.
TrialResult long_time_tail(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr double eta = 0.3;
  constexpr std::int64_t disks = 2304;
  const double rate = theory::disk_collision_rate(theory::kolafa_rottner(eta));
  const Gas gas{.disks = disks,
                .packing_fraction = eta,
                .collisions = 5e5,
                .observe = {{.name = "velocity_autocorrelation", .every = 0.5 / rate}},
                .equilibrate = 50.0};
  const Correlations found = correlations_of(gas, effort.full ? 320 : 16, effort, result);
  const Check growth = growth_check(found, eta, disks, law_holds, 60.0, effort);
  result.checks.push_back(growth);
  result.checks.push_back({.name = "no " + growth.name + " (must not fit)",
                           .theory = "0: a diffusion coefficient that exists",
                           .source = "Boltzmann, Enskog",
                           .expected = 0.0,
                           .measured = growth.measured,
                           .judged = Judged::disagrees});
  return result;
}

/// The same for a million disks, all of which are followed: a box in which sound does not come round within 60 mean free times.
TrialResult long_time_tail_of_a_million(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr double eta = 0.3;
  constexpr std::int64_t disks = 1'000'000;
  constexpr std::size_t replicas = 8;
  const double rate = theory::disk_collision_rate(theory::kolafa_rottner(eta));
  const Gas gas{.disks = disks,
                .packing_fraction = eta,
                .collisions = 50.0 * static_cast<double>(disks),
                .observe = {{.name = "velocity_autocorrelation", .every = 1.0 / rate, .disks = disks}},
                .equilibrate = 50.0};
  const Correlations found = correlations_of(gas, replicas, effort, result);
  for (const auto& [from, to] : {std::pair{20.0, law_holds}, {law_holds, 45.0}, {45.0, 60.0}})
    result.checks.push_back(growth_check(found, eta, disks, from, to, effort));
  Curve measured{.plot = "long-time-tail", .name = "measured"},
      modes{.plot = "long-time-tail", .name = "slow modes", .theory = true};
  for (std::size_t row = 0; row < found.lags.size(); ++row) {
    const double lag = found.lags[row];
    if (lag * rate < 5.0 || lag * rate > 80.0) continue;
    std::vector<double> values;
    for (const std::vector<double>& replica : found.values) values.push_back(replica[row]);
    const Measured mean = mean_of(values);
    measured.x.push_back(lag * rate), measured.y.push_back(mean.value), measured.error.push_back(mean.error);
    modes.x.push_back(lag * rate), modes.y.push_back(theory::velocity_correlation_of_modes(eta, disks, lag));
  }
  result.curves = {std::move(measured), std::move(modes)};
  return result;
}

}  // namespace

void add_transport(std::vector<Trial>& trials) {
  const std::string group = "transport";
  for (const double eta : {0.2, 0.4}) {
    const std::string name = fmt::format("instantaneous-{:.1f}", eta);
    trials.push_back({name, group, false, [=](const Effort& effort) { return instantaneous(name, eta, effort); }});
  }
  for (const double eta : {0.1, 0.2, 0.3, 0.4}) {
    const std::string name = fmt::format("transport-{:.1f}", eta);
    trials.push_back({name, group, false, [=](const Effort& effort) { return transport(name, eta, effort); }});
  }
  trials.push_back(
      {"long-time-tail", group, false, [](const Effort& effort) { return long_time_tail("long-time-tail", effort); }});
  trials.push_back({"long-time-tail-million", group, true,
                    [](const Effort& effort) { return long_time_tail_of_a_million("long-time-tail-million", effort); }, true,
                    10.0});
}

}  // namespace carom::validation
