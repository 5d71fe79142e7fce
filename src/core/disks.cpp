#include <carom/state.hpp>

#include <numeric>

namespace carom {

double Disks::total_mass() const {
  long double sum = 0.0L;
  for (const double m : mass) sum += static_cast<long double>(m);
  return static_cast<double>(sum);
}

double Disks::mean_diameter() const {
  if (radius.empty()) return 0.0;
  return 2.0 * std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(count());
}

}  // namespace carom
