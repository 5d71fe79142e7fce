#include "studies/validate/check.hpp"

#include "theory/goodness_of_fit.hpp"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

/// `difference` in standard errors. Without an error any difference is infinitely many of them; what is no number never agrees.
double in_errors(double difference, double error) {
  if (std::isnan(difference) || std::isnan(error)) return std::numeric_limits<double>::infinity();
  if (difference == 0.0) return 0.0;
  return error > 0.0 ? difference / error : std::copysign(std::numeric_limits<double>::infinity(), difference);
}

/// Returns the normal deviate that chance exceeds as often as Student's t with these degrees of freedom exceeds `t`.
double normal_for(double t, double freedom) {
  if (!std::isfinite(t) || !std::isfinite(freedom)) return t;
  const double beyond = cdf(complement(boost::math::students_t(freedom), std::abs(t)));
  return std::copysign(theory::standard_errors(2.0 * beyond), t);
}

}  // namespace

double Check::error() const { return std::hypot(measured.error, reference_error); }

double Check::freedom() const { return measured.freedom * std::pow(error() / measured.error, 4); }

double Check::z() const {
  return equivalent ? *equivalent : normal_for(in_errors(measured.value - expected, error()), freedom());
}

double Check::deviation() const {
  if (equivalent) return *equivalent;
  const double difference = measured.value - expected;
  if (std::isnan(difference)) return in_errors(difference, error());
  return normal_for(in_errors(std::copysign(std::max(0.0, std::abs(difference) - allowance), difference), error()), freedom());
}

bool Check::fits() const { return std::abs(deviation()) <= 5.0; }

bool Check::calibrates() const {
  const bool normal = !equivalent && !error_is_bound && measured.error > 0.0;
  return judged == Judged::agrees && normal && allowance + reference_error < 0.2 * measured.error;
}

bool Check::too_uncertain() const { return largest_error > 0.0 && !(error() <= largest_error); }

bool Check::holds() const { return judged == Judged::shown || (fits() == (judged == Judged::agrees) && !too_uncertain()); }

}  // namespace carom
