#include "pages/trails.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

constexpr double most_stretches =
    10'000.0;  // of one flight; of a longer one, only its end is drawn, under which the rest would lie

}  // namespace

Trails::Trails(const Box& box, const Eigen::Vector2d& acceleration, double span)
    : box_(box), acceleration_(acceleration), span_(span) {}

void Trails::follow(std::size_t disk) {
  if (disk >= flights_.size()) flights_.resize(disk + 1);
  followed_.resize(flights_.size(), false);
  followed_[disk] = true;
}

void Trails::forget() {
  for (auto& flights : flights_) flights.clear();
}

void Trails::note(std::size_t disk, double time, const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                  double shear_displacement) {
  if (disk >= flights_.size() || !followed_[disk]) return;
  std::deque<Flight>& flights = flights_[disk];
  flights.push_back({time, position, velocity, shear_displacement});
  while (flights.size() > 1 && flights[1].time <= time - span_) flights.pop_front();
}

void Trails::add_stretches(const Flight& flight, double from, double to, std::vector<Stretch>& trail) const {
  const double speed = flight.velocity.norm() + acceleration_.norm() * (to - flight.time);
  double longest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis)
    if (box_.periodic(axis)) longest = std::min(longest, 0.5 * box_.lengths()[axis]);
  const double needed = std::ceil(speed * (to - from) / longest);
  const double pieces = std::clamp(needed, 1.0, most_stretches);
  if (needed > pieces) from = to - pieces * longest / speed;
  const auto place = [&](double t) -> Eigen::Vector2d {
    return flight.position + (flight.velocity + acceleration_ * (0.5 * t)) * t;
  };
  const double dt = (to - from) / pieces;
  for (int k = 0; k < static_cast<int>(pieces); ++k) {
    const double begin = from - flight.time + k * dt;
    const Eigen::Vector2d start = place(begin), shift = into_box(box_, start, flight.shear_displacement);
    const Eigen::Vector2d middle = start + (flight.velocity + acceleration_ * begin) * (0.5 * dt);
    trail.push_back({start + shift, middle + shift, place(begin + dt) + shift});
  }
}

std::vector<std::vector<Stretch>> Trails::until(double time) const {
  std::vector<std::vector<Stretch>> trails(flights_.size());
  for (std::size_t i = 0; i < flights_.size(); ++i) {
    const std::deque<Flight>& flights = flights_[i];
    for (std::size_t k = 0; k < flights.size(); ++k) {
      const double from = std::max(flights[k].time, time - span_);
      const double to = k + 1 < flights.size() ? std::min(flights[k + 1].time, time) : time;
      if (to > from) add_stretches(flights[k], from, to, trails[i]);
    }
  }
  return trails;
}

}  // namespace carom
