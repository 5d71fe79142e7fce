#pragma once
// A run that is short, and yet long enough to be stopped and killed on the way, for one core and for several.

#include "support/program_test.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace carom::test {

inline const std::string many_disks = R"([box]
x = [0.0, 60.0]
y = [0.0, 50.0]
boundary = "periodic"

[[disks]]
count = 2000
radius = 0.5
mass = 1.0
positions = "hexagonal"
velocities = { temperature = 1.0 }

[collision]
rule = "specular"

[run]
time = 6.0
sample_every = 1.0

[output]
xyz = true
csv = true

[observe]
radial_distribution = true
)";

/// Runs of that scene, alone or shared out.
class SharedOutRunTest : public ProgramTest {
 protected:
  SharedOutRunTest() : ProgramTest(many_disks) {}

  /// Runs the scene into a directory of that name.
  Outcome run(const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"run", "gas.toml", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return carom(arguments);
  }
  [[nodiscard]] nlohmann::json summary(const std::string& directory) const {
    return nlohmann::json::parse(text_of(file(directory) / "summary.json"));
  }
  void expect_same_results(const std::string& a, const std::string& b) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(file(a)))
      if (const std::filesystem::path name = entry.path().filename(); name.extension() == ".csv" || name.extension() == ".xyz")
        names.push_back(name.string());
    EXPECT_GE(names.size(), 3U);
    for (const std::string& name : names) EXPECT_TRUE(text_of(file(a) / name) == text_of(file(b) / name)) << name;
    EXPECT_EQ(results(a), results(b));
  }
};

}  // namespace carom::test
