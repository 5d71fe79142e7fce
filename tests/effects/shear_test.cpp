// Lees-Edwards shear: images that slide, alone, in pairs, in the plan and in the balance of energy.

#include "core/contact_time.hpp"
#include "support/effect_scenes.hpp"
#include "support/engines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

namespace carom::test {
namespace {

Effects sheared(double rate, CollisionRule rule = CollisionRule::specular) {
  Effects effects;
  effects.collision.rule = rule;
  effects.shear = carom::Shear{rate};
  return effects;
}

/// A fluid whose velocities are drawn relative to the flow.
System flowing(std::int64_t disks, double packing_fraction, double rate) {
  Scene scene = gas_scene(disks, packing_fraction, Boundary::periodic);
  scene.effects = sheared(rate);
  return system_of(scene);
}

std::unique_ptr<AnyEngine> sheared_engine(const std::string& name, const System& system, double rate,
                                          CollisionRule rule = CollisionRule::specular) {
  Scene scene;
  scene.box = system.box;
  scene.effects = sheared(rate, rule);
  return detail::make_engine(detail::choose_engine(scene, system.disks, name), scene, system.disks, system.state);
}

class Shear : public testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] static std::unique_ptr<AnyEngine> engine_of(const System& system, double rate) {
    return sheared_engine(GetParam(), system, rate);
  }
};

TEST_P(Shear, CarriesOneDiskThroughTheSlidingEdgesAsTheClosedFormSays) {
  // All numbers are dyadic, so nothing is rounded: box 4 x 4, images slide at 4 / 8, by a box length in a time of 8.
  constexpr double rate = 0.125, speed = 0.5;
  const System system = system_of(square_box(4.0, Boundary::periodic), {{{1.0, 3.0}, {0.25, 1.0}}});
  const auto engine = engine_of(system, rate);
  // It passes the upper edge at 1, 5, 9, ..., each time by a displacement speed * t, less whole lengths, and a speed farther
  // back.
  double x = 1.0, v = 0.25, last = 0.0, edge = 1.0;
  for (int k = 1; k <= 300; ++k) {
    const double t = 0.75 * k;
    run_to(*engine, t);
    const State state = engine->state();
    for (; edge < t; edge += 4.0) {
      x += v * (edge - last) - std::fmod(speed * edge, 4.0);
      v -= speed;
      last = edge;
    }
    if (std::fmod(t - 1.0, 4.0) == 0.0) continue;  // on the edge: above or below
    const double now = x + v * (t - last);
    ASSERT_EQ(state.velocities(0, 0), v) << t;
    ASSERT_EQ(state.positions(0, 0), now - 4.0 * std::floor(now / 4.0)) << t;
    ASSERT_EQ(state.positions(1, 0), std::fmod(3.0 + t, 4.0)) << t;
    ASSERT_EQ(state.images(0, 0), static_cast<std::int64_t>(std::floor(now / 4.0))) << t;
    ASSERT_EQ(state.images(1, 0), static_cast<std::int64_t>(std::floor((3.0 + t) / 4.0))) << t;
    ASSERT_EQ(state.shear_displacement, std::fmod(speed * t, 4.0)) << t;
    ASSERT_EQ(engine->totals().shear_energy, (v * v - 0.25 * 0.25) / 2.0) << t;
  }
}

TEST_P(Shear, CarriesADiskDownwardsAndWithImagesThatSlideToTheLeft) {
  const System up = system_of(square_box(4.0, Boundary::periodic), {{{1.0, 3.0}, {0.25, 1.0}}});
  const System down = system_of(square_box(4.0, Boundary::periodic), {{{1.0, 1.0}, {0.25, -1.0}}});  // its mirror image
  for (int k = 1; k <= 40; ++k) {
    const double t = 0.5 + 0.75 * k;
    const auto one = engine_of(up, 0.125), other = engine_of(down, -0.125);
    run_to(*one, t);
    run_to(*other, t);
    const State state = one->state(), mirrored = other->state();
    if (std::fmod(t - 1.0, 4.0) == 0.0) continue;
    EXPECT_EQ(mirrored.positions(0, 0), state.positions(0, 0)) << t;
    EXPECT_EQ(mirrored.positions(1, 0), 4.0 - state.positions(1, 0)) << t;
    EXPECT_EQ(mirrored.velocities(0, 0), state.velocities(0, 0)) << t;
    EXPECT_EQ(mirrored.velocities(1, 0), -state.velocities(1, 0)) << t;
  }
}

