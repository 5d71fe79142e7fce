// Disks in a channel in which they cannot pass each other: collisions of disks and walls at any density, against an exact
// solution.

#include "studies/validate/gas.hpp"
#include "theory/single_file.hpp"

#include <carom/blocking.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace carom::validation {

namespace {

/// What a channel along x at kT = 1 tells between samples: the force along it, the force on both walls over twice its length, and
/// the potential energy per disk. Over a long time the force along y of disks on each other is that of the walls on disks, less
/// kT for each disk; what is left of the virial is that along x.
class ForcesAndEnergy final : public Observable {
 public:
  using Take = std::function<void(double force, double wall_pressure, double energy)>;
  ForcesAndEnergy(double step, const Scene& scene, Take take)
      : step_(step),
        length_(scene.box.lengths().x()),
        swing_(0.5 * (scene.box.lengths().y() - 1.0)),
        disks_(static_cast<double>(scene.disk_count())),
        steps_(scene.effects.potential_steps()),
        take_(std::move(take)) {}
  [[nodiscard]] std::string name() const override { return "forces_and_energy"; }
  [[nodiscard]] double step() const override { return step_; }
  void sample(const State& state, const Totals& totals) override {
    const double impulse = totals.wall_impulse[2] + totals.wall_impulse[3];
    if (begun_) {
      double energy = 0.0;
      for (std::size_t k = 0; k < steps_.size(); ++k) energy += steps_[k].energy * static_cast<double>(state.pairs_in_steps[k]);
      const double pushed = impulse - impulse_before_;
      take_((2.0 * disks_ + (totals.virial - virial_before_ - swing_ * pushed) / step_) / length_,
            pushed / (2.0 * length_ * step_), energy / disks_);
    }
    begun_ = true;
    impulse_before_ = impulse;
    virial_before_ = totals.virial;
  }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double step_, length_, swing_, disks_;
  std::vector<PotentialStep> steps_;
  Take take_;
  double impulse_before_ = 0.0, virial_before_ = 0.0;
  bool begun_ = false;
};

/// A zigzag along a channel, as wide as leaves neighbours and walls the same room.
ListedPositions zigzag(std::int64_t disks, double width, double length_per_disk) {
  const double closest = std::sqrt(std::max(0.0, 1.0 - length_per_disk * length_per_disk));
  const double swing = 0.5 * (closest + width - 1.0);
  ListedPositions places;
  for (std::int64_t i = 0; i < disks; ++i)
    places.values.emplace_back((static_cast<double>(i) + 0.5) * length_per_disk, 0.5 * (width + (i % 2 == 0 ? swing : -swing)));
  return places;
}

Scene channel_scene(std::int64_t disks, double width, double length_per_disk, const Run& run) {
  return {
      .box = {.upper = {length_per_disk * static_cast<double>(disks), width}, .boundary = {Boundary::periodic, Boundary::walls}},
      .species = {{.count = disks,
                   .radius = 0.5,
                   .mass = 1.0,
                   .positions = zigzag(disks, width, length_per_disk),
                   .velocities = MaxwellVelocities{1.0}}},
      .run = run};
}

/// Returns the mean over `values` in order, with the error by which the means of so many stretches of them scatter.
Measured mean_by_stretches(const std::vector<double>& values, std::size_t stretches) {
  const std::size_t each = values.size() / stretches;
  std::vector<double> means(stretches);
  for (std::size_t k = 0; k < stretches * each; ++k) means[k / each] += values[k] / static_cast<double>(each);
  return mean_of(means);
}

TrialResult channel(const std::string& trial, double width, double length_per_disk, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 50;
  // Heat spreads along the channel by one neighbour in some collisions, and forces remember a little of where it was for several
  // (N / 2 pi)^2 collisions of a disk, of 200 disks ten thousand: stretches are some times as long, and as much comes before the
  // first.
  constexpr double spreading = 5000.0;
  constexpr std::size_t stretches = 24;
  const Scene scene = channel_scene(disks, width, length_per_disk,
                                    run_of(effort.collisions(0.5 * disks * stretches * spreading), spreading, effort.seed_of(0)));
  std::vector<double> forces, wall_pressures;
  std::vector<std::unique_ptr<Observable>> own;
  own.push_back(std::make_unique<ForcesAndEnergy>(1.0, scene, [&](double force, double wall_pressure, double) {
    forces.push_back(force), wall_pressures.push_back(wall_pressure);
  }));
  (void)run(scene, effort, result, std::move(own));
  const theory::SingleFile exact = theory::single_file(width, length_per_disk, disks);
  const std::string what = fmt::format("{} disks in a channel of width {:g}, {:g} long for each", disks, width, length_per_disk);
  const std::string source = "Montero & Santos, arXiv:2212.08932 (2022); N disks: docs/validation.md";
  result.checks.push_back({.name = "force along the channel over kT / sigma, " + what,
                           .theory = "transfer matrix, for so many disks",
                           .source = source,
                           .expected = exact.force,
                           .measured = mean_by_stretches(forces, stretches)});
  result.checks.push_back({.name = "pressure on its walls over kT / sigma^2, " + what,
                           .theory = "transfer matrix, for so many disks",
                           .source = source,
                           .expected = exact.wall_pressure,
                           .measured = mean_by_stretches(wall_pressures, stretches)});
  return result;
}

/// Disks with a pair potential of steps or with a square well, in a bath of kT = 1.
TrialResult channel_with_potential(const std::string& trial, double width, double length_per_disk,
                                   const std::variant<SteppedPotential, SquareWell>& effect, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 200;
  Scene scene = channel_scene(disks, width, length_per_disk, run_of(effort.collisions(2e6), 200.0, effort.seed_of(0)));
  if (const auto* well = std::get_if<SquareWell>(&effect))
    scene.effects.square_well = *well;
  else
    scene.effects.stepped_potential = std::get<SteppedPotential>(effect);
  const std::vector<PotentialStep> steps = scene.effects.potential_steps();
  scene.effects.thermostat = Thermostat{1.0, 0.5};
  Blocking force, wall_pressure, energy;
  std::vector<std::unique_ptr<Observable>> own;
  own.push_back(std::make_unique<ForcesAndEnergy>(1.0, scene, [&](double along, double across, double potential) {
    force.add(along), wall_pressure.add(across), energy.add(potential);
  }));
  (void)run(scene, effort, result, std::move(own));
  const theory::SingleFile exact = theory::single_file(width, length_per_disk, disks, steps);
  std::string potential;
  for (const PotentialStep& step : steps) potential += fmt::format(", {:g} kT within {:g}", step.energy, step.width);
  const std::string what =
      fmt::format("{} disks in a channel of width {:g}, {:g} long for each{}", disks, width, length_per_disk, potential);
  const auto put = [&](const char* quantity, double expected, const Blocking& measured) {
    const auto estimate = measured.estimate();
    result.checks.push_back({.name = fmt::format("{}, {}", quantity, what),
                             .theory = "transfer matrix with steps, for so many disks",
                             .source = "Montero & Santos, arXiv:2402.15192 (2024); N disks: docs/validation.md",
                             .expected = expected,
                             .measured = {estimate->mean, estimate->error.value_or(NAN)}});
  };
  put("force along the channel over kT / sigma", exact.force, force);
  put("pressure on its walls over kT / sigma^2", exact.wall_pressure, wall_pressure);
  put("potential energy of a disk over kT", exact.energy, energy);
  return result;
}

}  // namespace

