// A simulation that is shared out has the bits of one that is not: random scenes, numbers of domains and threads, widths of
// halos, lengths of windows and places where one stops. Most of the halos are too narrow for their windows, which must be found.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <carom/simulation.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
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
  scene.run.seed = *rc::gen::inRange<std::uint64_t>(1, 1000);
  return scene;
}

/// Runs `scene` alone and shared out, through the same stops, and holds all that can be read of the two against each other.
void expect_same_bits(const Scene& scene, const Threads& threads, const std::vector<std::uint64_t>& stops) {
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads(threads);
  double time = 0.0;
  for (const std::uint64_t collisions : stops) {
    const RunLimits limits{.collisions = alone.counts().pair + collisions};
    const StopReason reason = alone.run_until(time += 20.0, limits);
    RC_ASSERT(shared.run_until(time, limits) == reason);
    RC_ASSERT(shared.time() == alone.time());
    RC_ASSERT(state_hash(shared.state()) == state_hash(alone.state()));
    const Totals a = alone.totals(), b = shared.totals();
    RC_ASSERT(b.pair == a.pair);
    RC_ASSERT(b.wall == a.wall);
    RC_ASSERT(b.other == a.other);
    RC_ASSERT(b.stale == a.stale);
    RC_ASSERT(b.virial == a.virial);
    RC_ASSERT(b.numerics.epochs == a.numerics.epochs);
    time = alone.time();
  }
  RC_ASSERT(shared.check_invariants() == alone.check_invariants());
}

RC_GTEST_PROP(PropertyThreads, GiveTheBitsOfOneForAnyGas, ()) {
  const Scene scene = any_gas();
  const Threads threads = any_threads();
  try {
    (void)make_simulation(scene);
  } catch (const SceneError&) {
    RC_DISCARD("the lattice does not fit");
  }
  RC_LOG() << scene.disk_count() << " disks, packing fraction " << scene.packing_fraction() << ", " << threads.threads
           << " threads, " << threads.domains << " domains, halo " << threads.halo << ", " << threads.events_per_window
           << " events of each disk in a window\n";
  const auto disks = static_cast<std::uint64_t>(scene.disk_count());
  expect_same_bits(scene, threads, {*rc::gen::inRange<std::uint64_t>(1, 5 * disks), 1, 4 * disks});
}

}  // namespace
}  // namespace carom::test
