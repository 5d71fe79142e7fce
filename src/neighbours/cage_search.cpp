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

#if CAROM_HAS_AVX512
namespace avx512 {
extern const CageKernel cage_kernel;
}
#else
namespace avx512 = avx2;
#endif

const CageKernel& cage_kernel() { return chosen_kernel(portable::cage_kernel, avx2::cage_kernel, avx512::cage_kernel); }

}  // namespace carom