void add_single_file(std::vector<Trial>& trials) {
  struct Channel {
    double width, length;
  };
  for (const Channel& at : {Channel{1.8, 1.0}, Channel{1.8, 2.0}, Channel{1.5, 0.95}, Channel{1.2, 1.2}}) {
    const std::string name = fmt::format("single-file-{:g}-{:g}", at.width, at.length);
    trials.push_back(
        {name, "single file", false, [=](const Effort& effort) { return channel(name, at.width, at.length, effort); }});
  }
  struct WithPotential {
    const char* what;
    double width, length;
    std::variant<SteppedPotential, SquareWell> effect;
  };
  for (const WithPotential& at :
       {WithPotential{"steps", 1.5, 1.2, SteppedPotential{{{1.2, 1.0}, {1.6, -1.0}}}},
        WithPotential{"steps", 1.8, 1.1, SteppedPotential{{{1.05, -1.0}, {1.1, 0.0}, {1.19, 0.5}}}},
        WithPotential{"well", 1.5, 1.3, SquareWell{1.5, 1.0}}, WithPotential{"shoulder", 1.3, 1.2, SquareWell{1.4, -1.0}}}) {
    const std::string name = fmt::format("single-file-{}-{:g}-{:g}", at.what, at.width, at.length);
    trials.push_back({name, "single file", false, [=](const Effort& effort) {
                        return channel_with_potential(name, at.width, at.length, at.effect, effort);
                      }});
  }
}

}  // namespace carom::validation
