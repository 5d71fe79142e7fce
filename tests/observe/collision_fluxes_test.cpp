// What collisions do to fluxes, added up: from the velocities before and after by definition; the same bits from records and from
// whole collisions, however they are handed over, whichever disk comes first, with every instruction set.

#include "core/all_equal.hpp"
#include "observe/flux_meter.hpp"
#include "observe/observed_run.hpp"
#include "support/instructions.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

/// Asks for some of the sums, and looks at them every `step` after `begin`.
class Asking final : public FluxFollower {
 public:
  explicit Asking(unsigned which = 7, double begin = 0.0, double step = std::numeric_limits<double>::infinity())
      : which_(which), step_(step), next_(begin + step) {}
  void ask(FluxSums& sums) override {
    if ((which_ & 1U) != 0) sums.transfer = &transfer;
    if ((which_ & 2U) != 0) sums.momentum = &momentum;
    if ((which_ & 4U) != 0) sums.energy = &energy;
  }
  [[nodiscard]] double until() const override { return next_; }
  void reach(double time) override {
    while (next_ < time) next_ += step_;
    look();
    momentum.since = energy.since = next_ - step_;
  }
  void look() {
    for (const Lanes& sum : transfer.virial) seen.push_back(sum.sum());
    seen.push_back(transfer.meetings);
    for (const FluxSum* sum : {&momentum, &energy})
      for (int axis = 0; axis < 2; ++axis) seen.insert(seen.end(), {sum->change[axis].sum(), sum->moment[axis].sum()});
  }

  TransferSum transfer;
  FluxSum momentum, energy;
  std::vector<double> seen;

 private:
  unsigned which_;
  double step_, next_;
};

Scene two_radii() {
  Scene scene = mixture_scene(60, 0.4, Boundary::periodic);
  scene.species[1].mass = scene.species[0].mass;
  return scene;
}

/// Told by a run of a gas that drifts, and read as whole collisions.
struct Told {
  explicit Told(Scene of = mixture_scene(60, 0.4, Boundary::periodic)) : scene(std::move(of)) {
    scene.run.time.reset();
    scene.run.collisions = 500;
    Simulation simulation = make_simulation(scene);
    state = simulation.state();
    state.velocities.colwise() += Eigen::Vector2d(0.3, -0.2);
    disks = simulation.disks();
    RunHooks hooks;
    hooks.collisions = [&](const CollisionRecords& told) {
      for (CollisionRecord record : told.records) {
        record.time += told.epoch;
        all.push_back(record);
      }
      heard = told;
    };
    run_schedule(simulation, hooks);
    all.resize(61);  // no multiple of four
    heard.records = all;
    heard.epoch = 7.0;
    heard.epoch_remainder = 1e-17;
    heard.read(collisions);
    for (std::size_t n = 0; n < all.size(); ++n) {
      const bool swapped = collisions[n].disk != heard.disks->ids[static_cast<std::size_t>(all[n].slot_i)];
      const Eigen::Vector2d r = (swapped ? -1.0 : 1.0) * collisions[n].separation;
      contacts.push_back({{r[0], r[1]}, true});
    }
  }
  [[nodiscard]] Eigen::Vector2d common() const {
    return common_velocity({.scene = scene, .disks = disks, .temperature = 1.0}, state);
  }
  /// What is seen where records are handed over `together`, and at the end.
  [[nodiscard]] std::vector<double> of_records(std::size_t together, Asking asking = Asking()) const {
    FluxMeter meter(scene, disks);
    meter.start(common());
    meter.add(asking);
    for (std::size_t begin = 0; begin < all.size(); begin += together) {
      CollisionRecords some = heard;
      some.records = std::span(all).subspan(begin, std::min(together, all.size() - begin));
      meter.follow(some);
    }
    asking.look();
    return asking.seen;
  }
  /// The same with contacts, for scenes whose velocities do not tell them.
  [[nodiscard]] std::vector<double> of_contacts(std::size_t together, Asking asking = Asking()) const {
    FluxMeter meter(scene, disks);
    meter.start(common());
    meter.add(asking);
    for (std::size_t begin = 0; begin < all.size(); begin += together) {
      CollisionRecords some = with_contacts();
      some.records = some.records.subspan(begin, std::min(together, all.size() - begin));
      some.contacts = some.contacts.subspan(begin, some.records.size());
      meter.follow(some);
    }
    asking.look();
    return asking.seen;
  }
  [[nodiscard]] CollisionRecords with_contacts() const {
    return {heard.disks, heard.epoch, heard.epoch_remainder, all, contacts};
  }

