#pragma once
// A log of events as columns for a page that replays it. A partner that is no disk has a number after theirs: sides of the box,
// then the rescaling of all velocities, then obstacles.

#include "pages/number_columns.hpp"

#include <carom/state.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom::detail {

template <class Id>
struct EventColumns {
  std::vector<double> time;
  std::vector<Id> disk, partner;
  std::vector<std::array<double, 4>> velocity;

  void add(const Event& event, std::size_t disks) {
    const auto code = event.partner >= 0               ? event.partner
                      : event.partner > first_obstacle ? static_cast<std::int32_t>(disks) - 1 - event.partner
                                                       : static_cast<std::int32_t>(disks) + 5 + first_obstacle - event.partner;
    push(event.time, static_cast<Id>(event.disk), static_cast<Id>(code),
         {event.velocity.x(), event.velocity.y(), event.partner_velocity.x(), event.partner_velocity.y()});
  }
  void add_rescaling(double when, double factor, std::size_t disks) {
    push(when, Id{0}, static_cast<Id>(disks + 4), {factor, 0.0, 0.0, 0.0});
  }
  template <class Real>
  void put(NumberColumns& columns) const {
    columns.add("time", time);
    columns.add("disk", disk);
    columns.add("partner", partner);
    std::vector<Real> flat;
    for (const auto& four : velocity)
      for (const double v : four) flat.push_back(static_cast<Real>(v));
    columns.add("velocity", flat);
  }

 private:
  void push(double when, Id first, Id second, const std::array<double, 4>& velocities) {
    time.push_back(when);
    disk.push_back(first);
    partner.push_back(second);
    velocity.push_back(velocities);
  }
};

/// Position and velocity of every disk, x and y of each.
[[nodiscard]] inline std::vector<double> start_column(const State& start) {
  std::vector<double> numbers;
  for (Eigen::Index i = 0; i < start.positions.cols(); ++i)
    numbers.insert(numbers.end(), {start.positions(0, i), start.positions(1, i), start.velocities(0, i), start.velocities(1, i)});
  return numbers;
}

}  // namespace carom::detail
