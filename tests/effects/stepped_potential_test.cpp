// Pair potentials of several steps: [stepped_potential].

#include "core/nearest_image.hpp"
#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

Scene with_steps(Scene scene, std::vector<PotentialStep> steps) {
  scene.effects.stepped_potential = SteppedPotential{std::move(steps)};
  return scene;
}

/// A shoulder, a well behind it, and a low shoulder round both.
const std::vector<PotentialStep> shoulder_and_well = {{1.2, 0.7}, {1.5, -0.6}, {1.8, 0.3}};

/// Two disks of diameter 1 on a line, centres 4 apart, that approach at relative speed 1. `mu`: their reduced mass.
Scene two_on_a_line(std::vector<PotentialStep> steps, double mass = 1.0, double other_mass = 1.0) {
  const double mu = mass * other_mass / (mass + other_mass);
  for (PotentialStep& step : steps) step.energy *= mu;
  return with_steps(scene_of_placed({{-32.0, -4.0}, {32.0, 4.0}, {Boundary::walls, Boundary::walls}},
                                    {{{-2.0, 0.0}, {1.0, 0.0}, 0.5, mass}, {{2.0, 0.0}, {0.0, 0.0}, 0.5, other_mass}}),
                    std::move(steps));
}

double relative_speed(const Simulation& simulation) {
  const State state = simulation.state();
  return state.velocities(0, 0) - state.velocities(0, 1);
}

/// Some roundings of numbers of the size of 8.
constexpr double rounding_of_eight = 64 * 0x1p-52;

void expect_same_runs(const Scene& one, const Scene& other, double time) {
  for (const char* engine : engines_with_effects) {
    const Ran a = run(one, engine, time), b = run(other, engine, time);
    EXPECT_TRUE(same_bits(a.simulation.state(), b.simulation.state())) << engine;
    EXPECT_EQ(a.simulation.totals().well, b.simulation.totals().well);
    EXPECT_EQ(a.simulation.totals().pair, b.simulation.totals().pair);
    EXPECT_EQ(a.simulation.totals().virial, b.simulation.totals().virial);
    EXPECT_EQ(energy_of(a.simulation), energy_of(b.simulation));
    ASSERT_EQ(a.events.size(), b.events.size());
    for (std::size_t k = 0; k < a.events.size(); ++k) ASSERT_EQ(a.events[k].time, b.events[k].time);
  }
}

/// The gases of the tests below.
std::vector<Scene> gases() {
  Scene falling = gas_scene(36, 0.3, Boundary::walls);
  falling.effects.gravity = Gravity{{0.0, -1.0}};
  return {gas_scene(64, 0.3, Boundary::periodic), mixture_scene(64, 0.3, Boundary::periodic), falling};
}

TEST(SteppedPotential, OfOneStepIsASquareWell) {
  for (const Scene& gas : gases())
    for (const double depth : {0.8, -0.5}) {
      Scene well = gas;
      well.effects.square_well = SquareWell{1.5, depth};
      expect_same_runs(well, with_steps(gas, {{1.5, -depth}}), 5.0);
    }
}

TEST(SteppedPotential, StepsThatChangeNothingAreNone) {
  for (const Scene& gas : gases()) {
    expect_same_runs(gas, with_steps(gas, {{1.2, 0.0}, {1.5, -0.0}}), 5.0);
    const Scene two = with_steps(gas, {{1.2, 0.7}, {1.6, -0.4}});
    expect_same_runs(two, with_steps(gas, {{1.1, 0.7}, {1.2, 0.7}, {1.3, -0.4}, {1.4, -0.4}, {1.6, -0.4}}), 5.0);
    expect_same_runs(two, with_steps(gas, {{1.2, 0.7}, {1.6, -0.4}, {1.7, 0.0}}), 5.0);
  }
}

TEST(SteppedPotential, EffectsNameTheStepsThatAct) {
  Effects effects;
  EXPECT_TRUE(effects.potential_steps().empty());
  effects.square_well = SquareWell{1.5, 2.0};
  ASSERT_EQ(effects.potential_steps().size(), 1U);
  EXPECT_EQ(effects.potential_steps()[0].energy, -2.0);
  effects.square_well = SquareWell{1.5, 0.0};
  EXPECT_TRUE(effects.potential_steps().empty());
  effects.square_well.reset();
  effects.stepped_potential = SteppedPotential{{{1.1, 0.0}, {1.2, 1.0}, {1.3, 1.0}, {1.4, 0.0}}};
  const std::vector<PotentialStep> steps = effects.potential_steps();
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].width, 1.1);
  EXPECT_EQ(steps[0].energy, 0.0);
  EXPECT_EQ(steps[1].width, 1.3);
}

