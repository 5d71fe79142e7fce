// Results do not depend on how wide a long double is: 64 bits with some compilers and on some machines, 80 on x86, 128 on others,
// as in WebAssembly, in which the golden hashes are computed too.

#include "golden/engine_bits.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

namespace carom::test {
namespace {

[[maybe_unused]] std::string printed_by(const std::string& program) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(program.c_str(), "r"), &pclose);
  std::string text;
  std::array<char, 256> line{};
  while (pipe && std::fgets(line.data(), line.size(), pipe.get()) != nullptr) text += line.data();
  return text;
}

TEST(GoldenLongDouble, OfSixtyFourBitsGivesTheSameBits) {
#ifdef CAROM_ENGINE_BITS_64
  EXPECT_EQ(printed_by(CAROM_ENGINE_BITS_64), engine_bits());
#else
  GTEST_SKIP() << "a debug build, or a compiler without -mlong-double-64";
#endif
}

}  // namespace
}  // namespace carom::test
