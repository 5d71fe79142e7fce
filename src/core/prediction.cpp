#include "core/prediction.hpp"

#include "core/instructions.hpp"

namespace carom {

namespace portable {
extern const PredictionKernel<Flight> flight_kernel;
extern const PredictionKernel<SizedFlight> sized_flight_kernel;
}  // namespace portable

#if CAROM_HAS_AVX2
namespace avx2 {
extern const PredictionKernel<Flight> flight_kernel;
extern const PredictionKernel<SizedFlight> sized_flight_kernel;
}  // namespace avx2
#else
namespace avx2 = portable;
#endif

template <>
const PredictionKernel<Flight>& prediction_kernel() {
  return use_avx2() ? avx2::flight_kernel : portable::flight_kernel;
}

template <>
const PredictionKernel<SizedFlight>& prediction_kernel() {
  return use_avx2() ? avx2::sized_flight_kernel : portable::sized_flight_kernel;
}

}  // namespace carom
