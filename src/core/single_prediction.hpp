#pragma once
// Predictions of one neighbour at a time, for pairs that the vectors of prediction_kernel.hpp do not support: those in steps of a
// potential and those in a sheared box. The time at which a disk leaves its neighbourhood has the same bits as there.

#include "core/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace carom {

constexpr double never = std::numeric_limits<double>::infinity();

inline double contact_distance(const PredictionFrame& frame, const Flight& /*a*/, const Flight& /*b*/) { return frame.sigma; }
inline double contact_distance(const PredictionFrame& /*frame*/, const SizedFlight& a, const SizedFlight& b) {
  return a.radius + b.radius;
}
inline double contact_distance(const PredictionFrame& frame, const MixedFlight& a, const MixedFlight& b) {
  return (a.radius + b.radius) * frame.contact_scales[a.species * frame.kinds + b.species];
}

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

/// When disks i and j meet, from `now` on; infinity for never, and for a disk and itself.
template <class Line>
using MeetingTime = double (*)(const Line* lines, const PredictionFrame& frame, std::int32_t i, std::int32_t j, double now);

template <class Line, MeetingTime<Line> meeting_time>
void predict_singly(const Line* lines, const PredictionFrame& frame, std::int32_t i, const Surroundings& around, double now,
                    Prediction& ahead) {
  ahead = {never, -1, 0, leaving_time(frame, lines[i], around, now)};
  for (std::uint32_t n = 0; n < around.count; ++n) {
    const double time = meeting_time(lines, frame, i, around.ids[n], now);
    if (time == never || time > ahead.pair_time) continue;
    ahead.tied = time == ahead.pair_time ? 1 : 0;
    ahead.pair_time = time;
    ahead.partner = around.ids[n];
  }
}

/// Draws the new lines of a pair. `v`: x and y of the one, x and y of the other.
template <bool falling, class Line>
void turn(Line* lines, const PredictionFrame& frame, CollidedPair& pair, double now, const double (&v)[4]) {
  pair.wrapped = pair.downwards = 0;
  for (int k = 0; k < 4; ++k) {
    Line& line = lines[pair.disk[k / 2]];
    const int axis = k % 2;
    const auto nearest = [&](double speed) { return static_cast<std::int64_t>(std::rint(speed * now * frame.steps[axis])); };
    const auto by = falling ? nearest(line.v[axis]) - nearest(v[k])
                            : static_cast<std::int64_t>((line.v[axis] - v[k]) * now * frame.steps[axis]);
    if (__builtin_add_overflow(line.x[axis], by, &line.x[axis])) pair.wrapped |= 1U << k;
    if (by < 0) pair.downwards |= 1U << k;
    line.v[axis] = v[k];
  }
}

}  // namespace carom
