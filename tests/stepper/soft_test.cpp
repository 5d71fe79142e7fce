// Springs in fixed steps: one contact in closed form, what is conserved, and the limit of hard disks.

#include "stepper/soft.hpp"
#include "observe/geometry.hpp"
#include "observe/mechanics.hpp"
#include "stepper/guarded.hpp"
#include "stepper/stepper.hpp"
#include "support/exact_run.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using Soft = SoftStep<ClosePairs>;
constexpr double steps_per_contact = Soft::steps_per_contact;

System pair_of(double mass, double other_mass, double gap = 1.0) {
  return system_of(square_box(16.0, Boundary::walls),
                   {{{6.0, 8.0}, {1.0, 0.0}, 0.5, mass}, {{7.0 + gap, 8.0}, {-1.0, 0.0}, 0.5, other_mass}});
}

TEST(Soft, TheLightestPairIsInContactForTheChosenNumberOfSteps) {
  for (const double dt : {0.01, 0.001}) {
    const System s = system_of(square_box(16.0, Boundary::walls),
                               {{{2, 2}, {0, 0}, 0.5, 3.0}, {{4, 2}, {0, 0}, 0.5, 0.5}, {{6, 2}, {0, 0}, 0.5, 2.0}});
    const double reduced = 0.5 * 2.0 / 2.5;
    EXPECT_NEAR(std::numbers::pi * std::sqrt(reduced / Soft::stiffness(s.disks.mass, dt)), steps_per_contact * dt, 1e-15);
  }
}

/// What an overlap that is `x` at the first step within and grows at the rate u does, by velocity Verlet as a reader would write
/// it. mu: the reduced mass; k: the stiffness; `damping`: relative.
struct OneContact {
  double x, u, mu, k, damping, dt;
  double parts = 0.0, lasts = 0.0, deepest = 0.0, virial = 0.0, lost = 0.0;

  OneContact& run() {
    const double gamma = damping * std::sqrt(k * mu);
    double since = x / u;
    for (; x > 0.0; since += dt) {
      const double parting = (-u + k * x * dt / (2.0 * mu)) / (1.0 + gamma * dt / (2.0 * mu));
      const double force = k * x - gamma * parting;
      deepest = std::max(deepest, x);
      virial += force * (1.0 - x) * dt;
      lost += gamma * parting * parting * dt;
      u -= force * dt / mu;
      x += u * dt;
    }
    parts = -u;
    lasts = since - x / u;
    return *this;
  }
};

/// Rounding of places, which are up to 8: by 2^-50, in 30 steps of a spring that makes speeds of them, of 52 per time.
constexpr double rounding = 2e-12;

TEST(Soft, AHeadOnPairPartsAsItCameAContactLater) {
  // For gaps that put the begin of the contact anywhere in a step. What is left by the theory of springs in steps, with alpha =
  // pi / steps_per_contact: alpha^2 / 24 of the time of contact, alpha^2 / 8 of the depth, (dt / t_c)^3 of speeds; and of the
  // virial sigma dp the overlap, whose mean over the force is a quarter of pi times the deepest.
  constexpr double dt = 0.002, contact = steps_per_contact * dt, alpha = std::numbers::pi / steps_per_contact;
  for (double phase = 0.0; phase < 1.0; phase += 0.05) {
    const double gap = 0.5 + 2.0 * phase * dt;
    const System s = pair_of(1.0, 1.0, gap);
    Stepper<Soft> stepper(s.box, s.disks, s.state, dt);
    stepper.record_events(true);
    double deepest = 0.0;
    for (int k = 0; k <= 1000; ++k) {
      run_to(stepper, k * dt);
      const State state = stepper.state();
      deepest = std::max(deepest, 1.0 - (state.positions(0, 1) - state.positions(0, 0)));
    }
    const State end = stepper.state();
    const double parts = end.velocities(0, 1) - end.velocities(0, 0), distance = end.positions(0, 1) - end.positions(0, 0);
    const double first = (std::floor(gap / (2.0 * dt)) + 1.0) * dt;  // the time of the first step within
    const OneContact twin = OneContact{2.0 * first - gap, 2.0, 0.5, Soft::stiffness(s.disks.mass, dt), 0.0, dt}.run();
    EXPECT_NEAR(parts, twin.parts, rounding);
    EXPECT_NEAR(distance, 1.0 + twin.parts * (2.0 - gap / 2.0 - twin.lasts), 2.0 * rounding);
    EXPECT_NEAR(deepest, twin.deepest, rounding);
    EXPECT_NEAR(stepper.totals().virial, twin.virial, rounding);
    EXPECT_NEAR(parts, 2.0, 2.0 * 2.1 * std::pow(steps_per_contact, -3.0)) << "2.03 for the worst phase";
    EXPECT_NEAR(twin.lasts, contact, 1.01 * (alpha * alpha / 24.0 + 2.1 * std::pow(steps_per_contact, -3.0)) * contact);
    EXPECT_NEAR(deepest, 2.0 * contact / std::numbers::pi, 1.01 * alpha * alpha / 8.0 * deepest);
    EXPECT_EQ(stepper.totals().pair, 1U);
    EXPECT_NEAR(stepper.totals().virial, 2.0 - contact,
                1.01 * 5.0 * alpha * alpha / 24.0 * contact + 2.1 * std::pow(steps_per_contact, -3.0));
    std::vector<Event> events;
    stepper.take_events(events);
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(events[0].time, gap / 2.0 + contact, 1.01 * dt);
    EXPECT_EQ(events[0].velocity, Eigen::Vector2d(end.velocities.col(0)));
  }
}

