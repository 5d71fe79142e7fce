// Collisions as columns.

#include "io/event_log.hpp"

#include <string>
#include <utility>

namespace carom::detail {

namespace {

// 64 KiB of a column of doubles: large enough for the compression, small enough that a killed run loses little.
DatasetLayout layout(std::vector<hsize_t> row) { return {.row = std::move(row), .rows_per_chunk = 8192, .compressed = true}; }

Hdf5Id described_group(hid_t file) {
  Hdf5Id group = create_group(file, "events");
  write_attribute(group.get(), "about",
                  std::string("every collision in order of time; velocities are those just after it; the exact time is time + "
                              "time_remainder to twice the digits of a double; partner < 0 is a wall: -1 left, -2 right, "
                              "-3 bottom, -4 top; partner <= -1000 is obstacle -1000 - partner of the scene, counted from 0"));
  return group;
}

}  // namespace

EventLog::EventLog(hid_t file) : EventLog(described_group(file)) {}

EventLog::EventLog(Hdf5Id group)
    : group_(std::move(group)),
      time_(group_.get(), "time", layout({})),
      time_remainder_(group_.get(), "time_remainder", layout({})),
      disk_(group_.get(), "disk", layout({})),
      partner_(group_.get(), "partner", layout({})),
      velocity_(group_.get(), "velocity", layout({2})),
      partner_velocity_(group_.get(), "partner_velocity", layout({2})) {
  write_attribute(time_.id(), "unit", std::string("ps"));
  write_attribute(time_remainder_.id(), "unit", std::string("ps"));
  write_attribute(velocity_.id(), "unit", std::string("Angstrom ps-1"));
  write_attribute(partner_velocity_.id(), "unit", std::string("Angstrom ps-1"));
}

void EventLog::start(const State& state) {
  const Hdf5Id start = create_group(group_.get(), "start");
  write_attribute(start.get(), "about", std::string("positions in the box and velocities at time 0, before the first event"));
  write_fixed(start.get(), "position", state.positions);
  write_fixed(start.get(), "velocity", state.velocities);
}

void EventLog::append(std::span<const Event> events) {
  for (const Event& event : events) {
    time_.add(event.time);
    time_remainder_.add(event.time_remainder);
    disk_.add(event.disk);
    partner_.add(event.partner);
    const auto velocity = velocity_.add_row();
    velocity[0] = event.velocity.x();
    velocity[1] = event.velocity.y();
    const auto partner_velocity = partner_velocity_.add_row();
    partner_velocity[0] = event.partner_velocity.x();
    partner_velocity[1] = event.partner_velocity.y();
  }
}

void EventLog::write() {
  for (auto* column : {&time_, &time_remainder_, &velocity_, &partner_velocity_}) column->write();
  for (auto* column : {&disk_, &partner_}) column->write();
}

void EventLog::close() {
  group_.reset();
  for (auto* column : {&time_, &time_remainder_, &velocity_, &partner_velocity_}) column->close();
  for (auto* column : {&disk_, &partner_}) column->close();
}

std::size_t EventLog::buffered_bytes() const {
  std::size_t bytes = disk_.buffered_bytes() + partner_.buffered_bytes();
  for (const auto* column : {&time_, &time_remainder_, &velocity_, &partner_velocity_}) bytes += column->buffered_bytes();
  return bytes;
}

}  // namespace carom::detail
