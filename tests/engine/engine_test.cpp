// The fast engine as its users meet it: looking on changes nothing, the clock starts anew, and the log is complete.

#include "observe/mechanics.hpp"
#include "support/engines.hpp"
#include "support/scenes.hpp"

#include <gtest/gtest.h>

namespace carom::test {
namespace {

std::vector<System> systems() {
  Scene channel = gas_scene(100, 0.5, Boundary::periodic);
  channel.box.boundary[1] = Boundary::walls;
  return {system_of(gas_scene(100, 0.1, Boundary::periodic)), system_of(gas_scene(100, 0.65, Boundary::walls)),
          system_of(channel), system_of(mixture_scene(100, 0.4, Boundary::periodic))};
}

TEST(Engine, SamplingAndStoppingAnywhereLeaveNoTraceInTheBits) {
  for (const System& system : systems())
    for (const CollisionRule rule : both_rules) {
      const auto straight = make_engine("fast", system, rule);
      const auto stopping = make_engine("fast", system, rule);
      const auto stepping = make_engine("fast", system, rule);
      run_to(*straight, 3.0);
      for (int k = 1; k <= 3000; ++k) {
        run_to(*stopping, k / 1000.0);
        if (k % 7 == 0) static_cast<void>(stopping->state());
        if (k % 500 == 0) {
          EXPECT_TRUE(stopping->check_invariants().empty());
        }
      }
      while (!stepping->run_until(Instant{3.0, 0.0}, no_limit, 1)) static_cast<void>(stepping->now());
      EXPECT_TRUE(same_bits(stopping->state(), straight->state()));
      EXPECT_TRUE(same_bits(stepping->state(), straight->state()));
      EXPECT_EQ(stopping->totals().pair, straight->totals().pair);
      EXPECT_EQ(stopping->totals().virial, straight->totals().virial);
      EXPECT_EQ(stopping->totals().other, straight->totals().other);
      EXPECT_EQ(stopping->totals().stale, straight->totals().stale);
    }
}

TEST(Engine, TheLogHoldsEveryCollisionOnceAndRecordingLeavesNoTrace) {
  for (const System& system : systems()) {
    const auto silent = make_engine("fast", system);
    const auto recording = make_engine("fast", system);
    run_to(*silent, 2.0);
    recording->record_events(true);
    std::vector<Event> log;
    for (int k = 1; k <= 20; ++k) {
      run_to(*recording, k / 10.0);
      for (const Event& event : recording->take_events()) {
        EXPECT_LE(event.time, k / 10.0);
        EXPECT_LT(event.partner, event.partner < 0 ? 0 : recording->state().positions.cols());
        EXPECT_TRUE(event.partner < 0 || event.disk < event.partner);
        EXPECT_GE(event.time, log.empty() ? 0.0 : log.back().time);
        log.push_back(event);
      }
    }
    EXPECT_TRUE(recording->take_events().empty());
    EXPECT_TRUE(same_bits(recording->state(), silent->state()));
    EXPECT_EQ(log.size(), silent->totals().pair + silent->totals().wall);
    // What the log says last about a disk is how it moves.
    const State state = silent->state();
    Eigen::Matrix2Xd velocities = system.state.velocities;
    for (const Event& event : log) {
      velocities.col(event.disk) = event.velocity;
      if (event.partner >= 0) velocities.col(event.partner) = event.partner_velocity;
    }
    EXPECT_TRUE(same_bits(velocities, state.velocities));
  }
}

TEST(Engine, StopsAtTheCollisionAskedForAndGoesOnFromThere) {
  for (const System& system : systems()) {
    const auto straight = make_engine("fast", system);
    const auto stopping = make_engine("fast", system);
    straight->run_until(forever, 1000, no_limit);
    for (std::uint64_t k = 1; k <= 1000; ++k) {
      ASSERT_FALSE(stopping->run_until(forever, k, no_limit));
      ASSERT_EQ(stopping->totals().pair, k);
    }
    EXPECT_TRUE(same_bits(stopping->state(), straight->state()));
  }
}

TEST(Engine, ResettingTheClockKeepsTheStateAndForgetsTheTotals) {
  for (const System& system : systems())
    for (const CollisionRule rule : both_rules) {
      const auto fast = make_engine("fast", system, rule);
      run_to(*fast, 0.7);
      const State before = fast->state();
      fast->reset_clock();
      State after = fast->state();
      EXPECT_EQ(after.time, 0.0);
      EXPECT_EQ(fast->totals().pair + fast->totals().wall + fast->totals().other + fast->totals().stale, 0u);
      EXPECT_EQ(fast->totals().virial, 0.0);
      EXPECT_TRUE(same_bits(after.velocities, before.velocities));
      // Positions are those of lines that now start here: rounded to steps of 2^-64 of a box length, and once more to doubles.
      EXPECT_LE((unwrapped(system.box, after) - unwrapped(system.box, before)).cwiseAbs().maxCoeff(),
                0x1p-51 * system.box.upper.maxCoeff());
      EXPECT_TRUE(fast->check_invariants().empty());

      // From there on as the textbook goes on from the same state, for a collision or two of every disk (errors of 1e-15
      // grow by exp(3.2) each at most).
      System there = system;
      there.state = after;
      const auto textbook = make_engine("textbook", there, rule);
      const auto expected = next_events(*textbook, 60), found = next_events(*fast, 60);
      for (std::size_t k = 0; k < 60; ++k) {
        ASSERT_EQ(found[k].disk, expected[k].disk);
        ASSERT_EQ(found[k].partner, expected[k].partner);
        ASSERT_NEAR(found[k].time, expected[k].time, 1e-11);
      }
    }
}

TEST(Engine, ResettingTheClockAtTheStartChangesNothing) {
  for (const System& system : systems()) {
    const auto plain = make_engine("fast", system);
    const auto reset = make_engine("fast", system);
    reset->reset_clock();
    run_to(*plain, 1.0);
    run_to(*reset, 1.0);
    EXPECT_TRUE(same_bits(plain->state(), reset->state()));
  }
}

// ----------------------------------------------------------------------------------------------- no disk, one and few

TEST(Engine, RunsWithoutDisks) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    const auto engine = make_engine("fast", system_of(square_box(4.0, boundary), {}));
    EXPECT_TRUE(engine->idle());
    EXPECT_TRUE(engine->run_until(Instant{1e9, 0.0}, no_limit, no_limit));
    EXPECT_TRUE(engine->run_until(forever, no_limit, no_limit));
    EXPECT_EQ(engine->now().high, 1e9);
    engine->reset_clock();
    EXPECT_EQ(engine->state().positions.cols(), 0);
    EXPECT_TRUE(engine->check_invariants().empty());
  }
}

