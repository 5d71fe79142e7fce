// Motions that are known in closed form.

#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "engine/textbook.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

template <class Real = double, class Rule = Specular>
TextbookEngine<Real> engine_for(const System& system) {
  return TextbookEngine<Real>(system.box, system.disks, system.state, rule_only<Rule>);
}

template <class Engine>
void run_to(Engine& engine, double time) {
  engine.run_until(Instant{time, 0.0}, no_limit, no_limit);
}

/// Where a ball is that bounces between 0 and `room`, starting at x with velocity v. Exact on dyadic numbers.
double triangle_wave(double x, double v, double t, double room) {
  const double unfolded = std::fmod(std::fmod(x + v * t, 2 * room) + 2 * room, 2 * room);
  return unfolded <= room ? unfolded : 2 * room - unfolded;
}

TEST(ExactMotion, OneDiskInABoxIsATriangleWaveWithZeroError) {
  const System system = system_of(square_box(4.0, Boundary::walls), {{{1.0, 2.25}, {0.5, -2.0}, 0.5}});
  auto engine = engine_for(system);
  for (int k = 0; k <= 64'000; ++k) {
    const double t = k / 64.0;
    run_to(engine, t);
    const State state = engine.state();
    ASSERT_EQ(state.positions(0, 0), 0.5 + triangle_wave(0.5, 0.5, t, 3.0)) << "t = " << t;
    ASSERT_EQ(state.positions(1, 0), 0.5 + triangle_wave(1.75, -2.0, t, 3.0)) << "t = " << t;
  }
  // Walls 3 apart: after 2.5 and then every 3 along x, after 1.75 and then every 3 along y, on ways of 500 and 2000.
  EXPECT_EQ(engine.totals().wall, 166u + 667u);
}

TEST(ExactMotion, ACornerReversesBothComponents) {
  const System system = system_of(square_box(4.0, Boundary::walls), {{{2.0, 2.0}, {1.0, 1.0}, 0.5}});
  auto engine = engine_for(system);
  run_to(engine, 1.5);
  EXPECT_EQ(engine.totals().wall, 2u);
  EXPECT_EQ(engine.state().velocities.col(0), Eigen::Vector2d(-1.0, -1.0));
  run_to(engine, 1500.0);
  EXPECT_EQ(engine.state().positions.col(0), Eigen::Vector2d(2.0, 2.0));
}

