// Disks in a channel in which they cannot pass each other: collisions of disks and walls at any density, against an exact
// solution.

#include "studies/validate/gas.hpp"
#include "theory/single_file.hpp"

#include <carom/blocking.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom::validation {

namespace {

/// The force on both walls of a channel along x, over kT and twice its length.
class WallPressure final : public Observable {
 public:
  WallPressure(double step, double length, Blocking& pressure) : step_(step), length_(length), pressure_(pressure) {}
  [[nodiscard]] std::string name() const override { return "wall_pressure"; }
  [[nodiscard]] double step() const override { return step_; }
  void sample(const State&, const Totals& totals) override {
    const double impulse = totals.wall_impulse[2] + totals.wall_impulse[3];
    if (begun_) pressure_.add((impulse - before_) / (2.0 * length_ * step_));
    begun_ = true;
    before_ = impulse;
  }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double step_, length_, before_ = 0.0;
  Blocking& pressure_;
  bool begun_ = false;
};

TrialResult channel(const std::string& trial, double width, double length_per_disk, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 200;
  const double length = length_per_disk * disks;
  // A zigzag, as wide as leaves neighbours and walls the same room.
  const double closest = std::sqrt(std::max(0.0, 1.0 - length_per_disk * length_per_disk));
  const double swing = 0.5 * (closest + width - 1.0);
  ListedPositions places;
  for (std::int64_t i = 0; i < disks; ++i)
    places.values.emplace_back((static_cast<double>(i) + 0.5) * length_per_disk, 0.5 * (width + (i % 2 == 0 ? swing : -swing)));
  const Scene scene{
      .box = {.upper = {length, width}, .boundary = {Boundary::periodic, Boundary::walls}},
      .species = {{.count = disks, .radius = 0.5, .mass = 1.0, .positions = places, .velocities = MaxwellVelocities{1.0}}},
      .run = run_of(effort.collisions(3e6), 500.0, effort.seed_of(0)),
      .observe = {{.name = "pressure"}}};
  Blocking pressure;
  std::vector<std::unique_ptr<Observable>> own;
  own.push_back(std::make_unique<WallPressure>(1.0, length, pressure));
  const Found found = run(scene, effort, result, std::move(own));
  const theory::SingleFile exact = theory::single_file(width, length_per_disk, disks);
  const std::string what = fmt::format("{} disks in a channel of width {:g}, {:g} long for each", disks, width, length_per_disk);
  const std::string source = "Montero & Santos, arXiv:2212.08932 (2022); 1/N: docs/validation.md";
  const Measured stress = found.measured("pressure", "P_xx");
  result.checks.push_back({.name = "force along the channel over kT / sigma, " + what,
                           .theory = "transfer matrix, with the first term in 1/N",
                           .source = source,
                           .expected = exact.force,
                           .measured = {stress.value * width, stress.error * width}});
  const auto estimate = pressure.estimate();
  result.checks.push_back({.name = "pressure on its walls over kT / sigma^2, " + what,
                           .theory = "transfer matrix, with the first term in 1/N",
                           .source = source,
                           .expected = exact.wall_pressure,
                           .measured = {estimate->mean, estimate->error.value_or(NAN)}});
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
}

}  // namespace carom::validation
