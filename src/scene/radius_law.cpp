#include "scene/radius_law.hpp"

#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <cmath>
#include <numbers>

namespace carom::detail {
namespace {

/// ln 2 in two parts; multiples of the first, below 2^11, are exact.
constexpr double ln2_high = 0x1.62e42fefa3800p-1, ln2_low = 0x1.ef35793c76730p-45;

struct Draw {
  RandomStream& random;

  double operator()(const LognormalRadii& law) const {
    const double relative = law.deviation / law.mean;
    const double variance = same_log1p(relative * relative);
    boost::random::normal_distribution<double> normal;
    return law.mean * same_exp(std::sqrt(variance) * normal(random) - variance / 2);
  }
  double operator()(const UniformRadii& law) const {
    if (law.least == law.most) return law.least;
    return boost::random::uniform_real_distribution<double>(law.least, law.most)(random);
  }
};

}  // namespace

double draw_radius(const RadiusLaw& law, RandomStream& random) { return std::visit(Draw{random}, law); }

double same_exp(double x) {
  // x = k ln 2 + r with |r| < 0.35: Taylor's series ends below rounding at r^14.
  const double k = std::floor(x * std::numbers::log2e + 0.5);
  const double r = (x - k * ln2_high) - k * ln2_low;
  double sum = 1.0;
  for (int n = 14; n > 0; --n) sum = 1.0 + sum * r / n;
  return std::ldexp(sum, static_cast<int>(k));
}

double same_log1p(double x) {
  // 1 + x = 2^k (1 + z) / (1 - z) with z^2 < 0.03, and its logarithm is k ln 2 + 2 (z + z^3 / 3 + z^5 / 5 + ...).
  int k = 0;
  const double fraction = std::frexp(1.0 + x, &k);
  const bool below = fraction < std::numbers::sqrt2 / 2;
  const double scaled = below ? 2 * fraction : fraction;
  if (below) --k;
  const double z = k == 0 ? x / (2.0 + x) : (scaled - 1.0) / (scaled + 1.0);
  double sum = 0.0;
  for (int n = 23; n > 0; n -= 2) sum = sum * z * z + 1.0 / n;
  return k * ln2_high + (2 * z * sum + k * ln2_low);
}

}  // namespace carom::detail
