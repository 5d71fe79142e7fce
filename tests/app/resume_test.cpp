// carom resume and carom extend as a user meets them: killed at any moment and resumed, a run ends with the files of one that
// nothing happened to.

#include "support/program_test.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

const std::string observed =
    "collisions = 30000\n[output]\nxyz = true\ncsv = true\nevents = true\n[observe]\npressure = true\nviscosity = true\n";

/// Without an end of its own.
std::string without_time(std::string scene) { return scene.erase(scene.find("time = 2.0"), 11); }

class Resume : public ProgramTest {
 protected:
  Resume() : ProgramTest(without_time(fifty_disks) + observed) {}

  /// Kills the program as soon as `ready`.
  Outcome kill_when(const std::vector<std::string>& arguments, int signal, const std::function<bool()>& ready) {
    return carom(arguments, [&](pid_t child) {
      (void)wait_until(ready);
      ::kill(child, signal);
    });
  }
  [[nodiscard]] bool is_there(const std::string& name) const { return fs::exists(file(name)); }

  void expect_same_files(const std::string& a, const std::string& b) {
    for (const char* name : {"trajectory.xyz", "samples.csv"})
      EXPECT_TRUE(text_of(file(a) / name) == text_of(file(b) / name)) << name;
    EXPECT_EQ(results(a), results(b));
    EXPECT_TRUE(is_there(b + "/trajectory.h5md"));
    EXPECT_FALSE(is_there(b + "/trajectory.h5md.partial"));
  }
};

TEST_F(Resume, AfterSigkillEndsWithTheSameFiles) {
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "whole", "-q"}).exit_code, 0);
  const std::vector<std::string> run = {"run", "gas.toml",           "--out",          "killed", "--force",
                                        "-q",  "--checkpoint-every", "5000 collisions"};
  const Outcome killed =
      ended_early([&] { return kill_when(run, SIGKILL, [&] { return is_there("killed/checkpoint-previous.h5"); }); });
  ASSERT_EQ(killed.exit_code, 128 + SIGKILL);
  EXPECT_FALSE(is_there("killed/summary.json"));
  const Outcome resumed = carom({"resume", "killed"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("going on from time"));
  expect_same_files("whole", "killed");
  const Outcome verified = carom({"verify", "killed"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
}

TEST_F(Resume, AfterASignalItSaysHow) {
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "whole", "-q", "--set", "run.collisions=120000"}).exit_code, 0);
  const Outcome stopped = ended_early([&] {
    return kill_when({"run", "gas.toml", "--out", "stopped", "--force", "--set", "run.collisions=120000"}, SIGTERM,
                     [&] { return is_there("stopped/trajectory.h5md.partial"); });
  });
  ASSERT_EQ(stopped.exit_code, 130);
  EXPECT_THAT(stopped.err, HasSubstr(" resume stopped goes on from there"));
  EXPECT_EQ(json::parse(text_of(file("stopped/summary.json")))["stopped"], "interrupted");
  EXPECT_EQ(carom({"resume", "stopped", "-q"}).exit_code, 0);
  expect_same_files("whole", "stopped");
  // The checkpoint of before the end would lead there again, and perhaps to another end.
  refused({"resume", "stopped"}, "this run has come to its end; carom extend takes it to a later one");
  EXPECT_EQ(carom({"extend", "stopped", "-q", "--collisions", "121000"}).exit_code, 0);
}

TEST_F(Resume, AfterItsWalltimeAgainAndAgain) {
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "whole", "-q", "--set", "run.collisions=60000"}).exit_code, 0);
  int code =
      carom({"run", "gas.toml", "--out", "parts", "-q", "--walltime", "0.001s", "--set", "run.collisions=60000"}).exit_code;
  ASSERT_EQ(code, 130);
  for (int parts = 1; code == 130 && parts < 100; ++parts)  // longer ones, for a machine with much other work
    code = carom({"resume", "parts", "-q", "--walltime", fmt::format("{}s", 0.1 * (1 + parts / 2))}).exit_code;
  EXPECT_EQ(code, 0);
  expect_same_files("whole", "parts");
}

TEST_F(Resume, AFinishedRunIsExtended) {
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "whole", "-q", "--set", "run.collisions=40000"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "longer", "-q", "--checkpoint-every", "1h"}).exit_code, 0);
  refused({"resume", "longer"}, "this run has come to its end; carom extend takes it to a later one");
  refused({"extend", "longer"}, "give the new end, with --time or with --collisions");
  refused({"extend", "longer", "--collisions", "30000"}, "the run has had 30000 already; give more");
  refused({"extend", "longer", "--time", "0.5"}, "already; give a later one");
  EXPECT_EQ(carom({"extend", "longer", "-q", "--collisions", "40000"}).exit_code, 0);
  for (const char* name : {"trajectory.xyz", "samples.csv"})
    EXPECT_TRUE(text_of(file("whole") / name) == text_of(file("longer") / name)) << name;
  EXPECT_EQ(results("whole")["energy"], results("longer")["energy"]);
}

