// Andersen's thermostat: events that come when and where chance says, the same on every engine, and the ensemble that they make.

#include "effects/andersen.hpp"
#include "observe/mechanics.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

Scene heated(Scene scene, double temperature, double rate) {
  scene.effects.thermostat = Thermostat{temperature, rate};
  return scene;
}

/// Of uniform disks, at scale 1.
double energy_of_spins(const Disks& disks, const State& state) {
  double sum = 0.0;
  for (std::size_t i = 0; i < disks.count(); ++i)
    sum += 0.25 * disks.mass[i] * std::pow(disks.radius[i] * state.spins[static_cast<Eigen::Index>(i)], 2);
  return sum;
}

TEST(Thermostat, AtRateZeroLeavesTheSameBits) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    Simulation plain = make_simulation(mixture_scene(20, 0.4, boundary));
    Simulation neutral = make_simulation(heated(mixture_scene(20, 0.4, boundary), 3.0, 0.0));
    plain.run_until(20.0);
    neutral.run_until(20.0);
    EXPECT_EQ(neutral.engine(), plain.engine());
    EXPECT_TRUE(same_bits(plain.state(), neutral.state()));
    EXPECT_EQ(neutral.totals().thermostat, 0U);
  }
}

TEST(Thermostat, EventsAreThoseOfAPoissonProcessOfAllDisks) {
  const Andersen andersen(Thermostat{2.0, 0.5}, 10, 7);
  constexpr int events = 100'000;
  double time = 0.0, squares = 0.0;
  std::vector<int> of_disk(10);
  for (int n = 0; n < events; ++n) {
    const ThermostatEvent event = andersen.event(static_cast<std::uint64_t>(n));
    time += event.wait;
    squares += event.wait * event.wait;
    ++of_disk.at(static_cast<std::size_t>(event.disk));
  }
  // Exponential at rate 10 * 0.5: mean 0.2 and as large a deviation; mean square 0.08, of deviation sqrt(20) 0.04. 5 of their
  // standard errors, as for each disk's number, which is binomial.
  EXPECT_NEAR(time / events, 0.2, 5 * 0.2 / std::sqrt(events));
  EXPECT_NEAR(squares / events, 0.08, 5 * 0.04 * std::sqrt(20.0 / events));
  for (const int number : of_disk) EXPECT_NEAR(number, events / 10, 5 * std::sqrt(events * 0.09));
}

TEST(Thermostat, GivesEveryEngineTheSameEvents) {
  // A lone disk between walls forgets by each event whatever rounding has done to its velocity.
  Scene scene =
      heated(scene_of(box_of(10.0, 10.0, Boundary::walls), {species_of(1, 0.5, 2.0, ListedPositions{{{5.0, 5.0}}}, AtRest{})}),
             1.0, 0.7);
  Simulation textbook = make_simulation(scene, "textbook");
  Simulation precise = make_simulation(scene, "textbook-quad");
  textbook.run_until(50.0);
  precise.run_until(50.0);
  EXPECT_GT(textbook.totals().thermostat, 10U);
  EXPECT_EQ(textbook.totals().thermostat, precise.totals().thermostat);
  EXPECT_EQ(textbook.state().velocities.cwiseAbs(), precise.state().velocities.cwiseAbs());
  // Rounding a time of 50 moves a disk of speed 3 by less than 50 * 3 * 2^-53 per event.
  EXPECT_LT((textbook.state().positions - precise.state().positions).norm(), 1e-12);
}

TEST(Thermostat, EventsComeAtTheirRate) {
  Simulation simulation = make_simulation(heated(gas_scene(36, 0.4, Boundary::periodic), 1.0, 0.5));
  simulation.run_until(100.0);
  // Poisson of mean 36 * 0.5 * 100; 5 standard deviations.
  EXPECT_NEAR(static_cast<double>(simulation.totals().thermostat), 1800.0, 5 * std::sqrt(1800.0));
}

TEST(Thermostat, AccountsForTheEnergyThatItGives) {
  for (const bool rough : {false, true}) {
    Scene scene = heated(mixture_scene(30, 0.4, Boundary::walls), 2.5, 0.3);
    if (rough) scene.effects.collision.roughness = 1.0;
    Simulation simulation = make_simulation(scene);
    const auto energy = [&] {
      const State state = simulation.state();
      return kinetic_energy(simulation.disks(), state) + (rough ? energy_of_spins(simulation.disks(), state) : 0.0);
    };
    const double before = energy();
    simulation.run_until(100.0);
    EXPECT_GT(simulation.totals().thermostat_energy, 10.0);
    // Some thousand collisions and events, each of which rounds the energy of two disks by some 1e-16 of it.
    EXPECT_NEAR(energy(), before + simulation.totals().thermostat_energy, 1e-12 * before);
    const auto faults = simulation.check_invariants();
    EXPECT_TRUE(faults.empty()) << faults.front();
  }
}

