#include "observe/lag_rows.hpp"

#include "core/instructions.hpp"

namespace carom {

CAROM_DECLARE_KERNELS_TO_AVX2(extern const LagRowsKernel lag_rows_kernel;)

const LagRowsKernel& lag_rows_kernel() { return CAROM_CHOSEN_KERNEL_TO_AVX2(lag_rows_kernel); }

}  // namespace carom