TEST_P(Shear, LetsTwoDisksCollideAcrossTheEdgeWhereTheImageIs) {
  constexpr double rate = 0.05, length = 10.0, speed = rate * length;
  const Eigen::Vector2d above(2.0, 9.25), below(8.5, 0.5), v_above(0.0, 0.0), v_below(0.0, -0.125);
  const System system = system_of(square_box(length, Boundary::periodic), {{above, v_above}, {below, v_below}});
  const auto engine = engine_of(system, rate);
  engine->record_events(true);
  engine->run_until({30.0, 0.0}, 1, no_limit);
  const std::vector<Event> events = engine->take_events();
  ASSERT_EQ(events.size(), 1u);
  // The image of the lower disk one box higher, one box to the left.
  const Vec2<double> r = above - (below + Eigen::Vector2d(-length, length));
  const Vec2<double> v = v_above - (v_below + Eigen::Vector2d(speed, 0.0));
  const double expected = contact_time<double>(r, v, 1.0);
  ASSERT_LT(expected, 30.0);
  // Crossing the edge rounds position and displacement a few times: 1e-15 of a box at a speed of half.
  EXPECT_NEAR(events[0].time, expected, 1e-13);
  const Vec2<double> at = r + v * expected, d = at.dot(v) * at;
  EXPECT_NEAR((events[0].velocity - (v_above - d)).norm(), 0.0, 1e-13);
  // The partner has left below and come back from above since: as its own image.
  EXPECT_NEAR(std::remainder(events[0].partner_velocity.x() - (v_below + d).x(), speed), 0.0, 1e-13);
  EXPECT_NEAR(events[0].partner_velocity.y() - (v_below + d).y(), 0.0, 1e-13);
}

TEST_P(Shear, LetsDisksCollideThatStandOnTheEdge) {
  // Two disks of mass 1 and 3 come together head-on, one above the other, and touch when one is exactly on the upper edge: at
  // time 1, when images are displaced by speed * 1, and at rest relative to each other along x if the images' speed is counted.
  constexpr double length = 8.0, rate = 0.125, speed = 1.0;
  const Box box = square_box(length, Boundary::periodic);
  // The lower disk goes down from 1.5 to 1, the upper one up from 7 to the edge, at x = 2: its image below is then at x = 1.
  const System system = system_of(box, {{{1.0, 1.5}, {0.0, -0.5}, 0.5, 3.0}, {{1.0, 7.0}, {speed, 1.0}, 0.5, 1.0}});
  const auto engine = engine_of(system, rate);
  engine->record_events(true);
  run_to(*engine, 1.0);
  const std::vector<Event> events = engine->take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].time, 1.0);
  // Of masses 3 and 1 with velocities -1/2 and 1: the centre of mass has -1/8, and both turn round in its frame.
  EXPECT_EQ(events[0].velocity, Eigen::Vector2d(0.0, 0.25));
  // The upper one is on the edge and moves down: as itself, at its speed, or as its image below, which is by `speed` slower.
  EXPECT_EQ(events[0].partner_velocity.y(), -1.25);
  run_to(*engine, 2.0);
  const State state = engine->state();
  EXPECT_EQ(state.positions.col(0), Eigen::Vector2d(1.0, 1.25));
  EXPECT_EQ(state.positions.col(1), Eigen::Vector2d(3.0, 6.75));
  EXPECT_EQ(state.velocities.col(1), Eigen::Vector2d(speed, -1.25));
  EXPECT_EQ(engine->totals().shear_energy, 0.0) << "it is back in its box";
}

/// The first contact of all pairs in all images that can matter.
double next_contact(const System& system, const State& state, double rate, double until) {
  const Eigen::Vector2d length = system.box.lengths();
  double first = infinity<double>;
  const auto n = state.positions.cols();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = i + 1; j < n; ++j)
      for (int y = -2; y <= 2; ++y)
        for (int x = -4; x <= 4; ++x) {
          const Vec2<double> image(x * length[0] + y * state.shear_displacement, y * length[1]);
          const Vec2<double> r = state.positions.col(i) - state.positions.col(j) - image;
          const Vec2<double> v = state.velocities.col(i) - state.velocities.col(j) - Vec2<double>(y * rate * length[1], 0.0);
          first = std::min(first, contact_time<double>(r, v, 1.0));
        }
  return std::min(first, until);
}

TEST_P(Shear, OverlooksNoCollisionOfAnyImage) {
  for (const double rate : {0.3, -0.3, 2.0})
    for (const double packing_fraction : {0.1, 0.6}) {
      const System system = flowing(16, packing_fraction, rate);
      const auto engine = engine_of(system, rate);
      for (std::uint64_t k = 0; k < 300; ++k) {
        const double before = engine->now().high;
        const double expected = before + next_contact(system, engine->state(), rate, 1.0);
        const std::uint64_t pairs = engine->totals().pair;
        engine->run_until({before + 1.0, 0.0}, pairs + 1, no_limit);
        // States are rounded to 1e-15 of the box, and contact at grazing incidence magnifies that: 1e-8 is its square root.
        ASSERT_NEAR(engine->now().high, expected, 1e-7) << "rate " << rate << ", at " << packing_fraction << ", collision " << k;
      }
    }
}

