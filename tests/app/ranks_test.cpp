// mpirun carom run as a user meets it: one run with the files of one core, whatever happens to it, and one sentence where
// something is wrong. tests/network has the same on hosts that reach each other by a network alone.

#include "support/shared_out_run.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// The process among the children of mpirun that has this rank; 0 where there is none yet.
pid_t process_of_rank(pid_t mpirun, int rank) {
  std::ifstream children("/proc/" + std::to_string(mpirun) + "/task/" + std::to_string(mpirun) + "/children");
  const std::string wanted = "OMPI_COMM_WORLD_RANK=" + std::to_string(rank);
  for (pid_t child = 0; children >> child;) {
    std::ifstream file("/proc/" + std::to_string(child) + "/environ");
    for (std::string variable; std::getline(file, variable, '\0');)
      if (variable == wanted) return child;
  }
  return 0;
}

class RanksOfRunCommand : public SharedOutRunTest {
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
    return run_program(directory_.path(), {"env", "OMPI_COMM_WORLD_SIZE=2", "OMPI_COMM_WORLD_RANK=" + rank, CAROM_PROGRAM, "run",
                                           "gas.toml", "--out", "apart"});
  }
  Outcome mpirun(const std::string& processes, const std::vector<std::string>& arguments,
                 const std::function<void(pid_t)>& meanwhile = {}) {
    std::vector<std::string> words = {"mpirun", "-n", processes, CAROM_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_program(directory_.path(), words, meanwhile);
  }
  /// Exit code 2, and this sentence, which one process says.
  void refused_once(const Outcome& outcome, const std::string& sentence) {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
    const std::size_t first = outcome.err.find("carom: ");
    EXPECT_EQ(outcome.err.find("\ncarom: ", first), std::string::npos) << outcome.err;
  }
};

TEST_F(RanksOfRunCommand, GiveTheFilesOfOneCore) {
  const std::vector<std::string> more = {"-q", "--events", "--set", "observe.pressure=true"};
  const auto arguments = [&](const std::string& out, const std::string& threads) {
    std::vector<std::string> all = {"run", "gas.toml", "--out", out, "--threads", threads};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ASSERT_EQ(carom(arguments("one", "1")).exit_code, 0);
  for (const std::string processes : {"2", "3"}) {
    const Outcome outcome = mpirun(processes, arguments("on" + processes, processes == "2" ? "2" : "auto"));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_same_results("one", "on" + processes);
  }
  const json cores = summary("on2")["cores"];
  EXPECT_EQ(cores["threads"], 2);
  EXPECT_EQ(cores["ranks"], 2);
  EXPECT_EQ(cores["domains"], 4);
  EXPECT_GT(cores["windows"], 10);
  EXPECT_EQ(summary("on3")["cores"]["domains"], 3);
  EXPECT_THAT(carom({"info", "on2/summary.json"}).out, HasSubstr("2 in each of 2 processes"));
  EXPECT_EQ(carom({"verify", "on3"}).exit_code, 0);
  EXPECT_EQ(mpirun("2", {"verify", "one"}).exit_code, 0) << "the run again, by both, which the first compares";
}

TEST_F(RanksOfRunCommand, SayMistakesOnce) {
  refused_once(mpirun("3", {"run", "gone.toml"}), "gone.toml: there is no such file");
  refused_once(mpirun("2", {"run", "gas.toml", "--set", "disks.0.radius=-1.0"}), "radius");
  refused_once(mpirun("2", {"run", "gas.toml", "--set", "drag.rate=1.0"}),
               "carom: gas.toml: only one process can compute this run, for drag slows the clock, and MPI has "
               "started 2; start one without it");
  refused_once(mpirun("2", {"run", "gas.toml", "--threads", "33"}), "--threads 33: give auto, or a number from 1 to 32");
  refused_once(mpirun("1", {"run", "gas.toml", ":", "-n", "1", CAROM_PROGRAM, "run", "gas.toml", "--force"}),
               "carom: MPI connects 2 processes, which compute one run together, and they were given different commands");
  EXPECT_FALSE(fs::exists(file("gas")));
}

TEST_F(RanksOfRunCommand, ThatMpiDoesNotConnectDoNotDoEverythingTwice) {
  const Outcome first = started_alone_of_two("0"), second = started_alone_of_two("1");
  EXPECT_EQ(first.exit_code, 2);
  EXPECT_THAT(first.err, StartsWith("carom: this is one of 2 processes, and "));
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_THAT(second.err, IsEmpty());
  EXPECT_FALSE(fs::exists(file("apart")));
}

TEST_F(RanksOfRunCommand, MayBeOthersWhereARunGoesOn) {
  ASSERT_EQ(run("whole", {"-q", "--threads", "1"}).exit_code, 0);
  int code = mpirun("2", {"run", "gas.toml", "--out", "parts", "-q", "--walltime", "0.05s"}).exit_code;
  std::size_t part = 0;
  for (; code == 130 && part < 100; ++part) {
    const std::string longer_and_longer = std::to_string(1 + part / 2) + "e-1s";
    code = part % 2 == 0 ? carom({"resume", "parts", "-q", "--threads", "2", "--walltime", longer_and_longer}).exit_code
                         : mpirun("3", {"resume", "parts", "-q", "--walltime", longer_and_longer}).exit_code;
  }
  EXPECT_EQ(code, 0);
  EXPECT_GT(part, 0U) << "the run was over before it could be stopped";
  expect_same_results("whole", "parts");
}

TEST_F(RanksOfRunCommand, StopAtASignalAndAreSaved) {
  const Outcome stopped = mpirun("2", {"run", "gas.toml", "--out", "stopped", "--set", "run.time=1e6"}, [&](pid_t child) {
    (void)wait_until([&] { return fs::exists(file("stopped/trajectory.h5md.partial")); });
    ::kill(child, SIGUSR1);  // which mpirun hands on to all
  });
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr(" resume stopped goes on from there"));
  EXPECT_EQ(summary("stopped")["stopped"], "interrupted");
  EXPECT_TRUE(fs::exists(file("stopped/checkpoint.h5")));
}

