// Pressure: the fluid at twelve densities, small systems without any correction, the virial series, the transition from liquid to
// hexatic, the solid near close packing.

#include "study/validation/gas.hpp"
#include "theory/bernard_krauth_2011.hpp"
#include "theory/clisby_mccoy_2006.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/li_2022.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace carom::validation {

namespace {

constexpr double pi = std::numbers::pi;
constexpr const char* kolafa_rottner_source = "Kolafa & Rottner, Mol. Phys. 104, 3435 (2006)";

/// One density of the fluid: as many disks as correlations ask for, and collisions.
struct Density {
  double eta;
  std::int64_t disks;
  double collisions;  ///< in a quick validation
};
// Beyond 0.63 the first term in 1/N does not hold any more; there systems are large enough for what it would be to be small.
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

TrialResult fluid(const std::string& trial, const Density& at, const Effort& effort) {
  TrialResult result{.trial = trial};
  const Gas gas{.disks = at.disks,
                .packing_fraction = at.eta,
                .collisions = effort.collisions(at.collisions),
                .observe = "pressure = true\n",
                .positions = at.eta > 0.64 ? fmt::format("{{ packing_fraction = {} }}", at.eta) : "\"hexagonal\"",
                .equilibrate = at.eta > 0.64 ? 3000.0 : 100.0};
  const Found found = run(scene_text(gas, effort.seed_of(0)), effort, result);
  const Measured Z = found.measured("pressure", "Z");
  const bool corrected = at.eta <= 0.63;
  const double infinite = theory::kolafa_rottner(at.eta), finite = theory::kolafa_rottner_finite(at.eta, at.disks);
  // What the correction would be there.
  const double unknown = corrected ? 0.0 : std::abs(finite - infinite);
  result.checks.push_back(
      {.name = fmt::format("Z at packing fraction {:.2f}, {} disks", at.eta, at.disks),
       .theory = corrected ? "the fluid's equation of state with the first term in 1/N" : "the fluid's equation of state",
       .source = kolafa_rottner_source,
       .expected = corrected ? finite : infinite,
       .measured = Z,
       .allowance = 2e-5 * infinite + unknown,
       .allowance_for = corrected ? "2e-5: the error of the equation of state"
                                  : "2e-5: the error of the equation of state; and the size of the term in 1/N"});
  result.checks.push_back(
      {.name = fmt::format("Z from how often disks collide, packing fraction {:.2f}, {} disks", at.eta, at.disks),
       .theory = "that from the momentum they transfer",
       .source = "exact: velocities at collisions are those of equilibrium",
       .expected = Z.value,
       .measured = {found.measured("pressure", "Z_rate").value,
                    std::hypot(Z.error, found.measured("pressure", "Z_rate").error)}});
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
  const double reference = corrected ? finite : infinite;
  result.curves.push_back({.plot = "equation-of-state-residual",
                           .name = "measured",
                           .x = {at.eta},
                           .y = {1e3 * (Z.value / reference - 1.0)},
                           .error = {1e3 * Z.error / reference}});
  return result;
}

TrialResult small(const std::string& trial, const theory::SmallSystemPressure& known, const Effort& effort) {
  TrialResult result{.trial = trial};
  const Gas gas{.disks = known.disks,
                .packing_fraction = known.packing_fraction,
                .collisions = effort.collisions(8e6),
                .observe = "pressure = true\n",
                .equilibrate = 2000.0};
  const Found found = run(scene_text(gas, effort.seed_of(0)), effort, result);
  const Measured P = found.measured("pressure", "reduced");
  result.checks.push_back(
      {.name = fmt::format("P sigma^2 / kT of {} disks at packing fraction {:.2f}", known.disks, known.packing_fraction),
       .theory = fmt::format("{} +- {} for this number of disks", known.pressure, known.error),
       .source = "Li et al., J. Chem. Phys. 157, 234111 (2022)",
       .expected = known.pressure,
       .measured = {P.value, std::hypot(P.error, known.error)}});
  return result;
}

/// A crystal of 16 x 18 disks in a box that fits it.
TrialResult solid(const std::string& trial, double alpha, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr int columns = 16, rows = 18, disks = columns * rows;
  // Close packing has eta_cp = pi / 2 sqrt3; lengths are 1 + alpha times as large in area.
  const double spacing = std::sqrt(1.0 + alpha);
  const std::string scene = fmt::format(
      "[box]\nx = [0.0, {:.17g}]\ny = [0.0, {:.17g}]\nboundary = \"periodic\"\n\n[[disks]]\ncount = {}\nradius = 0.5\nmass = "
      "1.0\n"
      "positions = \"hexagonal\"\nvelocities = {{ temperature = 1.0 }}\n\n[collision]\nrule = \"specular\"\n\n[run]\n"
      "collisions = {:.0f}\nequilibrate = {{ collisions_per_disk = 500 }}\nseed = {}\n\n[observe]\npressure = true\n",
      columns * spacing, rows * spacing * 0.5 * std::numbers::sqrt3, disks, effort.collisions(4e6), effort.seed_of(0));
  const Found found = run(scene, effort, result);
  const double eta = 0.25 * pi * disks / (columns * spacing * rows * spacing * 0.5 * std::numbers::sqrt3);
  const double expected = 2.0 * (1.0 - 1.0 / disks) / alpha + 1.90;
  result.checks.push_back({.name = fmt::format("Z of a crystal of {} disks at packing fraction {:.6f}", disks, eta),
                           .theory = "2 (1 - 1/N) / alpha + 1.90, alpha = eta_cp / eta - 1",
                           .source = "Salsburg & Wood, J. Chem. Phys. 37, 798 (1962)",
                           .expected = expected,
                           .measured = found.measured("pressure", "Z"),
                           .allowance = 0.02 + alpha,
                           .allowance_for = "the last digit of 1.90, the next term, of order alpha, and 1/N of 1.90"});
  return result;
}

TrialResult transition(const std::string& trial, const theory::TransitionPressure& known, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 16384;
  const Gas gas{.disks = disks,
                .packing_fraction = known.packing_fraction,
                .collisions = 6e8,
                .observe = "pressure = true\n",
                .equilibrate = 20'000.0};
  const Found found = run(scene_text(gas, effort.seed_of(0)), effort, result);
  result.checks.push_back(
      {.name = fmt::format("P sigma^2 / kT where liquid and hexatic coexist, packing fraction {:.3f}, {} disks",
                           known.packing_fraction, disks),
       .theory = fmt::format("{} of 1024^2 disks: flat from 0.700 to 0.716", known.pressure),
       .source = "Bernard & Krauth, Phys. Rev. Lett. 107, 155704 (2011)",
       .expected = known.pressure,
       .measured = found.measured("pressure", "reduced"),
       .allowance = 0.08,
       .allowance_for =
           "interfaces: the loop of the pressure is some +-0.04 high with 256^2 disks in the same paper, and grows like "
           "1 / sqrt N"});
  return result;
}

TrialResult engel(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  const Gas gas{.disks = 16384,
                .packing_fraction = 0.25 * pi * theory::engel_2013_density,
                .collisions = 6e8,
                .observe = "pressure = true\n",
                .equilibrate = 20'000.0};
  const Found found = run(scene_text(gas, effort.seed_of(0)), effort, result);
  result.checks.push_back({.name = "P sigma^2 / kT of 128^2 disks at density 0.88872",
                           .theory = "9.17079",
                           .source = "Engel et al., Phys. Rev. E 87, 042134 (2013), as HOOMD-blue's validation has it",
                           .expected = theory::engel_2013_pressure,
                           .measured = found.measured("pressure", "reduced")});
  return result;
}

}  // namespace

void add_equation_of_state(std::vector<Trial>& trials) {
  const std::string group = "equation of state";
  for (const Density& at : densities) {
    const std::string name = fmt::format("pressure-{:.2f}", at.eta);
    trials.push_back({name, group, false, [=](const Effort& effort) { return fluid(name, at, effort); }});
  }
  for (const theory::SmallSystemPressure& known : theory::li_2022) {
    const std::string name = fmt::format("pressure-{}-disks-{:.2f}", known.disks, known.packing_fraction);
    trials.push_back({name, group, false, [=](const Effort& effort) { return small(name, known, effort); }});
  }
  for (const double alpha : {1e-2, 1e-3}) {
    const std::string name = fmt::format("crystal-{:g}", alpha);
    trials.push_back({name, group, false, [=](const Effort& effort) { return solid(name, alpha, effort); }});
  }
  trials.push_back({"transition-hoomd", group, true, [](const Effort& effort) { return engel("transition-hoomd", effort); }});
  for (const theory::TransitionPressure& known : theory::bernard_krauth_2011) {
    if (known.packing_fraction < 0.7 || known.packing_fraction > 0.7165) continue;
    const std::string name = fmt::format("transition-{:.3f}", known.packing_fraction);
    trials.push_back({name, group, true, [=](const Effort& effort) { return transition(name, known, effort); }});
  }
}

}  // namespace carom::validation
