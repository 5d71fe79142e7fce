#include "observe/lag_rows.hpp"

#include "core/instructions.hpp"

namespace carom {

namespace portable {
extern const LagRowsKernel lag_rows_kernel;
}  // namespace portable

#if CAROM_HAS_AVX2
namespace avx2 {
extern const LagRowsKernel lag_rows_kernel;
}  // namespace avx2
#else
namespace avx2 = portable;
#endif

const LagRowsKernel& lag_rows_kernel() {
  return chosen_kernel(portable::lag_rows_kernel, avx2::lag_rows_kernel, avx2::lag_rows_kernel);
}

}  // namespace carom
