#include "neighbours/cage_search.hpp"

#include "core/instructions.hpp"

namespace carom {

namespace portable {
extern const CageKernel cage_kernel;
}
#if CAROM_HAS_AVX2
namespace avx2 {
extern const CageKernel cage_kernel;
}
#else
namespace avx2 = portable;
#endif

const CageKernel& cage_kernel() { return use_avx2() ? avx2::cage_kernel : portable::cage_kernel; }

}  // namespace carom
