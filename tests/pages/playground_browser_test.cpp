// The playground, where ./bootstrap playground has built it: its page in a browser, and its bits. Skipped elsewhere.

#include "support/child_process.hpp"
#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace carom::test {
namespace {

const std::filesystem::path checkout = CAROM_SOURCE_DIR;
const std::filesystem::path built = checkout / "build/playground";

bool is_built() { return std::filesystem::exists(built / "playground.html"); }

constexpr const char* not_built = "the playground is not built; ./bootstrap playground builds it, with emscripten";

TEST(BrowserPlayground, HoldsWhatItPromises) {
  if (!is_built()) GTEST_SKIP() << not_built;
  const TemporaryDirectory directory;
  const Outcome outcome = run_program(directory.path(), {"node", (checkout / "playground/tests/page_test.mjs").string(),
                                                         (built / "playground.html").string(), CAROM_PROGRAM});
  constexpr int no_browser_there = 77;
  if (outcome.exit_code == no_browser_there) GTEST_SKIP() << outcome.out;
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST(BrowserPlayground, GivesAllGoldenHashes) {
  if (!std::filesystem::exists(built / "golden.js")) GTEST_SKIP() << not_built;
  const TemporaryDirectory directory;
  const Outcome outcome =
      run_program(directory.path(), {"node", "--no-experimental-fetch", (built / "golden.js").string(), checkout.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

}  // namespace
}  // namespace carom::test
