// Predictions for disks in wells: a pair is either inside its well, and comes to its core or to the edge from within, or outside,
// and comes to the edge. One neighbour at a time: who is inside is looked up, which no vector does faster.

#include "core/contact_time.hpp"
#include "core/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

double contact_distance(const PredictionFrame& frame, const Flight& /*a*/, const Flight& /*b*/) { return frame.sigma; }
double contact_distance(const PredictionFrame& /*frame*/, const SizedFlight& a, const SizedFlight& b) {
  return a.radius + b.radius;
}

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

/// As in prediction_kernel.hpp.
template <class Line>
double leaving_time(const PredictionFrame& frame, const Line& line, const Surroundings& around, double now) {
  double first = never;
  for (int k = 0; k < 2; ++k) {
    if (line.v[k] == 0.0) continue;
    const auto centre = static_cast<std::int64_t>(static_cast<std::uint64_t>(around.centre[k]) << 32);
    const double off = static_cast<double>(wrapped_difference(line.x[k], centre)) * frame.unit[k] + line.v[k] * now;
    const double room = std::max(frame.half_width - (line.v[k] > 0.0 ? off : -off), 0.0);
    const double exact = now + room / std::abs(line.v[k]);
    const double shift = frame.edge_step * 0x1.8p52;
    const double nearest = (exact + shift) - shift;
    const double rounded = nearest > exact ? nearest - frame.edge_step : nearest;
    first = std::min(first, rounded > now ? rounded : exact);
  }
  return first;
}

template <class Line>
void predict(const Line* lines, const PredictionFrame& frame, std::int32_t i, const Surroundings& around, double now,
             Prediction& ahead) {
  ahead = {never, leaving_time(frame, lines[i], around, now), -1, 0};
  for (std::uint32_t n = 0; n < around.count; ++n) {
    const double time = meeting_time(lines, frame, i, around.ids[n], now);
    if (time == never || time > ahead.pair_time) continue;
    ahead.tied = time == ahead.pair_time ? 1 : 0;
    ahead.pair_time = time;
    ahead.partner = around.ids[n];
  }
}

template <class Line>
void store_and_predict(Line* lines, const PredictionFrame& frame, CollidedPair& pair, double now, std::int64_t ax,
                       std::int64_t ay, std::int64_t bx, std::int64_t by, double avx, double avy, double bvx, double bvy) {
  Line &a = lines[pair.disk[0]], &b = lines[pair.disk[1]];
  a.x[0] = ax, a.x[1] = ay, a.v[0] = avx, a.v[1] = avy;
  b.x[0] = bx, b.x[1] = by, b.v[0] = bvx, b.v[1] = bvy;
  for (int k = 0; k < 2; ++k) predict(lines, frame, pair.disk[k], pair.around[k], now, pair.ahead[k]);
}

}  // namespace

extern const PredictionKernel<Flight> well_flight_kernel = {&predict<Flight>, &store_and_predict<Flight>, "wells"};
extern const PredictionKernel<SizedFlight> well_sized_flight_kernel = {&predict<SizedFlight>, &store_and_predict<SizedFlight>,
                                                                       "wells"};

}  // namespace carom
