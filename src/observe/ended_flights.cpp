#include "observe/ended_flights.hpp"

#include "core/instructions.hpp"

namespace carom {

namespace portable {
extern const EndedFlightsKernel ended_flights_kernel;
}  // namespace portable

#if CAROM_HAS_AVX2
namespace avx2 {
extern const EndedFlightsKernel ended_flights_kernel;
}  // namespace avx2
#else
namespace avx2 = portable;
#endif

const EndedFlightsKernel& ended_flights_kernel() {
  return chosen_kernel(portable::ended_flights_kernel, avx2::ended_flights_kernel, avx2::ended_flights_kernel);
}

}  // namespace carom
