// The manual pages and the completion that the program prints of itself.

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr auto commands = {"run",  "check",  "horizon", "compare", "sweep", "validate", "init",
                           "info", "verify", "diff",    "play",    "bench", "hardcases"};

class Manual : public ::testing::Test {
 protected:
  std::string printed(const std::vector<std::string>& command) {
    const Outcome outcome = run_carom(directory_.path(), command);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, IsEmpty());
    return outcome.out;
  }
  /// What may stand where the last word is typed.
  std::string complete(std::vector<std::string> words) {
    words.insert(words.begin(), "complete");
    return printed(words);
  }
  /// What the script answers in a shell; empty where there is no such shell.
  std::string answer(const std::string& shell, const std::string& text) {
    write_text(directory_.file("script"), printed({"completion", shell}));
    const Outcome outcome = run_program(directory_.path(), {shell, "-c", text});
    is_missing = outcome.exit_code == 127;
    EXPECT_THAT(outcome.err, IsEmpty());
    return outcome.out;
  }
  bool is_missing = false;
  TemporaryDirectory directory_;
};

TEST_F(Manual, HasEveryCommandAndItsOptions) {
  const std::string page = printed({"man"});
  EXPECT_THAT(page, StartsWith(".TH CAROM 1"));
  for (const std::string command : commands) {
    EXPECT_THAT(page, HasSubstr(".BR carom\\-" + command + " (1)"));
    const std::string own = printed({"man", command});
    EXPECT_THAT(own, AllOf(HasSubstr(".SH NAME\ncarom\\-" + command + " \\- "), HasSubstr(".SH EXAMPLES\n"),
                           HasSubstr("\ncarom " + command)));
  }
  EXPECT_THAT(printed({"man", "run"}), HasSubstr("\\fB\\-q\\fR, \\fB\\-\\-quiet\\fR"));
  EXPECT_THAT(page, HasSubstr("SIGHUP, SIGXCPU and SIGUSR1 ask a run or a study to stop"));
  EXPECT_THAT(page, Not(HasSubstr("carom complete")));
}

TEST_F(Manual, IsSetWithoutAWarning) {
  printed({"man", "--out", "pages"});
  int pages = 0;
  for (const auto& page : std::filesystem::directory_iterator(directory_.file("pages"))) {
    const Outcome set = run_program(directory_.path(), {"groff", "-man", "-Tutf8", "-ww", page.path().string()});
    if (set.exit_code == 127) GTEST_SKIP() << "groff is not installed";
    EXPECT_EQ(set.exit_code, 0);
    EXPECT_THAT(set.err, IsEmpty()) << page.path();
    ++pages;
  }
  EXPECT_EQ(pages, 23);
  EXPECT_THAT(run_program(directory_.path(), {"groff", "-man", "-Tutf8", "pages/carom-horizon.1"}).out,
              HasSubstr("carom horizon box.toml"));
}

TEST_F(Manual, CompletionKnowsCommandsOptionsAndValues) {
  EXPECT_THAT(complete({"hor"}), StartsWith("horizon\t"));
  EXPECT_THAT(complete({""}), AllOf(HasSubstr("run\t"), Not(HasSubstr("complete\n"))));
  EXPECT_THAT(complete({"run", "--no-t"}), StartsWith("--no-trajectory\t"));
  EXPECT_EQ(complete({"run", ""}), ":files toml\n");
  EXPECT_EQ(complete({"report", ""}), ":directories\n");
  EXPECT_EQ(complete({"run", "--out", ""}), ":directories\n");
  EXPECT_THAT(complete({"run", "box.toml", "--engine", ""}), AllOf(HasSubstr("auto\n"), HasSubstr("fast\n")));
  EXPECT_EQ(complete({"run", "box.toml", "--engine=fa"}), "--engine=fast\n");
  EXPECT_THAT(complete({"run", "--method", "gu"}), "guarded\n");
  EXPECT_THAT(complete({"init", "pis"}), StartsWith("piston\t"));
  EXPECT_EQ(complete({"analyze", "box", "press"}), "pressure\n");
  EXPECT_EQ(complete({"analyze", "box", "pressure", "hex"}), "hexatic\n");
  EXPECT_EQ(complete({"movie", "box", "--colour", "sp"}), "speed\nspecies\n");
  EXPECT_EQ(complete({"run", "box.toml", "--progress", "a"}), "auto\nalways\n");
  EXPECT_THAT(complete({"validate", "--only", "reversal-f"}), HasSubstr("reversal-frozen\n"));
  EXPECT_THAT(complete({"validate", "--only", "equat"}), StartsWith("equation-of-state\t"));
  EXPECT_THAT(complete({"hardcases", "wall_and"}), HasSubstr("wall_and_lower_disk_at_once\n"));
  EXPECT_THAT(complete({"help", "ru"}), StartsWith("run\t"));
  EXPECT_EQ(complete({"completion", "z"}), "zsh\n");
  EXPECT_THAT(complete({"run", "--seed", "1", "--see"}), Not(HasSubstr("--seed\t"))) << "it is given already";
  EXPECT_EQ(complete({"nonsense", ""}), "");
}

