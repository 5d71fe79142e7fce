#include "core/two_doubles.hpp"

#include <carom/state.hpp>

#include <numeric>

namespace carom {

double Disks::total_mass() const {
  TwoDoubles sum;
  for (const double m : mass) sum = sum.plus(m);
  return sum.high;
}

double Disks::mean_diameter() const {
  if (radius.empty()) return 0.0;
  return 2.0 * std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(count());
}

}  // namespace carom
