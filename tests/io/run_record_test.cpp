// A run's summary and what was observed, read back.

#include "io/run_record.hpp"

#include "io/hand_made_run.hpp"
#include "io/summary.hpp"
#include "support/recorded_run.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace carom::test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Json json_of(const RunReport& report) { return Json::parse(summary_json(report, provenance())); }

/// Written, read and written again.
Json again(const Json& json) { return json_of(run_report_of(json)); }

RunReport with_effects() {
  RunReport report = hand_made_report(scene_of(2, 2));
  EffectsReport& effects = report.of_effects;
  effects.walls = {{.name = "top", .momentum = 40.0, .energy = 3.0, .force = 8.0, .pressure = {}, .end = WallState{15.0, 0.5}}};
  effects.packing_fraction_end = 0.125;
  effects.energies_end = Energies{.kinetic = 10.0, .spin = 2.0, .potential = -4.0, .pistons = 0.5};
  effects.spin_temperature = 1.25;
  effects.dissipated = 0.5;
  effects.obstacles = Eigen::Vector2d(1.5, -2.0);
  report.totals.thermostat = 4321;
  effects.thermostat = {.events = 4321, .energy = -10.0};
  effects.growth = {.scale = 1.5, .packing_fraction = 0.75, .energy = 20.0};
  effects.shear = {
      .strain = 2.5, .energy = 30.0, .pressure_xy_of_collisions = -0.5, .pressure_xy_of_flight = {}, .viscosity = 1.5};
  effects.bonds = 31;
  effects.energy_supplied = 0.25;
  return report;
}

TEST(RunReportOf, IsTheInverseOfTheSummary) {
  RunReport report = hand_made_report(scene_of(2, 2));
  EXPECT_EQ(again(json_of(report)), json_of(report));
  report.time_step = 0.25;
  report.stiffness = 5000.0;
  report.engine_asked = "auto";
  report.Z_note = "not yet at equilibrium";
  EXPECT_EQ(again(json_of(report)), json_of(report));
  report.Z.reset();
  report.Z_error.reset();
  report.overlap_at_start = 0.5;
  report.stopped = StopReason::collapsed;
  report.stopped_disks = {3, 5};
  report.measured = false;
  report.verification = Verification{.every = 100, .checks = 3, .faults = {"a disk is not where it should be"}};
  EXPECT_EQ(again(json_of(report)), json_of(report));
}

TEST(RunReportOf, HasAllThatEffectsDid) {
  const Json json = json_of(with_effects());
  EXPECT_EQ(again(json), json);
}

TEST(RunReportOf, TellsApartWhichEffectHasRedrawnVelocities) {
  RunReport report = with_effects();
  report.totals.thermostat = 4321 + 65 + 7;
  report.of_effects.tumbling = TumblingReport{.events = 65};
  report.of_effects.brownian = ThermostatReport{.events = 7, .energy = 0.5};
  const Json json = json_of(report);
  EXPECT_EQ(json.at("events").at("thermostat"), 4321);
  EXPECT_EQ(json.at("events").at("tumbling"), 65);
  EXPECT_EQ(json.at("events").at("brownian"), 7);
  EXPECT_EQ(again(json), json);
}

TEST(RunReportOf, DriftsAreRelativeToWhatTheyWereRelativeTo) {
  RunReport report = with_effects();
  report.energy_scale = 700.0;  // the parts cancel; energy goes from 32 to 32.5
  const RunReport read = run_report_of(json_of(report));
  EXPECT_DOUBLE_EQ(read.relative_energy_drift(), 0.5 / 700.0);
  EXPECT_DOUBLE_EQ(read.unaccounted_energy_drift().value(), 0.25 / 700.0);
  report.energy_final = report.energy_initial;
  EXPECT_DOUBLE_EQ(run_report_of(json_of(report)).unaccounted_energy_drift().value(), -0.25 / 700.0);
}

TEST(RunReportOf, EveryReasonToStopIsKnown) {
  RunReport report = hand_made_report(scene_of(2, 2));
  for (const StopReason reason :
       {StopReason::time, StopReason::collisions, StopReason::interrupted, StopReason::jammed, StopReason::collapsed,
        StopReason::cooled, StopReason::grown, StopReason::no_collisions, StopReason::invalid_state}) {
    report.stopped = reason;
    EXPECT_EQ(run_report_of(json_of(report)).stopped, reason);
  }
}

TEST(RunReportOf, OtherJsonIsRefused) {
  EXPECT_THROW((void)run_report_of(Json::object()), Json::exception);
  Json json = json_of(hand_made_report(scene_of(2, 2)));
  json["stopped"] = "tired";
  EXPECT_THROW((void)run_report_of(json), Json::exception);
  json["stopped"] = 7;
  EXPECT_THROW((void)run_report_of(json), Json::exception);
}

const std::string observed = R"(
title = "Two kinds"
[box]
x = [0.0, 8.0]
y = [0.0, 8.0]
boundary = "periodic"
[[disks]]
name = "large"
count = 9
radius = 0.4
mass = 2.0
positions = "random"
velocities = { temperature = 1.0 }
[[disks]]
name = "small"
count = 9
radius = 0.2
mass = 0.5
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[run]
time = 20.0
sample_every = 0.01
seed = 4
[observe]
temperature = true
speeds = { bins = 20 }
)";

