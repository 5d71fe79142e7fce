// Work and heat of few disks far from equilibrium: Jarzynski's and Crooks' theorems for two disks that a wall compresses, whose
// free energy is known in closed form, and the theorem of the heat that goes from wall to wall. Full trials: carom validate.

#include "support/block_means.hpp"
#include "theory/two_disks.hpp"

#include <carom/observe.hpp>
#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::test {
namespace {

double measured(const Scene& scene, const std::string& number) {
  Simulation simulation = make_simulation(scene);
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach(hooks);
  (void)run_schedule(simulation, hooks);
  for (const Measurement& one : observation.results())
    for (const Scalar& scalar : one.scalars)
      if (scalar.name == number) return scalar.value.value();
  ADD_FAILURE() << "there is no " << number;
  return 0.0;
}

Scene gas(std::int64_t disks, double width, double height, std::uint64_t seed) {
  Scene scene{.box = {.upper = {width, height}},
              .species = {{.count = disks, .radius = 0.5, .mass = 1.0, .velocities = MaxwellVelocities{1.0}}},
              .run = {.equilibrate = Run::Equilibrate{.time = 8.0}, .seed = seed, .keep_momentum = true},
              .observe = {{.name = "work", .every = 1.0}}};
  return scene;
}

std::vector<double> works(double from, double to, std::uint64_t first, int runs) {
  std::vector<double> found;
  for (int r = 0; r < runs; ++r) {
    Scene scene = gas(2, from, 4.0, first + static_cast<std::uint64_t>(r));
    scene.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 1.0};
    scene.run.time = 4.0;
    const std::string velocity = to < from ? "-0.5" : "0.5";
    scene.changes = {{.time = 0.0, .what = SetKeys{{"thermostat.rate=0", "walls.right={ velocity = " + velocity + " }"}}}};
    found.push_back(measured(scene, "work_right"));
  }
  return found;
}

TEST(PhysicsFluctuations, WorkObeysJarzynskiAndCrooks) {
  constexpr int runs = 800;
  const double difference = theory::free_energy_difference(2, 1.0, 6.0, 4.0, 4.0);
  std::vector<double> exponentials, one, other, plain = works(6.0, 4.0, 1, runs);
  for (const double work : plain) {
    exponentials.push_back(std::exp(difference - work));
    one.push_back(1.0 / (1.0 + std::exp(work - difference)));
  }
  for (const double work : works(4.0, 6.0, 10'001, runs)) other.push_back(1.0 / (1.0 + std::exp(work + difference)));
  const BlockMeans jarzynski = mean_of(exponentials), work = mean_of(plain), forward = mean_of(one), back = mean_of(other);
  EXPECT_NEAR(jarzynski.mean(), 1.0, 4.0 * jarzynski.error());
  EXPECT_LT(jarzynski.error(), 0.08);
  EXPECT_NEAR(forward.mean(), back.mean(), 4.0 * std::hypot(forward.error(), back.error()));
  EXPECT_GT(work.mean() - difference, 4.0 * work.error()) << "the compression is not slow";
}

/// P(q) = exp(s q) P(-q) makes a heat of size |q| negative with probability 1 / (1 + exp(s |q|)).
TEST(PhysicsFluctuations, HeatGoesTheWrongWayAsOftenAsItMay) {
  constexpr int runs = 1200;
  constexpr double s = 1.0 / 1.0 - 1.0 / 1.5;
  std::vector<double> excess;
  double wrong = 0.0;
  for (int r = 0; r < runs; ++r) {
    Scene scene = gas(3, 5.0, 5.0, 20'001 + static_cast<std::uint64_t>(r));
    scene.effects.walls[0].temperature = scene.effects.walls[1].temperature = 1.0;
    scene.run.time = 4.0;
    scene.changes = {{.time = 0.0, .what = SetKeys{{"walls.right.temperature=1.5"}}}};
    const double heat = measured(scene, "heat_right");
    if (heat == 0.0) continue;  // no disk has met the wall
    const double is_wrong = heat < 0.0 ? 1.0 : 0.0;
    wrong += is_wrong;
    excess.push_back(is_wrong - 1.0 / (1.0 + std::exp(s * std::abs(heat))));
  }
  const BlockMeans found = mean_of(excess);
  EXPECT_NEAR(found.mean(), 0.0, 4.0 * found.error());
  EXPECT_LT(found.error(), 0.015);
  EXPECT_GT(wrong, runs / 10);
}

/// By counting points of a grid: the integral is smooth in the contact distance.
TEST(PhysicsFluctuations, TheConfigurationIntegralOfTwoDisksIsThatOfAGrid) {
  constexpr double x = 3.5, y = 4.25, d = 1.0;
  constexpr int n = 60;
  double sum = 0.0;
  for (int i = -n + 1; i < n; ++i)
    for (int j = -n + 1; j < n; ++j) {
      const double dx = i * (x - d) / n, dy = j * (y - d) / n;
      if (dx * dx + dy * dy > d * d) sum += (n - std::abs(i)) * (n - std::abs(j));
    }
  const double free = (x - d) * (y - d);
  EXPECT_NEAR(theory::configuration_integral(2, d, x, y), sum * free * free / std::pow(n, 4), 0.01 * free * free);
  EXPECT_NEAR(theory::configuration_integral(1, d, x, y), free, 1e-15);
}

}  // namespace
}  // namespace carom::test
