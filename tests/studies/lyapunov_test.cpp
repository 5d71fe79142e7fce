// The tangent map against finite differences in 113 bits, and the exponent against its closed forms and known values.

#include "studies/horizon/lyapunov.hpp"
#include "core/nearest_image.hpp"
#include "support/systems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

/// A difference of two states of one time: r above, v below.
using Difference = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// Half of the difference of two runs in 113 bits that began at start + d and start - d, after `time`.
Difference finite_difference(const Scene& scene, const State& start, const Difference& d, double time) {
  const auto after = [&](double sign) {
    State from = start;
    from.positions += sign * d.topRows<2>();
    from.velocities += sign * d.bottomRows<2>();
    Simulation simulation = make_simulation(scene, from, "textbook-quad");
    simulation.run_until(time);
    return simulation.state();
  };
  const State a = after(1.0);
  const State b = after(-1.0);
  Difference half(4, start.positions.cols());
  for (Eigen::Index i = 0; i < half.cols(); ++i) {
    const Eigen::Vector2d apart = nearest_image(scene.box, a.positions.col(i) - b.positions.col(i));
    half.col(i) << apart + a.remainders.col(i) - b.remainders.col(i), a.velocities.col(i) - b.velocities.col(i);
  }
  return half / 2.0;
}

Difference tangent(const Scene& scene, const State& start, const Difference& d, double time) {
  Simulation simulation = make_simulation(scene, start, "textbook-quad");
  TangentFlow flow(scene.box, simulation.disks(), scene.effects, start, d.topRows<2>(), d.bottomRows<2>());
  simulation.record_events(true);
  simulation.run_until(time);
  for (const Event& event : simulation.take_events()) flow.follow(event);
  flow.advance(time);
  Difference grown(4, d.cols());
  grown << flow.dr(), flow.dv();
  return grown;
}

/// Any difference of that size.
Difference ripple(Eigen::Index disks, double size) {
  Difference d(4, disks);
  for (Eigen::Index k = 0; k < d.size(); ++k) d.data()[k] = size * std::sin(static_cast<double>(1 + k * k));
  return d;
}

struct Flow {
  std::string name;
  CollisionRule rule;
  bool mixture;
  Boundary boundary;
  double weight = 0.0;  ///< downward acceleration
};

/// By its name: its bytes are not all set.
void PrintTo(const Flow& flow, std::ostream* out) { *out << flow.name; }

class TangentOf : public ::testing::TestWithParam<Flow> {};

// The error of a central difference falls as the square of its size; a tangent map with a wrong term would leave one that does
// not. Rounding of velocities to doubles is 1e-16 of them, 1e-10 of a difference of 1e-6: far below what is left of 1e-5.
TEST_P(TangentOf, ATrajectoryIsTheLimitOfFiniteDifferences) {
  const Flow& flow = GetParam();
  Scene scene = flow.mixture ? mixture_scene(16, 0.4, flow.boundary) : gas_scene(16, 0.4, flow.boundary);
  scene.effects.collision.rule = flow.rule;
  if (flow.weight > 0.0) scene.effects.gravity = Gravity{{0.0, -flow.weight}};
  Simulation simulation = make_simulation(scene);
  simulation.run_until(10.0);  // away from the lattice, whose disks may lie on an edge
  State start = simulation.state();
  start.time = 0.0;
  // Two to four collisions per disk. Weight makes the mixture denser below, where disks collide more often.
  const double time = flow.rule == CollisionRule::reversal && flow.weight == 0.0 ? 1.5 : 0.6;
  const auto relative_error = [&](double size) {
    const Difference d = ripple(start.positions.cols(), size);
    const Difference grown = tangent(scene, start, d, time);
    EXPECT_GT(grown.norm(), 2.0 * d.norm()) << "too short to test anything";
    return (finite_difference(scene, start, d, time) - grown).norm() / grown.norm();
  };
  const double coarse = relative_error(4e-5);
  const double fine = relative_error(1e-5);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, coarse / 12.0);
}

INSTANTIATE_TEST_SUITE_P(Each, TangentOf,
                         ::testing::Values(Flow{"SpecularGas", CollisionRule::specular, false, Boundary::periodic},
                                           Flow{"SpecularMixtureInWalls", CollisionRule::specular, true, Boundary::walls},
                                           Flow{"ReversalGas", CollisionRule::reversal, false, Boundary::periodic},
                                           Flow{"ReversalMixtureInWalls", CollisionRule::reversal, true, Boundary::walls},
                                           Flow{"SpecularGasUnderGravity", CollisionRule::specular, false, Boundary::walls, 2.0},
                                           Flow{"ReversalMixtureUnderGravity", CollisionRule::reversal, true, Boundary::walls,
                                                2.0}),
                         [](const auto& flow) { return flow.param.name; });

