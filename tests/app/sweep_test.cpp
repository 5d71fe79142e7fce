// carom sweep: the same bytes however its runs are spread and however often it is killed; what fails, what is refused.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

namespace fs = std::filesystem;

const std::string sweep_text = "scene = \"gas.toml\"\nseeds = 2\n[grid]\ndisks.0.radius = [0.1, 0.2, 0.3]\n";

using Bytes = std::map<std::string, std::string>;

class SweepCommand : public ProgramTest {
 protected:
  SweepCommand() : ProgramTest(fifty_disks) { write_text(file("gas-sweep.toml"), sweep_text); }

  Outcome sweep(const std::vector<std::string>& options = {}, const std::function<void(pid_t)>& meanwhile = {}) {
    std::vector<std::string> arguments = {"sweep", "gas-sweep.toml"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return carom(arguments, meanwhile);
  }
  /// What the sweep makes of its runs.
  [[nodiscard]] Bytes results() const {
    Bytes bytes;
    for (const char* name : {"runs.csv", "sweep.csv", "columns.csv", "sweep.h5", "report.html"})
      bytes[name] = text_of(file(std::string("gas-sweep/") + name));
    return bytes;
  }
  [[nodiscard]] std::ptrdiff_t finished_runs() const {
    std::error_code none;
    std::ptrdiff_t count = 0;
    for (auto entry = fs::recursive_directory_iterator(file("gas-sweep"), none); entry != fs::recursive_directory_iterator();
         entry.increment(none))
      count += entry->path().filename() == "summary.json" ? 1 : 0;
    return count;
  }
  [[nodiscard]] std::vector<fs::path> checkpoints() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(file("gas-sweep")))
      if (entry.path().filename() == "checkpoint.h5") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }
  void clear() const { fs::remove_all(file("gas-sweep")); }
};

/// Those that run many processes carry the label of their name's beginning.
class ScenesSweep : public SweepCommand {};

/// Runs that take some tenths of a second each, so that they can be met at work.
class ScenesLongSweep : public SweepCommand {
 protected:
  ScenesLongSweep() { write_text(file("gas-sweep.toml"), sweep_text + "[set]\nrun.time = 600.0\noutput.trajectory = false\n"); }
};

TEST_F(ScenesSweep, WritesTablesAndPageAndGivesTheSameBytesForAnyNumberOfThreads) {
  const Outcome outcome = sweep({"--threads", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, AllOf(StartsWith("gas.toml: 3 points with 2 seeds each"), HasSubstr("\n  radius=0.1 "),
                                 HasSubstr("pressure.Z"), HasSubstr("Files in gas-sweep: ")));
  const Bytes one = results();
  for (const auto& [name, bytes] : one) EXPECT_THAT(bytes, Not(IsEmpty())) << name;
  EXPECT_EQ(std::count(one.at("sweep.csv").begin(), one.at("sweep.csv").end(), '\n'), 1 + 3);
  EXPECT_EQ(std::count(one.at("runs.csv").begin(), one.at("runs.csv").end(), '\n'), 1 + 6);
  for (const char* threads : {"2", "3"}) {
    clear();
    ASSERT_EQ(sweep({"--threads", threads, "-q"}).exit_code, 0);
    EXPECT_EQ(results(), one) << threads;
  }
}

TEST_F(ScenesSweep, FinishedRunsNeverRunAgain) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes before = results();
  const fs::path summary = file("gas-sweep/radius=0.1/seed=1/summary.json"),
                 other = file("gas-sweep/radius=0.2/seed=2/summary.json");
  const auto written = fs::last_write_time(summary);
  fs::remove(other);
  EXPECT_EQ(sweep({"-q"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(other));
  EXPECT_EQ(fs::last_write_time(summary), written);
  EXPECT_EQ(results(), before);
}

TEST_F(ScenesSweep, ARunIsThatOfItsSceneAndSeedByItself) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "--set", "disks.0.radius=0.2", "--seed", "2", "-q", "--no-trajectory"}).exit_code, 0);
  const auto virial = [&](const std::string& summary) {
    const std::string text = text_of(file(summary));
    return text.substr(text.find("\"virial\""), 40);
  };
  EXPECT_EQ(virial("gas-sweep/radius=0.2/seed=2/summary.json"), virial("gas/summary.json"));
}

