#pragma once
// A directory of its own with one scene in it, gas.toml, and the program run there.

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/types.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace carom::test {

class ProgramTest : public ::testing::Test {
 protected:
  explicit ProgramTest(const std::string& scene) { write_text(file("gas.toml"), scene); }

  Outcome carom(const std::vector<std::string>& arguments, const std::function<void(pid_t)>& meanwhile = {}) {
    return run_carom(directory_.path(), arguments, meanwhile);
  }
  /// The arguments are wrong: exit code 2, nothing on stdout, and one sentence that has these words.
  void refused(const std::vector<std::string>& arguments, const std::string& sentence) {
    const Outcome outcome = carom(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, ::testing::AllOf(::testing::StartsWith("carom: "), ::testing::HasSubstr(sentence)));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return directory_.path() / name; }
  /// The summary of a run directory, without what the clock on the wall says, and what ran it.
  [[nodiscard]] nlohmann::json results(const std::string& directory) const {
    auto found = nlohmann::json::parse(text_of(file(directory) / "summary.json"));
    for (const char* key : {"wall_seconds", "loop_seconds", "collisions_per_second", "command_line", "cores"}) found.erase(key);
    return found;
  }

  TemporaryDirectory directory_;
};

/// Fifty disks in a periodic box, without the end of its [run] table, to which a test may add.
inline const std::string fifty_disks = R"([box]
x = [0.0, 10.0]
y = [0.0, 10.0]
boundary = "periodic"

[[disks]]
count = 50
radius = 0.3
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }

[collision]
rule = "specular"

[run]
time = 2.0
sample_every = 0.5
)";

}  // namespace carom::test