TEST(Engine, ADiskThatFillsItsChannelSlidesAlongIt) {
  const Box box{{0.0, 0.0}, {16.0, 1.0}, {Boundary::walls, Boundary::walls}};
  const auto engine = make_engine("fast", system_of(box, {{{2.0, 0.5}, {1.0, 0.0}}, {{8.0, 0.5}, {0.0, 0.0}}}));
  run_to(*engine, 1000.0);
  EXPECT_TRUE(engine->check_invariants().empty());
  EXPECT_EQ(engine->totals().wall_impulse[2], 0.0);
  EXPECT_NEAR(static_cast<double>(engine->totals().pair), 1000.0 / 14.0, 2.0);  // a way of 14 between two of them
}

// ------------------------------------------------------------------------------------------------------ conservation

/// Energy and momentum over 1e6 collisions of 100 disks. A collision changes a pair's energy by its rounding: some five
/// operations, each of at most u = 2^-53 of that energy, of random sign and of about half that in the mean; so the total, a
/// hundred disks' worth, changes by less than 5 u / 2 * 2 / 100 of itself each time, and by 1000 times that after 1e6 steps of a
/// random walk: 5.6e-15, of which five standard deviations are 3e-14. A bias of 1e-19 per collision would show.
constexpr double energy_drift = 3e-14;

template <class Check>
void run_a_million_collisions(const System& system, CollisionRule rule, Check&& check) {
  const auto engine = make_engine("fast", system, rule);
  engine->run_until(forever, 1'000'000, no_limit);
  check(engine->state());
  const auto faults = engine->check_invariants();
  EXPECT_TRUE(faults.empty()) << faults.front();
}

TEST(PhysicsEngine, KeepsEnergyAndMomentumOverAMillionCollisions) {
  for (const double packing_fraction : {0.1, 0.3, 0.65}) {
    for (const CollisionRule rule : both_rules) {
      const System system = system_of(gas_scene(100, packing_fraction, Boundary::periodic));
      run_a_million_collisions(system, rule, [&](const State& end) {
        EXPECT_NEAR(kinetic_energy(system.disks, end) / kinetic_energy(system.disks, system.state), 1.0, energy_drift);
        // Momenta begin as sums of a hundred speeds of about 1.
        EXPECT_LE((total_momentum(system.disks, end) - total_momentum(system.disks, system.state)).norm(), 100.0 * energy_drift);
      });
    }
  }
}

TEST(PhysicsEngine, KeepsTheEnergyOfMixturesAndOfWalledGases) {
  for (const CollisionRule rule : both_rules) {
    for (const System& system :
         {system_of(mixture_scene(100, 0.4, Boundary::walls)), system_of(mixture_scene(100, 0.4, Boundary::periodic)),
          system_of(gas_scene(100, 0.5, Boundary::walls))})
      run_a_million_collisions(system, rule, [&](const State& end) {
        EXPECT_NEAR(kinetic_energy(system.disks, end) / kinetic_energy(system.disks, system.state), 1.0, energy_drift);
      });
  }
}

}  // namespace
}  // namespace carom::test