TEST_F(RanksOfRunCommand, GoOnInOtherNumbersAfterOneWasKilled) {
  const std::vector<std::string> longer = {"-q", "--set", "run.time=20.0"};
  std::vector<std::string> saving = longer, alone = longer;
  saving.insert(saving.begin(), {"run", "gas.toml", "--out", "killed", "--force", "--checkpoint-every", "20000 collisions"});
  alone.insert(alone.end(), {"--threads", "1"});
  ASSERT_EQ(run("whole", alone).exit_code, 0);
  for (const int rank : {1, 0}) {
    saving[3] = "killed" + std::to_string(rank);
    const Outcome killed = ended_early([&] {
      return mpirun("2", saving, [&](pid_t child) {
        pid_t victim = 0;
        (void)wait_until([&] {
          if (victim == 0) victim = process_of_rank(child, rank);
          return fs::exists(file(saving[3] + "/checkpoint-previous.h5"));
        });
        if (victim > 0) ::kill(victim, SIGKILL);
      });
    });
    ASSERT_NE(killed.exit_code, 0);
    EXPECT_THAT(killed.err, HasSubstr("exited on signal 9"));
    if (rank == 1) {
      EXPECT_THAT(killed.err,
                  HasSubstr("about to stop, and waiting for another process; should that have failed, and MPI end the run, "));
      EXPECT_THAT(killed.err, HasSubstr(" resume killed1 goes on from where it was saved last"));
    }
    const Outcome resumed =
        rank == 1 ? carom({"resume", saving[3], "-q", "--threads", "1"}) : mpirun("3", {"resume", saving[3], "-q"});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    expect_same_results("whole", saving[3]);
  }
}

/// carom started as one of two processes, installed below a prefix of its own.
class OneOfTwoRunCommand : public SharedOutRunTest {
 protected:
  void SetUp() override {
    for (const char* folder : {"prefix/bin", "prefix/libexec/carom"}) fs::create_directories(file(folder));
    fs::copy_file(CAROM_PROGRAM, file("prefix/bin/carom"));
  }
  Outcome started(const std::string& processes) {
    return run_program(directory_.path(), {"env", "OMPI_COMM_WORLD_SIZE=" + processes, "OMPI_COMM_WORLD_RANK=0",
                                           file("prefix/bin/carom"), "run", "gas.toml", "--out", "a place", "-q"});
  }
};

TEST_F(OneOfTwoRunCommand, IsRefusedWithoutCaromMpi) {
  const Outcome outcome = started("2");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, StartsWith("carom: this is one of 2 processes, and this carom is built without MPI"));
  EXPECT_THAT(outcome.err, HasSubstr("install the package carom-mpi"));
  EXPECT_FALSE(fs::exists(file("a place")));
}

TEST_F(OneOfTwoRunCommand, IsCaromMpiWithTheSameArgumentsAndOneAloneIsNot) {
  const fs::path mpi = file("prefix/libexec/carom/carom-mpi");
  write_text(mpi, "#!/bin/sh\nprintf '%s|' with MPI: \"$@\"\nexit 7\n");
  fs::permissions(mpi, fs::perms::owner_all);
  const Outcome one_of_two = started("2");
  EXPECT_EQ(one_of_two.exit_code, 7);
  EXPECT_EQ(one_of_two.out, "with|MPI:|run|gas.toml|--out|a place|-q|");
  EXPECT_EQ(started("1").exit_code, 0);
  EXPECT_TRUE(fs::exists(file("a place/summary.json")));
}

}  // namespace
}  // namespace carom::test
