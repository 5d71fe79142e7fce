// summary.json against the scene format.

#include "io/summary.hpp"

#include "io/hand_made_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <carom/version.hpp>
#include <nlohmann/json.hpp>

#include <limits>

namespace carom::test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::ElementsAre;

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

Json summary_of(const RunReport& report) { return Json::parse(summary_json(report, provenance())); }

TEST(Summary, HasTheKeysOfTheSceneFormatInItsOrderAndThenItsOwn) {
  const Json json = summary_of(hand_made_report(scene_of(2, 2)));
  EXPECT_THAT(keys_of(json), ElementsAre("carom", "scene", "seed", "engine", "effects", "disks", "packing_fraction", "time",
                                         "state_hash", "samples", "events", "wall_seconds", "collisions_per_second", "energy",
                                         "momentum", "temperature", "pressure", "overlap", "stopped", "title", "loop_seconds",
                                         "virial", "wall_impulse", "numerics", "command_line", "resolved_scene"));
  EXPECT_THAT(keys_of(json["carom"]), ElementsAre("version", "commit", "compiler", "flags", "instructions"));
  EXPECT_THAT(keys_of(json["events"]), ElementsAre("pair", "wall", "other", "stale", "total"));
  EXPECT_THAT(keys_of(json["energy"]), ElementsAre("initial", "final", "relative_drift"));
  EXPECT_THAT(keys_of(json["momentum"]), ElementsAre("initial", "final"));
  EXPECT_THAT(keys_of(json["temperature"]), ElementsAre("mean"));
  EXPECT_THAT(keys_of(json["pressure"]), ElementsAre("Z", "Z_error", "reduced"));
  EXPECT_THAT(keys_of(json["overlap"]), ElementsAre("max_relative", "checked"));
}

