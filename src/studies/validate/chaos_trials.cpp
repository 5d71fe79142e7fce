// What the symmetries of Hamiltonian dynamics say of all Lyapunov exponents.

#include "studies/horizon/spectrum.hpp"
#include "studies/validate/gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom::validation {

namespace {

TrialResult lyapunov_spectrum(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 8;
  const auto spectrum_of = [&](CollisionRule rule, Boundary boundary) {
    const Gas gas{.disks = disks, .packing_fraction = 0.3, .rule = rule, .boundary = boundary, .equilibrate = 0.0};
    const Scene scene = scene_of(gas, effort.seed_of(0));
    result.scenes.push_back(resolved_toml(scene));
    const auto found = measure_spectrum(scene, make_simulation(scene).state(),
                                        {.collisions = static_cast<std::uint64_t>(effort.collisions(20'000.0)),
                                         .proceed = [&](double) { return !effort.proceed || effort.proceed(); }});
    if (!found && effort.proceed && !effort.proceed()) throw Interrupted{};
    return found.value();
  };
  const auto put_pairs = [&](const LyapunovSpectrum& found, const std::string& what, Judged judged) {
    result.checks.push_back(
        {.name = fmt::format("largest sum of a pair of Lyapunov exponents over the collision rate, {} {}", disks, what),
         .theory = "0: the i-th largest and the i-th smallest of a Hamiltonian system",
         .source = "the tangent map is symplectic",
         .expected = 0.0,
         .measured = {found.pairing / found.collision_rate, 0.0},
         .allowance = 1e-9,
         .allowance_for = "rounding",
         .judged = judged});
  };
  const auto put_zeros = [&](const LyapunovSpectrum& found, const std::string& what, int expected, const char* theory) {
    // Those of conserved numbers are ln t / t after the time t at most, 0.2 % of the collision rate; the next are about 0.3 of
    // it.
    const auto zeros = std::count_if(found.exponents.begin(), found.exponents.end(),
                                     [&](double exponent) { return std::abs(exponent) < 0.01 * found.collision_rate; });
    result.checks.push_back({.name = fmt::format("Lyapunov exponents below 1 % of the collision rate, {} {}", disks, what),
                             .theory = fmt::format("{}: {}", expected, theory),
                             .source = "conserved numbers",
                             .expected = static_cast<double>(expected),
                             .measured = {static_cast<double>(zeros), 0.0}});
  };
  const LyapunovSpectrum periodic = spectrum_of(CollisionRule::specular, Boundary::periodic);
  put_pairs(periodic, "disks in a periodic box", Judged::agrees);
  put_zeros(periodic, "disks in a periodic box", 6,
            "momentum and place of the centre of mass, energy, and the time at which it all began");
  const LyapunovSpectrum walls = spectrum_of(CollisionRule::specular, Boundary::walls);
  put_pairs(walls, "disks between walls", Judged::agrees);
  put_zeros(walls, "disks between walls", 2, "energy, and the time at which it all began");
  put_pairs(spectrum_of(CollisionRule::reversal, Boundary::periodic), "disks under the reversal rule (must not fit)",
            Judged::disagrees);
  return result;
}

}  // namespace

void add_chaos(std::vector<Trial>& trials) {
  trials.push_back({"lyapunov-spectrum", "percolation and chaos", false,
                    [](const Effort& effort) { return lyapunov_spectrum("lyapunov-spectrum", effort); }});
}

}  // namespace carom::validation
