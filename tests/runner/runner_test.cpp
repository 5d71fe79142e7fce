// A run with its files, its checkpoints and its page, made by the library alone.

#include "runner/runner.hpp"
#include "runner/resumed_run.hpp"

#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <carom/scene.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Scene gas(double time = 40.0) {
  Scene scene = parse_scene(R"(
[box]
x = [0.0, 12.0]
y = [0.0, 12.0]
boundary = "periodic"

[[disks]]
count = 40
radius = 0.5
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }

[collision]
rule = "specular"

[run]
time = 40.0
sample_every = 1.0
seed = 7

[observe]
pressure = true

[output]
csv = true
)");
  scene.run.time = time;
  return scene;
}

Provenance provenance_of(const Simulation& simulation) {
  return {.resolved_scene = resolved_toml(simulation.scene()), .command_line = "", .engine = simulation.engine()};
}

struct Finished {
  RunnerOutcome outcome;
  bool saved = false;
};

/// Runs the gas into the directory, and stops it after that many questions whether to go on, which come several times a second.
Finished run_gas(const std::filesystem::path& path, RunnerOptions options, double time = 40.0,
                 std::optional<int> questions = {}) {
  Simulation simulation = make_simulation(gas(time));
  const RunDirectory directory(path, false);
  Runner runner(simulation, &directory, provenance_of(simulation), std::move(options));
  RunnerHooks hooks;
  if (questions) hooks.proceed = [&](const Progress&) { return --*questions > 0; };
  RunnerOutcome outcome = runner.run(hooks);
  return {std::move(outcome), runner.saved_now()};
}

/// Runs the gas with no files at all.
std::string plain_hash() {
  Simulation simulation = make_simulation(gas());
  (void)run_schedule(simulation);
  return state_hash(simulation.state());
}

TEST(Runner, WritesAllFilesOfARunAndPrintsNothing) {
  const TemporaryDirectory place;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const Finished done = run_gas(place.path() / "gas", {.threads = 1, .report = true});
  EXPECT_THAT(::testing::internal::GetCapturedStdout(), IsEmpty());
  EXPECT_THAT(::testing::internal::GetCapturedStderr(), IsEmpty());
  EXPECT_EQ(done.outcome.report.state_hash, plain_hash());
  EXPECT_EQ(done.outcome.report.observables.size(), 1U);
  EXPECT_FALSE(done.outcome.report_failed);
  EXPECT_FALSE(done.saved);
  for (const char* name : {"trajectory.h5md", "summary.json", "report.html"}) {
    EXPECT_THAT(done.outcome.files, Contains(name));
    EXPECT_TRUE(std::filesystem::exists(place.path() / "gas" / name)) << name;
  }
  EXPECT_THAT(text_of(place.path() / "gas/summary.json"), HasSubstr(plain_hash()));
}

TEST(Runner, SavesARunThatIsStoppedAndGoesOnToTheSameBits) {
  const TemporaryDirectory place;
  const double time = 4000.0;  // half a million collisions, so that the first question comes before the end
  const Finished whole = run_gas(place.path() / "whole", {.threads = 1}, time);
  const Finished part = run_gas(place.path() / "part", {.threads = 1}, time, 1);
  EXPECT_EQ(part.outcome.report.stopped, StopReason::interrupted);
  EXPECT_LT(part.outcome.report.time, time);
  ASSERT_TRUE(part.saved);
  const RunDirectory directory = RunDirectory::reopen(place.path() / "part");
  const Checkpoint from(directory.path());
  std::optional<Simulation> simulation;
  from.read("simulation", [&](std::istream& in) { simulation.emplace(restore_simulation(gas(time), in)); });
  Runner runner(*simulation, &directory, from.facts().provenance, {.threads = 1}, &from);
  EXPECT_TRUE(runner.saved());
  const RunnerOutcome rest = runner.run();
  EXPECT_EQ(rest.report.state_hash, whole.outcome.report.state_hash);
  EXPECT_EQ(text_of(place.path() / "part/samples.csv"), text_of(place.path() / "whole/samples.csv"));
}

