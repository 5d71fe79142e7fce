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

// For the files that choose among kernels, which alone know what sets the build has. CAROM_DECLARE_KERNELS(declarations;) puts
// declarations into the namespace of each set, and CAROM_CHOSEN_KERNEL(name) is the one to run. With ..._TO_AVX2 AVX-512 has no
// kernel of its own. The name of a set that the build does not have stands for the next lower one.
#if CAROM_HAS_AVX2
#define CAROM_IN_AVX2(...) \
  namespace avx2 {         \
  __VA_ARGS__              \
  }
#else
#define CAROM_IN_AVX2(...) namespace avx2 = portable;
#endif
#if CAROM_HAS_AVX512
#define CAROM_IN_AVX512(...) \
  namespace avx512 {         \
  __VA_ARGS__                \
  }
#else
#define CAROM_IN_AVX512(...) namespace avx512 = avx2;
#endif
#define CAROM_DECLARE_KERNELS_TO_AVX2(...) \
  namespace portable {                     \
  __VA_ARGS__                              \
  }                                        \
  CAROM_IN_AVX2(__VA_ARGS__)
#define CAROM_DECLARE_KERNELS(...) \
  namespace portable {             \
  __VA_ARGS__                      \
  }                                \
  CAROM_IN_AVX2(__VA_ARGS__)       \
  CAROM_IN_AVX512(__VA_ARGS__)
#define CAROM_CHOSEN_KERNEL(name) chosen_kernel(portable::name, avx2::name, avx512::name)
#define CAROM_CHOSEN_KERNEL_TO_AVX2(name) chosen_kernel(portable::name, avx2::name, avx2::name)
