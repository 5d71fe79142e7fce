#include "theory/barometer.hpp"

#include "theory/equation_of_state.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace carom::theory {

std::vector<double> barometer(double weight, double per_floor, double radius, double height, std::size_t steps) {
  const double dy = height / static_cast<double>(steps), area = std::numbers::pi * radius * radius;
  const auto profile = [&](double at_floor) {
    std::vector<double> n;
    double at = at_floor;
    for (std::size_t k = 0; k < 2 * steps; ++k) {  // two halves of each step
      const double eta = at * area, d = 1e-4 * eta;
      const double slope = ((eta + d) * kolafa_rottner(eta + d) - (eta - d) * kolafa_rottner(eta - d)) / (2.0 * d);
      at *= std::exp(-weight / slope * 0.5 * dy);
      if (k % 2 == 0) n.push_back(at);
    }
    return n;
  };
  // The more disks at the floor, the more in all.
  double low = 0.0, high = 10.0 * per_floor * weight;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    const std::vector<double> n = profile(middle);
    (std::accumulate(n.begin(), n.end(), 0.0) * dy < per_floor ? low : high) = middle;
  }
  return profile(low);
}

}  // namespace carom::theory
