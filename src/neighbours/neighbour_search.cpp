#include "neighbours/neighbour_search.hpp"

#include "core/instructions.hpp"

namespace carom {

namespace portable {
extern const NeighbourSearchKernel neighbour_search_kernel;
}

#if CAROM_HAS_AVX2
namespace avx2 {
extern const NeighbourSearchKernel neighbour_search_kernel;
}
#else
namespace avx2 = portable;
#endif

#if CAROM_HAS_AVX512
namespace avx512 {
extern const NeighbourSearchKernel neighbour_search_kernel;
}
#else
namespace avx512 = avx2;
#endif

const NeighbourSearchKernel& neighbour_search_kernel() {
  return chosen_kernel(portable::neighbour_search_kernel, avx2::neighbour_search_kernel, avx512::neighbour_search_kernel);
}

}  // namespace carom