TEST_F(ScenesSweep, ARunThatFailsIsListedAndStopsNoOther) {
  const fs::path obstacle = file("gas-sweep/radius=0.2/seed=1/trajectory.h5md");
  fs::create_directories(obstacle);
  const Outcome outcome = sweep();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("1 run failed:\n  radius=0.2/seed=1: gas-sweep/radius=0.2/seed=1/trajectory.h5md: a "
                                           "directory is where a result belongs"),
                                 HasSubstr("Files in")));
  EXPECT_EQ(outcome.err, "carom: gas-sweep.toml: 1 of 6 runs failed, as runs.csv says; the same command tries them again\n");
  EXPECT_EQ(finished_runs(), 5);
  EXPECT_THAT(results()["runs.csv"], HasSubstr("radius=0.2/seed=1,failed,,"));
  EXPECT_THAT(results()["report.html"], HasSubstr("Failed runs"));
  fs::remove(obstacle);
  EXPECT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes mended = results();
  clear();
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  EXPECT_EQ(results(), mended);
}

TEST_F(ScenesSweep, TheTableOnTheTerminalSaysWhichColumnsItLeavesOut) {
  write_text(file("wide.toml"),
             "scene = \"gas.toml\"\ntable = [\"time\", \"pressure.Z\", \"temperature.mean\", \"packing_fraction\", "
             "\"energy.initial\", \"energy.final\"]\n[grid]\ndisks.0.radius = [0.1, 0.2]\n");
  const Outcome outcome = carom({"sweep", "wide.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("  not shown, but in sweep.csv: energy.initial, energy.final\n"));
}

TEST_F(ScenesSweep, TheTableOnTheTerminalHasNoColumnTwice) {
  write_text(file("seen.toml"), std::string(fifty_disks) + "[observe]\npressure = true\n");
  write_text(file("seen-sweep.toml"), "scene = \"seen.toml\"\n[grid]\ndisks.0.radius = [0.1, 0.2]\n");
  const Outcome outcome = carom({"sweep", "seen-sweep.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t first = outcome.out.find("observables.pressure.Z ");
  ASSERT_NE(first, std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("observables.pressure.Z ", first + 1), std::string::npos) << outcome.out;
}

TEST_F(ScenesSweep, InfoTellsWhatASweepHasLeft) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Outcome whole = carom({"info", "gas-sweep"});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_THAT(whole.out, AllOf(StartsWith("gas-sweep/sweep.h5: results of a sweep\n"), HasSubstr("gas.toml\n"),
                               HasSubstr(" 3, of disks.0.radius\n"), HasSubstr(" 6, 6 finished\n"), HasSubstr("pressure.Z"),
                               HasSubstr("sweep.csv: table of a sweep, a row per point\n"),
                               HasSubstr("runs.csv: table of a sweep, a row per run\n"), Not(HasSubstr("incomplete"))));
  const Outcome columns = carom({"info", "gas-sweep/columns.csv"});
  EXPECT_EQ(columns.exit_code, 0) << columns.err;
  EXPECT_THAT(columns.out, StartsWith("gas-sweep/columns.csv: units and meanings of the columns of sweep.csv and runs.csv\n"));
  const std::string bytes = text_of(file("gas-sweep/sweep.h5"));
  for (std::size_t size = 0; size < bytes.size(); size += bytes.size() / 16) {
    write_text(file("cut.h5"), bytes.substr(0, size));
    const Outcome cut = carom({"info", "cut.h5"});
    EXPECT_EQ(cut.exit_code, 2) << size << cut.out;
    EXPECT_EQ(std::count(cut.err.begin(), cut.err.end(), '\n'), 1) << size << cut.err;
  }
}

TEST_F(ScenesSweep, InfoTellsOfASweepThatWasKilled) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  for (const char* table : {"sweep.h5", "sweep.csv", "runs.csv"}) fs::remove(file("gas-sweep") / table);
  fs::remove(file("gas-sweep/radius=0.2/seed=2/summary.json"));
  const Outcome killed = carom({"info", "gas-sweep"});
  EXPECT_EQ(killed.exit_code, 0) << killed.err;
  EXPECT_THAT(killed.out, AllOf(StartsWith("gas-sweep: runs of a sweep, without its tables\n"),
                                HasSubstr(" 6 begun, 5 with results\n"), HasSubstr("the same command continues it")));
}

TEST_F(SweepCommand, WhatIsWrongIsSaidBeforeAnythingRuns) {
  const auto refused_sweep = [&](const std::string& text, const std::string& sentence) {
    write_text(file("wrong.toml"), text);
    refused({"sweep", "wrong.toml"}, sentence);
    EXPECT_FALSE(fs::exists(file("wrong")));
  };
  refused_sweep("scene = \"gas.toml\"\n[grid]\ndisks.0.radius = [0.1, 9.0]\n",
                "wrong.toml:3:24: the scene of the point radius=9.0");
  refused_sweep("scene = \"gas.toml\"\n[gird]\n", "wrong.toml:2:2: a sweep has no key \"gird\"; did you mean \"grid\"?");
  refused({"run", "gas-sweep.toml"},
          "gas-sweep.toml:1:9: this is a sweep, whose scene is in a file of its own; run it by carom sweep");
  refused({"sweep", "nowhere.toml"}, "nowhere.toml: there is no such file");
  refused({"sweep", "gas-sweep.toml", "--threads", "0"}, "--threads 0: it can be 1 to 4096");
  refused({"sweep", "gas-sweep.toml", "--progress", "often"}, "--progress often: ");
  refused({"sweep", "gas-sweep.toml", "--out", "gas.toml"}, "gas.toml: this is a file");
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  refused({"sweep", "gas-sweep.toml", "--out", "gas"}, "gas: this directory holds the results of a run, not of a sweep");
}

TEST_F(ScenesSweep, RunsOfAnotherSceneAreReplacedOnlyByForce) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes before = results();
  write_text(file("gas-sweep.toml"), sweep_text + "[set]\nrun.time = 3.0\n");
  refused({"sweep", "gas-sweep.toml"}, "gas-sweep/radius=0.1/seed=1: this directory holds a run of another scene");
  EXPECT_EQ(results(), before);
  EXPECT_EQ(sweep({"-q", "--force"}).exit_code, 0);
  EXPECT_THAT(results()["runs.csv"], HasSubstr("radius=0.1/seed=1,finished,time,"));
  EXPECT_NE(results(), before);
}

TEST_F(ScenesSweep, ListsTheCommandsOfWhatIsToDoWhichMakeTheSameRuns) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes before = results();
  EXPECT_EQ(sweep({"--list"}).out, "");
  clear();
  const Outcome listed = sweep({"--list"});
  EXPECT_EQ(listed.exit_code, 0);
  EXPECT_FALSE(fs::exists(file("gas-sweep")));
  EXPECT_EQ(std::count(listed.out.begin(), listed.out.end(), '\n'), 6);
  ASSERT_EQ(run_program(directory_.path(), {"sh", "-ec", listed.out}).exit_code, 0);
  EXPECT_EQ(sweep({"--list"}).out, "");
  EXPECT_EQ(sweep({"-q"}).exit_code, 0);
  EXPECT_EQ(results(), before);
}

