// Predictions in a sheared box. Disks far from its upper and lower edges meet no disk beyond them and go to the vector kernel;
// the few others are predicted one neighbour at a time, by the formula of prediction_kernel.hpp.

#include "core/single_prediction.hpp"
#include "core/sliding_separation.hpp"

#include <cmath>
#include <cstdlib>

namespace carom {

namespace {

template <class Line>
double meeting_time(const Line* lines, const PredictionFrame& frame, std::int32_t i, std::int32_t j, double now) {
  const std::int32_t above = boxes_between(frame.sliding.heights[i], frame.sliding.heights[j]);
  const auto [r, velocity] = approach(frame, lines[i], lines[j], above, now);
  const double x = r[0], y = r[1], vx = velocity[0], vy = velocity[1];
  const double sigma = contact_distance(frame, lines[i], lines[j]), sigma2 = sigma * sigma;
  const double b = x * vx + y * vy;
  const double s = x * vy - y * vx;
  const double d = sigma2 * (vx * vx + vy * vy) - s * s;
  if (!(b < 0.0) || !(d >= 0.0)) return never;  // nor does a disk meet itself
  const double c = (x * x + y * y) - sigma2;
  const double wait = c / (std::sqrt(d) - b);
  return now + (wait > 0.0 ? wait : 0.0);
}

bool is_inner(const PredictionFrame& frame, const Surroundings& around) {
  return std::abs(std::int64_t{around.centre[1]}) < frame.sliding.inner;
}

/// `plain`: the kernel of an instruction set, for all other disks.
template <class Line, const PredictionKernel<Line>& plain>
void predict(const Line* lines, const PredictionFrame& frame, std::int32_t i, const Surroundings& around, double now,
             Prediction& ahead) {
  if (is_inner(frame, around)) return plain.predict(lines, frame, i, around, now, ahead);
  predict_singly<Line, &meeting_time<Line>>(lines, frame, i, around, now, ahead);
}

template <class Line, const PredictionKernel<Line>& plain>
void turn_and_predict(Line* lines, const PredictionFrame& frame, CollidedPair& pair, double now, double avx, double avy,
                      double bvx, double bvy) {
  if (is_inner(frame, pair.around[0]) && is_inner(frame, pair.around[1]))
    return plain.turn_and_predict(lines, frame, pair, now, avx, avy, bvx, bvy);
  turn<false>(lines, frame, pair, now, {avx, avy, bvx, bvy});
  for (int k = 0; k < 2; ++k) predict<Line, plain>(lines, frame, pair.disk[k], pair.around[k], now, pair.ahead[k]);
}

template <class Line, const PredictionKernel<Line>& plain>
constexpr PredictionKernel<Line> kernel = {&predict<Line, plain>, &turn_and_predict<Line, plain>, "sheared"};

}  // namespace

namespace portable {
extern const PredictionKernel<Flight> flight_kernel;
extern const PredictionKernel<SizedFlight> sized_flight_kernel;
extern const PredictionKernel<MixedFlight> mixed_flight_kernel;
extern const PredictionKernel<Flight> sheared_flight_kernel = kernel<Flight, flight_kernel>;
extern const PredictionKernel<SizedFlight> sheared_sized_flight_kernel = kernel<SizedFlight, sized_flight_kernel>;
extern const PredictionKernel<MixedFlight> sheared_mixed_flight_kernel = kernel<MixedFlight, mixed_flight_kernel>;
}  // namespace portable

#if CAROM_HAS_AVX2
namespace avx2 {
extern const PredictionKernel<Flight> flight_kernel;
extern const PredictionKernel<SizedFlight> sized_flight_kernel;
extern const PredictionKernel<MixedFlight> mixed_flight_kernel;
extern const PredictionKernel<Flight> sheared_flight_kernel = kernel<Flight, flight_kernel>;
extern const PredictionKernel<SizedFlight> sheared_sized_flight_kernel = kernel<SizedFlight, sized_flight_kernel>;
extern const PredictionKernel<MixedFlight> sheared_mixed_flight_kernel = kernel<MixedFlight, mixed_flight_kernel>;
}  // namespace avx2
#endif

#if CAROM_HAS_AVX512
namespace avx512 {
extern const PredictionKernel<Flight> flight_kernel;
extern const PredictionKernel<SizedFlight> sized_flight_kernel;
extern const PredictionKernel<MixedFlight> mixed_flight_kernel;
extern const PredictionKernel<Flight> sheared_flight_kernel = kernel<Flight, flight_kernel>;
extern const PredictionKernel<SizedFlight> sheared_sized_flight_kernel = kernel<SizedFlight, sized_flight_kernel>;
extern const PredictionKernel<MixedFlight> sheared_mixed_flight_kernel = kernel<MixedFlight, mixed_flight_kernel>;
}  // namespace avx512
#endif

}  // namespace carom
