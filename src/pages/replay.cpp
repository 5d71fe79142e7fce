// Replay from event to event.

#include "pages/replay.hpp"

#include "core/nearest_image.hpp"
#include "scene/effect_traits.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

std::string why_no_replay(const Scene& scene) {
  if (!scene.changes.empty()) return "what acts changes during the run, which the event log does not hold";
  const Effects& effects = scene.effects;
  if (const std::string_view why = detail::first_reason(effects, &detail::EffectTraits::why_no_replay); !why.empty())
    return std::string(why);
  if (effects.growth_rate() > 0.0 && effects.collision.roughness)
    return "velocities of growing disks are rescaled by an energy that spins are part of, which the event log does not hold";
  return {};
}

namespace {

std::string why_not_by_its_kind(const Recording& run, std::uint64_t most_events, std::string_view holder) {
  if (!run.why_no_log.empty()) return run.why_no_log;
  if (run.events > most_events) return fmt::format("its {} events are more than the {} that {}", run.events, most_events, holder);
  return why_no_replay(run.scene);
}

}  // namespace

Replay::Replay(const Scene& scene, const Disks& disks, const State& start, VelocityDigits digits)
    : disks_(&disks), digits_(digits) {
  acceleration_ = scene.effects.acceleration();
  for (Eigen::Index i = 0; i < start.positions.cols(); ++i)
    flights_.push_back({start.positions.col(i), start.velocities.col(i), start.time});
  const Box& box = scene.box;
  for (std::size_t side = 0; side < 4; ++side) {
    const WallProperties& wall = scene.effects.walls[side];
    sides_[side].position = start.walls.size() == 4 ? start.walls[side].position : edge_of(box, side);
    sides_[side].velocity = wall.velocity.value_or(0.0);
    if (wall.mass && start.walls.size() == 4) sides_[side].velocity = start.walls[side].velocity;
    piston_mass_[side] = wall.mass.value_or(0.0);
    if (wall.mass) {
      const double inward = wall.load.value_or(0.0) * box.lengths()[1 - axis_of_wall(side)] / *wall.mass;
      sides_[side].acceleration = is_upper_wall(side) ? -inward : inward;
    }
  }
  if (scene.effects.growth_rate() > 0.0) {
    rescale_every_ = std::max<std::uint64_t>(1, disks.count() / 2);  // as src/simulation/driven_engine.cpp does
    energy_at_start_ = kinetic_energy(start.time);
  }
}

double Replay::rounded(double value) const {
  if (digits_ == VelocityDigits::twice) return value;
  // GCC 12 leaves the rounding out where it does two of them at once.
  const volatile float narrow = static_cast<float>(value);
  return static_cast<double>(narrow);
}

Eigen::Vector2d Replay::position(std::size_t disk, double time) const {
  const Flight& flight = flights_[disk];
  const double dt = time - flight.time;
  return flight.position + (flight.velocity + acceleration_ * (0.5 * dt)) * dt;
}

Eigen::Vector2d Replay::velocity(std::size_t disk, double time) const {
  return flights_[disk].velocity + acceleration_ * (time - flights_[disk].time);
}

double Replay::wall_position(std::size_t side, double time) const {
  const Side& wall = sides_[side];
  const double dt = time - wall.time;
  return wall.position + (wall.velocity + 0.5 * wall.acceleration * dt) * dt;
}

double Replay::kinetic_energy(double time) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < flights_.size(); ++i) sum += 0.5 * disks_->mass[i] * velocity(i, time).squaredNorm();
  return sum;
}

void Replay::turn(std::size_t disk, double time, const Eigen::Vector2d& velocity) {
  flights_[disk] = {position(disk, time), {rounded(velocity.x()), rounded(velocity.y())}, time};
}

/// The momentum that the disk is about to lose across the side goes to the piston.
void Replay::push(std::size_t side, std::size_t disk, double time, const Eigen::Vector2d& velocity) {
  const int axis = axis_of_wall(side);
  const double given = disks_->mass[disk] * (this->velocity(disk, time)[axis] - velocity[axis]);
  Side& piston = sides_[side];
  const double dt = time - piston.time;
  piston.position = wall_position(side, time);
  piston.velocity += piston.acceleration * dt + given / piston_mass_[side];
  piston.time = time;
}

std::optional<double> Replay::apply(const Event& event) {
  const auto disk = static_cast<std::size_t>(event.disk);
  if (event.partner < 0 && event.partner > first_obstacle) {
    const auto side = static_cast<std::size_t>(-1 - event.partner);
    if (piston_mass_[side] > 0.0) push(side, disk, event.time, event.velocity);
  }
  turn(disk, event.time, event.velocity);
  if (event.partner < 0) return {};
  turn(static_cast<std::size_t>(event.partner), event.time, event.partner_velocity);
  if (rescale_every_ == 0 || ++pairs_ % rescale_every_ != 0 || !(energy_at_start_ > 0.0)) return {};
  const double factor = rounded(std::sqrt(energy_at_start_ / kinetic_energy(event.time)));
  for (std::size_t i = 0; i < flights_.size(); ++i)
    flights_[i] = {position(i, event.time), velocity(i, event.time) * factor, event.time};
  return factor;
}

double distance_from_samples(const Scene& scene, Replay replay, const std::vector<Event>& events, std::uint64_t samples,
                             const std::function<State(std::uint64_t)>& sample) {
  constexpr std::uint64_t most_samples = 50;  // each is read and compared whole
  const std::uint64_t step = std::max<std::uint64_t>(1, samples / most_samples);
  double farthest = 0.0;
  std::size_t next = 0;
  for (std::uint64_t k = 0; k < samples; k += step) {
    if (k + step >= samples) k = samples - 1;  // the last one, which every slip before has reached
    const State state = sample(k);
    for (; next < events.size() && events[next].time <= state.time; ++next) replay.apply(events[next]);
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
      const Eigen::Vector2d apart = replay.position(static_cast<std::size_t>(i), state.time) - state.positions.col(i);
      farthest = std::max(farthest, nearest_image(scene.box, apart).norm());
    }
    for (std::size_t side = 0; side < state.walls.size(); ++side)
      if (scene.effects.walls[side].mass)
        farthest = std::max(farthest, std::abs(replay.wall_position(side, state.time) - state.walls[side].position));
  }
  return farthest;
}

ExactRun read_exactly(const Recording& run, std::uint64_t most_events, std::string_view holder) {
  ExactRun exact;
  exact.start = run.sample(0);
  exact.why_not = why_not_by_its_kind(run, most_events, holder);
  if (!exact.exact()) return exact;
  const Scene& scene = run.scene;
  exact.events = run.event_log();
  exact.distance = distance_from_samples(scene, Replay(scene, run.disks, exact.start), exact.events, run.samples, run.sample);
  if (!(exact.distance <= replay_tolerance * scene.box.lengths().maxCoeff())) {
    exact.why_not =
        fmt::format("the collisions in its log do not lead to its samples (they are up to {:.2g} apart)", exact.distance);
    exact.events = {};
  }
  return exact;
}

}  // namespace carom
