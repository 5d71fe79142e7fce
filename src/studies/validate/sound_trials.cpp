// The speed of sound, from the Brillouin peak: the frequency with which the longest density wave of a box swings.

#include "studies/validate/brillouin_fit.hpp"
#include "studies/validate/gas.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/kinetic.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace carom::validation {

namespace {

/// F(k,t) of independent runs, up to a longest lag.
struct Scattering {
  std::vector<double> lags;
  std::vector<std::vector<double>> runs;

  /// Returns the mean over all runs, or over all but one.
  [[nodiscard]] std::vector<double> mean(std::size_t without) const {
    std::vector<double> sum(lags.size());
    for (std::size_t r = 0; r < runs.size(); ++r)
      for (std::size_t k = 0; k < lags.size() && r != without; ++k) sum[k] += runs[r][k];
    for (double& value : sum) value /= static_cast<double>(runs.size() - (without < runs.size() ? 1 : 0));
    return sum;
  }
};

TrialResult sound(const std::string& trial, double eta, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::size_t replicas = 16;
  const std::int64_t disks = effort.full ? 4096 : 2304;
  const Box box = square_box(disks, eta);
  const double k = 2.0 * std::numbers::pi / box.lengths().x();
  const std::complex<double> wave = theory::sound_wave(eta, k);
  const double rate = theory::disk_collision_rate(theory::kolafa_rottner(eta)), period = 2.0 * std::numbers::pi / wave.imag();
  // 0.55 units of the box are nearest to the waves (1, 0) and (0, 1), the longest.
  const Gas gas{.disks = disks,
                .packing_fraction = eta,
                .collisions = effort.collisions(7e5),
                .observe = {{.name = "intermediate_scattering", .every = period / 64.0, .largest = 0.55 * k, .disks = 1}},
                .equilibrate = -2.0 * rate / wave.real()};
  Scattering found;
  for (std::size_t r = 0; r < replicas; ++r) {
    const Found one = run(scene_of(gas, effort.seed_of(r)), effort, result);
    const std::vector<double>&lags = one.column("intermediate_scattering", "lag"),
          &F = one.column("intermediate_scattering", "F");
    found.lags.clear();
    found.runs.emplace_back();
    for (std::size_t row = 0; row < lags.size() && lags[row] <= -2.0 / wave.real(); ++row)
      found.lags.push_back(lags[row]), found.runs.back().push_back(F[row]);
  }
  result.scenes.resize(1);  // the others differ in the seed

  const double Z = theory::kolafa_rottner(eta), S = theory::structure_factor_at_zero(eta), heat = Z * Z / (1.0 / S + Z * Z);
  const BrillouinFit guess{
      .heat = heat * S, .sound = (1.0 - heat) * S, .heat_decay = -wave.real(), .damping = -wave.real(), .frequency = wave.imag()};
  const std::vector<double> mean = found.mean(replicas);
  const BrillouinFit fit = fit_brillouin(found.lags, mean, guess);
  // The jackknife: error and bias of a fit that is not linear.
  std::vector<double> without;
  for (std::size_t r = 0; r < replicas; ++r) without.push_back(fit_brillouin(found.lags, found.mean(r), fit).frequency);
  const Measured others = mean_of(without);
  constexpr double n = replicas;
  const double frequency = n * fit.frequency - (n - 1.0) * others.value, error = (n - 1.0) * others.error;

  const double speed = theory::sound_speed(eta), slower = wave.imag() / (speed * k);
  const Measured measured{frequency / (k * slower), error / (k * slower), others.freedom};
  result.checks.push_back(
      {.name = fmt::format("speed of sound at packing fraction {:.1f}, {} disks", eta, disks),
       .theory = "sqrt(Z + eta Z' + Z^2) v_T",
       .source = "docs/validation.md, from the pressure of Kolafa & Rottner, Mol. Phys. 104, 3435 (2006)",
       .expected = speed,
       .measured = measured,
       .allowance = (1.0 - slower) * speed,
       .allowance_for = fmt::format("the {:.2f} % by which hydrodynamics makes a wave of this length slower, beyond which it "
                                    "leaves out terms of the same order",
                                    100.0 * (1.0 - slower))});
  result.checks.push_back(
      {.name = fmt::format("speed of sound at packing fraction {:.1f}, {} disks, at one temperature (must not fit)", eta, disks),
       .theory = "sqrt(Z + eta Z') v_T: heat that is exchanged at once",
       .source = "Newton",
       .expected = std::sqrt(1.0 / S),
       .measured = measured,
       .judged = Judged::disagrees});
  const std::string name = fmt::format("packing fraction {:.1f}", eta);
  Curve points{.plot = "sound", .name = name}, line{.plot = "sound", .name = name + ", fit", .theory = true};
  for (std::size_t row = 0; row < found.lags.size(); ++row) {
    const double time = found.lags[row];
    points.x.push_back(time / period), points.y.push_back(mean[row] / mean[0]);
    line.x.push_back(time / period), line.y.push_back(fit.at(time) / mean[0]);
  }
  result.curves = {std::move(points), std::move(line)};
  return result;
}

}  // namespace

void add_sound(std::vector<Trial>& trials) {
  for (const double eta : {0.2, 0.4}) {
    const std::string name = fmt::format("sound-{:.1f}", eta);
    trials.push_back({name, "transport", false, [=](const Effort& effort) { return sound(name, eta, effort); }});
  }
}

}  // namespace carom::validation