// A gas round a fixed disk, under an arc and over a segment, whose faces, ends and hollow sides are all met; in a circle, and in
// a periodic box whose images cross the shapes.
TEST(TangentFlow, AtFixedShapesIsTheLimitOfFiniteDifferences) {
  for (const bool in_circle : {true, false}) {
    Scene scene = gas_scene(16, 0.2, Boundary::periodic);
    const Eigen::Vector2d middle = 0.5 * (scene.box.lower + scene.box.upper);
    const double half = 0.5 * scene.box.lengths().x();
    scene.effects.obstacles = {
        DiskObstacle{middle - Eigen::Vector2d(half / 3.0, 0.0), half / 8.0}, ArcObstacle{middle, half / 1.5, 20.0, 130.0},
        SegmentObstacle{middle + Eigen::Vector2d(0.1, -half / 2.0), middle + Eigen::Vector2d(half / 2.0, -half / 2.5)}};
    if (in_circle) {
      put_in_circle(scene.box, scene.effects, {middle, half});
      scene.effects.gravity = Gravity{{0.3, -1.0}};
    }
    scene.species[0].positions = RandomPositions{};
    Simulation simulation = make_simulation(scene);
    simulation.run_until(10.0);
    State start = simulation.state();
    start.time = 0.0;
    constexpr double time = 1.5;
    simulation = make_simulation(scene, start);
    simulation.run_until(time);
    EXPECT_GT(simulation.counts().obstacle, 5U);
    const auto relative_error = [&](double size) {
      const Difference d = ripple(start.positions.cols(), size);
      const Difference grown = tangent(scene, start, d, time);
      EXPECT_GT(grown.norm(), 2.0 * d.norm()) << "too short to test anything";
      return (finite_difference(scene, start, d, time) - grown).norm() / grown.norm();
    };
    const double size = in_circle ? 1e-6 : 4e-5;  // weight and rim make a difference grow fast
    const double coarse = relative_error(size), fine = relative_error(size / 4.0);
    EXPECT_LT(coarse, 1e-3) << in_circle;
    EXPECT_LT(fine, coarse / 12.0) << in_circle;
  }
}

// Equal smooth disks head on, relative velocity g, displaced by y across: the line of centres turns by y / sigma, and the
// velocity that it turns round by twice that.
TEST(TangentFlow, AHeadOnCollisionOfSmoothDisksTurnsByTwiceTheDisplacement) {
  const System s = system_of(square_box(8.0, Boundary::walls), {{{2.0, 4.0}, {1.0, 0.0}}, {{4.0, 4.0}, {-1.0, 0.0}}});
  Eigen::Matrix2Xd dr = Eigen::Matrix2Xd::Zero(2, 2);
  dr(1, 0) = 0.5;
  TangentFlow flow(s.box, s.disks, Effects{}, s.state, dr, Eigen::Matrix2Xd::Zero(2, 2));
  flow.follow({0.5, 0.0, 0, 1, {-1.0, 0.0}, {1.0, 0.0}});
  EXPECT_EQ(flow.dr()(1, 0), 0.5);
  EXPECT_EQ(flow.dv()(1, 0) - flow.dv()(1, 1), -2.0 * 2.0 * -0.5);
  EXPECT_EQ(flow.dv().row(1).sum(), 0.0) << "momentum is conserved";
  flow.advance(1.5);
  EXPECT_EQ(flow.dr()(1, 0), 0.5 + 1.0);
}

TEST(TangentFlow, AWallTurnsRoundTheDifferenceAcrossIt) {
  const System s = system_of(square_box(4.0, Boundary::walls), {{{2.0, 2.0}, {1.0, 0.25}}});
  TangentFlow flow(s.box, s.disks, Effects{}, s.state, Eigen::Vector2d(0.5, 0.25), Eigen::Vector2d(0.125, 1.0));
  flow.follow({1.5, 0.0, 0, wall_right, {-1.0, 0.25}, {0.0, 0.0}});
  EXPECT_EQ(flow.dr(), Eigen::Matrix2Xd(Eigen::Vector2d(-0.5 - 1.5 * 0.125, 0.25 + 1.5)));
  EXPECT_EQ(flow.dv(), Eigen::Matrix2Xd(Eigen::Vector2d(-0.125, 1.0)));
}

std::optional<Lyapunov> exponent_of(const Scene& scene, std::uint64_t collisions = 0) {
  const State start = make_simulation(scene).state();
  return measure_lyapunov(scene, start, measure_event_rates(scene, start), {.collisions = collisions, .proceed = {}});
}

TEST(Lyapunov, IsNoneWhereDisksNeverCollide) {
  Scene empty = gas_scene(4, 0.3, Boundary::periodic);
  empty.species.clear();
  EXPECT_FALSE(exponent_of(empty));
  EXPECT_FALSE(exponent_of(gas_scene(1, 0.1, Boundary::walls)));
  Scene rest = gas_scene(16, 0.3, Boundary::periodic);
  rest.species.front().velocities = AtRest{};
  EXPECT_FALSE(exponent_of(rest));
}