TEST_F(SweepCommand, SaysWhichPointsAreThereAlready) {
  write_text(file("gas-sweep.toml"),
             "scene = \"gas.toml\"\n[grid]\n\"run.time\" = [1, 1.0]\n[[points]]\nname = \"twin\"\n\"run.time\" = 1e0\n");
  const Outcome outcome = sweep({"--list"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err,
            "carom: gas-sweep.toml: points whose scenes are there already are left out: time=1.0 (as time=1), twin (as "
            "time=1)\n");
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1) << outcome.out;
}

TEST_F(SweepCommand, ANumberOfTheTableThatNoRunHasIsNamed) {
  write_text(file("gas-sweep.toml"), "scene = \"gas.toml\"\ntable = [\"time\", \"walls.left.force\"]\n");
  const Outcome refused = sweep();  // the gas has no walls: that is known before anything runs
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, StartsWith("carom: gas-sweep.toml:2:18: table.1 is \"walls.left.force\", and no run has that number"));
  EXPECT_FALSE(fs::exists(file("gas-sweep")));
  write_text(file("gas-sweep.toml"), "scene = \"gas.toml\"\ntable = [\"time\", \"pressure.Z\"]\n[set]\nrun.time = 0.0\n");
  const Outcome outcome = sweep();  // without collisions there is no Z: that is seen afterwards
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "carom: gas-sweep.toml: no run has the number \"pressure.Z\" of the table\n");
}

