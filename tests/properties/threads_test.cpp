// A simulation that is shared out has the bits of one that is not: random scenes, numbers of domains, threads and ranks, widths
// of halos, lengths of windows and places where one stops. Most of the halos are too narrow for their windows, which must be
// found.

#include "support/decoded_scene.hpp"
#include "support/memory_ranks.hpp"
#include "support/same_totals.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <carom/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace carom::test {
namespace {

double between(int low, int high, double unit) { return unit * *rc::gen::inRange(low, high + 1); }

Threads any_threads() {
  return {.threads = *rc::gen::inRange<std::size_t>(1, 5),
          .domains = *rc::gen::inRange<std::size_t>(1, 17),
          .halo = between(8, 120, 0.1),
          .events_per_window = between(1, 40, 0.1)};
}

/// A gas in which some disks may be larger, from a lattice, in a box of any shape.
Scene any_gas() {
  const auto disks = *rc::gen::inRange<std::int64_t>(2, 1500);
  const double packing_fraction = between(5, 70, 0.01), shape = between(5, 20, 0.1);
  const double side = std::sqrt(static_cast<double>(disks) * std::numbers::pi / 4.0 / packing_fraction);
  const auto boundary = [] { return *rc::gen::arbitrary<bool>() ? Boundary::periodic : Boundary::walls; };
  Scene scene;
  scene.box = {{0.0, 0.0}, {shape * side + 1.0, side / shape + 1.0}, {boundary(), boundary()}};
  Species gas;
  gas.name = "gas";
  gas.count = disks;
  gas.radius = 0.5;
  gas.mass = 1.0;
  if (*rc::gen::arbitrary<bool>()) {
    const auto seventh = *rc::gen::inRange<std::int64_t>(2, 8);
    for (std::int64_t i = 0; i < disks; ++i) {
      gas.radii.push_back(i % seventh == 0 ? 0.5 : 0.3);
      gas.masses.push_back(i % seventh == 0 ? 3.0 : 1.0);
    }
  }
  gas.positions = HexagonalLattice{};
  gas.velocities = MaxwellVelocities{1.0};
  scene.species = {gas};
  scene.effects.collision.rule = *rc::gen::arbitrary<bool>() ? CollisionRule::specular : CollisionRule::reversal;
  if (*rc::gen::arbitrary<bool>()) scene.effects.growth = Growth{.rate = between(1, 100, 0.001)};
  const double rate = between(1, 50, 0.1), temperature = between(1, 40, 0.1);
  switch (*rc::gen::inRange(0, 6)) {
    case 0:
      scene.effects.thermostat = Thermostat{temperature, rate};
      break;
    case 1:
      scene.effects.tumbling = Tumbling{rate};
      break;
    case 2:
      scene.effects.brownian = Brownian{temperature, rate};
      break;
    default:
      break;
  }
  scene.run.seed = *rc::gen::inRange<std::uint64_t>(1, 1000);
  return scene;
}

/// The time in which the fastest disk flies from one disk to the next, if none stands in its way.
double flight_time(const Scene& scene, const State& state) {
  const double fastest = state.velocities.colwise().norm().maxCoeff();
  return std::sqrt(scene.box.area() / static_cast<double>(scene.disk_count())) / (fastest > 0.0 ? fastest : 1.0);
}

/// Runs `scene` alone and shared out, through the same stops, and holds all that can be read of the two against each other.
void expect_same_bits(const Scene& scene, Threads threads, int ranks, const std::vector<std::uint64_t>& stops) {
  ServingRanks serving(ranks);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  threads.domains = std::max(threads.domains, static_cast<std::size_t>(ranks));
  shared.set_threads(threads, serving.first());
  const double longest = 20.0 * flight_time(scene, alone.state());
  double time = 0.0;
  for (const std::uint64_t collisions : stops) {
    const RunLimits limits{.collisions = alone.counts().pair + collisions};
    const StopReason reason = alone.run_until(time += longest, limits);
    RC_ASSERT(shared.run_until(time, limits) == reason);
    RC_ASSERT(shared.time() == alone.time());
    RC_ASSERT(state_hash(shared.state()) == state_hash(alone.state()));
    RC_ASSERT(different_totals_of_cores(alone.totals(), shared.totals()) == "");
    time = alone.time();
  }
  RC_ASSERT(shared.check_invariants() == alone.check_invariants());
}

/// Whether the scene check takes a scene, its engine can be shared out, and no disks collide without end before `most` events nor
/// are walls so fast that there are far more epochs, at each of which all threads meet, than events of a disk.
bool possible(const Scene& scene, std::uint64_t most) {
  try {
    Simulation alone = make_simulation(scene);
    if (!alone.why_not_threads().empty()) return false;
    const auto few_epochs = [&] { return alone.counts().numerics.epochs < most / 40; };
    alone.run_until(60.0 * flight_time(scene, alone.state()), {.events = most, .proceed = few_epochs});
    return alone.counts().events() < most && few_epochs();
  } catch (const SceneError&) {
    return false;
  }
}

/// A few disks with extreme numbers, and any effects that domains know. Small sizes stand for bytes that are all alike.
Scene any_effects() {
  const auto bytes = rc::gen::resize(100, rc::gen::container<std::vector<std::uint8_t>>(160, rc::gen::arbitrary<std::uint8_t>()));
  for (int tries = 0; tries < 100; ++tries) {
    try {
      Scene scene = parse_scene(decoded_scene(*bytes));
      Effects& effects = scene.effects;
      effects.shear.reset();
      for (WallProperties& wall : effects.walls) {
        wall.mass.reset(), wall.load.reset();
        wall.temperature.reset(), wall.tangential_velocity.reset();
      }
      if (possible(scene, 20'000)) return scene;
    } catch (const SceneError&) {
      continue;
    }
  }
  RC_DISCARD("no scene of a hundred can be shared out");
}

void tell(const Scene& scene, const Threads& threads, int ranks) {
  RC_LOG() << ranks << " ranks, " << scene.disk_count() << " disks, packing fraction " << scene.packing_fraction() << ", "
           << threads.threads << " threads, " << threads.domains << " domains, halo " << threads.halo << ", "
           << threads.events_per_window << " events of each disk in a window\n";
}

/// A gas that can be shared out.
Scene any_gas_of_several_cores() {
  Scene scene = any_gas();
  try {
    if (!make_simulation(scene).why_not_threads().empty()) scene.effects.growth.reset();  // until they fill the box
    if (!make_simulation(scene).why_not_threads().empty())
      RC_DISCARD("the box is too narrow for the engine that can be shared out");
  } catch (const SceneError&) {
    RC_DISCARD("the lattice does not fit");
  }
  return scene;
}

RC_GTEST_PROP(PropertyThreads, GiveTheBitsOfOneForAnyGas, ()) {
  const Scene scene = any_gas_of_several_cores();
  const Threads threads = any_threads();
  const int ranks = *rc::gen::inRange(1, 5);
  tell(scene, threads, ranks);
  const auto disks = static_cast<std::uint64_t>(scene.disk_count());
  expect_same_bits(scene, threads, ranks, {*rc::gen::inRange<std::uint64_t>(1, 5 * disks), 1, 4 * disks});
}

RC_GTEST_PROP(PropertyThreads, EndARunToANumberOfCollisionsWhereOneDoes, ()) {
  Scene scene = any_gas_of_several_cores();
  Threads threads = any_threads();
  const int ranks = *rc::gen::inRange(1, 5);
  tell(scene, threads, ranks);
  scene.effects.growth.reset();  // which has an end of its own
  scene.run.collisions = *rc::gen::inRange<std::uint64_t>(1, 5 * static_cast<std::uint64_t>(scene.disk_count()));
  if (*rc::gen::arbitrary<bool>())
    scene.run.equilibrate = Run::Equilibrate{.collisions_per_disk = between(1, 20, 0.1), .time = {}};
  ServingRanks serving(ranks);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  threads.domains = std::max(threads.domains, static_cast<std::size_t>(ranks));
  shared.set_threads(threads, serving.first());
  const StopReason reason = run_schedule(alone).stopped;
  RC_ASSERT(run_schedule(shared).stopped == reason);
  RC_ASSERT(shared.time() == alone.time());
  RC_ASSERT(shared.counts().pair == alone.counts().pair);
  RC_ASSERT(state_hash(shared.state()) == state_hash(alone.state()));
}

RC_GTEST_PROP(PropertyThreads, GiveTheBitsOfOneForAnyEffects, ()) {
  const Scene scene = any_effects();
  const Threads threads = any_threads();
  RC_LOG() << scene.text;
  const int ranks = *rc::gen::inRange(1, 5);
  tell(scene, threads, ranks);
  const auto disks = static_cast<std::uint64_t>(scene.disk_count());
  expect_same_bits(scene, threads, ranks, {*rc::gen::inRange<std::uint64_t>(1, 20 * disks), 1, 10 * disks});
}

}  // namespace
}  // namespace carom::test
