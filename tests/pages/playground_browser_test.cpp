// The page of the playground in a browser, where ./bootstrap playground has built it. Skipped elsewhere.

#include "support/child_process.hpp"
#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace carom::test {
namespace {

const std::filesystem::path checkout = CAROM_SOURCE_DIR;
const std::filesystem::path built_page = checkout / "build/playground/playground.html";

TEST(BrowserPlayground, HoldsWhatItPromises) {
  if (!std::filesystem::exists(built_page))
    GTEST_SKIP() << "the playground is not built; ./bootstrap playground builds it, with emscripten";
  const TemporaryDirectory directory;
  const Outcome outcome = run_program(
      directory.path(), {"node", (checkout / "playground/tests/page_test.mjs").string(), built_page.string(), CAROM_PROGRAM});
  constexpr int no_browser_there = 77;
  if (outcome.exit_code == no_browser_there) GTEST_SKIP() << outcome.out;
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

}  // namespace
}  // namespace carom::test