TEST_F(ScenesLongSweep, InterruptedItSaysHowToGoOnAndThenGivesTheSameBytes) {
  write_text(file("gas-sweep.toml"), "scene = \"gas.toml\"\n[grid]\nrun.time = [1.0, 5000.0, 2.0]\n");
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes whole = results();
  for (const int number : {SIGINT, SIGTERM}) {
    clear();
    const Outcome stopped = sweep({"--threads", "1"}, [&](pid_t child) {
      EXPECT_TRUE(wait_until([&] { return fs::exists(file("gas-sweep/time=5000.0/seed=1/trajectory.h5md.partial")); }));
      kill(child, number);
    });
    EXPECT_EQ(stopped.exit_code, 130);
    EXPECT_THAT(stopped.err,
                AllOf(HasSubstr("gas-sweep.toml: interrupted; "), HasSubstr(" 1 of 3 runs are finished, and the same command")));
    EXPECT_THAT(results()["runs.csv"], HasSubstr(",missing,"));
    const std::vector<fs::path> saved = checkpoints();
    EXPECT_THAT(saved, Not(IsEmpty()));
    EXPECT_EQ(sweep({"-q"}).exit_code, 0);
    EXPECT_EQ(results(), whole);
    EXPECT_EQ(checkpoints(), saved);  // a run that begins anew would have removed its own
  }
}

TEST_F(ScenesLongSweep, KilledAgainAndAgainItEndsWithTheSameBytes) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes whole = results();
  clear();
  for (const std::ptrdiff_t enough : {0, 1, 3, 4}) {
    const Outcome killed = sweep({"--threads", "2"}, [&](pid_t child) {
      EXPECT_TRUE(wait_until([&] { return fs::exists(file("gas-sweep")) && finished_runs() >= enough; }));
      kill(child, SIGKILL);
    });
    EXPECT_EQ(killed.exit_code, 128 + SIGKILL);
  }
  EXPECT_EQ(sweep({"-q"}).exit_code, 0);
  EXPECT_EQ(results(), whole);
}

TEST_F(ScenesSweep, ACheckpointThatIsNoneOrOfAnotherSceneIsNotGoneOnFrom) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes whole = results();
  const fs::path damaged = file("gas-sweep/radius=0.1/seed=1"), foreign = file("gas-sweep/radius=0.2/seed=1");
  for (const fs::path& run : {damaged, foreign}) {
    fs::remove(run / "summary.json");
    write_text(run / "checkpoint.h5", "not a checkpoint");
  }
  ASSERT_EQ(carom({"run", "gas.toml", "-q", "--checkpoint-every", "1h"}).exit_code, 0);
  fs::copy_file(file("gas/checkpoint.h5"), foreign / "checkpoint.h5", fs::copy_options::overwrite_existing);
  write_text(foreign / "scene.toml", text_of(file("gas.toml")));
  EXPECT_EQ(sweep({"-q"}).exit_code, 0);
  EXPECT_EQ(results(), whole);
  EXPECT_THAT(checkpoints(), IsEmpty());
}

TEST_F(ScenesLongSweep, ARunThatCannotGoOnKeepsItsCheckpoint) {
  write_text(file("gas-sweep.toml"), "scene = \"gas.toml\"\n[grid]\nrun.time = [5000.0]\n");
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes whole = results();
  clear();
  const std::string run = "gas-sweep/time=5000.0/seed=1/";
  EXPECT_EQ(sweep({},
                  [&](pid_t child) {
                    EXPECT_TRUE(wait_until([&] { return fs::exists(file(run + "trajectory.h5md.partial")); }));
                    kill(child, SIGINT);
                  })
                .exit_code,
            130);
  const std::string saved = text_of(file(run + "checkpoint.h5"));
  ASSERT_FALSE(saved.empty());
  // No file beyond some kilobytes: what the run goes on to write does not fit.
  const Outcome full =
      run_program(directory_.path(), {"sh", "-c", "ulimit -f 16; exec \"$0\" sweep gas-sweep.toml -q", CAROM_PROGRAM});
  EXPECT_NE(full.exit_code, 0);
  EXPECT_EQ(text_of(file(run + "checkpoint.h5")), saved);
  EXPECT_EQ(sweep({"-q"}).exit_code, 0);
  EXPECT_EQ(results(), whole);
}

TEST_F(ScenesSweep, RunsSaveThemselvesWhereAskedTo) {
  refused({"sweep", "gas-sweep.toml", "--checkpoint-every", "often"}, "--checkpoint-every");
  ASSERT_EQ(sweep({"-q", "--checkpoint-every", "1h"}).exit_code, 0);
  EXPECT_EQ(checkpoints().size(), 6U);
}

