#pragma once
// Which of the kernels that are compiled for several instruction sets run here.

namespace carom {

/// Instruction sets in ascending order: a machine that has one has all before it.
enum class Instructions { portable, avx2, avx512 };

/// Returns the best that this build has kernels for and the machine can run; or, of these, the one that the environment names in
/// CAROM_INSTRUCTIONS (any other word is ignored). The bits of a run do not depend on it.
[[nodiscard]] Instructions chosen_instructions();

/// Returns the name of an instruction set as CAROM_INSTRUCTIONS spells it.
[[nodiscard]] const char* name_of(Instructions set);

/// Returns the version of a kernel to run on this machine.
template <class Kernel>
const Kernel& chosen_kernel(const Kernel& portable, const Kernel& avx2, const Kernel& avx512) {
  const Instructions set = chosen_instructions();
  return set == Instructions::avx512 ? avx512 : set == Instructions::avx2 ? avx2 : portable;
}

}  // namespace carom
