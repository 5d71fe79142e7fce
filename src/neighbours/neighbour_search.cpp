#include "neighbours/neighbour_search.hpp"

#include "core/instructions.hpp"

namespace carom {

CAROM_DECLARE_KERNELS(extern const NeighbourSearchKernel neighbour_search_kernel;)

const NeighbourSearchKernel& neighbour_search_kernel() { return CAROM_CHOSEN_KERNEL(neighbour_search_kernel); }

}  // namespace carom