TEST_F(ScenesLongSweep, TwoAtATimeAreRefusedAndAKillLeavesNoRunAtWork) {
  write_text(file("gas-sweep.toml"), sweep_text + "[set]\nrun.time = 1e6\noutput.trajectory = false\n");
  const Outcome killed = sweep({"--threads", "2"}, [&](pid_t child) {
    EXPECT_TRUE(wait_until([&] { return fs::exists(file("gas-sweep/radius=0.1/seed=2/scene.toml")); }));
    refused({"sweep", "gas-sweep.toml"}, "gas-sweep: another process is writing into this directory");
    kill(child, SIGKILL);
  });
  EXPECT_EQ(killed.exit_code, 128 + SIGKILL);
  // Runs hold the lock as long as they live: a run that gets it is alone.
  write_text(file("gas-sweep.toml"), sweep_text);
  const Outcome next = sweep({"-q"});
  EXPECT_EQ(next.exit_code, 0) << next.err;
}

/// Under mpirun.
class ScenesSweepUnderMpi : public ScenesLongSweep {
 protected:
  void SetUp() override {
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    if (started_alone_of_two("0").err.find("built without MPI") != std::string::npos)
      GTEST_SKIP() << "carom is built without MPI";
    if (run_program(directory_.path(), {"mpirun", "--version"}).exit_code == 127) GTEST_SKIP() << "there is no mpirun";
  }
  Outcome started_alone_of_two(const std::string& rank) {
    return run_program(directory_.path(), {"env", "OMPI_COMM_WORLD_SIZE=2", "OMPI_COMM_WORLD_RANK=" + rank, CAROM_PROGRAM,
                                           "sweep", "gas-sweep.toml"});
  }
  Outcome sweep_of(const std::string& processes, const std::vector<std::string>& options = {},
                   const std::function<void(pid_t)>& meanwhile = {}) {
    std::vector<std::string> words = {"mpirun", "-n", processes, CAROM_PROGRAM, "sweep", "gas-sweep.toml"};
    words.insert(words.end(), options.begin(), options.end());
    return run_program(directory_.path(), words, meanwhile);
  }
};

TEST_F(ScenesSweepUnderMpi, AnyNumberOfProcessesGivesTheSameBytes) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes alone = results();
  for (const char* processes : {"2", "3"}) {
    clear();
    const Outcome outcome = sweep_of(processes, {"-q", "--threads", "2"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(results(), alone) << processes;
  }
}

TEST_F(ScenesSweepUnderMpi, FailuresAndMistakesEndAllProcesses) {
  fs::create_directories(file("gas-sweep/radius=0.2/seed=1/summary.json"));
  EXPECT_EQ(sweep_of("3").exit_code, 1);
  EXPECT_EQ(finished_runs(), 6);  // with the directory of that name
  EXPECT_THAT(results()["runs.csv"], HasSubstr("radius=0.2/seed=1,failed,,"));
  write_text(file("gas-sweep.toml"), "scene = \"gone.toml\"\n");
  const Outcome mistaken = sweep_of("3");
  EXPECT_EQ(mistaken.exit_code, 2);
  EXPECT_THAT(mistaken.err, HasSubstr("gone.toml: there is no such file"));
}

TEST_F(ScenesSweepUnderMpi, KilledItGoesOnAlone) {
  ASSERT_EQ(sweep({"-q"}).exit_code, 0);
  const Bytes whole = results();
  clear();
  const Outcome killed = sweep_of("2", {"-q"}, [&](pid_t child) {
    EXPECT_TRUE(wait_until([&] { return finished_runs() > 1; }));
    kill(child, SIGTERM);
  });
  EXPECT_NE(killed.exit_code, 0);
  EXPECT_EQ(sweep({"-q"}).exit_code, 0);
  EXPECT_EQ(results(), whole);
}

TEST_F(ScenesSweepUnderMpi, ProcessesThatMpiDoesNotConnectDoNotDoEverythingTwice) {
  const Outcome first = started_alone_of_two("0"), second = started_alone_of_two("1");
  EXPECT_EQ(first.exit_code, 2);
  EXPECT_THAT(first.err, StartsWith("carom: this is one of 2 processes, and "));
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_THAT(second.err, IsEmpty());
  EXPECT_FALSE(fs::exists(file("gas-sweep")));
}

}  // namespace
}  // namespace carom::test