/// A dashpot sets in and ends between steps: each force of a step counts for all of it, so the speed is off by a random part of
/// gamma dt / mu times itself. Returns half of that.
double randomness(double restitution) {
  const double log = -std::log(restitution);
  return log / std::hypot(std::numbers::pi, log) * (std::numbers::pi / steps_per_contact);
}

TEST(Soft, DampingLeavesTheShareOfTheSpeedThatRestitutionSays) {
  constexpr int phases = 25;
  constexpr double dt = 0.002;
  for (const double restitution : {0.95, 0.8, 0.5, 0.1}) {
    double speed = 0.0, lost = 0.0;
    for (int k = 0; k < phases; ++k) {
      const System s = pair_of(1.0, 3.0, 0.5 + 2.0 * dt * k / phases);
      Effects effects;
      effects.collision.restitution = restitution;
      Stepper<Soft> stepper(s.box, s.disks, s.state, dt, effects);
      run_to(stepper, 2.0);
      const State end = stepper.state();
      const double share = (end.velocities(0, 1) - end.velocities(0, 0)) / 2.0;
      EXPECT_NEAR(share, restitution, (1.0 + restitution) * randomness(restitution));
      speed += share / phases;
      lost += stepper.totals().dissipated / phases;
    }
    EXPECT_NEAR(speed, restitution, 0.003) << restitution;
    EXPECT_NEAR(lost, 0.75 * 4.0 / 2.0 * (1.0 - restitution * restitution), 0.01) << restitution;
  }
}

TEST(Soft, AWallTakesTwiceTheMomentumOrLessWhereItIsInelastic) {
  constexpr int phases = 25;
  constexpr double dt = 0.002;
  for (const double restitution : {1.0, 0.5}) {
    double impulse = 0.0, energy = 0.0;
    for (int k = 0; k < phases; ++k) {
      const System s = system_of(square_box(8.0, Boundary::walls), {{{6.5 + dt * k / phases, 4.0}, {1.0, 0.25}, 0.5, 3.0}});
      Effects effects;
      effects.walls[1].restitution = restitution;
      Stepper<Soft> stepper(s.box, s.disks, s.state, dt, effects);
      run_to(stepper, 2.0);
      EXPECT_EQ(stepper.totals().wall, 1U);
      EXPECT_EQ(stepper.state().velocities(1, 0), 0.25);
      EXPECT_NEAR(stepper.totals().wall_impulse[1], 3.0 * (1.0 - stepper.state().velocities(0, 0)), 1e-12);
      impulse += stepper.totals().wall_impulse[1] / phases;
      energy += stepper.totals().wall_energy[1] / phases;
    }
    EXPECT_NEAR(impulse, 3.0 * (1.0 + restitution), 0.01);
    EXPECT_NEAR(energy, 1.5 * (1.0 - restitution * restitution), 0.01);
  }
}

