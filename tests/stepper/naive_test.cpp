// Each fault of the naive method on two disks or one, in closed form. All numbers are dyadic, so equality is exact.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

/// Disks in a walled box [-8, 8] x [-8, 8], where they are put, whether or not they overlap.
Simulation naive(const std::vector<Placed>& disks, double dt, CollisionRule rule = CollisionRule::reversal,
                 const std::string& method = "naive") {
  Scene scene = scene_of({{-8.0, -8.0}, {8.0, 8.0}, {Boundary::walls, Boundary::walls}}, {});
  scene.effects.collision.rule = rule;
  const System system = system_of(scene.box, disks);
  for (const Placed& disk : disks) scene.species.push_back(species_of(1, disk.radius, disk.mass, RandomPositions{}, AtRest{}));
  return make_simulation(scene, system.state, FixedStep{method, dt});
}

/// Two unit disks on the x axis, `gap` between their edges, that approach at speed u each.
std::vector<Placed> head_on(double gap, double u) {
  return {{{-0.5 - gap / 2, 0.0}, {u, 0.0}}, {{0.5 + gap / 2, 0.0}, {-u, 0.0}}};
}

TEST(Naive, APairFoundLessThanUDtDeepIsTurnedRoundOnce) {
  constexpr double dt = 0.125, u = 1.0;
  Simulation s = naive(head_on(0.1875, u), dt);  // at step 1 it is 0.0625 deep, and 2 u dt = 0.25
  s.run_until(dt);
  EXPECT_EQ(s.totals().pair, 1U);
  EXPECT_EQ(s.state().velocities(0, 0), -u);
  EXPECT_EQ(s.state().velocities(0, 1), u);
  s.run_until(10 * dt);
  EXPECT_EQ(s.totals().pair, 1U);
}

TEST(Naive, ADeepPairIsTurnedRoundTwiceInEveryStepWhichCancels) {
  // Half a radius deep in each other, as a third disk may have left them. Disk 0 finds disk 1: they exchange velocities and disk
  // 0 stays where it is. Disk 1 finds disk 0: they exchange back, and disk 1 stays too. So no disk moves, whatever the velocities
  // say.
  constexpr double dt = 0.125;
  Simulation s = naive({{{-0.25, 0.0}, {-1.0, 0.0}}, {{0.25, 0.0}, {0.0, 0.0}}}, dt);
  for (int step = 0; step < 1000; ++step) {
    s.run_until(step * dt);
    ASSERT_EQ(s.totals().pair, 2U * static_cast<unsigned>(step + 1));
    ASSERT_EQ(s.state().positions(0, 0), -0.25);
    ASSERT_EQ(s.state().positions(0, 1), 0.25);
    ASSERT_EQ(s.state().velocities(0, 0), -1.0);
  }
  EXPECT_EQ(s.totals().virial, 0.0);  // what each reversal gives the next takes
}

TEST(Naive, APairThatFliesTheSameWayIsLockedForEver) {
  // Disk 0 follows at a, disk 1 flees at b < a. When disk 1 looks, disk 0 has already moved by a dt: they collide before they
  // touch. In the next step disk 0 has moved by b dt, still too near, and the parting pair is sent back. From then on there is
  // one reversal in every step and the distance stays.
  constexpr double dt = 0.125, a = 1.0, b = 0.5, distance = 1.03125;
  Simulation s = naive({{{-6.0, 0.0}, {a, 0.0}}, {{-6.0 + distance, 0.0}, {b, 0.0}}}, dt);
  for (int step = 0; step < 100; ++step) {
    s.run_until(step * dt);
    ASSERT_EQ(s.totals().pair, static_cast<unsigned>(step + 1));
    ASSERT_EQ(s.state().positions(0, 1) - s.state().positions(0, 0), distance);
    ASSERT_EQ(s.state().positions(0, 0), -6.0 + dt * (a * ((step + 1) / 2) + b * (step / 2)));
  }
}

