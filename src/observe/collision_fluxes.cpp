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

/// Vectors are of four doubles, for which AVX-512 has nothing better to offer.
const FluxKernel& flux_kernel() { return chosen_kernel(portable::flux_kernel, avx2::flux_kernel, avx2::flux_kernel); }

}  // namespace carom
