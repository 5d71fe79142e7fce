// What collisions do to fluxes: from the velocities before and after by definition; the same bits from notes and from whole
// collisions, whichever disk comes first, with every instruction set.

#include "observe/flux_meter.hpp"
#include "observe/observed_run.hpp"
#include "support/instructions.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom::test {
namespace {

/// All that CollisionFluxes says, row by row.
std::vector<double> numbers(const CollisionFluxes& fluxes) {
  std::vector<double> all;
  for (std::size_t row = 0; row < fluxes.count; ++row) {
    all.push_back(fluxes.time[row]);
    for (const auto& column : fluxes.virial) all.push_back(column[row]);
    for (const CollisionFluxes::Flux* flux : {&fluxes.momentum, &fluxes.energy})
      for (int axis = 0; axis < 2; ++axis) all.insert(all.end(), {flux->change[axis][row], flux->jump[axis][row]});
    all.push_back(fluxes.meeting[row]);
  }
  return all;
}

/// Told by a run of a mixture that drifts, and read as whole collisions.
struct Told {
  explicit Told(double restitution = 1.0) {
    scene.effects.collision.restitution = restitution;
    scene.run.time.reset();
    scene.run.collisions = 500;
    Simulation simulation = make_simulation(scene);
    state = simulation.state();
    state.velocities.colwise() += Eigen::Vector2d(0.3, -0.2);
    disks = simulation.disks();
    RunHooks hooks;
    hooks.collisions = [&](const CollisionNotes& told) {
      all.insert(all.end(), told.notes.begin(), told.notes.end());
      heard = told;
    };
    run_schedule(simulation, hooks);
    all.resize(CollisionFluxes::most - 3);  // no multiple of four; of one epoch
    heard.notes = all;
    heard.epoch = 7.0;
    heard.epoch_remainder = 1e-17;
    heard.read(collisions);
  }
  [[nodiscard]] Eigen::Vector2d common() const {
    return common_velocity({.scene = scene, .disks = disks, .temperature = 1.0}, state);
  }

  Scene scene = mixture_scene(60, 0.4, Boundary::periodic);
  Disks disks = {};
  State state = {};
  std::vector<CollisionNote> all = {};
  CollisionNotes heard = {};
  std::vector<PairCollision> collisions = {};
};

TEST(CollisionFluxes, AreWhatTheVelocitiesSay) {
  for (const double restitution : {1.0, 0.9}) {
    const Told told(restitution);
    FluxMeter meter(told.disks);
    meter.start(told.common());
    const Eigen::Vector2d common = told.common();
    ASSERT_GT(common.norm(), 0.1);
    const CollisionFluxes& fluxes = meter.of(told.heard, told.heard.notes);
    ASSERT_EQ(fluxes.count, told.collisions.size());
    for (std::size_t row = 0; row < fluxes.count; ++row) {
      const PairCollision& met = told.collisions[row];
      const double m = told.disks.mass[static_cast<std::size_t>(met.disk)];
      const double M = told.disks.mass[static_cast<std::size_t>(met.partner)];
      Eigen::Matrix2d momentum = Eigen::Matrix2d::Zero();
      Eigen::Vector2d energy = Eigen::Vector2d::Zero();
      const auto add = [&](double mass, const Eigen::Vector2d& velocity) {
        const Eigen::Vector2d v = velocity - common;
        momentum += mass * v * v.transpose();
        energy += 0.5 * mass * v.squaredNorm() * v;
        return 0.5 * mass * v.squaredNorm();
      };
      const double gained = add(m, met.velocity) + add(-m, met.velocity_before);
      const double lost = -(add(M, met.partner_velocity) + add(-M, met.partner_velocity_before));
      const Eigen::Vector2d J = m * (met.velocity - met.velocity_before), r = met.separation;
      // Some ten operations on numbers below 100.
      const double rounding = 1e-13;
      EXPECT_NEAR(fluxes.momentum.change[0][row], momentum(0, 1), rounding);
      EXPECT_NEAR(fluxes.momentum.change[1][row], 0.5 * (momentum(0, 0) - momentum(1, 1)), rounding);
      EXPECT_NEAR(fluxes.momentum.jump[0][row], r.x() * J.y(), rounding);
      EXPECT_NEAR(fluxes.momentum.jump[1][row], 0.5 * (r.x() * J.x() - r.y() * J.y()), rounding);
      EXPECT_NEAR(fluxes.virial[1][row], r.x() * J.y(), rounding);
      EXPECT_NEAR(fluxes.virial[2][row], r.y() * J.x(), rounding);
      EXPECT_NEAR(fluxes.virial[0][row] + fluxes.virial[3][row], r.dot(J), rounding);
      for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(fluxes.energy.change[axis][row], energy[axis], 10.0 * rounding);
        EXPECT_NEAR(fluxes.energy.jump[axis][row], 0.5 * (gained + lost) * r[axis], rounding);
      }
      EXPECT_EQ(fluxes.time[row], met.time);
      EXPECT_NEAR(fluxes.meeting[row], r.norm() * std::sqrt(m * M / (m + M)), rounding);
    }
  }
}

TEST(CollisionFluxes, OfNotesAndOfWholeCollisionsAreTheSameBits) {
  const Told told;
  FluxMeter of_notes(told.disks), of_collisions(told.disks);
  of_notes.start(told.common());
  of_collisions.start(told.common());
  for (const std::size_t count : {std::size_t{1}, std::size_t{5}, told.all.size()})
    EXPECT_EQ(numbers(of_notes.of(told.heard, told.heard.notes.first(count))),
              numbers(of_collisions.of(std::span(told.collisions).first(count))))
        << count;
  EXPECT_EQ(of_notes.of(told.heard, {}).count, 0U);
}

TEST(CollisionFluxes, DoNotDependOnWhichDiskComesFirst) {
  Told told;
  FluxMeter meter(told.disks), other(told.disks);
  meter.start(told.common());
  other.start(told.common());
  const std::vector<double> before = numbers(meter.of(told.heard, told.heard.notes));
  for (CollisionNote& note : told.all) {
    std::swap(note.place, note.partner);
    std::swap(note.before, note.partner_before);
    std::swap(note.after, note.partner_after);
  }
  EXPECT_EQ(numbers(other.of(told.heard, told.heard.notes)), before);
}

TEST(CollisionFluxes, AreTheSameBitsWithEveryInstructionSet) {
  const Told told;
  std::vector<std::vector<double>> found;
  for (const std::string_view set : instruction_sets) {
    const WithInstructions with(set);
    FluxMeter meter(told.disks);
    meter.start(told.common());
    found.push_back(numbers(meter.of(told.heard, told.heard.notes)));
  }
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
}

TEST(CollisionFluxes, OfDisksThatOnlyTouchAreNothing) {
  const Told told;
  FluxMeter meter(told.disks);
  CollisionNote graze = told.all[0];
  std::copy_n(graze.before, 2, graze.after);
  std::copy_n(graze.partner_before, 2, graze.partner_after);
  const CollisionFluxes& fluxes = meter.of(told.heard, std::span(&graze, 1));
  for (const auto& column : fluxes.virial) EXPECT_EQ(column[0], 0.0);
  EXPECT_EQ(fluxes.momentum.change[0][0], 0.0);
  EXPECT_EQ(fluxes.energy.jump[1][0], 0.0);
}

}  // namespace
}  // namespace carom::test