TEST(Naive, ADiskThatIsStillBeyondAWallInTheNextStepIsTurnedOutAgain) {
  constexpr double dt = 0.125, u = 0.5;
  Simulation s = naive({{{8.25, 0.0}, {-u, 0.0}}}, dt);  // beyond the wall already, and on its way back
  for (int step = 0; step < 100; ++step) {
    s.run_until(step * dt);
    EXPECT_EQ(s.state().velocities(0, 0), step % 2 == 0 ? u : -u);
    EXPECT_EQ(s.state().positions(0, 0), step % 2 == 0 ? 8.25 : 8.25 + u * dt);
  }
  EXPECT_EQ(s.totals().wall, 100U);
  EXPECT_EQ(s.totals().wall_impulse[1], 0.0);  // every second push is inward
}

TEST(Naive, AWallIsMetByTheCentreOrInTheOtherVariantByTheEdge) {
  constexpr double dt = 0.25;
  const Placed disk{{7.0, 0.0}, {1.0, 0.0}};
  Simulation centre = naive({disk}, dt);
  Simulation edge = naive({disk}, dt, CollisionRule::reversal, "naive-edge");
  const auto farthest = [](Simulation& s) {
    double x = 0.0;
    for (int step = 0; step < 12; ++step) {
      s.run_until(step * dt);
      x = std::max(x, s.state().positions(0, 0));
    }
    return x;
  };
  EXPECT_EQ(farthest(centre), 8.25);  // "beyond" is strictly beyond: one step past the limit
  EXPECT_EQ(farthest(edge), 7.75);
}

TEST(Naive, EarlierDisksHaveMovedWhenALaterOneLooks) {
  // Touching disks in a row would not be in contact at this step's places; disk 1 sees where disk 0 has gone in the same step.
  constexpr double dt = 0.25;
  Simulation s = naive({{{0.0, 0.0}, {0.5, 0.0}}, {{1.0625, 0.0}, {0.0, 0.0}}}, dt);
  s.run_until(0.0);
  EXPECT_EQ(s.totals().pair, 1U);
  EXPECT_EQ(s.state().velocities(0, 0), 0.0);
  EXPECT_EQ(s.state().velocities(0, 1), 0.5);
  s.run_until(dt);
  EXPECT_EQ(s.state().positions(0, 0), 0.125);  // it had left with the velocity that the later reversal has taken
}

TEST(Naive, CentreUponCentreHasNoDirectionAndNothingHappens) {
  for (const CollisionRule rule : both_rules) {
    Simulation s = naive({{{0.0, 0.0}, {0.0, 0.0}}, {{0.0, 0.0}, {0.0, 0.0}}}, 0.5, rule);
    s.run_until(4.0);
    EXPECT_TRUE(s.state().velocities.allFinite());
    EXPECT_TRUE((s.state().velocities.array() == 0.0).all());
  }
}

TEST(Naive, EnergyAndMomentumShowNothingOfAllThis) {
  Scene scene = mixture_scene(30, 0.5, Boundary::periodic);
  for (const CollisionRule rule : both_rules) {
    scene.effects.collision.rule = rule;
    Simulation s = make_simulation(scene, FixedStep{"naive", 0.05});
    const auto energy = [&] {
      const State state = s.state();
      double sum = 0.0;
      for (Eigen::Index i = 0; i < state.velocities.cols(); ++i)
        sum += 0.5 * s.disks().mass[static_cast<std::size_t>(i)] * state.velocities.col(i).squaredNorm();
      return sum;
    };
    const double before = energy();
    s.run_until(20.0);
    ASSERT_GT(s.totals().pair, 1000U);
    // Each reversal rounds the velocities of two disks, six operations each.
    EXPECT_NEAR(energy() / before, 1.0, 12e-16 * static_cast<double>(s.totals().pair));
  }
}

}  // namespace
}  // namespace carom::test