TEST(Soft, MomentumStaysToRoundingAndEnergyWhereNoSpringIsPressed) {
  // A random part of a contact's energy, which is below 2.
  const double change = 2.0 * 2.0 * 0.52 / (steps_per_contact * steps_per_contact);
  for (const Scene& scene : {gas_scene(12, 0.4, Boundary::periodic), mixture_scene(12, 0.4, Boundary::periodic)}) {
    const System s = system_of(scene);
    constexpr double dt = 0.0005;
    Stepper<Soft> stepper(s.box, s.disks, s.state, dt);
    const double before = kinetic_energy(s.disks, s.state);
    int free = 0;
    for (int k = 0; k < 20'000; ++k) {
      run_to(stepper, k * dt);
      const State state = stepper.state();
      ASSERT_LT((total_momentum(s.disks, state) - total_momentum(s.disks, s.state)).norm(), 1e-12);
      if (deepest_overlap(scene.box, scene.effects, s.disks, state).relative > 0.0) continue;
      ++free;
      const double contacts = 1.0 + static_cast<double>(stepper.totals().pair);
      ASSERT_NEAR(kinetic_energy(s.disks, state), before, 4.0 * change * std::sqrt(contacts));
    }
    EXPECT_GT(free, 1000);
    EXPECT_LT(free, 19'900);
    EXPECT_GT(stepper.totals().pair, 100U);
  }
}

TEST(Soft, ApproachesHardDisksWithTheFirstOrderOfTheContactTime) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scene scene = mixture_scene(12, 0.3, Boundary::periodic, seed);
    const State start = make_simulation(scene).state();
    const ExactRun exact = exact_run(scene, start, 0.75);
    ASSERT_GT(exact.events.size(), 5U);
    std::vector<double> errors;
    for (const double dt : {2e-4, 1e-4, 5e-5}) {
      Simulation s = make_simulation(scene, start, FixedStep{"soft", dt});
      s.run_until(0.75);
      errors.push_back(rms_difference(scene, s.state(), exact.end));
    }
    EXPECT_GT(errors[1], 1e-4);
    for (const int k : {0, 1})
      EXPECT_NEAR(std::log2(errors[static_cast<std::size_t>(k)] / errors[static_cast<std::size_t>(k) + 1]), 1.0, 0.3) << seed;
  }
}

TEST(Soft, IsTheSearchOfAllPairsToTheLastBit) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
    for (const double dt : {0.0005, 0.005}) {
      const System s = system_of(mixture_scene(60, 0.4, boundary));
      Effects effects;
      effects.collision.restitution = 0.9;
      Stepper<Soft> listed(s.box, s.disks, s.state, dt, effects);
      Stepper<SoftStep<AllPairs>> twin(s.box, s.disks, s.state, dt, effects);
      run_to(listed, 400 * dt);
      run_to(twin, 400 * dt);
      EXPECT_TRUE(same_bits(listed.state(), twin.state()));
      EXPECT_EQ(listed.totals().pair, twin.totals().pair);
    }
}

TEST(Soft, WhatASpringCannotDoIsRefused) {
  const auto sentence = [](const Scene& scene) {
    return refusal<std::invalid_argument>([&] { return make_simulation(scene, FixedStep{"soft", 0.01}); });
  };
  Scene scene = gas_scene(4, 0.1, Boundary::walls);
  EXPECT_EQ(sentence(scene), "");
  scene.effects.walls[3].restitution = 0.0;
  EXPECT_EQ(
      sentence(scene),
      "the method \"soft\" has springs that let nothing part at restitution 0; take another method, or a restitution above 0");
  scene.effects.collision.rule = CollisionRule::reversal;
  EXPECT_EQ(
      sentence(scene),
      "the method \"soft\" has a spring along the line of centres, which cannot turn round the whole relative velocity as the "
      "rule \"reversal\" does; take another method, or the rule \"specular\"");
}

}  // namespace
}  // namespace carom::test
