// Diffusion, viscosity and heat conductivity against Enskog's theory, which leaves out that collisions are correlated; and what
// these correlations do to diffusion in two dimensions, where it never comes to an end.

#include "study/validation/gas.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/kinetic.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace carom::validation {

namespace {

/// A row of a table of lags: the first that is not shorter.
std::size_t row_at(const std::vector<double>& lags, double time) {
  std::size_t row = 0;
  while (row + 1 < lags.size() && lags[row] < time) ++row;
  return row;
}

TrialResult transport(const std::string& trial, double eta, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 256;
  const double rate = theory::disk_collision_rate(theory::kolafa_rottner(eta));
  const Gas gas{
      .disks = disks,
      .packing_fraction = eta,
      .collisions = effort.collisions(2e6),
      .observe = fmt::format("viscosity = true\nheat_conductivity = true\nvelocity_autocorrelation = {{ every = {:.6g} }}\n",
                             0.25 / rate)};
  const Found found = run(scene_text(gas, effort.seed_of(0)), effort, result);
  // Correlations between collisions, which Enskog leaves out, and what a box as small as this cuts off.
  const double off = eta < 0.35 ? 0.1 : 0.15;
  const std::string because =
      fmt::format("Enskog's theory itself, known to be {:.0f} % off by simulations of the fluid", 100.0 * off);
  const auto held = [&](const std::string& name, const char* plot, double expected, const Measured& measured,
                        const std::string& source) {
    result.checks.push_back({.name = fmt::format("{} at packing fraction {:.1f}", name, eta),
                             .theory = "Enskog",
                             .source = source,
                             .expected = expected,
                             .measured = measured,
                             .allowance = off * expected,
                             .allowance_for = because});
    result.curves.push_back(
        {.plot = "transport", .name = plot, .x = {eta}, .y = {measured.value / expected}, .error = {measured.error / expected}});
  };
  held("viscosity (Green-Kubo)", "viscosity", theory::enskog_viscosity(eta), found.measured("viscosity", "green_kubo"),
       "Gass, J. Chem. Phys. 54, 1898 (1971)");
  held("heat conductivity (Green-Kubo)", "heat conductivity", theory::enskog_conductivity(eta),
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
  // From the first collisions on a disk is carried by the vortex it has made: the correlation has a tail a / t.
  const double density = 4.0 * eta / std::numbers::pi;
  const double tail = 1.0 / (8.0 * std::numbers::pi * density * (enskog + theory::enskog_viscosity(eta) / density));
  const std::size_t row = row_at(until, 3.0 / rate);
  held("D(t) at three mean free times", "diffusion at 3 mean free times", enskog * (1.0 - std::exp(-until[row] * rate)),
       {D[row], error[row]}, "Chapman-Enskog; the velocity has not quite forgotten itself");
  if (eta > 0.25 && eta < 0.35) {
    // Shown, not hidden: the growth from three to twelve mean free times, which theory without correlations says is nothing.
    const std::size_t later = row_at(until, std::min(12.0 / rate, longest));
    const double growth = D[later] - D[row];
    const double expected = tail * std::log(until[later] / until[row]) + enskog * std::exp(-until[row] * rate);
    result.checks.push_back(
        {.name = fmt::format("growth of D from {:.1f} to {:.1f} mean free times at packing fraction {:.1f}", until[row] * rate,
                             until[later] * rate, eta),
         .theory = "kT / (8 pi rho m (D + nu)) ln(t2 / t1), the tail of the autocorrelation",
         .source = "Ernst, Hauge & van Leeuwen, Phys. Rev. Lett. 25, 1254 (1970)",
         .expected = expected,
         .measured = {growth, std::hypot(error[row], error[later])},
         .allowance = 0.5 * expected,
         .allowance_for = "the tail is the law of long times, when the box is felt already; Enskog's D and nu"});
    result.checks.push_back({.name = "the same against no growth at all (must not fit)",
                             .theory = "0: a diffusion coefficient that exists",
                             .source = "Boltzmann, Enskog",
                             .expected = 0.0,
                             .measured = {growth, std::hypot(error[row], error[later])},
                             .judged = Judged::disagrees});
  }
  return result;
}

}  // namespace

void add_transport(std::vector<Trial>& trials) {
  for (const double eta : {0.1, 0.2, 0.3, 0.4}) {
    const std::string name = fmt::format("transport-{:.1f}", eta);
    trials.push_back({name, "transport", false, [=](const Effort& effort) { return transport(name, eta, effort); }});
  }
}

}  // namespace carom::validation
