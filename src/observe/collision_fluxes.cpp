#include "observe/collision_fluxes.hpp"

#include "core/instructions.hpp"

namespace carom {

CAROM_DECLARE_KERNELS(extern const FluxKernel flux_kernel;)

/// Vectors are of four doubles on both; AVX-512 has room for all sums in registers.
const FluxKernel& flux_kernel() { return CAROM_CHOSEN_KERNEL(flux_kernel); }

}  // namespace carom
