#include "observe/bounded_part.hpp"

#include <cmath>
#include <optional>

namespace carom {

void RateWithBoundedPart::add(double x, double weight, double before, double after) {
  all_.add(x, weight);
  rest_.add(x + (after - before), weight);
  weight_ += weight;
  const double deviation = after - mean_;
  mean_ += deviation / static_cast<double>(++count_);
  squares_ += deviation * (after - mean_);
}

void RateWithBoundedPart::fill(Scalar& scalar, double step, double offset) const {
  const std::optional<Blocking::Estimate> found = all_.estimate();
  if (!found) return;
  rest_.fill(scalar, step);
  scalar.value = offset + found->mean;
  if (!scalar.error) return;
  const double variance = squares_ / (static_cast<double>(count_) - 1.0);
  scalar.error = std::hypot(*scalar.error, std::sqrt(2.0 * variance) / std::abs(weight_));
}

}  // namespace carom
