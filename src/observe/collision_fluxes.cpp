#include "observe/collision_fluxes.hpp"

#include "core/instructions.hpp"

namespace carom {

namespace portable {
extern const FluxKernel flux_kernel;
}  // namespace portable

#if CAROM_HAS_AVX2
namespace avx2 {
extern const FluxKernel flux_kernel;
}  // namespace avx2
#else
namespace avx2 = portable;
#endif

#if CAROM_HAS_AVX512
namespace avx512 {
extern const FluxKernel flux_kernel;
}  // namespace avx512
#else
namespace avx512 = avx2;
#endif

/// Vectors are of four doubles on both; AVX-512 has room for all sums in registers.
const FluxKernel& flux_kernel() { return chosen_kernel(portable::flux_kernel, avx2::flux_kernel, avx512::flux_kernel); }

}  // namespace carom
