#include "core/prediction.hpp"

#include "core/instructions.hpp"

namespace carom {

CAROM_DECLARE_KERNELS(extern const PredictionKernel<Flight> flight_kernel, falling_flight_kernel, growing_flight_kernel,
                      sheared_flight_kernel;
                      extern const PredictionKernel<SizedFlight> sized_flight_kernel, falling_sized_flight_kernel,
                      growing_sized_flight_kernel, sheared_sized_flight_kernel;)

extern const PredictionKernel<Flight> well_flight_kernel;
extern const PredictionKernel<SizedFlight> well_sized_flight_kernel;
extern const PredictionKernel<Flight> falling_well_flight_kernel;
extern const PredictionKernel<SizedFlight> falling_well_sized_flight_kernel;

template <>
const PredictionKernel<Flight>& prediction_kernel(Contact contact) {
  switch (contact) {
    case Contact::falling:
      return CAROM_CHOSEN_KERNEL(falling_flight_kernel);
    case Contact::growing:
      return CAROM_CHOSEN_KERNEL(growing_flight_kernel);
    case Contact::wells:
      return well_flight_kernel;
    case Contact::falling_wells:
      return falling_well_flight_kernel;
    case Contact::sheared:
      return CAROM_CHOSEN_KERNEL(sheared_flight_kernel);
    case Contact::hard:
      break;
  }
  return CAROM_CHOSEN_KERNEL(flight_kernel);
}

template <>
const PredictionKernel<SizedFlight>& prediction_kernel(Contact contact) {
  switch (contact) {
    case Contact::falling:
      return CAROM_CHOSEN_KERNEL(falling_sized_flight_kernel);
    case Contact::growing:
      return CAROM_CHOSEN_KERNEL(growing_sized_flight_kernel);
    case Contact::wells:
      return well_sized_flight_kernel;
    case Contact::falling_wells:
      return falling_well_sized_flight_kernel;
    case Contact::sheared:
      return CAROM_CHOSEN_KERNEL(sheared_sized_flight_kernel);
    case Contact::hard:
      break;
  }
  return CAROM_CHOSEN_KERNEL(sized_flight_kernel);
}

}  // namespace carom