TEST(ExactMotion, ADiskInAPeriodicBoxComesRoundWithItsImagesCounted) {
  const System system = system_of(square_box(4.0, Boundary::periodic), {{{1.0, 2.0}, {1.0, -0.5}, 0.5}});
  auto engine = engine_for(system);
  run_to(engine, 4096.0);
  const State state = engine.state();
  EXPECT_EQ(state.positions.col(0), Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(state.images.col(0), Winding(1024, -512));
}

TEST(ExactMotion, TwoDisksCollideAtTheTimeAndAngleOfTheClosedForm) {
  // Impact parameter 0.6, diameter 1: contact with the line of centres at 0.8, 0.6 after a way of 3.2.
  for (const double ratio : {1.0, 3.0, 1e6, 1e12}) {
    const System system = system_of(square_box(20.0, Boundary::walls),
                                    {{{6.0, 10.0}, {1.0, 0.0}, 0.5, 1.0}, {{10.0, 10.6}, {0.0, 0.0}, 0.5, ratio}});
    const double give = 2.0 * ratio / (1.0 + ratio);  // part of the relative velocity along the normal that disk 0 loses
    const double take = 2.0 / (1.0 + ratio);

    auto specular = engine_for<double, Specular>(system);
    specular.record_events(true);
    run_to(specular, 3.5);
    const Event event = specular.take_events().at(0);
    EXPECT_NEAR(event.time, 3.2, 1e-14);
    EXPECT_NEAR(event.velocity.x(), 1.0 - give * 0.64, 1e-14);
    EXPECT_NEAR(event.velocity.y(), -give * 0.48, 1e-14);
    EXPECT_NEAR(event.partner_velocity.x(), take * 0.64, 1e-14 * take);
    EXPECT_NEAR(event.partner_velocity.y(), take * 0.48, 1e-14 * take);

    auto reversal = engine_for<double, Reversal>(system);
    reversal.record_events(true);
    run_to(reversal, 3.5);
    const Event reversed = reversal.take_events().at(0);
    EXPECT_NEAR(reversed.velocity.x(), 1.0 - give, 1e-15);
    EXPECT_EQ(reversed.velocity.y(), 0.0);
    EXPECT_NEAR(reversed.partner_velocity.x(), take, 1e-15 * take);
  }
}

TEST(ExactMotion, UnderReversalTheRelativePathIsRetraced) {
  const System system = system_of(square_box(64.0, Boundary::walls),
                                  {{{30.0, 32.0}, {1.0, 0.25}, 0.5, 1.0}, {{34.0, 32.75}, {-0.5, 0.0}, 0.5, 3.0}});
  auto engine = engine_for<double, Reversal>(system);
  engine.record_events(true);
  run_to(engine, 8.0);
  const double contact = engine.take_events().at(0).time;
  for (const double s : {0.125, 0.5, 1.0, 2.0}) {
    auto before = engine_for<double, Reversal>(system);
    auto after = engine_for<double, Reversal>(system);
    run_to(before, contact - s);
    run_to(after, contact + s);
    const Eigen::Vector2d r_before = before.state().positions.col(0) - before.state().positions.col(1);
    const Eigen::Vector2d r_after = after.state().positions.col(0) - after.state().positions.col(1);
    // Positions of size 64 are rounded a handful of times.
    EXPECT_LE((r_before - r_after).norm(), 8 * 64 * 0x1p-52) << s;
  }
}

template <class Rule>
void expect_cradle(int row) {
  std::vector<Placed> placed = {{{2.0, 2.0}, {1.0, 0.0}}};
  for (int i = 1; i < row; ++i) placed.push_back({{4.0 + i, 2.0}, {0.0, 0.0}});  // touching, at rest
  auto engine = engine_for<double, Rule>(system_of({{0.0, 0.0}, {32.0, 4.0}, {Boundary::walls, Boundary::walls}}, placed));
  run_to(engine, 2.0 + 1.0);
  EXPECT_EQ(engine.totals().pair, static_cast<std::uint64_t>(row - 1));
  for (int i = 0; i < row; ++i)
    EXPECT_EQ(engine.state().velocities(0, i), i == row - 1 ? 1.0 : 0.0) << "disk " << i << " of " << row;
}

TEST(ExactMotion, NewtonsCradleHandsTheVelocityToTheLastDisk) {
  for (int row = 2; row <= 10; ++row) {
    expect_cradle<Specular>(row);
    expect_cradle<Reversal>(row);
  }
}

/// Two balls on a line and a wall: realised by two disks whose centres share one y, exactly, in a long box. The small
/// one (mass 1) rests between the left wall and the large one (mass `ratio`), which comes in at unit speed. Their radii
/// only shift the coordinates of the point masses.
template <class Real>
std::uint64_t galperin_collisions(double ratio) {
  const Box box{{0.0, -2.0}, {1e6, 2.0}, {Boundary::walls, Boundary::walls}};
  auto engine =
      engine_for<Real, Specular>(system_of(box, {{{3.0, 0.0}, {0.0, 0.0}, 0.5, 1.0}, {{8.0, 0.0}, {-1.0, 0.0}, 0.5, ratio}}));
  engine.run_until(Instant{1e5, 0.0}, no_limit, no_limit);
  EXPECT_EQ(engine.state().positions(1, 0), 0.0);
  EXPECT_EQ(engine.state().positions(1, 1), 0.0);
  return engine.totals().pair + engine.totals().wall;
}

TEST(ExactMotion, GalperinsBilliardCountsTheDigitsOfPi) {
  EXPECT_EQ(galperin_collisions<double>(1.0), 3u);
  EXPECT_EQ(galperin_collisions<double>(100.0), 31u);
  EXPECT_EQ(galperin_collisions<double>(1e4), 314u);
  EXPECT_EQ(galperin_collisions<double>(1e6), 3141u);
}

TEST(ExactMotion, GalperinsCountIsTheSameAtEveryPrecision) {
  EXPECT_EQ(galperin_collisions<float>(100.0), 31u);
  EXPECT_EQ(galperin_collisions<long double>(1e6), 3141u);
  EXPECT_EQ(galperin_collisions<Quad>(1e6), 3141u);
}

TEST(ExactMotion, DisksAtRestStayAndTimePasses) {
  auto engine = engine_for(system_of(square_box(4.0, Boundary::walls), {{{1.0, 1.0}, {0.0, 0.0}}, {{2.0, 1.0}, {0.0, 0.0}}}));
  run_to(engine, 1e300);
  EXPECT_EQ(engine.now().high, 1e300);
  EXPECT_EQ(engine.state().positions.col(1), Eigen::Vector2d(2.0, 1.0));
  EXPECT_TRUE(engine.idle());
}

}  // namespace
}  // namespace carom::test