  Scene scene;
  Disks disks = {};
  State state = {};
  std::vector<CollisionRecord> all = {};
  CollisionRecords heard = {};
  std::vector<PairContact> contacts = {};
  std::vector<PairCollision> collisions = {};
};

/// A scene whose velocities do not tell where disks touched, so that records come with their contacts.
Scene reversed(Scene scene) {
  scene.effects.collision.rule = CollisionRule::reversal;
  return scene;
}

void expect_what_velocities_say(const Told& told, const Asking& found) {
  Eigen::Matrix2d virial = Eigen::Matrix2d::Zero(), momentum = virial, momentum_moment = virial;
  Eigen::Vector2d energy = Eigen::Vector2d::Zero(), energy_moment = energy;
  double meetings = 0.0;
  for (const PairCollision& met : told.collisions) {
    const double m = told.disks.mass[static_cast<std::size_t>(met.disk)];
    const double M = told.disks.mass[static_cast<std::size_t>(met.partner)];
    Eigen::Matrix2d of_momentum = Eigen::Matrix2d::Zero();
    Eigen::Vector2d of_energy = Eigen::Vector2d::Zero();
    const auto add = [&](double mass, const Eigen::Vector2d& velocity) {
      const Eigen::Vector2d v = velocity - told.common();
      of_momentum += mass * v * v.transpose();
      of_energy += 0.5 * mass * v.squaredNorm() * v;
      return 0.5 * mass * v.squaredNorm();
    };
    const double gained = add(m, met.velocity) + add(-m, met.velocity_before);
    const double lost = -(add(M, met.partner_velocity) + add(-M, met.partner_velocity_before));
    const Eigen::Vector2d J = m * (met.velocity - met.velocity_before), r = met.separation;
    virial += r * J.transpose();
    momentum += of_momentum;
    energy += of_energy;
    momentum_moment += r * J.transpose() - met.time * of_momentum;
    energy_moment += 0.5 * (gained + lost) * r - met.time * of_energy;
    meetings += r.norm() * std::sqrt(m * M / (m + M));
  }
  // Sums of 61 times some ten operations on numbers below 100, times of about ten.
  const double rounding = 61e-13;
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(found.transfer.virial[c].sum(), virial(c / 2, c % 2), rounding) << c;
  EXPECT_NEAR(0.5 * found.momentum.change[0].sum(), momentum(0, 1), rounding);
  EXPECT_NEAR(0.5 * found.momentum.change[1].sum(), 0.5 * (momentum(0, 0) - momentum(1, 1)), rounding);
  EXPECT_NEAR(0.5 * found.momentum.moment[0].sum(), momentum_moment(0, 1), 10.0 * rounding);
  EXPECT_NEAR(0.5 * found.momentum.moment[1].sum(), 0.5 * (momentum_moment(0, 0) - momentum_moment(1, 1)), 10.0 * rounding);
  const bool equal_masses = told.disks.mass.front() == told.disks.mass.back();
  for (int axis = 0; axis < 2 && equal_masses; ++axis) {
    EXPECT_NEAR(0.25 * found.energy.change[axis].sum(), energy[axis], 10.0 * rounding);
    EXPECT_NEAR(0.25 * found.energy.moment[axis].sum(), energy_moment[axis], 100.0 * rounding);
  }
  if (!all_equal(told.disks.radius)) {
    EXPECT_NEAR(found.transfer.meetings, meetings, rounding);
  }
}

TEST(CollisionFluxes, AreWhatTheVelocitiesSay) {
  Scene inelastic = mixture_scene(60, 0.4, Boundary::periodic);
  inelastic.effects.collision.restitution = 0.9;
  for (const Scene& scene :
       {mixture_scene(60, 0.4, Boundary::periodic), inelastic, two_radii(), gas_scene(60, 0.5, Boundary::periodic)}) {
    const Told told(scene);
    ASSERT_GT(told.common().norm(), 0.1);
    Asking asking;
    FluxMeter meter(told.scene, told.disks);
    meter.start(told.common());
    meter.add(asking);
    meter.follow(told.heard);
    expect_what_velocities_say(told, asking);
  }
}

TEST(CollisionFluxes, ThatAreToldAreWhatTheVelocitiesSay) {
  Scene inelastic = two_radii();
  inelastic.effects.collision.restitution = 0.9;
  for (const Scene& of : {two_radii(), inelastic}) {
    const Told told(of);
    const Scene scene = reversed(told.scene);
    Asking asking;
    FluxMeter meter(scene, told.disks);
    meter.start(told.common());
    meter.add(asking);
    meter.follow(told.with_contacts());
    expect_what_velocities_say(told, asking);
  }
}

