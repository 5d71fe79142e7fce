#pragma once
// Which of the kernels that are compiled for several instruction sets may run here.

namespace carom {

/// Whether the AVX2 kernels run: this build has them, the machine can, and the environment does not say
/// CAROM_INSTRUCTIONS=portable. The bits of a run do not depend on it.
[[nodiscard]] bool use_avx2();

}  // namespace carom
