#include "observe/ended_flights.hpp"

#include "core/instructions.hpp"

namespace carom {

CAROM_DECLARE_KERNELS_TO_AVX2(extern const EndedFlightsKernel ended_flights_kernel;)

const EndedFlightsKernel& ended_flights_kernel() { return CAROM_CHOSEN_KERNEL_TO_AVX2(ended_flights_kernel); }

}  // namespace carom
