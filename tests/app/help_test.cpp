// What the program says of its commands, and that what it says works.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

const std::vector<std::string> every_command = {
    "init", "check",  "run",   "resume",  "extend",  "info",  "verify", "playground", "analyze",  "diff", "play",
    "help", "report", "movie", "horizon", "compare", "sweep", "bench",  "hardcases",  "validate", "man",  "completion"};

class HelpCommand : public ProgramTest {
 protected:
  HelpCommand() : ProgramTest(fifty_disks) {}
  std::string printed(const std::vector<std::string>& arguments) {
    const Outcome outcome = carom(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, IsEmpty());
    return outcome.out;
  }
  /// Runs a line of a shell, with this program as carom.
  Outcome shell(const std::string& line) {
    return run_program(directory_.path(), {"bash", "-c", "carom() { '" CAROM_PROGRAM "' \"$@\"; }\n" + line});
  }
};

TEST_F(HelpCommand, WithoutACommandThereAreFiveToBeginWith) {
  const Outcome outcome = carom({});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  for (const char* command : {"init", "run", "play", "report", "sweep"})
    EXPECT_THAT(outcome.err, ContainsRegex(std::string("\n  ") + command + " +[A-Z]"));
  EXPECT_THAT(outcome.err, AllOf(Not(HasSubstr("hardcases")), HasSubstr("carom run box.toml"),
                                 HasSubstr("carom help lists all " + std::to_string(every_command.size()) + " commands")));
}

TEST_F(HelpCommand, ListsEveryCommandByPurpose) {
  const std::string list = printed({"help"});
  EXPECT_EQ(printed({"--help"}), list);
  for (const std::string& command : every_command) EXPECT_THAT(list, ContainsRegex("\n  " + command + " +[A-Z]"));
  EXPECT_THAT(list, AllOf(HasSubstr("\nScenes and runs:\n"), HasSubstr("\nResults of a run:\n"), HasSubstr("\nStudies:\n"),
                          Not(HasSubstr("Subcommands")), HasSubstr("carom run box.toml")));
}

TEST_F(HelpCommand, ExplainsACommandInGroups) {
  const std::string run = printed({"help", "run"});
  EXPECT_EQ(printed({"run", "--help"}), run);
  EXPECT_THAT(run, StartsWith("carom run: run a scene and write its results\n\nusage: carom run SCENE [OPTIONS]\n"));
  for (const char* heading : {"Arguments", "Scene", "How it is computed", "Results", "Checks", "Saving", "On the terminal"})
    EXPECT_THAT(run, HasSubstr(std::string("\n") + heading + ":\n"));
  for (const std::string& command : every_command)
    EXPECT_THAT(printed({"help", command}), Not(HasSubstr("\nOptions:\n")))
        << "every option of carom " << command << " has a heading";
}

TEST_F(HelpCommand, LinesFitATerminal) {
  for (const std::string& command : every_command)
    for (const std::string& line : lines_of(printed({"help", command}))) EXPECT_LE(line.size(), 100U) << command << ": " << line;
}

TEST_F(HelpCommand, WhatMeansTheSameIsCalledTheSame) {
  for (const std::string& command : every_command) {
    const std::string help = printed({"help", command});
    EXPECT_THAT(help, Not(HasSubstr("--output"))) << command;
    EXPECT_THAT(help, Not(HasSubstr("\n      --out "))) << command;
    EXPECT_THAT(help, Not(HasSubstr("\n      --quiet"))) << command;
    if (help.find("--progress") != std::string::npos) {
      EXPECT_THAT(help, HasSubstr("--quiet")) << command;
    }
  }
  for (const char* command : {"run", "check", "horizon", "compare"})
    for (const char* option : {"--set KEY=VALUE", "--seed N", "--time T", "--engine ENGINE"})
      EXPECT_THAT(printed({"help", command}), HasSubstr(option)) << command;
}

