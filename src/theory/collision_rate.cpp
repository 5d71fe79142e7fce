#include "theory/collision_rate.hpp"

#include "theory/equation_of_state.hpp"

#include <cmath>
#include <numbers>

namespace carom::theory {

double collision_rate(std::span<const Component> gas, double kT) {
  double radii = 0.0, squares = 0.0;  // per area
  for (const Component& kind : gas) {
    radii += kind.density * kind.radius;
    squares += kind.density * kind.radius * kind.radius;
  }
  const double eta = std::numbers::pi * squares;
  if (!(eta > 0.0)) return 0.0;
  const double bare = 1.0 / (1.0 - eta);
  const double crowding = (kolafa_rottner(eta) - 1.0) / (2.0 * eta) - bare;  // g - 1 / (1 - eta) of equal disks
  double rate = 0.0;
  for (const Component& i : gas)
    for (const Component& j : gas) {
      const double sigma = i.radius + j.radius;
      const double g = bare + crowding * (2.0 * i.radius * j.radius / sigma) * (radii / squares);
      const double reduced_mass = i.mass * j.mass / (i.mass + j.mass);
      rate += 0.5 * i.density * j.density * sigma * g * std::sqrt(2.0 * std::numbers::pi * kT / reduced_mass);
    }
  return rate;
}

}  // namespace carom::theory
