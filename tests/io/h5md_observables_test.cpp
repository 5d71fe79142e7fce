// What the effects of a scene add to trajectory.h5md.

#include "io/h5md_observables.hpp"

#include "io/h5md_reader.hpp"
#include "io/h5md_writer.hpp"
#include "io/hand_made_run.hpp"
#include "io/run_writer.hpp"
#include "observe/energy.hpp"
#include "observe/geometry.hpp"
#include "observe/mechanics.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace carom::test {
namespace {

using ::testing::ElementsAre;

class H5mdObservables : public ::testing::Test {
 protected:
  std::filesystem::path write(const Scene& scene, std::uint64_t frames) {
    const std::filesystem::path path = temporary_.path() / "trajectory.h5md";
    H5mdWriter writer(path, scene, hand_made_disks(scene), provenance());
    for (std::uint64_t k = 0; k < frames; ++k) writer.sample(k, state_with_effects_at(k, scene), {});
    writer.close();
    return path;
  }

  TemporaryDirectory temporary_;
};

TEST_F(H5mdObservables, AreEnergyTemperatureAndWhatHasHappenedWhereNoEffectActs) {
  const H5Reader file(write(scene_of(2, 1), 2));
  EXPECT_THAT(file.members("/observables"),
              ElementsAre("kinetic_energy", "pair_collisions", "temperature", "virial", "wall_energy", "wall_impulse"));
  EXPECT_THAT(file.strings("/parameters", "effects"), ElementsAre("specular", "walls"));
}

TEST_F(H5mdObservables, TellTheTotalsUpToEachSample) {
  const std::filesystem::path path = temporary_.path() / "trajectory.h5md";
  const Scene scene = scene_of(2, 1);
  H5mdWriter writer(path, scene, hand_made_disks(scene), provenance());
  Totals totals;
  totals.pair = 12'345'678'901;
  totals.virial = 0.1;
  totals.wall_impulse = {1.5, -2.5, 3.5, 4.5};
  totals.wall_energy = {0.0, 1e-300, 7.0, -8.0};
  writer.sample(0, state_at(0, scene), totals);
  writer.close();
  const H5Reader file(path);
  EXPECT_THAT(file.doubles("/observables/pair_collisions/value"), ElementsAre(12'345'678'901.0));
  EXPECT_THAT(file.doubles("/observables/virial/value"), ElementsAre(0.1));
  EXPECT_THAT(file.doubles("/observables/wall_impulse/value"), ElementsAre(1.5, -2.5, 3.5, 4.5));
  EXPECT_THAT(file.doubles("/observables/wall_energy/value"), ElementsAre(0.0, 1e-300, 7.0, -8.0));
}

TEST_F(H5mdObservables, AreThereForWhatTheSceneNames) {
  EXPECT_THAT(H5Reader(write(scene_with_effects(2, 1), 2)).members("/observables"),
              ElementsAre("bonds", "kinetic_energy", "packing_fraction", "pair_collisions", "piston_energy", "potential_energy",
                          "scale", "spin", "spin_energy", "spin_temperature", "temperature", "total_energy", "virial",
                          "wall_energy", "wall_impulse", "wall_velocity", "walls", "well_passages"));
  Scene sheared = scene_of(2, 1);
  sheared.effects.shear = Shear{.rate = 0.5};
  EXPECT_THAT(H5Reader(write(sheared, 2)).members("/observables"),
              ElementsAre("kinetic_energy", "pair_collisions", "shear_displacement", "temperature", "virial", "wall_energy",
                          "wall_impulse"));
}

TEST_F(H5mdObservables, AreMeasuredOnEverySample) {
  const Scene scene = scene_with_effects(2, 1);
  const Disks disks = hand_made_disks(scene);
  const H5Reader file(write(scene, 4));
  const auto value = [&](const std::string& name) { return file.doubles("/observables/" + name + "/value"); };
  EXPECT_THAT(file.extents("/observables/spin/value"), ElementsAre(4, 3));
  EXPECT_THAT(file.extents("/observables/walls/value"), ElementsAre(4, 4));
  for (std::size_t k = 0; k < 4; ++k) {
    const State state = state_with_effects_at(k, scene);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(value("spin")[3 * k + i], state.spins[static_cast<Eigen::Index>(i)]);
    for (std::size_t side = 0; side < 4; ++side) EXPECT_EQ(value("walls")[4 * k + side], state.walls[side].position);
    for (std::size_t side = 0; side < 4; ++side) EXPECT_EQ(value("wall_velocity")[4 * k + side], state.walls[side].velocity);
    EXPECT_EQ(value("scale")[k], state.scale);
    EXPECT_EQ(value("bonds")[k], static_cast<double>(state.bonds));
    EXPECT_EQ(value("packing_fraction")[k], packing_fraction(scene.box, disks, state));
    EXPECT_EQ(value("spin_energy")[k], spin_energy(disks, state));
    EXPECT_EQ(value("spin_temperature")[k], spin_temperature(disks, state));
    EXPECT_EQ(value("potential_energy")[k], potential_energy(scene.box, scene.effects, disks, state));
    EXPECT_EQ(value("piston_energy")[k], piston_energy(scene.effects, state));
    EXPECT_EQ(value("total_energy")[k], total_energy(scene.box, scene.effects, disks, state));
  }
}

TEST_F(H5mdObservables, ShareTheStepsAndTimesOfTheSamples) {
  const H5Reader file(write(scene_with_effects(2, 1), 2));
  for (const std::string& name : file.members("/observables")) {
    EXPECT_TRUE(file.same_object(particles + "/position/step", "/observables/" + name + "/step")) << name;
    EXPECT_TRUE(file.same_object(particles + "/position/time", "/observables/" + name + "/time")) << name;
  }
}

TEST_F(H5mdObservables, TheBoxFollowsWallsAndShearWhileItsOriginStays) {
  const H5Reader file(write(scene_with_effects(2, 1), 5));
  EXPECT_THAT(file.numbers<double>(particles + "/box", "origin", H5T_NATIVE_DOUBLE), ElementsAre(-1.0, 10.0, -2.0));
  const std::vector<double> edges = file.doubles(particles + "/box/edges/value");
  for (std::size_t k = 0; k < 5; ++k) {
    const double steps = static_cast<double>(k);
    EXPECT_EQ(edges[9 * k], 4.0);
    EXPECT_EQ(edges[9 * k + 4], 2.5 + 0.75 * steps);
    EXPECT_EQ(edges[9 * k + 3], state_with_effects_at(k, scene_with_effects(2, 1)).shear_displacement);
    EXPECT_EQ(edges[9 * k + 8], std::max(4.0, 2.5 + 0.75 * steps));
  }
  EXPECT_THAT(file.doubles(particles + "/radius"), ElementsAre(0.03, 0.03, 0.01)) << "as the scene has them";
}

TEST_F(H5mdObservables, SpinsThatAnEngineDoesNotKeepAreZero) {
  const Scene scene = scene_with_effects(2, 1);
  const std::filesystem::path path = temporary_.path() / "t.h5md";
  H5mdWriter writer(path, scene, hand_made_disks(scene), provenance());
  writer.sample(0, state_at(0, scene), {});
  writer.close();
  EXPECT_THAT(H5Reader(path).doubles("/observables/spin/value"), ElementsAre(0.0, 0.0, 0.0));
}

TEST_F(H5mdObservables, NoDisksHaveNoSpins) {
  Scene scene = scene_with_effects(0, 0);
  scene.species.clear();
  const H5Reader file(write(scene, 2));
  EXPECT_THAT(file.extents("/observables/spin/value"), ElementsAre(2, 0));
  EXPECT_THAT(file.extents("/observables/walls/value"), ElementsAre(2, 4));
}

TEST_F(H5mdObservables, AreThoseOfTheEffectsThatActAtTheTime) {
  Scene scene = scene_of(3, 2);
  scene.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 1.0};  // which a change brings
  scene.box.boundary = {Boundary::periodic, Boundary::periodic};
  const State state = state_at(3, scene);
  {
    RunWriter writer(RunDirectory(temporary_.path() / "out", false), scene, hand_made_disks(scene), provenance());
    writer.set_effects({});
    writer.sample(0, state, {});
    writer.set_effects(scene.effects);
    writer.sample(1, state, {});
    writer.finish(hand_made_report(scene));
  }
  const H5Reader file(temporary_.path() / "out/trajectory.h5md");
  const double before = kinetic_temperature(scene.box, {}, hand_made_disks(scene), state),
               after = kinetic_temperature(scene.box, scene.effects, hand_made_disks(scene), state);
  EXPECT_NE(before, after);
  EXPECT_THAT(file.doubles("/observables/temperature/value"), ElementsAre(before, after));
}

TEST_F(H5mdObservables, AreThoseOfTheStateWhereUnwrappedPositionsAreWritten) {
  Scene scene = scene_of(3, 2);
  scene.box.boundary = {Boundary::periodic, Boundary::periodic};
  scene.effects.shear = Shear{.rate = 0.5};
  scene.output = {.trajectory = true, .unwrapped = true};
  State state = state_at(3, scene);
  state.images.row(1).setConstant(-2);
  {
    RunWriter writer(RunDirectory(temporary_.path() / "out", false), scene, hand_made_disks(scene), provenance());
    writer.sample(0, state, {});
    writer.finish(hand_made_report(scene));
  }
  const H5Reader file(temporary_.path() / "out/trajectory.h5md");
  EXPECT_EQ(file.doubles("/observables/temperature/value")[0],
            kinetic_temperature(scene.box, scene.effects, hand_made_disks(scene), state));
  EXPECT_EQ(file.doubles(particles + "/position/value")[1], state.positions(1, 0) - 2 * 2.5);
}

}  // namespace
}  // namespace carom::test