TEST_F(Resume, WhatCannotBeExtendedIsLeftAsItIs) {
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "done", "-q", "--checkpoint-every", "1h"}).exit_code, 0);
  const json before = results("done");
  const auto trajectory = text_of(file("done/trajectory.h5md"));
  const auto left_alone = [&] {
    EXPECT_EQ(results("done"), before);
    EXPECT_TRUE(text_of(file("done/trajectory.h5md")) == trajectory);
  };
  refused({"extend", "done", "--time", "1e300"}, "--time 1e+300: ");
  left_alone();
  refused({"extend", "done", "--collisions", "-1"}, "--collisions");
  refused({"extend", "done", "--collisions", "9223372036854775808"}, "--collisions");
  left_alone();
  for (const char* product : {"samples.csv", "trajectory.xyz", "trajectory.h5md"}) {
    const fs::path path = file("done") / product, aside = file("aside");
    fs::rename(path, aside);
    refused({"extend", "done", "--collisions", "40000"}, std::string(product) + ": this file of the run is missing; put it back");
    write_text(path, text_of(aside).substr(0, 100));
    refused({"extend", "done", "--collisions", "40000"}, "the file has 100 bytes and must have ");
    fs::rename(aside, path);
    left_alone();
  }
  EXPECT_EQ(carom({"extend", "done", "-q", "--collisions", "40000"}).exit_code, 0);
}

TEST_F(Resume, WithADamagedCheckpointThePreviousOneIsUsedAndSaid) {
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "whole", "-q"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "hurt", "-q", "--checkpoint-every", "5000 collisions"}).exit_code, 0);
  fs::remove(file("hurt/summary.json"));  // as if the end had never been written
  std::string damaged = text_of(file("hurt/checkpoint.h5"));
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  write_text(file("hurt/checkpoint.h5"), damaged);
  const Outcome resumed = carom({"resume", "hurt"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("checkpoint.h5: its checksum is wrong; going on from hurt/checkpoint-previous.h5 instead"));
  expect_same_files("whole", "hurt");
}

TEST_F(Resume, WhatCannotBeResumedIsRefusedAndLeftAsItIs) {
  refused({"resume", "nowhere"}, "there is no such directory");
  fs::create_directory(file("empty"));
  refused({"resume", "empty"}, "there is no checkpoint from which a run could go on");
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "cut", "-q", "--checkpoint-every", "5000 collisions"}).exit_code, 0);
  fs::remove(file("cut/summary.json"));
  fs::resize_file(file("cut/samples.csv"), 100);
  const Outcome cut = carom({"resume", "cut"});
  EXPECT_NE(cut.exit_code, 0);
  EXPECT_THAT(cut.err, HasSubstr("the file has 100 bytes and must have "));
  EXPECT_TRUE(is_there("cut/checkpoint.h5"));
}

TEST_F(Resume, ADirectoryBelongsToOneRunAtATime) {
  const Outcome first = carom({"run", "gas.toml", "--out", "busy", "-q", "--set", "run.collisions=1000000000"}, [&](pid_t child) {
    (void)wait_until([&] { return is_there("busy/trajectory.h5md.partial"); });
    refused({"run", "gas.toml", "--out", "busy", "--force"}, "another process is writing into this directory");
    refused({"resume", "busy"}, "another process is writing into this directory; wait for its end\n");  // it has no other place
    ::kill(child, SIGKILL);
  });
  EXPECT_EQ(first.exit_code, 128 + SIGKILL);
}

TEST_F(Resume, DurationsAreReadAsPeopleTypeThem) {
  for (const char* wrong : {"soon", "10 parsecs", "-1s", "0", "1:2:3:4", "1h30", "collisions", "1.5 collisions"})
    refused({"run", "gas.toml", "--out", "never", "--checkpoint-every", wrong}, "--checkpoint-every ");
  refused({"run", "gas.toml", "--out", "never", "--walltime", "later"}, "--walltime later: give a length of time such as 90s");
  EXPECT_FALSE(is_there("never"));
}

TEST_F(Resume, AStoppedRunThatCannotBeSavedSaysSoAndIsNotCalledInterrupted) {
  // No file beyond eight kilobytes: enough for the summary, and not for a checkpoint.
  write_text(file("plain.toml"), without_time(fifty_disks));
  const Outcome outcome =
      run_program(directory_.path(),
                  {"sh", "-c", "ulimit -f 16; exec \"$0\" run plain.toml --time 1e6 --walltime 0.2s --no-trajectory -o full -q",
                   CAROM_PROGRAM});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("full/checkpoint.h5.partial: cannot write: File too large; "));
  EXPECT_THAT(outcome.err, HasSubstr("; the run cannot go on later\n"));
  EXPECT_TRUE(std::filesystem::exists(file("full/summary.json")));
  EXPECT_FALSE(std::filesystem::exists(file("full/checkpoint.h5.partial")));
}

}  // namespace
}  // namespace carom::test
