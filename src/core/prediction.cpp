#include "core/prediction.hpp"

#include "core/instructions.hpp"

namespace carom {

#define CAROM_DECLARE_KERNELS                                             \
  extern const PredictionKernel<Flight> flight_kernel;                    \
  extern const PredictionKernel<SizedFlight> sized_flight_kernel;         \
  extern const PredictionKernel<Flight> falling_flight_kernel;            \
  extern const PredictionKernel<SizedFlight> falling_sized_flight_kernel; \
  extern const PredictionKernel<Flight> growing_flight_kernel;            \
  extern const PredictionKernel<SizedFlight> growing_sized_flight_kernel; \
  extern const PredictionKernel<Flight> sheared_flight_kernel;            \
  extern const PredictionKernel<SizedFlight> sheared_sized_flight_kernel;

namespace portable {
CAROM_DECLARE_KERNELS
}  // namespace portable

#if CAROM_HAS_AVX2
namespace avx2 {
CAROM_DECLARE_KERNELS
}  // namespace avx2
#else
namespace avx2 = portable;
#endif

#if CAROM_HAS_AVX512
namespace avx512 {
CAROM_DECLARE_KERNELS
}  // namespace avx512
#else
namespace avx512 = avx2;
#endif

extern const PredictionKernel<Flight> well_flight_kernel;
extern const PredictionKernel<SizedFlight> well_sized_flight_kernel;
extern const PredictionKernel<Flight> falling_well_flight_kernel;
extern const PredictionKernel<SizedFlight> falling_well_sized_flight_kernel;

#define CAROM_CHOSEN(name) chosen_kernel(portable::name, avx2::name, avx512::name)

template <>
const PredictionKernel<Flight>& prediction_kernel(Contact contact) {
  switch (contact) {
    case Contact::falling:
      return CAROM_CHOSEN(falling_flight_kernel);
    case Contact::growing:
      return CAROM_CHOSEN(growing_flight_kernel);
    case Contact::wells:
      return well_flight_kernel;
    case Contact::falling_wells:
      return falling_well_flight_kernel;
    case Contact::sheared:
      return CAROM_CHOSEN(sheared_flight_kernel);
    case Contact::hard:
      break;
  }
  return CAROM_CHOSEN(flight_kernel);
}

template <>
const PredictionKernel<SizedFlight>& prediction_kernel(Contact contact) {
  switch (contact) {
    case Contact::falling:
      return CAROM_CHOSEN(falling_sized_flight_kernel);
    case Contact::growing:
      return CAROM_CHOSEN(growing_sized_flight_kernel);
    case Contact::wells:
      return well_sized_flight_kernel;
    case Contact::falling_wells:
      return falling_well_sized_flight_kernel;
    case Contact::sheared:
      return CAROM_CHOSEN(sheared_sized_flight_kernel);
    case Contact::hard:
      break;
  }
  return CAROM_CHOSEN(sized_flight_kernel);
}

}  // namespace carom
