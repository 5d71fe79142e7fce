// Motions that are known in closed form, in the fast engine and in the textbook.

#include "support/engines.hpp"
#include "support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

/// Where a ball is that bounces between 0 and `room`, starting at x with velocity v. Exact on dyadic numbers.
double triangle_wave(double x, double v, double t, double room) {
  const double unfolded = std::fmod(std::fmod(x + v * t, 2 * room) + 2 * room, 2 * room);
  return unfolded <= room ? unfolded : 2 * room - unfolded;
}

class ExactMotion : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] std::unique_ptr<AnyEngine> engine_of(const System& system, CollisionRule rule = CollisionRule::specular) const {
    return make_engine(GetParam(), system, rule);
  }
};

TEST_P(ExactMotion, OneDiskInABoxIsATriangleWaveWithZeroError) {
  const auto engine = engine_of(system_of(square_box(4.0, Boundary::walls), {{{1.0, 2.25}, {0.5, -2.0}, 0.5}}));
  for (int k = 0; k <= 64'000; ++k) {
    const double t = k / 64.0;
    run_to(*engine, t);
    const State state = engine->state();
    ASSERT_EQ(state.positions(0, 0), 0.5 + triangle_wave(0.5, 0.5, t, 3.0)) << "t = " << t;
    ASSERT_EQ(state.positions(1, 0), 0.5 + triangle_wave(1.75, -2.0, t, 3.0)) << "t = " << t;
  }
  // Walls 3 apart: after 2.5 and then every 3 along x, after 1.75 and then every 3 along y, on ways of 500 and 2000.
  EXPECT_EQ(engine->totals().wall, 166u + 667u);
}

TEST_P(ExactMotion, ACornerReversesBothComponents) {
  const auto engine = engine_of(system_of(square_box(4.0, Boundary::walls), {{{2.0, 2.0}, {1.0, 1.0}, 0.5}}));
  engine->record_events(true);
  run_to(*engine, 1.5);
  EXPECT_EQ(engine->totals().wall, 2u);
  EXPECT_EQ(engine->state().velocities.col(0), Eigen::Vector2d(-1.0, -1.0));
  EXPECT_EQ(engine->take_events()[0].partner, wall_right) << "the vertical wall comes first";
  run_to(*engine, 1500.0);
  EXPECT_EQ(engine->state().positions.col(0), Eigen::Vector2d(2.0, 2.0));
}