TEST_F(HelpCommand, TheNameOfBeforeStillWorks) {
  EXPECT_EQ(carom({"init", "--output", "a.toml"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(file("a.toml")));
}

TEST_F(HelpCommand, VersionMayBeACommand) { EXPECT_EQ(printed({"version"}), printed({"--version"})); }

// Every example of every command, in the order of the list, in one directory.
TEST_F(HelpCommand, EveryExampleWorks) {
  write_text(file("density.toml"),
             "scene = \"box.toml\"\nseeds = 2\n[set]\n\"run.time\" = 0.5\n[grid]\n\"disks.0.count\" = [10, 20]\n");
  const bool has_ffmpeg = run_program(directory_.path(), {"ffmpeg", "-version"}).exit_code == 0;
  const bool has_playground = carom({"playground", "-o", "try.html"}).exit_code == 0;
  // What takes minutes, or is not in this directory; and what starts a browser or waits for a shell.
  const auto is_tried = [&](const std::string& line) {
    for (const char* words : {"carom validate ", "carom bench ", "--out whole ", "mine.npy", "--open", "source "})
      if ((line + " ").find(words) != std::string::npos) {
        const bool is_short = line.find("--list") != std::string::npos || line.find("--only") != std::string::npos ||
                              line.find("--disks") != std::string::npos;
        if (!is_short) return false;
      }
    if (line.find("movie") != std::string::npos && line.find(".png") == std::string::npos && !has_ffmpeg) return false;
    return line.find("playground") == std::string::npos || has_playground;
  };
  int tried = 0;
  for (const std::string& command : every_command) {
    const std::string help = printed({"help", command});
    const std::size_t examples = help.find("\nFor example:\n");
    ASSERT_NE(examples, std::string::npos) << command;
    for (std::string line : lines_of(help.substr(examples))) {
      if (!line.starts_with("  ") || line.starts_with("  #")) continue;
      line = line.substr(2, line.find(" # ") - 2);
      if (!is_tried(line)) continue;
      if (const std::size_t hours = line.find("--walltime 2h"); hours != std::string::npos)
        line.replace(hours, 13, "--walltime 1s");
      if (line.starts_with("carom resume long")) line += " --walltime 1s";
      if (line.starts_with("carom movie") && line.find("--size") == std::string::npos) line += " --size 160";
      const Outcome outcome = shell(line);
      const bool is_stopped = line.find("--walltime") != std::string::npos;
      const int expected = is_stopped ? 130 : command == "diff" ? 1 : 0;
      EXPECT_EQ(outcome.exit_code, expected) << line << "\n" << outcome.err;
      ++tried;
    }
  }
  EXPECT_GE(tried, 30);
}

class TryNextCommand : public HelpCommand, public ::testing::WithParamInterface<std::vector<std::string>> {};

// What the summary of a run proposes can be copied line by line, the first time and the second.
TEST_P(TryNextCommand, EveryLineWorks) {
  std::filesystem::copy_file(CAROM_SOURCE_DIR "/docs/scenes/box.toml", file("it's a box.toml"));
  std::vector<std::string> arguments = {"run", "it's a box.toml", "--time", "0.2"};
  arguments.insert(arguments.end(), GetParam().begin(), GetParam().end());
  for (int time = 0; time < 2; ++time) {
    const Outcome outcome = carom(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::size_t next = outcome.out.find("\nTry next\n");
    ASSERT_NE(next, std::string::npos);
    const std::vector<std::string> lines = lines_of(outcome.out.substr(next + 10));
    EXPECT_GE(lines.size(), 3U);
    for (const std::string& line : lines) {
      const Outcome tried = run_program(directory_.path(), {"bash", "-c", line});
      EXPECT_EQ(tried.exit_code, 0) << line << "\n" << tried.err;
    }
    if (time == 0) arguments.emplace_back("--force");
  }
}

INSTANTIATE_TEST_SUITE_P(Each, TryNextCommand,
                         ::testing::Values(std::vector<std::string>{}, std::vector<std::string>{"--seed", "1"},
                                           std::vector<std::string>{"--events", "--out", "a b/c"},
                                           std::vector<std::string>{"--set", "run.sample_every=false"},
                                           std::vector<std::string>{"--no-trajectory"},
                                           std::vector<std::string>{"--no-trajectory", "--events"},
                                           std::vector<std::string>{"--set", "collision.rule=reversal", "--seed", "5"},
                                           std::vector<std::string>{"--method", "guarded", "--dt", "0.01", "--seed", "3"}));

}  // namespace
}  // namespace carom::test
