// Predictions for disks in wells. A pair is either inside its well, and reaches its core or the edge from within, or outside, and
// reaches the edge. Neighbours are predicted one at a time: vectors would not look up faster which pairs are inside.

#include "core/contact_time.hpp"
#include "core/single_prediction.hpp"

#include <algorithm>

namespace carom {

namespace {

template <class Line>
double meeting_time(const Line* lines, const PredictionFrame& frame, std::int32_t i, std::int32_t j, double now) {
  if (i == j) return never;
  const Line &a = lines[i], &b = lines[j];
  const Vec2<double> v(a.v[0] - b.v[0], a.v[1] - b.v[1]);
  Vec2<double> r;
  for (int k = 0; k < 2; ++k) r[k] = static_cast<double>(wrapped_difference(a.x[k], b.x[k])) * frame.unit[k] + v[k] * now;
  const double sigma = contact_distance(frame, a, b);
  const std::vector<std::int32_t>& inside = frame.inside[i];
  if (std::find(inside.begin(), inside.end(), j) == inside.end()) return now + contact_time<double>(r, v, frame.well * sigma);
  return now + std::min(contact_time<double>(r, v, sigma), escape_time<double>(r, v, frame.well * sigma));
}

template <bool falling, class Line>
void turn_and_predict(Line* lines, const PredictionFrame& frame, CollidedPair& pair, double now, double avx, double avy,
                      double bvx, double bvy) {
  turn<falling>(lines, frame, pair, now, {avx, avy, bvx, bvy});
  for (int k = 0; k < 2; ++k)
    predict_singly<Line, &meeting_time<Line>>(lines, frame, pair.disk[k], pair.around[k], now, pair.ahead[k]);
}

template <bool falling, class Line>
constexpr PredictionKernel<Line> kernel = {&predict_singly<Line, &meeting_time<Line>>, &turn_and_predict<falling, Line>, "wells"};

}  // namespace

extern const PredictionKernel<Flight> well_flight_kernel = kernel<false, Flight>;
extern const PredictionKernel<SizedFlight> well_sized_flight_kernel = kernel<false, SizedFlight>;
extern const PredictionKernel<Flight> falling_well_flight_kernel = kernel<true, Flight>;
extern const PredictionKernel<SizedFlight> falling_well_sized_flight_kernel = kernel<true, SizedFlight>;
extern const PredictionKernel<MixedFlight> well_mixed_flight_kernel = kernel<false, MixedFlight>;
extern const PredictionKernel<MixedFlight> falling_well_mixed_flight_kernel = kernel<true, MixedFlight>;

}  // namespace carom
