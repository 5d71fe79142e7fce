// Lees-Edwards shear: images that slide, alone, in pairs, in the plan and in the balance of energy.

#include "core/contact_time.hpp"
#include "engine/textbook.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace carom::test {
namespace {

Effects sheared(double rate) {
  Effects effects;
  effects.shear = Shear{rate, {}};
  return effects;
}

/// A fluid whose velocities are drawn relative to the flow.
System flowing(std::int64_t disks, double packing_fraction, double rate) {
  Scene scene = gas_scene(disks, packing_fraction, Boundary::periodic);
  scene.effects = sheared(rate);
  return system_of(scene);
}

TEST(Shear, CarriesOneDiskThroughTheSlidingEdgesAsTheClosedFormSays) {
  // All numbers are dyadic, so nothing is rounded: box 4 x 4, images slide at 4 / 8.
  constexpr double rate = 0.125, speed = 0.5;
  const System system = system_of(square_box(4.0, Boundary::periodic), {{{1.0, 3.0}, {0.25, 1.0}}});
  TextbookEngine<double> engine(system.box, system.disks, system.state, sheared(rate));
  for (int k = 1; k <= 100; ++k) {
    const double t = 0.75 * k;
    engine.run_until({t, 0.0}, no_limit, no_limit);
    const State state = engine.state();
    // It passes the upper edge at 1, 5, 9, ..., each time by a displacement speed * t and a speed farther back.
    double x = 1.0, v = 0.25, last = 0.0;
    for (double edge = 1.0; edge < t; edge += 4.0) {
      x += v * (edge - last) - speed * edge;
      v -= speed;
      last = edge;
    }
    x += v * (t - last);
    if (std::fmod(t - 1.0, 4.0) == 0.0) continue;  // on the edge: above or below
    EXPECT_EQ(state.velocities(0, 0), v) << t;
    EXPECT_EQ(state.positions(0, 0), x - 4.0 * std::floor(x / 4.0)) << t;
    EXPECT_EQ(state.positions(1, 0), std::fmod(3.0 + t, 4.0)) << t;
  }
}

TEST(Shear, LetsTwoDisksCollideAcrossTheEdgeWhereTheImageIs) {
  constexpr double rate = 0.05, length = 10.0, speed = rate * length;
  const Eigen::Vector2d above(2.0, 9.25), below(8.5, 0.5), v_above(0.0, 0.0), v_below(0.0, -0.125);
  const System system = system_of(square_box(length, Boundary::periodic), {{above, v_above}, {below, v_below}});
  TextbookEngine<double> engine(system.box, system.disks, system.state, sheared(rate));
  engine.record_events(true);
  engine.run_until({30.0, 0.0}, 1, no_limit);
  const std::vector<Event> events = engine.take_events();
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

TEST(Shear, OverlooksNoCollisionOfAnyImage) {
  for (const double rate : {0.3, -0.3, 2.0})
    for (const double packing_fraction : {0.1, 0.6}) {
      const System system = flowing(16, packing_fraction, rate);
      TextbookEngine<double> engine(system.box, system.disks, system.state, sheared(rate));
      for (std::uint64_t k = 0; k < 300; ++k) {
        const double before = engine.now().high;
        const double expected = before + next_contact(system, engine.state(), rate, 1.0);
        const std::uint64_t pairs = engine.totals().pair;
        engine.run_until({before + 1.0, 0.0}, pairs + 1, no_limit);
        // States are rounded to 1e-15 of the box, and contact at grazing incidence magnifies that: 1e-8 is its square root.
        ASSERT_NEAR(engine.now().high, expected, 1e-7) << "rate " << rate << ", at " << packing_fraction << ", collision " << k;
      }
    }
}

TEST(Shear, GivesTheEnergyThatTheStressSays) {
  // Of the energy K relative to the flow: dK/dt = -rate (sum m c_x c_y + collisions), exactly.
  constexpr double rate = 0.2, dt = 1.0 / 2048.0;
  constexpr int steps = 4096;
  const System system = flowing(36, 0.4, rate);
  const double middle = (system.box.lower.y() + system.box.upper.y()) / 2.0;
  TextbookEngine<double> engine(system.box, system.disks, system.state, sheared(rate));
  struct Moments {
    double energy = 0.0, stress = 0.0;
  };
  const auto moments = [&] {
    const State state = engine.state();
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
    engine.run_until({k * dt, 0.0}, no_limit, no_limit);
    const Moments now = moments();
    flight += dt * (last.stress + now.stress) / 2.0;
    jumps += std::abs(now.stress - last.stress);
    last = now;
  }
  ASSERT_GT(engine.totals().pair, 100u);
  const double expected = -rate * (flight + engine.totals().virial_xy);
  // The trapezium rule is wrong by dt / 2 times each jump of the stress, at most.
  EXPECT_NEAR(last.energy - start.energy, expected, rate * dt / 2.0 * jumps + 1e-12);
  EXPECT_GT(std::abs(expected), 10.0 * rate * dt / 2.0 * jumps) << "else the test says nothing";
}

TEST(Shear, AtRateZeroLeavesTheBits) {
  const System system = system_of(gas_scene(64, 0.5, Boundary::periodic));
  TextbookEngine<double> sheared_engine(system.box, system.disks, system.state, sheared(0.0));
  TextbookEngine<double> plain(system.box, system.disks, system.state);
  sheared_engine.run_until({20.0, 0.0}, no_limit, no_limit);
  plain.run_until({20.0, 0.0}, no_limit, no_limit);
  EXPECT_EQ(sheared_engine.state().positions, plain.state().positions);
  EXPECT_EQ(sheared_engine.state().velocities, plain.state().velocities);
}

TEST(Shear, KeepsAPlanThatAnExhaustiveSearchConfirms) {
  const System system = flowing(100, 0.55, 0.5);
  TextbookEngine<double> engine(system.box, system.disks, system.state, sheared(0.5));
  for (int k = 1; k <= 20; ++k) {
    engine.run_until({0.37 * k, 0.0}, no_limit, no_limit);
    const auto faults = engine.check_invariants();
    ASSERT_TRUE(faults.empty()) << faults.front();
  }
}

TEST(Shear, RunBackwardsLeadsBackToTheStart) {
  const System system = flowing(16, 0.3, 0.25);
  TextbookEngine<Quad> there(system.box, system.disks, system.state, sheared(0.25));
  there.run_until({2.0, 0.0}, no_limit, no_limit);
  ASSERT_GT(there.totals().pair, 16u);
  State turned = there.state();
  turned.velocities = -turned.velocities;
  TextbookEngine<Quad> back(system.box, system.disks, turned, sheared(-0.25));
  back.run_until({2.0, 0.0}, no_limit, no_limit);
  // The state between was rounded to doubles; chaos magnifies that by less than 3.2 per collision of each disk.
  const double per_disk = 2.0 * static_cast<double>(there.totals().pair) / 16.0;
  EXPECT_LT((back.state().velocities + system.state.velocities).cwiseAbs().maxCoeff(), 1e-14 * std::exp(3.2 * per_disk / 2.0));
}

}  // namespace
}  // namespace carom::test
