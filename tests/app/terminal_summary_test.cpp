// What the terminal says of a run whose effects gave and took.

#include "app/terminal_summary.hpp"

#include "io/hand_made_run.hpp"
#include "observe/effects_report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class TerminalSummary : public ::testing::Test {
 protected:
  [[nodiscard]] std::string text() const { return cli::terminal_summary(report_, scene_, {"out", {}, "carom"}); }

  Scene scene_ = scene_of(2, 2);
  RunReport report_ = hand_made_report(scene_);
};

TEST_F(TerminalSummary, SaysNothingOfEffectsThatASceneDoesNotName) {
  report_.of_effects.walls.push_back({.name = "top", .momentum = 40.0, .energy = 0.0, .force = 8.0, .pressure = 2.0, .end = {}});
  EXPECT_THAT(text(), AllOf(HasSubstr("relative drift 1.6e-02"), ContainsRegex("Z = PA/\\(NkT\\) +2.5")));
  EXPECT_THAT(text(), Not(AnyOf(HasSubstr("top wall"), HasSubstr("dissipated"), HasSubstr("spin"), HasSubstr("thermostat"),
                                HasSubstr("obstacles"), HasSubstr("bonds"), HasSubstr("grown"))));
}

TEST_F(TerminalSummary, WallsThatTheSceneNamesTellPressureAndHeat) {
  scene_.effects.walls[2].temperature = 2.0;
  scene_.effects.walls[3].velocity = 0.5;
  report_.of_effects.walls.push_back(
      {.name = "bottom", .momentum = 40.0, .energy = -3.0, .force = 8.0, .pressure = 2.0, .end = {}});
  report_.of_effects.walls.push_back(
      {.name = "top", .momentum = 60.0, .energy = 1.0, .force = 12.0, .pressure = {}, .end = WallState{15.0, 0.5}});
  report_.of_effects.packing_fraction_end = 0.125;
  report_.Z.reset();
  EXPECT_THAT(text(), AllOf(ContainsRegex("bottom wall +pressure 2 +supplied energy 3\n"),
                            ContainsRegex("top wall +force 12 +removed energy 1; now at 15, velocity 0.5\n"),
                            ContainsRegex("packing fraction +0.125 +at the end"),
                            ContainsRegex("Z = PA/\\(NkT\\) +none +the area changes")));
}

TEST_F(TerminalSummary, TemperatureIsWithoutCommonMotionWhereDisksKeepIt) {
  report_.samples = 3;
  scene_.box.boundary = {Boundary::periodic, Boundary::periodic};
  EXPECT_THAT(text(), ContainsRegex("temperature kT .* kinetic, without centre-of-mass motion\n"));
  scene_.box.boundary[1] = Boundary::walls;
  EXPECT_THAT(text(), ContainsRegex("temperature kT .* kinetic, without centre-of-mass motion along x\n"));
  scene_.effects.walls[2].temperature = 2.0;  // it gives and takes momentum along itself too
  EXPECT_THAT(text(), ContainsRegex("temperature kT .* kinetic\n"));
  report_.samples = 0;
  EXPECT_THAT(text(), ContainsRegex("temperature kT .* kinetic, at the end: there are no samples\n"));
}

TEST_F(TerminalSummary, EveryEffectHasARow) {
  EffectsReport& effects = report_.of_effects;
  report_.totals.obstacle = 1234;
  report_.totals.thermostat = 4321;
  effects.spin_temperature = 1.25;
  effects.dissipated = 0.5;
  effects.obstacles = Eigen::Vector2d(1.5, -2.0);
  effects.thermostat = {.events = 4321, .energy = -10.0};
  effects.growth = {.scale = 1.5, .packing_fraction = 0.75, .energy = 20.0};
  effects.shear = {
      .strain = 2.5, .energy = 30.0, .pressure_xy_of_collisions = -0.5, .pressure_xy_of_flight = -0.25, .viscosity = 1.5};
  effects.bonds = 31;
  EXPECT_THAT(text(), AllOf(ContainsRegex("obstacle hits +1,234"), ContainsRegex("thermostat events +4,321"),
                            ContainsRegex("spin temperature +1.25"), ContainsRegex("dissipated +0.5"),
                            ContainsRegex("obstacle momentum +\\(1.5, -2\\)"), ContainsRegex("thermostat +removed energy 10\n")));
  EXPECT_THAT(text(), AllOf(ContainsRegex("radii +1.5 +times those at the start\n"),
                            ContainsRegex("packing fraction +0.75 +at the end\n"), ContainsRegex("growth +supplied energy 20\n"),
                            ContainsRegex("strain +2.5 +rate times time\n"), ContainsRegex("shear +supplied energy 30\n"),
                            ContainsRegex("viscosity +1.5"), ContainsRegex("bonds +31")));
}

TEST_F(TerminalSummary, EnergyThatWasGivenIsToldFromEnergyThatWasLost) {
  report_.of_effects.energy_supplied = 0.5;  // from 32 to 32.5
  EXPECT_THAT(text(), HasSubstr("32 at the start; supplied and lost energy account for the change exactly\n"));
}

TEST_F(TerminalSummary, ReasonsToStopAreSentences) {
  report_.stopped = StopReason::collapsed;
  EXPECT_THAT(text(), HasSubstr("elastic_below"));
  report_.stopped = StopReason::grown;
  report_.of_effects.growth = {.scale = 1.5, .packing_fraction = 0.75, .energy = 20.0};
  EXPECT_THAT(text(), HasSubstr("grown to packing fraction 0.75, as requested"));
}