TEST_F(Manual, CompletionOffersDirectoriesThatHoldARun) {
  for (const char* name : {"box", "box-analysis", "box-empty", "box sweep/eta=0.1"})
    std::filesystem::create_directories(directory_.file(name));
  write_text(directory_.file("box-analysis/analysis.json"), "{}");
  write_text(directory_.file("box/summary.json"), "{}");
  write_text(directory_.file("box sweep/eta=0.1/checkpoint.h5"), "");
  EXPECT_EQ(complete({"play", ""}), ":directory box\n:directory box sweep\n");
  EXPECT_EQ(complete({"play", "box sweep/"}), ":directory box sweep/eta=0.1\n");
  EXPECT_EQ(complete({"play", "box-"}), ":directories\n");
  EXPECT_EQ(complete({"play", "~/"}), ":directories\n");
  EXPECT_EQ(complete({"play", "nowhere/"}), ":directories\n");
}

TEST_F(Manual, CompletionKnowsTheKeysOfAScene) {
  std::filesystem::copy_file(CAROM_SOURCE_DIR "/docs/scenes/box.toml", directory_.file("box.toml"));
  EXPECT_THAT(complete({"run", "box.toml", "--set", "run.ti"}), StartsWith("run.time=\tnow 5.0\n"));
  EXPECT_THAT(complete({"run", "box.toml", "--set", "disks.0."}),
              AllOf(HasSubstr("disks.0.count=\tnow 64\n"), HasSubstr("disks.0.velocities.uniform=")));
  EXPECT_EQ(complete({"run", "nowhere.toml", "--set", "run.ti"}), "");
}

TEST_F(Manual, BashCompletesCommandsOptionsAndFiles) {
  write_text(directory_.file("gas.toml"), "");
  write_text(directory_.file("gas.csv"), "");
  std::filesystem::create_directory(directory_.file("gasket"));
  const auto completed = [&](const std::string& words, int word) {
    return answer("bash", "source ./script; COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(word) +
                              "; _carom '" CAROM_PROGRAM "'; echo \"${COMPREPLY[@]}\"");
  };
  EXPECT_EQ(completed("carom hor", 1), "horizon\n");
  EXPECT_EQ(completed("carom run --no-t", 2), "--no-trajectory\n");
  EXPECT_EQ(completed("carom check ga", 2), "gasket gas.toml\n");
  EXPECT_EQ(completed("carom report ga", 2), "gasket\n");
  std::filesystem::create_directory(directory_.file("gas-analysis"));
  write_text(directory_.file("gasket/summary.json"), "{}");
  EXPECT_EQ(completed("carom report ga", 2), "gasket\n");
  EXPECT_EQ(completed("carom info gas.c", 2), "gas.csv\n");
  EXPECT_EQ(completed("carom init pis", 2), "piston\n");
  EXPECT_EQ(completed("carom run x.toml --engine = fa", 5), "fast\n");
}

TEST_F(Manual, FishCompletesCommandsOptionsAndFiles) {
  write_text(directory_.file("gas.toml"), "");
  write_text(directory_.file("gas.csv"), "");
  std::filesystem::create_symlink(CAROM_PROGRAM, directory_.file("carom"));
  const auto completed = [&](const std::string& line) {
    return answer("fish", "set PATH . $PATH; source script; complete -C '" + line + "'");
  };
  const std::string command = completed("carom hor");
  if (is_missing) GTEST_SKIP() << "fish is not installed";
  EXPECT_THAT(command, StartsWith("horizon\t"));
  EXPECT_THAT(completed("carom run --no-t"), StartsWith("--no-trajectory\t"));
  EXPECT_THAT(completed("carom init pis"), StartsWith("piston\t"));
  EXPECT_THAT(completed("carom run gas"), AllOf(HasSubstr("gas.toml"), Not(HasSubstr("gas.csv"))));
}

TEST_F(Manual, ZshCompletesCommandsOptionsAndFiles) {
  // The functions of zsh's own completion system stand for themselves.
  const auto completed = [&](const std::string& words, int current) {
    return answer("zsh",
                  "compdef() { : }; _files() { print files $* }; compadd() { print -l -- ${(P)${@[-1]}} }\n"
                  "source ./script; words=('" CAROM_PROGRAM "' " +
                      words + "); CURRENT=" + std::to_string(current) + "; _carom");
  };
  const std::string command = completed("hor", 2);
  if (is_missing) GTEST_SKIP() << "zsh is not installed";
  EXPECT_EQ(command, "horizon\n");
  EXPECT_EQ(completed("run --no-t", 3), "--no-trajectory\n");
  EXPECT_EQ(completed("init pis", 3), "piston\n");
  EXPECT_EQ(completed("run ''", 3), "files -g *.(toml)\n");
  EXPECT_EQ(completed("report ''", 3), "files -/\n");
}

}  // namespace
}  // namespace carom::test