TEST(SteppedPotential, TwoDisksPassAllStepsAtTheSpeedsOfTheirEnergies) {
  // mu u^2 / 2 + U: in units of mu it is 1/2 outside; within 3 U = -3/2 and u = 2, within 2 U = 0 and u = 1, within 3/2 U = -4
  // and u = 3. From 4: at 3 at t = 1, at 2 at 3/2, at 3/2 at 2, at the core at 2 + 1/6, and back.
  const std::vector<PotentialStep> steps = {{1.5, -4.0}, {2.0, 0.0}, {3.0, -1.5}};
  for (const char* engine : engines_with_effects)
    for (const auto& [m, M] : {std::pair{1.0, 1.0}, std::pair{1.0, 3.0}, std::pair{1.0, 1e12}, std::pair{1e-120, 3e-120}}) {
      SCOPED_TRACE(testing::Message() << engine << ", M = " << M);
      const Scene scene = two_on_a_line(steps, m, M);
      const double sixth = 1.0 / 6.0;
      const std::vector<double> times = {1.0, 1.5, 2.0, 2.0 + sixth, 2.0 + 2 * sixth, 2.5 + 2 * sixth, 3.0 + 2 * sixth};
      const Ran ran = run(scene, engine, 4.0);
      ASSERT_EQ(ran.events.size(), times.size());
      for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(ran.events[k].time, times[k], rounding_of_eight) << k;
      EXPECT_EQ(ran.simulation.totals().pair, 1U);
      EXPECT_EQ(ran.simulation.totals().well, 6U);
      EXPECT_EQ(ran.simulation.state().bonds, 0U);
      EXPECT_NEAR(relative_speed(ran.simulation), -1.0, rounding_of_eight);
      const double mu = m * M / (m + M);
      // The virial: sum of distance times impulse, 2 mu u at the core and mu times the changes of u at the edges, both ways.
      EXPECT_NEAR(ran.simulation.totals().virial / mu, 2.0 * (1.0 * 3.0 - 1.5 * 2.0 + 2.0 * 1.0 - 3.0 * 1.0), rounding_of_eight);

      Simulation within = make_simulation(scene, engine);
      const std::vector<std::pair<double, double>> speeds = {{1.25, 2.0},  {1.75, 1.0}, {2.1, 3.0},
                                                             {2.25, -3.0}, {2.5, -1.0}, {3.0, -2.0}};
      const std::vector<std::vector<std::uint64_t>> pairs = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      for (std::size_t k = 0; k < speeds.size(); ++k) {
        within.run_until(speeds[k].first);
        EXPECT_NEAR(relative_speed(within), speeds[k].second, rounding_of_eight) << k;
        EXPECT_EQ(within.state().pairs_in_steps, pairs[k]) << k;
        EXPECT_EQ(within.state().bonds, 1U);
        EXPECT_NEAR(energy_of(within), 0.5 * m, rounding_of_eight * m);
      }
    }
}

TEST(SteppedPotential, TurnsRoundAtABarrierWithinAWell) {
  // Within 3 u = 2, so that mu u^2 / 2 = 2 in units of mu. A barrier of just that height, and of more, is not passed.
  for (const char* engine : engines_with_effects)
    for (const double height : {2.0, 2.5, 1e6}) {
      const Ran ran = run(two_on_a_line({{2.0, -1.5 + height}, {3.0, -1.5}}), engine, 4.0);
      ASSERT_EQ(ran.events.size(), 3U) << engine;
      EXPECT_NEAR(ran.events[1].time, 1.5, rounding_of_eight);
      EXPECT_NEAR(ran.events[2].time, 2.0, rounding_of_eight);
      EXPECT_EQ(ran.simulation.totals().pair, 0U);
      EXPECT_NEAR(relative_speed(ran.simulation), -1.0, rounding_of_eight);
    }
  // Of a little less, u' = sqrt(4 - 2 * 1.875) = 1/2 is left: at the core at 1.5 + 2, and back by the same way.
  for (const char* engine : engines_with_effects) {
    const Ran ran = run(two_on_a_line({{2.0, 0.375}, {3.0, -1.5}}), engine, 8.0);
    ASSERT_EQ(ran.events.size(), 5U) << engine;
    EXPECT_NEAR(ran.events[2].time, 3.5, rounding_of_eight);
    EXPECT_NEAR(ran.events[4].time, 6.0, rounding_of_eight);
  }
}

TEST(SteppedPotential, KeepsAPairBehindABarrier) {
  // Between the core and a barrier of energy 1 at 2, with mu u^2 / 2 = 1/16: bounces for ever, 1 apart at u = 1/2.
  for (const char* engine : engines_with_effects) {
    const Scene scene = with_steps(scene_of_placed({{-32.0, -4.0}, {32.0, 4.0}, {Boundary::walls, Boundary::walls}},
                                                   {{{-0.75, 0.0}, {-0.25, 0.0}}, {{0.75, 0.0}, {0.25, 0.0}}}),
                                   {{2.0, -0.125}, {2.5, 1.0}});
    const Ran ran = run(scene, engine, 400.5);
    EXPECT_EQ(ran.simulation.totals().pair, 100U) << engine;  // at 3, 7, ...
    EXPECT_EQ(ran.simulation.totals().well, 100U);            // at 1, 5, ...
    EXPECT_EQ(ran.simulation.state().pairs_in_steps, (std::vector<std::uint64_t>{1, 0}));
    EXPECT_NEAR(energy_of(ran.simulation), 1.0 / 16 - 0.125, rounding_of_eight);
  }
}