TEST(Runner, HandsTheStartOfTheMeasuredRunToTheHookThatCompletesTheReport) {
  const TemporaryDirectory place;
  Simulation simulation = make_simulation(gas());
  const State start = simulation.state();
  const RunDirectory directory(place.path() / "gas", false);
  Runner runner(simulation, &directory, provenance_of(simulation), {.threads = 1, .keep_start = true});
  int calls = 0;
  const RunnerOutcome outcome = runner.run({.complete = [&](RunReport& report, const State& handed) {
    ++calls;
    EXPECT_EQ(state_hash(handed), state_hash(start));
    report.title = "completed";
  }});
  EXPECT_EQ(calls, 1);
  EXPECT_THAT(text_of(place.path() / "gas/summary.json"), HasSubstr("completed"));
}

TEST(Runner, SaysThatAReportFailedAndKeepsTheRun) {
  const TemporaryDirectory place;
  std::filesystem::create_directories(place.path() / "gas/report.html.partial");
  const RunDirectory directory = RunDirectory::reopen(place.path() / "gas");
  Simulation simulation = make_simulation(gas());
  Runner runner(simulation, &directory, provenance_of(simulation), {.threads = 1, .report = true});
  const RunnerOutcome outcome = runner.run();
  EXPECT_TRUE(outcome.report_failed);
  EXPECT_THAT(outcome.files, Contains("summary.json"));
  EXPECT_THAT(outcome.files, Not(Contains("report.html")));
}

TEST(Runner, RefusesAPlanThatIsNone) {
  const TemporaryDirectory place;
  Simulation simulation = make_simulation(gas());
  const RunDirectory directory(place.path() / "gas", false);
  EXPECT_THROW(Runner(simulation, &directory, provenance_of(simulation), {.checkpoint_every = "now and then"}),
               std::invalid_argument);
}

TEST(Runner, WithoutADirectoryHasTheSameReportAndWritesNothing) {
  const TemporaryDirectory temporary;
  const Finished written = run_gas(temporary.path() / "run", {.threads = 1});
  Simulation simulation = make_simulation(gas());
  std::vector<double> times;
  const RunnerOutcome outcome = Runner(simulation, nullptr, provenance_of(simulation), {.checkpoint_every = "1s", .report = true})
                                    .run({.sample = [&](const State& state, const Totals&) { times.push_back(state.time); }});
  EXPECT_EQ(outcome.report.state_hash, written.outcome.report.state_hash);
  EXPECT_EQ(outcome.report.Z, written.outcome.report.Z);
  EXPECT_THAT(outcome.files, IsEmpty());
  EXPECT_EQ(times.size(), outcome.report.samples);
  EXPECT_EQ(times.back(), 40.0);
}

/// Counts samples; saved and continued.
class SampleCount final : public Observable {
 public:
  [[nodiscard]] std::string name() const override { return "sample_count"; }
  [[nodiscard]] double step() const override { return 0.5; }
  void sample(const State&, const Totals&) override { ++count_; }
  void save(std::ostream& out) const override { out << count_ << '\n'; }
  void load(std::istream& in) override { in >> count_; }
  Measurement finish(double, const Totals&) override { return {.name = name(), .scalars = {{.name = "count", .value = count_}}}; }

 private:
  double count_ = 0.0;
};

TEST(Runner, ObservablesOfTheProgramAreMeasuredAndGoOnFromACheckpoint) {
  const RunnerOptions options = {.observe = [](Observation& observation) { observation.add(std::make_unique<SampleCount>()); }};
  const TemporaryDirectory temporary;
  const Finished stopped = run_gas(temporary.path() / "run", options, 1e7, 2);
  ASSERT_TRUE(stopped.saved);
  const auto counted = [](const RunReport& report) { return report.observables.back().scalars.front().value.value_or(0.0); };
  const double before = counted(stopped.outcome.report);
  EXPECT_EQ(before, std::floor(stopped.outcome.report.time / 0.5) + 1.0);

  const double end = std::ceil(stopped.outcome.report.time) + 10.0;
  const ResumedRun resumed(temporary.path() / "run", {.time = end});
  resumed.check_end({.time = end});
  Simulation simulation = resumed.simulation();
  Runner runner(simulation, &resumed.directory, resumed.provenance(), options, &resumed.from);
  EXPECT_EQ(counted(runner.run().report), end / 0.5 + 1.0);
}

}  // namespace
}  // namespace carom::test