TEST(CollisionFluxes, AreAddedUpOnceForAllObservablesWithTheSameStep) {
  const Told told;
  Asking all, momentum(2), others(5);
  FluxMeter meter(told.scene, told.disks);
  meter.start(told.common());
  for (Asking* asking : {&all, &momentum, &others}) meter.add(*asking);
  meter.follow(told.heard);
  const std::vector<double> alone = told.of_records(61);
  for (Asking* asking : {&all, &momentum, &others}) asking->look();
  EXPECT_EQ(all.seen, alone);
  for (std::size_t k = 0; k < alone.size(); ++k) EXPECT_EQ(k >= 5 && k < 9 ? momentum.seen[k] : others.seen[k], alone[k]) << k;
}

TEST(CollisionFluxes, OfImpulsesWhoseSquaresHaveLostDigitsAreThoseOfAllOthers) {
  Told told(gas_scene(60, 0.5, Boundary::periodic));
  const std::vector<double> usual = told.of_records(61);
  const double unit = 0x1p-518;  // squares of 2^-1036 have some 38 digits
  for (double& mass : told.disks.mass) mass *= unit;
  const std::vector<double> light = told.of_records(61);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(light[k] / unit, usual[k], 61.0 * 10.0 * 0x1p-30) << k;
}

TEST(CollisionFluxes, AreTheSameBitsHoweverTheyAreHandedOver) {
  for (const Scene& scene : {mixture_scene(60, 0.4, Boundary::periodic), gas_scene(60, 0.5, Boundary::periodic)}) {
    const Told told(scene);
    const double begin = told.collisions.front().time, end = told.collisions.back().time;
    const Asking asking(7, begin, (end - begin) / 4.5);
    const std::vector<double> expected = told.of_records(told.all.size(), asking);
    EXPECT_GT(expected.size(), 3U * 13U);  // looks on the way, and one at the end
    for (const std::size_t together : {1U, 2U, 3U, 4U, 5U, 8U, 30U}) {
      EXPECT_EQ(told.of_records(together, asking), expected) << together;
    }
  }
}

TEST(CollisionFluxes, DoNotDependOnWhatElseIsAsked) {
  for (const bool by_records : {true, false}) {
    Told told(two_radii());
    if (!by_records) told.scene = reversed(told.scene);
    const auto seen = [&](const Asking& asking) {
      return by_records ? told.of_records(61, asking) : told.of_contacts(61, asking);
    };
    const std::vector<double> all = seen(Asking());
    for (unsigned which = 1; which < 8; ++which) {
      const std::vector<double> some = seen(Asking(which));
      for (std::size_t k = 0; k < all.size(); ++k) {
        const unsigned of = k < 5 ? 1U : k < 9 ? 2U : 4U;
        EXPECT_EQ(some[k], (which & of) != 0 ? all[k] : 0.0) << which << " " << k;
      }
    }
  }
}

TEST(CollisionFluxes, DoNotDependOnWhichDiskComesFirst) {
  Told told(two_radii());
  const std::vector<double> before = told.of_records(61);
  for (CollisionRecord& record : told.all) {
    std::swap(record.slot_i, record.slot_j);
    std::swap(record.before_i, record.before_j);
    std::swap(record.after_i, record.after_j);
  }
  EXPECT_EQ(told.of_records(61), before);
}

TEST(CollisionFluxes, AreTheSameBitsWithEveryInstructionSet) {
  for (const Scene& scene : {mixture_scene(60, 0.4, Boundary::periodic), gas_scene(60, 0.5, Boundary::periodic)}) {
    Told told(scene);
    std::vector<std::vector<double>> of_records, of_contacts;
    for (const std::string_view set : instruction_sets) {
      const WithInstructions with(set);
      told.scene.effects.collision.rule = CollisionRule::specular;
      of_records.push_back(told.of_records(61));
      told.scene.effects.collision.rule = CollisionRule::reversal;
      of_contacts.push_back(told.of_contacts(61));
    }
    for (const std::size_t set : {1U, 2U}) {
      EXPECT_EQ(of_records[0], of_records[set]);
      EXPECT_EQ(of_contacts[0], of_contacts[set]);
    }
  }
}

TEST(CollisionFluxes, OfDisksThatOnlyTouchAreNothing) {
  Told told(gas_scene(60, 0.5, Boundary::periodic));
  told.all.resize(1);
  std::copy_n(told.all[0].before_i, 2, told.all[0].after_i);
  std::copy_n(told.all[0].before_j, 2, told.all[0].after_j);
  for (const double sum : told.of_records(1)) EXPECT_EQ(sum, 0.0);
}

}  // namespace
}  // namespace carom::test