/// The number of pairs within each step, by their distances.
std::vector<std::uint64_t> pairs_by_distance(const Simulation& simulation) {
  const State state = simulation.state();
  const Box& box = simulation.scene().box;
  const std::vector<PotentialStep> steps = simulation.scene().effects.potential_steps();
  std::vector<std::uint64_t> pairs(steps.size());
  for (std::size_t i = 0; i < simulation.disks().count(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
      const double ratio = nearest_image(box, state.positions.col(a) - state.positions.col(b)).norm() /
                           (simulation.disks().radius[i] + simulation.disks().radius[j]);
      for (std::size_t k = 0; k < steps.size(); ++k)
        if (ratio < steps[k].width) {
          ++pairs[k];
          break;
        }
    }
  return pairs;
}

TEST(SteppedPotential, KeepsEnergyAndMomentumAndCountsPairs) {
  for (const char* engine : engines_with_effects)
    for (const Scene& gas : gases()) {
      SCOPED_TRACE(engine);
      Simulation simulation = make_simulation(with_steps(gas, shoulder_and_well), engine);
      const double energy = energy_of(simulation);
      EXPECT_EQ(simulation.state().pairs_in_steps, pairs_by_distance(simulation));
      for (int k = 1; k <= 4; ++k) {
        simulation.run_until(1e9, {.collisions = 2'500U * static_cast<std::uint64_t>(k)});
        simulation.run_until(simulation.time() + 1e-3);  // away from the edge
        EXPECT_EQ(simulation.state().pairs_in_steps, pairs_by_distance(simulation)) << k;
      }
      EXPECT_GT(simulation.totals().well, 5'000U);
      // Some 3e4 events with a rounding of a pair's energy each.
      EXPECT_NEAR(energy_of(simulation), energy, 1e-11 * 64);
      if (gas.box.periodic(0)) {
        EXPECT_LE(total_momentum(simulation.disks(), simulation.state()).norm(), 1e-12 * 64);
      }
      EXPECT_TRUE(simulation.check_invariants().empty());
    }
}

TEST(SteppedPotential, FastAndTextbookEnginesAgree) {
  // Rounding differs in the two, and grows by a decade in some free times.
  for (const Scene& gas : gases()) {
    const Scene scene = with_steps(gas, shoulder_and_well);
    const Ran general = run(scene, "general", 0.5), textbook = run(scene, "textbook", 0.5);
    EXPECT_GT(general.simulation.totals().well, 20U);
    ASSERT_EQ(general.events.size(), textbook.events.size());
    for (std::size_t k = 0; k < general.events.size(); ++k) {
      EXPECT_EQ(general.events[k].disk, textbook.events[k].disk);
      EXPECT_EQ(general.events[k].partner, textbook.events[k].partner);
    }
    EXPECT_LE((general.simulation.state().velocities - textbook.simulation.state().velocities).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_EQ(general.simulation.state().pairs_in_steps, textbook.simulation.state().pairs_in_steps);
  }
}

TEST(SteppedPotential, FindsItsWayBack) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = with_steps(gas_scene(64, 0.3, Boundary::periodic), shoulder_and_well);
    const auto [start, there, back] = there_and_back(scene, engine, 1.0);
    EXPECT_GT(there.totals().well, 30U);
    EXPECT_LE((back.state().velocities + start.velocities).cwiseAbs().maxCoeff(), 1e-10) << engine;
    EXPECT_EQ(back.state().pairs_in_steps, start.pairs_in_steps);
  }
}

TEST(SteppedPotential, PairsThatBeginExactlyAtAnEdgeAreOutsideItUntilTheyApproach) {
  // Centres 2 apart, where a step of energy 1/2 ends and one of energy -1/4 begins.
  const std::vector<PotentialStep> steps = {{2.0, 0.5}, {3.0, -0.25}};
  const Box box{{-32.0, -4.0}, {32.0, 4.0}, {Boundary::walls, Boundary::walls}};
  const auto at_edge = [&](double v) {
    return with_steps(scene_of_placed(box, {{{-1.0, 0.0}, {v, 0.0}}, {{1.0, 0.0}, {0.0, 0.0}}}), steps);
  };
  for (const char* engine : engines_with_effects) {
    EXPECT_EQ(run(at_edge(0.0), engine, 5.0).events.size(), 0U);
    EXPECT_EQ(run(at_edge(0.0), engine, 5.0).simulation.state().pairs_in_steps, (std::vector<std::uint64_t>{0, 1}));
    const Ran near = run(at_edge(2.0), engine, 0.25);  // mu u^2 / 2 = 1 of which 3/4 go: u' = 1
    EXPECT_EQ(near.simulation.state().pairs_in_steps, (std::vector<std::uint64_t>{1, 0}));
    EXPECT_NEAR(relative_speed(near.simulation), 1.0, rounding_of_eight);
    EXPECT_EQ(near.events.at(0).time, 0.0);
  }
}

}  // namespace
}  // namespace carom::test
