#include "simulation/springs.hpp"

#include "core/reduced_mass.hpp"
#include "stepper/grid.hpp"
#include "stepper/soft.hpp"
#include "stepper/stable_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace carom::detail {

namespace {

/// Returns one in the third digit of `value` > 0.
double third_digit(double value) { return std::pow(10.0, std::floor(std::log10(value)) - 2.0); }
/// Returns the nearest number of three digits that is not above `value` > 0.
double three_digits_below(double value) { return std::floor(value / third_digit(value)) * third_digit(value); }
/// Returns the nearest number of three digits that is above `value` > 0.
double three_digits_above(double value) { return (std::floor(value / third_digit(value)) + 1.0) * third_digit(value); }

}  // namespace

double least_restitution(const Effects& effects) {
  double least = effects.collision.restitution.value_or(1.0);
  for (const WallProperties& wall : effects.walls) least = std::min(least, wall.restitution.value_or(1.0));
  return least;
}

double stable_step(const Disks& disks, const Effects& effects, double stiffness) {
  return stable_below(disks.radius, disks.mass, stiffness, SoftStep<ClosePairs>::relative_damping(least_restitution(effects)));
}

void require_stable_springs(const FixedStep& step, const Disks& disks, const Effects& effects) {
  using Springs = SoftStep<ClosePairs>;
  if (step.method != "soft") {
    if (!step.stiffness) return;
    throw std::invalid_argument(
        fmt::format("the method \"{}\" has no springs, and so no stiffness; leave it out, or take \"soft\"", step.method));
  }
  if (!step.stiffness) {
    // What dt gives them makes all dt alike.
    if (1.0 < stable_step(disks, effects, Springs::stiffness(disks.mass, 1.0))) return;
    const double bound = stable_step(disks, effects, 1.0) / step.dt;
    throw std::invalid_argument(fmt::format(
        "every time step with {:g} steps in the shortest contact is unstable where many small disks touch a large one that is "
        "not heavy enough; give a stiffness of at most {:.3g} with a time step of {:g}, and a hundredth of that to resolve "
        "contacts",
        Springs::steps_per_contact, three_digits_below(bound * bound), step.dt));
  }
  if (!(*step.stiffness > 0.0 && std::isfinite(*step.stiffness)))
    throw std::invalid_argument(fmt::format("the stiffness is {:g}; it must be positive and finite", *step.stiffness));
  const double bound = stable_step(disks, effects, *step.stiffness);
  if (!(step.dt < bound))
    throw std::invalid_argument(fmt::format(
        "a time step of {:g} is unstable with a stiffness of {:g} where several disks touch one; take at most {:.3g}, "
        "and a tenth of that to resolve contacts",
        step.dt, *step.stiffness, three_digits_below(bound)));
}

void require_springs_that_hold(const Simulation& simulation) {
  if (!simulation.stiffness()) return;
  const double stiffness = *simulation.stiffness();
  const auto require_above = [&](double least, const char* what) {
    if (!(stiffness > least))
      throw std::invalid_argument(
          fmt::format("with a stiffness of {:g} {} at the speeds of the start; take a stiffness above {:.3g}", stiffness, what,
                      three_digits_above(least)));
  };
  const Disks& disks = simulation.disks();
  const Eigen::VectorXd speeds = simulation.state().velocities.colwise().norm();
  const auto speed = [&](std::size_t i) { return speeds[static_cast<Eigen::Index>(i)]; };
  double at_walls = 0.0;
  std::size_t fastest[2] = {};
  for (std::size_t i = 0; i < disks.count(); ++i) {
    const double rate = speed(i) / disks.radius[i];
    at_walls = std::max(at_walls, disks.mass[i] * rate * rate);
    if (i == 0) continue;
    if (speed(i) > speed(fastest[0]))
      fastest[1] = std::exchange(fastest[0], i);
    else if (i == 1 || speed(i) > speed(fastest[1]))
      fastest[1] = i;
  }
  const Box& box = simulation.scene().box;
  if (!box.periodic(0) || !box.periodic(1)) require_above(at_walls, "a disk would leave the box through a wall");
  if (!simulation.scene().effects.obstacles.empty()) require_above(at_walls, "a disk would pass through an obstacle");
  if (disks.count() < 2) return;
  const auto [i, j] = fastest;
  const double rate = (speed(i) + speed(j)) / (disks.radius[i] + disks.radius[j]);
  require_above(reduced_mass(disks.mass[i], disks.mass[j]) * rate * rate, "the two fastest disks would pass through each other");
}

}  // namespace carom::detail