TEST(Lyapunov, EndsWhenToldTo) {
  const Scene scene = gas_scene(64, 0.3, Boundary::periodic);
  const State start = make_simulation(scene).state();
  int asked = 0;
  const auto proceed = [&](double) { return ++asked < 3; };
  EXPECT_FALSE(measure_lyapunov(scene, start, measure_event_rates(scene, start), {.collisions = 0, .proceed = proceed}));
  EXPECT_EQ(asked, 3);
}

TEST(Lyapunov, PerTimeIsPerCollisionTimesTheCollisionRate) {
  const std::optional<Lyapunov> lambda = exponent_of(gas_scene(64, 0.3, Boundary::periodic), 20'000);
  ASSERT_TRUE(lambda);
  EXPECT_NEAR(lambda->per_time, lambda->per_collision * lambda->collision_rate, 1e-12 * lambda->per_time);
  EXPECT_TRUE(lambda->is_chaotic());
}

// Twice the speed is the same motion in half the time.
TEST(Lyapunov, ScalesWithTheSpeedOfTheDisks) {
  Scene scene = gas_scene(36, 0.3, Boundary::walls);
  const std::optional<Lyapunov> slow = exponent_of(scene, 10'000);
  scene.species.front().velocities = MaxwellVelocities{4.0};
  const std::optional<Lyapunov> fast = exponent_of(scene, 10'000);
  ASSERT_TRUE(slow && fast);
  EXPECT_EQ(fast->per_collision, slow->per_collision);
  EXPECT_EQ(fast->per_time, 2.0 * slow->per_time);
}

struct Known {
  CollisionRule rule;
  double density;  ///< N sigma^2 / A
  double per_collision;
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.density; }

class PhysicsLyapunov : public ::testing::TestWithParam<Known> {};

// Reference: a brute-force computation made for this project (no value of the literature) with N = 64, good to about one per
// cent and given to two decimals: 0.01 of the value and half a unit of the last place, beside 4 standard errors. Under reversal
// the set of velocities is frozen, so that each start has an exponent of its own: those of 12 starts scatter by 0.0085.
TEST_P(PhysicsLyapunov, PerCollisionIsTheKnownValue) {
  Scene scene = gas_scene(64, GetParam().density * std::numbers::pi / 4.0, Boundary::periodic);
  scene.effects.collision.rule = GetParam().rule;
  const std::optional<Lyapunov> lambda = exponent_of(scene);
  ASSERT_TRUE(lambda && lambda->per_collision_error);
  const double known = GetParam().per_collision;
  EXPECT_LT(*lambda->per_collision_error, 0.02 * known);
  const double of_the_start = GetParam().rule == CollisionRule::reversal ? 0.0085 : 0.0;
  const double chance = std::hypot(*lambda->per_collision_error, of_the_start);
  EXPECT_NEAR(lambda->per_collision, known, 4.0 * chance + 0.01 * known + 0.005);
}

INSTANTIATE_TEST_SUITE_P(Specular, PhysicsLyapunov,
                         ::testing::Values(Known{CollisionRule::specular, 0.1, 3.16}, Known{CollisionRule::specular, 0.2, 2.01},
                                           Known{CollisionRule::specular, 0.4, 1.11}, Known{CollisionRule::specular, 0.6, 0.71},
                                           Known{CollisionRule::specular, 0.7, 0.57}, Known{CollisionRule::specular, 0.8, 0.44}));
INSTANTIATE_TEST_SUITE_P(Reversal, PhysicsLyapunov,
                         ::testing::Values(Known{CollisionRule::reversal, 0.05, 0.56}, Known{CollisionRule::reversal, 0.2, 0.56},
                                           Known{CollisionRule::reversal, 0.4, 0.56}, Known{CollisionRule::reversal, 0.7, 0.56}));

// The variance over 24 starts divided by the mean square of the errors is F-distributed with 23 and some 24 * 31 degrees of
// freedom: between 0.3 and 2.2 with a probability of 0.998.
TEST(PhysicsLyapunovError, IsTheScatterOfIndependentRuns) {
  constexpr int runs = 24;
  std::vector<double> values;
  double mean = 0.0;
  double squared_errors = 0.0;
  for (int seed = 1; seed <= runs; ++seed) {
    const std::optional<Lyapunov> lambda =
        exponent_of(gas_scene(64, 0.3, Boundary::periodic, static_cast<std::uint64_t>(seed)), 50'000);
    ASSERT_TRUE(lambda && lambda->per_collision_error);
    values.push_back(lambda->per_collision);
    mean += lambda->per_collision / runs;
    squared_errors += *lambda->per_collision_error * *lambda->per_collision_error / runs;
  }
  double variance = 0.0;
  for (const double value : values) variance += (value - mean) * (value - mean) / (runs - 1);
  EXPECT_GT(variance / squared_errors, 0.3);
  EXPECT_LT(variance / squared_errors, 2.2);
}

}  // namespace
}  // namespace carom::test
