#include "core/prediction.hpp"

#include "core/instructions.hpp"

namespace carom {

CAROM_DECLARE_KERNELS(extern const PredictionKernel<Flight> flight_kernel, falling_flight_kernel, growing_flight_kernel,
                      sheared_flight_kernel;
                      extern const PredictionKernel<SizedFlight> sized_flight_kernel, falling_sized_flight_kernel,
                      growing_sized_flight_kernel, sheared_sized_flight_kernel;
                      extern const PredictionKernel<MixedFlight> mixed_flight_kernel, falling_mixed_flight_kernel,
                      growing_mixed_flight_kernel, sheared_mixed_flight_kernel;)

extern const PredictionKernel<Flight> step_flight_kernel, falling_step_flight_kernel;
extern const PredictionKernel<SizedFlight> step_sized_flight_kernel, falling_step_sized_flight_kernel;
extern const PredictionKernel<MixedFlight> step_mixed_flight_kernel, falling_step_mixed_flight_kernel;

// NOLINTBEGIN(bugprone-macro-parentheses): a type has none
#define CAROM_PREDICTION_KERNELS(Line, name)                             \
  template <>                                                            \
  const PredictionKernel<Line>& prediction_kernel(PredictionKind kind) { \
    switch (kind) {                                                      \
      case PredictionKind::falling:                                      \
        return CAROM_CHOSEN_KERNEL(falling_##name);                      \
      case PredictionKind::growing:                                      \
        return CAROM_CHOSEN_KERNEL(growing_##name);                      \
      case PredictionKind::steps:                                        \
        return step_##name;                                              \
      case PredictionKind::falling_steps:                                \
        return falling_step_##name;                                      \
      case PredictionKind::sheared:                                      \
        return CAROM_CHOSEN_KERNEL(sheared_##name);                      \
      case PredictionKind::hard:                                         \
        break;                                                           \
    }                                                                    \
    return CAROM_CHOSEN_KERNEL(name);                                    \
  }
// NOLINTEND(bugprone-macro-parentheses)
CAROM_PREDICTION_KERNELS(Flight, flight_kernel)
CAROM_PREDICTION_KERNELS(SizedFlight, sized_flight_kernel)
CAROM_PREDICTION_KERNELS(MixedFlight, mixed_flight_kernel)

}  // namespace carom