class RunRecordTest : public ::testing::Test {
 protected:
  [[nodiscard]] RunRecord recorded(const std::vector<std::string>& overrides = {}) const {
    record(parse_scene(observed, "observed.toml", overrides), run_);
    return read_run_record(run_);
  }
  [[nodiscard]] std::string refusal() const {
    return test::refusal<OutputError>([&] { return read_run_record(run_); });
  }

  TemporaryDirectory directory_;
  std::filesystem::path run_ = directory_.path() / "run";
};

TEST_F(RunRecordTest, HasNumbersAndTablesOfWhatWasObserved) {
  const RunRecord record = recorded();
  ASSERT_EQ(record.report.observables.size(), 2U);
  const Measurement &temperature = record.report.observables[0], &speeds = record.report.observables[1];
  EXPECT_EQ(temperature.name, "temperature");
  EXPECT_EQ(temperature.scalars.front().name, "kT");
  EXPECT_EQ(temperature.scalars.front().unit, "energy");
  // Energy and momentum are kept, and with them this temperature; it was drawn to be 1 with the common motion in it.
  EXPECT_NEAR(temperature.scalars.front().value.value(), record.report.temperature_mean, 1e-12);
  ASSERT_EQ(speeds.tables.size(), 2U);
  const Table& table = speeds.tables.front();
  EXPECT_EQ(table.name, "speeds");
  ASSERT_EQ(table.columns.size(), 7U);
  EXPECT_EQ(table.columns[0].name, "middle");
  EXPECT_EQ(table.columns[0].unit, "length / time");
  EXPECT_EQ(table.columns[3].name, "density_large");
  // Every disk is in some bin: densities times the width of a bin come to 1.
  const double width = table.columns[0].values[1] - table.columns[0].values[0];
  double sum = 0.0;
  for (const double density : table.columns[1].values) sum += density * width;
  EXPECT_NEAR(sum, 1.0, 1e-2) << "but for those that are faster than the last bin";
}

TEST_F(RunRecordTest, HasTheSceneAndAThousandSamplesAtMost) {
  const RunRecord record = recorded({"run.seed=9"});
  ASSERT_TRUE(record.source);
  EXPECT_EQ(record.source->text, observed);
  EXPECT_EQ(record.source->overrides, std::vector<std::string>{"run.seed=9"});
  EXPECT_EQ(parse_scene(record.source->resolved).run.seed, 9U);
  EXPECT_THAT(record.source->species, ElementsAre("large", "small"));
  EXPECT_EQ(record.source->disks.count(), 18U);
  EXPECT_EQ(record.source->samples, 2001U);
  ASSERT_EQ(record.source->times.size(), 667U);  // every third
  EXPECT_EQ(record.source->times[2], 0.06);
  ASSERT_EQ(record.source->sampled.size(), 4U);
  EXPECT_EQ(record.source->sampled[0].name, "kinetic_energy");
  EXPECT_EQ(record.source->sampled[0].values.size(), 667U);
  EXPECT_EQ(record.command_line, "in a test");
}

TEST_F(RunRecordTest, WithoutATrajectoryItHasTheSummaryAndItsScene) {
  (void)recorded();
  std::filesystem::remove(run_ / "trajectory.h5md");
  const RunRecord record = read_run_record(run_);
  EXPECT_FALSE(record.has_trajectory);
  EXPECT_EQ(record.report.title, "Two kinds");
  EXPECT_EQ(record.report.observables.size(), 2U);
  ASSERT_TRUE(record.source);
  EXPECT_EQ(record.source->disks.count(), 18U);
  EXPECT_EQ(record.source->disks.mass[17], 0.5);
  EXPECT_THAT(record.source->species, ElementsAre("large", "small"));
  EXPECT_EQ(record.source->samples, 0U);
}

TEST_F(RunRecordTest, DamagedFilesAreRefusedInOneSentence) {
  (void)recorded();
  const std::string summary = text_of(run_ / "summary.json"), trajectory = text_of(run_ / "trajectory.h5md");
  write_text(run_ / "summary.json", summary.substr(0, 200));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("summary.json: "), HasSubstr("damaged or cut short")));
  write_text(run_ / "summary.json", "{\"time\": 3}");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("summary.json: "), HasSubstr("damaged or cut short")));
  write_text(run_ / "summary.json", summary);
  write_text(run_ / "trajectory.h5md", trajectory.substr(0, trajectory.size() / 2));
  EXPECT_THAT(refusal(), AllOf(HasSubstr("trajectory.h5md: "), HasSubstr("damaged or cut short")));
  std::filesystem::remove(run_ / "trajectory.h5md");
  std::filesystem::create_directory(run_ / "trajectory.h5md");
  EXPECT_THAT(refusal(), HasSubstr("trajectory.h5md: this is a directory, and a file is to be there"));
}

}  // namespace
}  // namespace carom::test
