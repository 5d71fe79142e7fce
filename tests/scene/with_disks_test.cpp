// Arrays of a program as the disks of a scene.

#include "scene/scene_equality.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace carom::test {
namespace {

using testing::HasSubstr;

const DiskArrays three = {.positions = {{1.0, 1.0}, {4.0, 1.0}, {7.0, 1.0}},
                          .velocities = {{1.0, 0.0}, {0.0, 2.0}, {-1.0, 0.5}},
                          .radii = {0.5, 0.25, 0.125},
                          .masses = {1.0, 2.0, 3.0}};

Scene one_species() {
  return scene_of(box_of(10.0, 10.0, Boundary::walls), {species_of(5, 0.2, 1.0, RandomPositions{}, MaxwellVelocities{1.0})});
}

Scene two_species() {
  const Species small = species_of(1, 0.2, 1.0, RandomPositions{}, AtRest{}),
                large = species_of(2, 0.4, 4.0, RandomPositions{}, AtRest{});
  return scene_of(box_of(10.0, 10.0, Boundary::walls), {small, large});
}

/// The scene with what a file needs and a program may leave out: names, and an end. It has no samples, and so no trajectory.
Scene as_in_a_file(Scene scene) {
  for (std::size_t s = 0; s < scene.species.size(); ++s) scene.species[s].name = "disks" + std::to_string(s);
  scene.run.time = 1.0;
  scene.output.trajectory = false;
  return scene;
}

std::string said_of(const Scene& scene, const DiskArrays& disks) {
  return refusal<SceneError>([&] { return with_disks(scene, disks); });
}

TEST(WithDisks, ASimulationBeginsWithWhatTheArraysHold) {
  const Simulation simulation = make_simulation(with_disks(one_species(), three));
  const State state = simulation.state();
  ASSERT_EQ(state.positions.cols(), 3);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_EQ(state.positions.col(i), three.positions[k]);
    EXPECT_EQ(state.velocities.col(i), three.velocities[k]);
  }
  EXPECT_EQ(simulation.disks().radius, three.radii);
  EXPECT_EQ(simulation.disks().mass, three.masses);
}

TEST(WithDisks, WhatIsAbsentStaysTheScenesOwn) {
  const Scene scene = with_disks(as_in_a_file(two_species()), {.positions = three.positions});
  const Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.disks().radius, (std::vector{0.2, 0.4, 0.4}));
  EXPECT_EQ(simulation.disks().species, (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_TRUE(simulation.state().velocities.isZero());
  EXPECT_EQ(scene.text, resolved_toml(scene));
  EXPECT_EQ(resolved_toml(parse_scene(scene.text)), scene.text);
}

TEST(WithDisks, TheResolvedSceneReadsBackAsTheSameScene) {
  for (const Scene& scene : {one_species(), two_species()}) {
    const Scene with = with_disks(as_in_a_file(scene), three);
    EXPECT_EQ(first_difference(parse_scene(with.text), with), "");
  }
}

TEST(WithDisks, RefusesArraysThatDoNotFitTogether) {
  DiskArrays disks = three;
  disks.velocities.pop_back();
  EXPECT_EQ(said_of(one_species(), disks), "there are 2 velocities and 3 positions; give one of each per disk");
  disks = {.positions = {{1.0, 1.0}, {4.0, 1.0}}};
  EXPECT_THAT(said_of(two_species(), disks), HasSubstr("there are 2 positions, and the 2 species of the scene have 3 disks"));
}

TEST(WithDisks, RefusesWhatASceneFileIsRefusedFor) {
  EXPECT_THAT(said_of(one_species(), {.positions = {{1.0, 1.0}, {1.1, 1.0}}}), HasSubstr("overlap"));
  EXPECT_THAT(said_of(one_species(), {.positions = {{1.0, 11.0}}}), HasSubstr("box"));
  EXPECT_THAT(said_of(one_species(), {.positions = {{1.0, std::nan("")}}}), HasSubstr("nan"));
  EXPECT_THAT(said_of(one_species(), {.positions = {{1.0, 1.0}}, .radii = {-1.0}}), HasSubstr("radi"));
}

}  // namespace
}  // namespace carom::test
