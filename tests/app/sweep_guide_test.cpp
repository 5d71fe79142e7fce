// docs/sweeps.md: its example is the one that is kept, and the numbers that it prints are those of the commands.

#include "support/child_process.hpp"
#include "support/scene_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

TEST(ScenesSweepGuide, ShowsTheExampleAndWhatItPrints) {
  const std::filesystem::path sweep = docs / "scenes/sweeps/equation_of_state.toml";
  const std::string page = text_of(docs / "sweeps.md"), example = text_of(sweep);
  EXPECT_THAT(page, HasSubstr(example.substr(example.find("scene = "))));
  const TemporaryDirectory directory;
  const Outcome outcome = run_carom(directory.path(), {"sweep", sweep.string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);  // with the path of the scene
  for (int row = 0; row < 1 + 11; ++row) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_THAT(page, HasSubstr(line + "\n"));
  }
}

}  // namespace
}  // namespace carom::test
