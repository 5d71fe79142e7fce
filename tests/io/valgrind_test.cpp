// What writes and reads files, under valgrind: no byte is used that was given back, or that was never set.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace carom::test {
namespace {

namespace fs = std::filesystem;

const std::string written_and_observed = R"([output]
xyz = true
csv = true
events = true
[observe]
pressure = true
viscosity = true
radial_distribution = true
free_flight = true
)";

class Valgrind : public ProgramTest {
 protected:
  Valgrind() : ProgramTest(fifty_disks + written_and_observed) {}

  void SetUp() override {
    const Outcome tried = under_valgrind({CAROM_PROGRAM, "--version"});
    if (tried.exit_code == 127) GTEST_SKIP() << "valgrind is not installed";
    for (const char* beyond_valgrind : {"unrecognised instruction", "Sanitizer"})
      if (tried.err.find(beyond_valgrind) != std::string::npos)
        GTEST_SKIP() << "this build does not run under valgrind: " << tried.err;
    ASSERT_EQ(tried.exit_code, 0) << tried.err;
  }

  /// Valgrind knows no AVX-512.
  Outcome under_valgrind(const std::vector<std::string>& words) {
    std::vector<std::string> all = {"env",       "CAROM_INSTRUCTIONS=avx2",  "valgrind",
                                    "--quiet",   "--error-exitcode=99",      "--num-callers=30",
                                    "--vgdb=no", "--exit-on-first-error=yes"};
    all.insert(all.end(), words.begin(), words.end());
    return run_program(directory_.path(), all);
  }
  void expect_sound(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), CAROM_PROGRAM);
    const Outcome outcome = under_valgrind(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

TEST_F(Valgrind, ARunIsSavedExtendedAndRead) {
  expect_sound({"run", "gas.toml", "--out", "run", "-q", "--checkpoint-every", "100 collisions"});
  expect_sound({"extend", "run", "--time", "2.5", "-q"});
  expect_sound({"info", "run"});
  expect_sound({"analyze", "run", "pressure"});
}

TEST_F(Valgrind, NothingOfASavedStateIsLeftUnset) {
  for (const char* engine : {"general", "textbook-long-double"})
    expect_sound({"run", "gas.toml", "--engine", engine, "--set", "observe={}", "--out", engine, "-q", "--set", "run.time=0.5",
                  "--checkpoint-every", "1h"});
}

/// Of the tests beside this one those that are quick there; docs/reliability.md has the command for all of them.
TEST_F(Valgrind, TheTestsOfFiles) {
  const std::string tests = fs::read_symlink("/proc/self/exe");
  const Outcome outcome = under_valgrind({tests, "--gtest_brief=1",
                                          "--gtest_filter=Hdf5File*:H5mdFile.*:RunWriter.*:RunReaderTest.*:Checkpoint.Holds*:"
                                          "ResumedText.*-*.MemoryDoesNotGrow*"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

}  // namespace
}  // namespace carom::test
