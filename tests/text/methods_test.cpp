// Words and options for engines and methods.

#include "text/methods.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace carom::test {
namespace {

TEST(Methods, AreNamedWithTheirStepAndStiffness) {
  EXPECT_EQ(method_words("fast", std::nullopt, std::nullopt), "fast");
  EXPECT_EQ(method_words("naive", 0.001, std::nullopt), "naive, dt = 0.001");
  EXPECT_EQ(method_words("soft", 0.001, 5000.0), "soft, dt = 0.001, stiffness = 5000");
}

TEST(Methods, OptionsChooseAMethodAgainToTheLastBit) {
  EXPECT_EQ(method_options("fast", std::nullopt, std::nullopt), "--engine fast");
  EXPECT_EQ(method_options("naive", 0.1, std::nullopt), "--method naive --dt 0.1");
  EXPECT_EQ(method_options("soft", 0.0123456789012345, 1.0 / 3.0),
            "--method soft --dt 0.0123456789012345 --stiffness 0.3333333333333333");
}

}  // namespace
}  // namespace carom::test
