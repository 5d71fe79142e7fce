#pragma once
// Instruction sets by name, and what runs with one of them.

#include <cstdlib>
#include <string>
#include <string_view>

namespace carom::test {

constexpr std::string_view instruction_sets[] = {"portable", "avx2", "avx512"};

/// While it lives CAROM_INSTRUCTIONS asks for one set, and before and after for none.
class WithInstructions {
 public:
  explicit WithInstructions(std::string_view set) { setenv("CAROM_INSTRUCTIONS", std::string(set).c_str(), 1); }
  WithInstructions(const WithInstructions&) = delete;
  WithInstructions& operator=(const WithInstructions&) = delete;
  ~WithInstructions() { unsetenv("CAROM_INSTRUCTIONS"); }
};

}  // namespace carom::test
