#pragma once
// Which of the kernels that are compiled for several instruction sets run here.

namespace carom {

/// In rising order: a machine that has one has those before it.
enum class Instructions { portable, avx2, avx512 };

/// The best that this build has kernels for and the machine can run; or, of these, the one that the environment names in
/// CAROM_INSTRUCTIONS (any other word is ignored). The bits of a run do not depend on it.
[[nodiscard]] Instructions chosen_instructions();

/// As in CAROM_INSTRUCTIONS.
[[nodiscard]] const char* name_of(Instructions set);

/// Of the versions of a kernel, the one to run.
template <class Kernel>
const Kernel& chosen_kernel(const Kernel& portable, const Kernel& avx2, const Kernel& avx512) {
  const Instructions set = chosen_instructions();
  return set == Instructions::avx512 ? avx512 : set == Instructions::avx2 ? avx2 : portable;
}

}  // namespace carom
