#include "study/validation/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

double Check::deviation() const {
  if (equivalent) return *equivalent;
  const double difference = measured.value - expected;
  // What is no number never agrees.
  if (std::isnan(difference) || std::isnan(measured.error)) return std::numeric_limits<double>::infinity();
  const double beyond = std::max(0.0, std::abs(difference) - allowance);
  if (beyond == 0.0) return 0.0;
  // A deviation that no error explains is infinitely many of them.
  return std::copysign(measured.error > 0.0 ? beyond / measured.error : std::numeric_limits<double>::infinity(), difference);
}

bool Check::fits() const { return std::abs(deviation()) <= 5.0; }

bool Check::holds() const { return judged == Judged::shown || fits() == (judged == Judged::agrees); }

}  // namespace carom