TEST(Thermostat, LeavesTheSameBitsWhereverOneStops) {
  const Scene scene = heated(mixture_scene(20, 0.5, Boundary::periodic), 1.0, 0.4);
  Simulation once = make_simulation(scene), often = make_simulation(scene);
  once.run_until(10.0);
  for (std::uint64_t k = 1; k < 100; ++k) {
    often.run_until(1e9, {.collisions = 3 * k});
    if (often.time() > 10.0 * static_cast<double>(k) / 100.0) continue;
    often.run_until_sample(k, 0.1);
  }
  ASSERT_LE(often.time(), 10.0);
  often.run_until(10.0);
  EXPECT_TRUE(same_bits(once.state(), often.state()));
  EXPECT_EQ(once.totals().thermostat, often.totals().thermostat);
  EXPECT_EQ(once.totals().thermostat_energy, often.totals().thermostat_energy);
}

TEST(Thermostat, GoesOnWhenTheClockIsReset) {
  const Scene scene = heated(gas_scene(16, 0.3, Boundary::walls), 1.0, 0.5);
  Simulation simulation = make_simulation(scene), twin = make_simulation(scene);
  simulation.run_until(10.0);
  const std::uint64_t before = simulation.totals().thermostat;
  simulation.reset_clock();
  EXPECT_EQ(simulation.totals().thermostat, 0U);
  EXPECT_EQ(simulation.totals().thermostat_energy, 0.0);
  simulation.run_until(10.0);
  twin.run_until(20.0);
  EXPECT_EQ(before + simulation.totals().thermostat, twin.totals().thermostat);
}

TEST(Thermostat, SetsDisksInMotionThatWaitForCollisions) {
  Scene scene = heated(gas_scene(16, 0.3, Boundary::periodic), 1.0, 0.1);
  scene.species.front().velocities = AtRest{};
  scene.run.collisions = 20;
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::collisions);
  EXPECT_EQ(simulation.totals().pair, 20U);
}

void expect_gamma_law(Scene scene, double temperature, double shape) {
  const bool rough = scene.effects.collision.roughness.has_value();
  constexpr double rate = 2.0;
  scene = heated(scene, temperature, rate);
  Simulation simulation = make_simulation(scene);
  constexpr int samples = 4000;
  double sum = 0.0, squares = 0.0;
  for (int k = 1; k <= samples; ++k) {
    // Each event makes 1 / N of the energy new, so energies 8 / rate apart are correlated by exp(-8) = 3e-4.
    simulation.run_until(8.0 / rate * (k + 1));
    const State state = simulation.state();
    const double energy = kinetic_energy(simulation.disks(), state) + (rough ? energy_of_spins(simulation.disks(), state) : 0.0);
    sum += energy;
    squares += energy * energy;
  }
  const double mean = sum / samples, variance = squares / samples - mean * mean;
  // Gamma(k, kT): mean k kT, variance s = k kT^2, fourth central moment (3 + 6/k) s^2; 4 standard errors of each.
  const double s = shape * temperature * temperature;
  EXPECT_NEAR(mean, shape * temperature, 4 * std::sqrt(s / samples));
  EXPECT_NEAR(variance, s, 4 * s * std::sqrt((2.0 + 6.0 / shape) / samples));
}

TEST(PhysicsThermostat, GivesTheEnergyTheGammaLawOfTheCanonicalEnsemble) {
  expect_gamma_law(mixture_scene(16, 0.3, Boundary::periodic), 1.7, 16.0);
  expect_gamma_law(gas_scene(9, 0.2, Boundary::walls), 0.4, 9.0);
}

TEST(PhysicsThermostat, SharesItWithSpin) {
  Scene scene = mixture_scene(16, 0.3, Boundary::walls);
  scene.effects.collision.roughness = 1.0;
  expect_gamma_law(scene, 1.7, 24.0);  // three degrees of freedom of kT / 2 per disk
}

}  // namespace
}  // namespace carom::test
