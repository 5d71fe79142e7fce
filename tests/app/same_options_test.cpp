// Options that mean the same in several commands: --time, --set, --json, --quiet and --open.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SameOptionsCommand : public ProgramTest {
 protected:
  SameOptionsCommand() : ProgramTest(fifty_disks) {
    write_text(file("density.toml"),
               "scene = \"gas.toml\"\nseeds = 2\n[set]\n\"run.time\" = 0.5\n[grid]\n\"disks.0.count\" = [10, 20]\n");
  }
  json printed(const std::vector<std::string>& arguments, int exit_code = 0) {
    const Outcome outcome = carom(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    return json::parse(outcome.out);
  }
  /// Nothing is printed; only the exit code tells.
  void silent(const std::vector<std::string>& arguments, int exit_code = 0) {
    const Outcome outcome = carom(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty()) << arguments.front();
  }
};

TEST_F(SameOptionsCommand, TimeIsShortForTheKeyOfTheScene) {
  const json by_name = printed({"run", "gas.toml", "--time", "1", "--json", "--out", "a"});
  const json by_key = printed({"run", "gas.toml", "--set", "run.time=1", "--json", "--out", "b"});
  EXPECT_EQ(by_name["time"], 1.0);
  EXPECT_EQ(by_name["state_hash"], by_key["state_hash"]);
  EXPECT_EQ(by_name["resolved_scene"], by_key["resolved_scene"]);
}

TEST_F(SameOptionsCommand, SweepsChangeEveryPointAndPrintTheirNumbers) {
  const json sweep = printed({"sweep", "density.toml", "--set", "run.time=0.25", "--json", "--threads", "1"});
  ASSERT_EQ(sweep["points"].size(), 2U);
  EXPECT_EQ(sweep["seeds"], json({1, 2}));
  for (std::size_t k = 0; k < 2; ++k) {
    const json& point = sweep["points"][k];
    EXPECT_EQ(point["values"]["disks.0.count"], 10.0 * static_cast<double>(k + 1));
    EXPECT_EQ(point["finished"], 2);
    EXPECT_EQ(point["numbers"]["time"]["mean"], 0.25);
    EXPECT_EQ(point["numbers"]["time"]["count"], 2);
  }
  // The mean over the two runs, as their own files have it.
  const auto pairs = [&](const char* seed) {
    return json::parse(text_of(file(std::string("density/count=10/seed=") + seed + "/summary.json")))["events"]["pair"]
        .get<double>();
  };
  EXPECT_EQ(sweep["points"][0]["numbers"]["events.pair"]["mean"], (pairs("1") + pairs("2")) / 2.0);
  refused({"sweep", "density.toml", "--set", "disks.0.count=5"},
          "the points of the sweep give disks.0.count values of their own");
  refused({"sweep", "density.toml", "--set", "run.seed=5"}, "its file has seeds = 4");
  refused({"sweep", "density.toml", "--set", "run.tiem=5"}, "did you mean \"time\"?");
}

TEST_F(SameOptionsCommand, VerifyPrintsJson) {
  silent({"run", "gas.toml", "-q", "--out", "a"});
  const json same = printed({"verify", "a", "--json"});
  EXPECT_TRUE(same["same"]);
  EXPECT_THAT(same["differences"], IsEmpty());
  silent({"run", "gas.toml", "-q", "--seed", "5", "--out", "b"});
  std::filesystem::copy_file(file("b/trajectory.h5md"), file("a/trajectory.h5md"),
                             std::filesystem::copy_options::overwrite_existing);
  const json other = printed({"verify", "a", "--json"}, 4);
  EXPECT_FALSE(other["same"]);
  EXPECT_FALSE(other["differences"].empty());
}

TEST_F(SameOptionsCommand, QuietLeavesTheExitCode) {
  silent({"init", "-q"});
  silent({"check", "gas.toml", "-q"});
  silent({"run", "gas.toml", "-q", "--out", "a"});
  silent({"run", "gas.toml", "-q", "--seed", "5", "--out", "b"});
  silent({"verify", "a", "-q"});
  silent({"diff", "a", "a", "-q"});
  silent({"diff", "a", "b", "-q"}, 1);
  silent({"play", "a", "-q"});
  silent({"report", "a", "-q"});
  EXPECT_TRUE(std::filesystem::exists(file("a/report.html")));
}

TEST_F(SameOptionsCommand, OpenStartsABrowserOnThePage) {
  silent({"run", "gas.toml", "-q", "--out", "a"});
  std::filesystem::create_directory(file("bin"));
  write_text(file("bin/xdg-open"), "#!/bin/sh\necho \"$1\" >>" + file("opened").string() + "\n");
  std::filesystem::permissions(file("bin/xdg-open"), std::filesystem::perms::owner_all);
  for (const char* page : {"report", "play"}) {
    const Outcome outcome = run_program(
        directory_.path(), {"env", "PATH=" + file("bin").string() + ":/usr/bin:/bin", CAROM_PROGRAM, page, "a", "--open"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  EXPECT_THAT(text_of(file("opened")), HasSubstr("/a/report.html\n"));
  EXPECT_THAT(text_of(file("opened")), HasSubstr("/a/player.html\n"));
}

}  // namespace
}  // namespace carom::test
