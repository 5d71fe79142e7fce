// carom run --threads N as a user meets it: the files of one core, whatever happens to the run, and one sentence where a run
// cannot be shared out.

#include "support/shared_out_run.hpp"

#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

using ThreadsOfRun = SharedOutRunTest;

TEST_F(ThreadsOfRun, GiveTheFilesOfOneCore) {
  ASSERT_EQ(run("one", {"-q", "--threads", "1"}).exit_code, 0);
  const Outcome four = run("four", {"--threads", "4"});
  EXPECT_EQ(four.exit_code, 0) << four.err;
  EXPECT_THAT(four.out, ::testing::ContainsRegex("threads +4 +[0-9,]+ windows of 4 domains"));
  expect_same_results("one", "four");
  EXPECT_GT(summary("four")["cores"]["windows"], 10);
  const Outcome verified = carom({"verify", "four"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
  const Outcome diff = carom({"diff", "one", "four"});
  EXPECT_EQ(diff.exit_code, 0) << diff.out;
}

TEST_F(ThreadsOfRun, GiveTheSameObservablesOfCollisionsAndTheSameLog) {
  const std::vector<std::string> more = {"-q", "--events", "--set", "observe.pressure=true", "--set", "observe.viscosity=true"};
  for (const char* threads : {"1", "2"}) {
    std::vector<std::string> arguments = more;
    arguments.insert(arguments.end(), {"--threads", threads});
    ASSERT_EQ(run(std::string("with") + threads, arguments).exit_code, 0);
  }
  expect_same_results("with1", "with2");
  EXPECT_EQ(carom({"verify", "with2"}).exit_code, 0);
}

/// Each domain counts its simultaneous collisions by itself, and leaves out those of two domains.
TEST_F(ThreadsOfRun, AreVerifiedWhateverSimultaneousCollisionsTheyCount) {
  for (const char* threads : {"1", "2"}) {
    ASSERT_EQ(run(threads, {"-q", "--threads", threads}).exit_code, 0);
    json told = summary(threads);
    told["numerics"]["simultaneous"] = told["numerics"]["simultaneous"].get<int>() + 1;
    std::ofstream(file(threads) / "summary.json") << told;
  }
  EXPECT_EQ(carom({"verify", "2"}).exit_code, 0);
  const Outcome alone = carom({"verify", "1"});
  EXPECT_NE(alone.exit_code, 0);
  EXPECT_THAT(alone.out + alone.err, HasSubstr("/numerics/simultaneous"));
}

TEST_F(ThreadsOfRun, AreToldWithWhatTheyTook) {
  ASSERT_EQ(run("three", {"-q", "--threads", "3", "--report"}).exit_code, 0);
  const json cores = summary("three")["cores"];
  EXPECT_EQ(cores["threads"], 3);
  EXPECT_EQ(cores["domains"], 3);
  EXPECT_EQ(cores["ranks"], 1);
  EXPECT_GE(cores["windows"], cores["windows_redone"]);
  EXPECT_THAT(carom({"info", "three/summary.json"}).out, ::testing::ContainsRegex("threads +3, [0-9,]+ windows? of 3 domains, "));
  EXPECT_THAT(text_of(file("three/report.html")), HasSubstr("windows of 3 domains"));
}

TEST_F(ThreadsOfRun, AreNotMentionedWhereThereIsOne) {
  const Outcome outcome = run("one", {"--threads", "auto"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, Not(HasSubstr("threads")));
  EXPECT_FALSE(summary("one").contains("cores")) << "2,000 disks are too few";
}

TEST_F(ThreadsOfRun, MayBeOthersWhereARunGoesOn) {
  ASSERT_EQ(run("whole", {"-q", "--threads", "1"}).exit_code, 0);
  for (const std::vector<std::string>& numbers : {std::vector<std::string>{"4", "1", "2"}, {"1", "3", "4"}}) {
    const std::string out = "parts" + numbers.front();
    int code = run(out, {"-q", "--threads", numbers.front(), "--walltime", "0.05s"}).exit_code;
    std::size_t part = 0;
    for (; code == 130 && part < 100; ++part)
      code = carom({"resume", out, "-q", "--threads", numbers[1 + part % 2], "--walltime", std::to_string(1 + part / 2) + "e-1s"})
                 .exit_code;
    EXPECT_EQ(code, 0) << out;
    EXPECT_GT(part, 0U) << "the run was over before it could be stopped";
    expect_same_results("whole", out);
  }
}

TEST_F(ThreadsOfRun, EndWithTheSameFilesAfterSigkill) {
  const std::vector<std::string> longer = {"-q", "--set", "run.time=20.0"};
  std::vector<std::string> saving = longer, alone = longer;
  saving.insert(saving.end(), {"--threads", "2", "--checkpoint-every", "20000 collisions"});
  alone.insert(alone.end(), {"--threads", "1"});
  ASSERT_EQ(run("whole", alone).exit_code, 0);
  saving.insert(saving.begin(), {"run", "gas.toml", "--out", "killed", "--force"});
  const Outcome killed = ended_early([&] {
    return carom(saving, [&](pid_t child) {
      (void)wait_until([&] { return fs::exists(file("killed/checkpoint-previous.h5")); });
      ::kill(child, SIGKILL);
    });
  });
  ASSERT_EQ(killed.exit_code, 128 + SIGKILL);
  EXPECT_EQ(carom({"resume", "killed", "-q", "--threads", "3"}).exit_code, 0);
  expect_same_results("whole", "killed");
}

TEST_F(ThreadsOfRun, StopAtASignalAndSaySo) {
  const Outcome stopped =
      carom({"run", "gas.toml", "--out", "stopped", "--threads", "2", "--set", "run.time=1e6"}, [&](pid_t child) {
        (void)wait_until([&] { return fs::exists(file("stopped/trajectory.h5md.partial")); });
        ::kill(child, SIGINT);
      });
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr(" resume stopped goes on from there"));
  EXPECT_EQ(summary("stopped")["stopped"], "interrupted");
  EXPECT_TRUE(fs::exists(file("stopped/checkpoint.h5")));
}

TEST_F(ThreadsOfRun, AreRefusedInOneSentenceWhereARunCannotBeSharedOut) {
  const std::string range = "give auto, or a number from 1 to 32";
  for (const char* wrong : {"0", "33", "two", "-1"})
    refused({"run", "gas.toml", "--threads", wrong}, std::string("--threads ") + wrong + ": " + range);
  refused({"run", "gas.toml", "--threads", "3", "--set", "drag.rate=1.0"},
          "--threads 3: only one core can compute this run, for drag slows the clock; give 1, or leave it out");
  refused({"run", "gas.toml", "--threads", "3", "--engine", "textbook"}, "--threads 3: only one core can compute this run, for");
  EXPECT_FALSE(fs::exists(file("gas")));
}

TEST_F(ThreadsOfRun, AreToldByCheckWithTheReason) {
  EXPECT_THAT(carom({"check", "gas.toml"}).out,
              HasSubstr("threads     one core: 2,000 disks are fewer than the 50,000 from which on several cores pay\n"));
  EXPECT_THAT(carom({"check", "gas.toml", "--set", "drag.rate=1.0"}).out,
              HasSubstr("threads     one core: drag slows the clock"));
}

}  // namespace
}  // namespace carom::test