/// Of the energy K relative to the flow: dK/dt = -rate (sum m c_x c_y + collisions), exactly. Under reversal impulses are not
/// along the line of centres, and r_y J_x is not r_x J_y.
void expect_energy_of_stress(const char* name, CollisionRule rule) {
  constexpr double rate = 0.2, dt = 1.0 / 2048.0;
  constexpr int steps = 4096;
  const System system = flowing(36, 0.4, rate);
  const double middle = (system.box.lower.y() + system.box.upper.y()) / 2.0;
  const auto engine = sheared_engine(name, system, rate, rule);
  struct Moments {
    double energy = 0.0, stress = 0.0;
  };
  const auto moments = [&] {
    const State state = engine->state();
    Moments sum;
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
      const double c_x = state.velocities(0, i) - rate * (state.positions(1, i) - middle), c_y = state.velocities(1, i);
      sum.energy += (c_x * c_x + c_y * c_y) / 2.0;
      sum.stress += c_x * c_y;
    }
    return sum;
  };
  const Moments start = moments();
  Moments last = start;
  double flight = 0.0, jumps = 0.0;
  for (int k = 1; k <= steps; ++k) {
    run_to(*engine, k * dt);
    const Moments now = moments();
    flight += dt * (last.stress + now.stress) / 2.0;
    jumps += std::abs(now.stress - last.stress);
    last = now;
  }
  ASSERT_GT(engine->totals().pair, 100u);
  const double expected = -rate * (flight + engine->totals().virial_yx);
  // The trapezium rule is wrong by dt / 2 times each jump of the stress, at most.
  EXPECT_NEAR(last.energy - start.energy, expected, rate * dt / 2.0 * jumps + 1e-12);
  EXPECT_GT(std::abs(expected), 10.0 * rate * dt / 2.0 * jumps) << "else the test says nothing";
}

TEST_P(Shear, GivesTheEnergyThatTheStressSays) { expect_energy_of_stress(GetParam(), CollisionRule::specular); }
TEST_P(Shear, GivesTheEnergyThatTheStressSaysUnderReversal) { expect_energy_of_stress(GetParam(), CollisionRule::reversal); }

TEST_P(Shear, AtRateZeroLeavesTheBits) {
  const System system = system_of(gas_scene(64, 0.5, Boundary::periodic));
  const auto at_rate_zero = engine_of(system, 0.0), plain = make_engine(GetParam(), system);
  run_to(*at_rate_zero, 20.0);
  run_to(*plain, 20.0);
  EXPECT_TRUE(same_bits(at_rate_zero->state(), plain->state()));
  EXPECT_EQ(at_rate_zero->totals().other, plain->totals().other);
  EXPECT_EQ(at_rate_zero->totals().stale, plain->totals().stale);
}

TEST_P(Shear, KeepsAPlanThatAnExhaustiveSearchConfirms) {
  const System system = flowing(100, 0.55, 0.5);
  const auto engine = engine_of(system, 0.5);
  for (int k = 1; k <= 20; ++k) {
    run_to(*engine, 0.37 * k);
    const auto faults = engine->check_invariants();
    ASSERT_TRUE(faults.empty()) << faults.front();
  }
}

TEST_P(Shear, LooksForDisksAtRestInImagesThatSlide) {
  // Nothing moves but the images. The image of the lower disk above is 43 to the right of the upper disk's place, or 57 to the
  // left, and comes at speed 1, 0.5 higher: they touch when it is sqrt(3) / 2 away.
  const System system =
      system_of(square_box(100.0, Boundary::periodic), {{{2.0, 99.75}, {0.0, 0.0}}, {{45.0, 0.25}, {0.0, 0.0}}});
  const auto engine = engine_of(system, 0.01);
  EXPECT_FALSE(engine->idle());
  engine->run_until(forever, 1, no_limit);
  EXPECT_NEAR(engine->now().high, 57.0 - std::sqrt(0.75), 1e-13);  // some roundings of a time of 56
}

TEST(ShearInQuad, RunBackwardsLeadsBackToTheStart) {
  const System system = flowing(16, 0.3, 0.25);
  const auto there = sheared_engine("textbook-quad", system, 0.25);
  there->run_until({2.0, 0.0}, no_limit, no_limit);
  ASSERT_GT(there->totals().pair, 16u);
  State turned = there->state();
  turned.velocities = -turned.velocities;
  const auto back = sheared_engine("textbook-quad", {system.box, system.disks, turned}, -0.25);
  back->run_until({2.0, 0.0}, no_limit, no_limit);
  // The state between was rounded to doubles; chaos magnifies that by less than 3.2 per collision of each disk.
  const double per_disk = 2.0 * static_cast<double>(there->totals().pair) / 16.0;
  EXPECT_LT((back->state().velocities + system.state.velocities).cwiseAbs().maxCoeff(), 1e-14 * std::exp(3.2 * per_disk / 2.0));
}

INSTANTIATE_TEST_SUITE_P(All, Shear, testing::ValuesIn(engines_with_effects),
                         [](const auto& engine) { return std::string(engine.param); });

}  // namespace
}  // namespace carom::test
