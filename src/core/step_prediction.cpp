// Predictions for disks with a stepped potential. A pair in a step reaches the step's inner edge, which may be the hard core, or
// its outer one. Neighbours are predicted one at a time: vectors would not look up faster in which step a pair is.

#include "core/pair_step.hpp"
#include "core/single_prediction.hpp"

namespace carom {

namespace {

template <class Line>
double meeting_time(const Line* lines, const PredictionFrame& frame, std::int32_t i, std::int32_t j, double now) {
  if (i == j) return never;
  const Line &a = lines[i], &b = lines[j];
  const Vec2<double> v(a.v[0] - b.v[0], a.v[1] - b.v[1]);
  Vec2<double> r;
  for (int k = 0; k < 2; ++k) r[k] = static_cast<double>(wrapped_difference(a.x[k], b.x[k])) * frame.unit[k] + v[k] * now;
  const std::int32_t step = find_step(frame.pair_steps[i], j, frame.outside);
  return now + time_to_edge<double>(frame.edges, step, frame.outside, r, v, contact_distance(frame, a, b));
}

template <bool falling, class Line>
void turn_and_predict(Line* lines, const PredictionFrame& frame, CollidedPair& pair, double now, double avx, double avy,
                      double bvx, double bvy) {
  turn<falling>(lines, frame, pair, now, {avx, avy, bvx, bvy});
  for (int k = 0; k < 2; ++k)
    predict_singly<Line, &meeting_time<Line>>(lines, frame, pair.disk[k], pair.around[k], now, pair.ahead[k]);
}

template <bool falling, class Line>
constexpr PredictionKernel<Line> kernel = {&predict_singly<Line, &meeting_time<Line>>, &turn_and_predict<falling, Line>, "steps"};

}  // namespace

extern const PredictionKernel<Flight> step_flight_kernel = kernel<false, Flight>;
extern const PredictionKernel<SizedFlight> step_sized_flight_kernel = kernel<false, SizedFlight>;
extern const PredictionKernel<Flight> falling_step_flight_kernel = kernel<true, Flight>;
extern const PredictionKernel<SizedFlight> falling_step_sized_flight_kernel = kernel<true, SizedFlight>;
extern const PredictionKernel<MixedFlight> step_mixed_flight_kernel = kernel<false, MixedFlight>;
extern const PredictionKernel<MixedFlight> falling_step_mixed_flight_kernel = kernel<true, MixedFlight>;

}  // namespace carom
