#include "core/prediction.hpp"

#include "core/instructions.hpp"

namespace carom {

namespace portable {
extern const PredictionKernel<Flight> flight_kernel;
extern const PredictionKernel<SizedFlight> sized_flight_kernel;
extern const PredictionKernel<Flight> growing_flight_kernel;
extern const PredictionKernel<SizedFlight> growing_sized_flight_kernel;
extern const PredictionKernel<Flight> sheared_flight_kernel;
extern const PredictionKernel<SizedFlight> sheared_sized_flight_kernel;
}  // namespace portable

#if CAROM_HAS_AVX2
namespace avx2 {
extern const PredictionKernel<Flight> flight_kernel;
extern const PredictionKernel<SizedFlight> sized_flight_kernel;
extern const PredictionKernel<Flight> growing_flight_kernel;
extern const PredictionKernel<SizedFlight> growing_sized_flight_kernel;
extern const PredictionKernel<Flight> sheared_flight_kernel;
extern const PredictionKernel<SizedFlight> sheared_sized_flight_kernel;
}  // namespace avx2
#else
namespace avx2 = portable;
#endif

#if CAROM_HAS_AVX512
namespace avx512 {
extern const PredictionKernel<Flight> flight_kernel;
extern const PredictionKernel<SizedFlight> sized_flight_kernel;
extern const PredictionKernel<Flight> growing_flight_kernel;
extern const PredictionKernel<SizedFlight> growing_sized_flight_kernel;
extern const PredictionKernel<Flight> sheared_flight_kernel;
extern const PredictionKernel<SizedFlight> sheared_sized_flight_kernel;
}  // namespace avx512
#else
namespace avx512 = avx2;
#endif

extern const PredictionKernel<Flight> well_flight_kernel;
extern const PredictionKernel<SizedFlight> well_sized_flight_kernel;

template <>
const PredictionKernel<Flight>& prediction_kernel(Contact contact) {
  if (contact == Contact::wells) return well_flight_kernel;
  if (contact == Contact::growing)
    return chosen_kernel(portable::growing_flight_kernel, avx2::growing_flight_kernel, avx512::growing_flight_kernel);
  if (contact == Contact::sheared)
    return chosen_kernel(portable::sheared_flight_kernel, avx2::sheared_flight_kernel, avx512::sheared_flight_kernel);
  return chosen_kernel(portable::flight_kernel, avx2::flight_kernel, avx512::flight_kernel);
}

template <>
const PredictionKernel<SizedFlight>& prediction_kernel(Contact contact) {
  if (contact == Contact::wells) return well_sized_flight_kernel;
  if (contact == Contact::growing)
    return chosen_kernel(portable::growing_sized_flight_kernel, avx2::growing_sized_flight_kernel,
                         avx512::growing_sized_flight_kernel);
  if (contact == Contact::sheared)
    return chosen_kernel(portable::sheared_sized_flight_kernel, avx2::sheared_sized_flight_kernel,
                         avx512::sheared_sized_flight_kernel);
  return chosen_kernel(portable::sized_flight_kernel, avx2::sized_flight_kernel, avx512::sized_flight_kernel);
}

}  // namespace carom
