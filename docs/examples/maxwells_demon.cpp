// Maxwell's demon: two gases at one temperature, a wall between them, and a door in the wall that opens for fast disks from the
// left and for slow disks from the right. The door is an obstacle, which set_effects() puts there and takes away; the rule is a
// function of the state. Heat flows from cold to hot, for the demon looks at every disk.

#include <carom/carom.hpp>

#include <cmath>
#include <cstdio>
#include <exception>

namespace {

constexpr double middle = 20.0, door_from = 8.0, door_to = 12.0, radius = 0.5, temperature = 1.0;

/// Returns the distance of a disk from the wall's line, positive on the left, and NaN where it is not in front of the door.
double distance_in_front_of_door(const carom::State& state, Eigen::Index i) {
  const Eigen::Vector2d r = state.positions.col(i);
  return r.y() < door_from - radius || r.y() > door_to + radius ? NAN : middle - r.x();
}

/// Returns whether the door is to be open. A disk in the doorway keeps it as it is.
bool wants_open(const carom::State& state, bool open) {
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
    if (std::abs(distance_in_front_of_door(state, i)) < 1.01 * radius) return open;
  bool wanted = false;
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    const Eigen::Vector2d v = state.velocities.col(i);
    const double distance = distance_in_front_of_door(state, i);
    if (!(std::abs(distance) < 2.0 && distance * v.x() > 0.0)) continue;  // far away, or moving away
    const bool fast = v.squaredNorm() > 2.0 * temperature;
    if ((distance > 0.0) != fast) return false;  // this one is to stay where it is
    wanted = true;
  }
  return wanted;
}

}  // namespace

int main() try {
  using carom::SegmentObstacle;
  const SegmentObstacle door{.from = {middle, door_from}, .to = {middle, door_to}};
  const carom::Scene scene{
      .box = {.lower = {0.0, 0.0}, .upper = {2.0 * middle, 20.0}},
      .species = {{.count = 100,
                   .radius = radius,
                   .mass = 1.0,
                   .positions = carom::RandomPositions{},
                   .velocities = carom::MaxwellVelocities{temperature}}},
      .effects = {.obstacles = {SegmentObstacle{.from = {middle, 0.0}, .to = {middle, door_from}},
                                SegmentObstacle{.from = {middle, door_to}, .to = {middle, 20.0}}, door}},
  };
  carom::Simulation simulation = carom::make_simulation(scene);
  carom::State state;
  bool open = false;
  int openings = 0;
  for (int k = 1; k <= 4000; ++k) {
    simulation.run_until(0.1 * k);
    simulation.state(state);
    if (wants_open(state, open) == open) continue;
    open = !open;
    openings += open ? 1 : 0;
    carom::Effects effects = simulation.scene().effects;
    open ? effects.obstacles.pop_back() : effects.obstacles.push_back(door);
    simulation.set_effects(effects);
  }

  double energy[2] = {0.0, 0.0};
  int disks[2] = {0, 0};
  simulation.state(state);
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    const int side = state.positions(0, i) < middle ? 0 : 1;
    energy[side] += 0.5 * state.velocities.col(i).squaredNorm();
    ++disks[side];
  }
  const double left = energy[0] / disks[0], right = energy[1] / disks[1];
  std::printf("the door was opened %d times; kT is %.3f on the left (%d disks) and %.3f on the right (%d disks)\n", openings,
              left, disks[0], right, disks[1]);
  std::printf("%s\n", right > 1.2 * left ? "heat has flowed from cold to hot" : "nothing to see");
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