TEST_P(ExactMotion, ADiskInAPeriodicBoxComesRoundWithItsImagesCounted) {
  const auto engine = engine_of(system_of(square_box(4.0, Boundary::periodic), {{{1.0, 2.0}, {1.0, -0.5}, 0.5}}));
  run_to(*engine, 4096.0);
  const State state = engine->state();
  EXPECT_EQ(state.positions.col(0), Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(state.images.col(0), Winding(1024, -512));
}

TEST_P(ExactMotion, OneDiskGoesRoundAPeriodicBoxUntilLongPastABillion) {
  const auto engine = engine_of(system_of(square_box(4.0, Boundary::periodic), {{{1.0, 2.0}, {0x1p-10, -0x1p-11}, 0.5}}));
  for (const double t : {4096.0, 4096.0 * 256.0, 4096.0 * 256.0 * 1024.0}) {
    run_to(*engine, t);
    const State state = engine->state();
    EXPECT_EQ(state.positions.col(0), Eigen::Vector2d(1.0, t == 4096.0 ? 0.0 : 2.0));
    EXPECT_EQ(state.images(0, 0), static_cast<std::int64_t>(t / 4096.0));
    EXPECT_EQ(state.images(1, 0), -static_cast<std::int64_t>(t / 8192.0));
    EXPECT_EQ(engine->now().high, t);
  }
  EXPECT_EQ(engine->totals().pair, 0u);
}

TEST_P(ExactMotion, TwoDisksCollideAtTheTimeAndAngleOfTheClosedForm) {
  // Impact parameter 0.6, diameter 1: contact with the line of centres at 0.8, 0.6 after a way of 3.2.
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
    for (const double ratio : {1.0, 3.0, 1e6, 1e12}) {
      const System system =
          system_of(square_box(20.0, boundary), {{{6.0, 10.0}, {1.0, 0.0}, 0.5, 1.0}, {{10.0, 10.6}, {0.0, 0.0}, 0.5, ratio}});
      const double give = 2.0 * ratio / (1.0 + ratio);  // part of the relative velocity along the normal that disk 0 loses
      const double take = 2.0 / (1.0 + ratio);
      const Event specular = next_events(*engine_of(system, CollisionRule::specular), 1).at(0);
      EXPECT_NEAR(specular.time, 3.2, 1e-14);
      EXPECT_NEAR(specular.velocity.x(), 1.0 - give * 0.64, 1e-14);
      EXPECT_NEAR(specular.velocity.y(), -give * 0.48, 1e-14);
      EXPECT_NEAR(specular.partner_velocity.x(), take * 0.64, 1e-14 * take);
      EXPECT_NEAR(specular.partner_velocity.y(), take * 0.48, 1e-14 * take);
      const Event reversal = next_events(*engine_of(system, CollisionRule::reversal), 1).at(0);
      EXPECT_NEAR(reversal.velocity.x(), 1.0 - give, 1e-15);
      EXPECT_EQ(reversal.velocity.y(), 0.0);
      EXPECT_NEAR(reversal.partner_velocity.x(), take, 1e-15 * take);
    }
}

TEST_P(ExactMotion, UnderReversalTheRelativePathIsRetraced) {
  const System system = system_of(square_box(64.0, Boundary::walls),
                                  {{{30.0, 32.0}, {1.0, 0.25}, 0.5, 1.0}, {{34.0, 32.75}, {-0.5, 0.0}, 0.5, 3.0}});
  const auto engine = engine_of(system, CollisionRule::reversal);
  engine->record_events(true);
  run_to(*engine, 8.0);
  const double contact = engine->take_events().at(0).time;
  for (const double s : {0.125, 0.5, 1.0, 2.0}) {
    const auto before = engine_of(system, CollisionRule::reversal), after = engine_of(system, CollisionRule::reversal);
    run_to(*before, contact - s);
    run_to(*after, contact + s);
    const Eigen::Vector2d r_before = before->state().positions.col(0) - before->state().positions.col(1);
    const Eigen::Vector2d r_after = after->state().positions.col(0) - after->state().positions.col(1);
    // Positions of size 64 are rounded a handful of times.
    EXPECT_LE((r_before - r_after).norm(), 8 * 64 * 0x1p-52) << s;
  }
}

TEST_P(ExactMotion, NewtonsCradleHandsTheVelocityToTheLastDisk) {
  for (const CollisionRule rule : both_rules)
    for (int row = 2; row <= 10; ++row) {
      std::vector<Placed> placed = {{{2.0, 2.0}, {1.0, 0.0}}};
      for (int i = 1; i < row; ++i) placed.push_back({{4.0 + i, 2.0}, {0.0, 0.0}});  // touching, at rest
      const auto engine = engine_of(system_of(box_of(32.0, 4.0, Boundary::walls), placed), rule);
      run_to(*engine, 2.0 + 1.0);
      EXPECT_EQ(engine->totals().pair, static_cast<std::uint64_t>(row - 1));
      for (int i = 0; i < row; ++i)
        EXPECT_EQ(engine->state().velocities(0, i), i == row - 1 ? 1.0 : 0.0) << "disk " << i << " of " << row;
    }
}

/// Two balls on a line and a wall: realised by two disks whose centres share one y, exactly, in a long box. The small
/// one (mass 1) rests between the left wall and the large one (mass `ratio`), which comes in at unit speed. Their radii
/// only shift the coordinates of the point masses.
std::uint64_t galperin_collisions(const std::string& name, double ratio) {
  const Box box{{0.0, -2.0}, {4096.0, 2.0}, {Boundary::walls, Boundary::walls}};
  const auto engine =
      make_engine(name, system_of(box, {{{3.0, 0.0}, {0.0, 0.0}, 0.5, 1.0}, {{8.0, 0.0}, {-1.0, 0.0}, 0.5, ratio}}));
  run_to(*engine, 2048.0);
  EXPECT_EQ(engine->state().positions(1, 0), 0.0);
  EXPECT_EQ(engine->state().positions(1, 1), 0.0);
  return engine->totals().pair + engine->totals().wall;
}

TEST_P(ExactMotion, GalperinsBilliardCountsTheDigitsOfPi) {
  for (const auto& [ratio, collisions] : {std::pair{1.0, 3u}, {100.0, 31u}, {1e4, 314u}, {1e6, 3141u}, {1e8, 31415u}})
    EXPECT_EQ(galperin_collisions(GetParam(), ratio), collisions) << ratio;
}

TEST(GalperinsBilliard, CountsTheSameAtEveryPrecision) {
  EXPECT_EQ(galperin_collisions("textbook-float", 100.0), 31u);
  EXPECT_EQ(galperin_collisions("textbook-long-double", 1e6), 3141u);
  EXPECT_EQ(galperin_collisions("textbook-quad", 1e6), 3141u);
}

TEST_P(ExactMotion, DisksAtRestStayAndTimePasses) {
  const auto engine =
      engine_of(system_of(square_box(4.0, Boundary::walls), {{{1.0, 1.0}, {0.0, 0.0}}, {{2.0, 1.0}, {0.0, 0.0}}}));
  run_to(*engine, 1e300);
  EXPECT_EQ(engine->now().high, 1e300);
  EXPECT_EQ(engine->state().positions.col(1), Eigen::Vector2d(2.0, 1.0));
  EXPECT_TRUE(engine->idle());
  EXPECT_TRUE(engine->check_invariants().empty());
}

INSTANTIATE_TEST_SUITE_P(All, ExactMotion, testing::Values("fast", "textbook"), [](const auto& name) { return name.param; });

}  // namespace
}  // namespace carom::test