TEST_F(TerminalSummary, WithoutZItSaysWhy) {
  report_.Z.reset();
  scene_.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 1.0};
  EXPECT_THAT(text(), HasSubstr("the mean temperature is unknown without samples"));
  report_.totals.pair = 0;
  EXPECT_THAT(text(), HasSubstr("no pair of disks has collided"));
  scene_.effects.gravity = Gravity{.acceleration = {0.0, -1.0}};
  EXPECT_THAT(text(), HasSubstr("pressure and density change with height"));
}

TEST_F(TerminalSummary, PressureHasTheErrorOfZInProportion) {
  report_.Z = 2.0;
  report_.Z_error = 0.1;
  report_.reduced_pressure = 1.0;
  EXPECT_THAT(text(), ContainsRegex("P sigma\\^2/kT +1\\.000 ± 0\\.050\n"));
  report_.Z_error.reset();
  EXPECT_THAT(text(), ContainsRegex("P sigma\\^2/kT +1\n"));
}

TEST_F(TerminalSummary, SaysWhatTheWallsFeelBesideZOfDisksAlone) {
  report_.Z_error = 0.1;
  report_.disks = 2;
  scene_.box.boundary = {Boundary::walls, Boundary::walls};
  report_.totals.wall_impulse = {30.0, 34.0, 31.0, 33.0};
  report_.of_effects = effects_report(scene_, Disks{}, report_.totals, {.time = report_.time});
  const Eigen::Vector2d lengths = scene_.box.lengths();
  const double pressure = (64.0 / lengths.y() + 64.0 / lengths.x()) / (2.0 * 2.0 * report_.time);
  const std::string on_walls = fmt::format("{:.5g}", pressure * lengths.prod() / (2.0 * report_.temperature_mean));
  EXPECT_THAT(text(), HasSubstr("from momentum transfer between disks; on the walls it is " + on_walls + "\n"));
  scene_.box.boundary = {Boundary::periodic, Boundary::periodic};
  report_.of_effects = {};
  EXPECT_THAT(text(), HasSubstr("from momentum transfer\n"));
}

TEST_F(TerminalSummary, SaysWhereZWasNotYetThatOfEquilibrium) {
  EXPECT_THAT(text(), Not(HasSubstr("not in equilibrium")));
  report_.Z_note = "not yet at equilibrium: 3 and 2";
  EXPECT_THAT(text(), AllOf(ContainsRegex("Z = PA/\\(NkT\\) .* not yet at equilibrium: 3 and 2\n"),
                            HasSubstr("so it was not in equilibrium: Z.\n")));
}

TEST_F(TerminalSummary, WhatToTryNextIsWhatWorks) {
  const auto next = [&] {
    const std::string all = cli::terminal_summary(report_, scene_, {"out", {"out/trajectory.h5md"}, "carom"});
    return all.substr(all.find("Try next"));
  };
  report_.scene = CAROM_SOURCE_DIR "/docs/scenes/box.toml";
  scene_.output.trajectory = true;
  report_.samples = 3;
  EXPECT_THAT(next(),
              AllOf(HasSubstr("carom info out/trajectory.h5md"), HasSubstr("carom play out "), HasSubstr("carom report")));
  const std::string with_a_page = cli::terminal_summary(report_, scene_, {"out", {"out/report.html"}, "carom"});
  EXPECT_THAT(with_a_page.substr(with_a_page.find("Try next")), Not(HasSubstr("carom report")));
  report_.samples = 0;  // events or observables alone
  EXPECT_THAT(next(), AllOf(HasSubstr("carom info out/trajectory.h5md"), Not(HasSubstr("carom play"))));
  report_.samples = 3;
  scene_.output.trajectory = false;
  EXPECT_THAT(next(), Not(HasSubstr("carom play")));
  // The same changes, and no other seed where none is asked for.
  scene_.overrides = {"run.time=2", "run.seed=7", "disks.0.velocities={ speed = 1.0 }"};
  scene_.effects.collision.rule = CollisionRule::specular;
  scene_.species.front().positions = RandomPositions{};
  EXPECT_THAT(next(), ContainsRegex("carom run .* --set run.time=2 --set 'disks.0.velocities=\\{ speed = 1.0 \\}' --seed"));
  EXPECT_THAT(next(), Not(HasSubstr("run.seed=7")));
  for (Species& species : scene_.species) {
    species.positions = ListedPositions{};
    species.velocities = AtRest{};
  }
  EXPECT_THAT(next(), Not(HasSubstr("another seed")));
  report_.scene = "elsewhere/box.toml";
  EXPECT_THAT(next(), Not(HasSubstr("carom run")));
}

TEST_F(TerminalSummary, ARunThatTimeStopsNamesTheDisks) {
  report_.stopped = StopReason::jammed;
  EXPECT_THAT(text(), HasSubstr("jammed: disks that touch on all sides"));
  report_.stopped_disks = {3, 5};
  EXPECT_THAT(text(), HasSubstr("jammed: disks 3 and 5 touch on all sides"));
  report_.stopped_disks = {0, 1, 2, 3, 5, 8, 13};
  EXPECT_THAT(text(), HasSubstr("jammed: disks 0, 1, 2, 3 and 3 more touch"));
  report_.stopped = StopReason::collapsed;
  report_.stopped_disks = {7};
  EXPECT_THAT(text(), HasSubstr("collapsed: disk 7 collides at ever shorter intervals"));
}

TEST_F(TerminalSummary, AnOverlapThatWasAcceptedIsTold) {
  report_.max_relative_overlap = 0.25;
  report_.overlap_at_start = 0.125;
  EXPECT_THAT(text(), ContainsRegex("worst overlap +2.5e-01 diameters .*; 1.2e-01 accepted at the start"));
}

}  // namespace
}  // namespace carom::test