TEST(Summary, CarriesTheNumbersOfTheReport) {
  const Json json = summary_of(hand_made_report(scene_of(2, 2)));
  EXPECT_EQ(json["carom"]["version"], build_info().version);
  EXPECT_EQ(json["scene"], "hand_made.toml");
  EXPECT_EQ(json["seed"].get<std::uint64_t>(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(json["effects"], Json::array({"periodic", "walls", "specular"}));
  EXPECT_EQ(json["disks"], 4);
  EXPECT_EQ(json["samples"], 51);
  EXPECT_EQ(json["events"], (Json{{"pair", 1000}, {"wall", 20}, {"other", 300}, {"stale", 4}, {"total", 1324}}));
  EXPECT_EQ(json["collisions_per_second"], 2000.0);  // 1000 pair collisions in half a second of the loop
  EXPECT_EQ(json["energy"]["relative_drift"], 0.015625);
  EXPECT_EQ(json["momentum"]["final"], Json::array({0.75, 0.125}));
  EXPECT_EQ(json["pressure"]["Z"], 2.5);
  EXPECT_EQ(json["overlap"]["max_relative"], 1e-13);
  EXPECT_EQ(json["stopped"], "time");
  EXPECT_EQ(json["wall_impulse"]["bottom"], 3.0);
  EXPECT_EQ(json["title"], "Hand-made: größer & kleiner");
}

TEST(Summary, HasARemarkOnZWhereThereIsOne) {
  RunReport report = hand_made_report(scene_of(2, 2));
  EXPECT_FALSE(summary_of(report)["pressure"].contains("Z_note"));
  report.Z_note = "not yet at equilibrium";
  EXPECT_EQ(summary_of(report)["pressure"]["Z_note"], "not yet at equilibrium");
}

TEST(Summary, WhatHasNoMeaningOrIsNotFiniteIsNull) {
  RunReport report = hand_made_report(scene_of(2, 2));
  report.Z.reset();
  report.Z_error = std::numeric_limits<double>::quiet_NaN();
  report.reduced_pressure = std::numeric_limits<double>::infinity();
  report.loop_seconds = 0.0;
  report.momentum_final.x() = std::numeric_limits<double>::quiet_NaN();
  const Json json = summary_of(report);
  EXPECT_TRUE(json["pressure"]["Z"].is_null());
  EXPECT_TRUE(json["pressure"]["Z_error"].is_null());
  EXPECT_TRUE(json["pressure"]["reduced"].is_null());
  EXPECT_TRUE(json["collisions_per_second"].is_null());
  EXPECT_EQ(json["momentum"]["final"], Json::array({nullptr, 0.125}));
}

TEST(Summary, EveryDoubleReadsBackExactly) {
  RunReport report = hand_made_report(scene_of(2, 2));
  report.energy_initial = 0.1 + 0.2;
  report.energy_final = 1.0 / 3.0;
  const Json json = summary_of(report);
  EXPECT_EQ(json["energy"]["initial"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(json["energy"]["final"].get<double>(), 1.0 / 3.0);
}

/// A report whose every part is there, with numbers of its own.
RunReport report_with_effects() {
  RunReport report = hand_made_report(scene_of(2, 2));
  report.totals.obstacle = 30;
  report.totals.well = 5;
  report.totals.thermostat = 7;
  EffectsReport& effects = report.of_effects;
  effects.walls.push_back({.name = "bottom", .momentum = 40.0, .energy = 3.0, .force = 8.0, .pressure = 2.0, .end = {}});
  effects.walls.push_back(
      {.name = "top", .momentum = 60.0, .energy = -1.0, .force = 12.0, .pressure = {}, .end = WallState{15.0, 0.5}});
  effects.packing_fraction_end = 0.3;
  effects.energies_end = {.kinetic = 20.0, .spin = 2.5, .potential = 7.0, .pistons = 3.0};
  effects.spin_temperature = 1.25;
  effects.dissipated = 0.5;
  effects.obstacles = Eigen::Vector2d(1.5, -2.0);
  effects.thermostat = {.events = 7, .energy = 10.0};
  effects.growth = {.scale = 1.5, .packing_fraction = 0.75, .energy = 20.0};
  effects.shear = {
      .strain = 2.5, .energy = 30.0, .pressure_xy_of_collisions = -0.5, .pressure_xy_of_flight = -0.25, .viscosity = 1.5};
  effects.bonds = 3;
  effects.energy_supplied = 0.25;
  return report;
}

TEST(Summary, EveryEffectHasItsKeyAfterThoseOfEveryRun) {
  const Json json = summary_of(report_with_effects());
  EXPECT_THAT(
      keys_of(json),
      ElementsAre("carom", "scene", "seed", "engine", "effects", "disks", "packing_fraction", "time", "state_hash", "samples",
                  "events", "wall_seconds", "collisions_per_second", "energy", "momentum", "temperature", "pressure", "overlap",
                  "stopped", "title", "loop_seconds", "virial", "wall_impulse", "numerics", "walls", "packing_fraction_end",
                  "dissipated", "obstacles", "thermostat", "growth", "shear", "square_well", "command_line", "resolved_scene"));
  EXPECT_THAT(keys_of(json["events"]), ElementsAre("pair", "wall", "other", "stale", "obstacle", "well", "thermostat", "total"));
  EXPECT_THAT(keys_of(json["energy"]), ElementsAre("initial", "final", "relative_drift", "supplied", "unaccounted", "parts"));
  EXPECT_THAT(keys_of(json["temperature"]), ElementsAre("mean", "spin_mean"));
}

TEST(Summary, EffectsTellWhatTheyGaveAndTook) {
  const Json json = summary_of(report_with_effects());
  EXPECT_EQ(json["events"]["total"], 1000 + 20 + 300 + 4 + 30 + 5 + 7);
  EXPECT_EQ(json["energy"]["unaccounted"], (32.5 - 32.0 - 0.25) / 32.5);
  EXPECT_EQ(json["energy"]["parts"], (Json{{"kinetic", 20.0}, {"spin", 2.5}, {"potential", 7.0}, {"pistons", 3.0}}));
  EXPECT_EQ(json["walls"]["bottom"], (Json{{"momentum", 40.0}, {"energy", 3.0}, {"force", 8.0}, {"pressure", 2.0}}));
  EXPECT_EQ(
      json["walls"]["top"],
      (Json{
          {"momentum", 60.0}, {"energy", -1.0}, {"force", 12.0}, {"pressure", nullptr}, {"position", 15.0}, {"velocity", 0.5}}));
  EXPECT_EQ(json["packing_fraction_end"], 0.3);
  EXPECT_EQ(json["dissipated"], 0.5);
  EXPECT_EQ(json["obstacles"], (Json{{"momentum", {1.5, -2.0}}}));
  EXPECT_EQ(json["thermostat"], (Json{{"events", 7}, {"energy", 10.0}}));
  EXPECT_EQ(json["growth"], (Json{{"scale", 1.5}, {"packing_fraction", 0.75}, {"energy", 20.0}}));
  EXPECT_EQ(
      json["shear"],
      (Json{{"strain", 2.5}, {"energy", 30.0}, {"pressure_xy", {{"collisions", -0.5}, {"flight", -0.25}}}, {"viscosity", 1.5}}));
  EXPECT_EQ(json["square_well"], (Json{{"bonds", 3}}));
}

TEST(Summary, TellsOfSeveralCoresOnlyWhereTheyShared) {
  RunReport report = hand_made_report(scene_of(2, 2));
  EXPECT_FALSE(summary_of(report).contains("cores"));
  report.threads = {.threads = 2, .domains = 4, .windows = 50, .windows_redone = 3, .events = 900, .events_alone = 100};
  const Json json = summary_of(report);
  EXPECT_EQ(json["cores"], (Json{{"threads", 2},
                                 {"domains", 4},
                                 {"ranks", 1},
                                 {"windows", 50},
                                 {"windows_redone", 3},
                                 {"events", 900},
                                 {"events_alone", 100}}));
  const RunReport read = run_report_of(json);
  EXPECT_EQ(read.threads.threads, 2U);
  EXPECT_EQ(read.threads.domains, 4U);
  EXPECT_EQ(read.threads.windows, 50U);
  EXPECT_EQ(read.threads.windows_redone, 3U);
  EXPECT_DOUBLE_EQ(read.threads.share_alone(), 0.1);
}

TEST(Summary, ReasonsToStopHaveNames) {
  RunReport report = hand_made_report(scene_of(2, 2));
  report.stopped = StopReason::collapsed;
  EXPECT_EQ(summary_of(report)["stopped"], "collapsed");
  report.stopped = StopReason::grown;
  EXPECT_EQ(summary_of(report)["stopped"], "grown");
}

TEST(Summary, NamesThatAreNotUtf8DoNotBreakIt) {
  RunReport report = hand_made_report(scene_of(2, 2));
  report.scene = "sc\xe8ne.toml";
  EXPECT_EQ(summary_of(report)["scene"], "sc\xef\xbf\xbdne.toml");
}

}  // namespace
}  // namespace carom::test
