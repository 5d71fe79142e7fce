#pragma once
// Laws by which the radii of a species are drawn when its scene is read: `radius = { lognormal = ... }` or `{ uniform = ... }`.

#include "core/random.hpp"

#include <Eigen/Core>

#include <variant>

namespace carom::detail {

/// The logarithm of the radius is normal. Radius r = mean exp(s z - s^2 / 2), with s^2 = ln(1 + (deviation / mean)^2) and a
/// normal deviate z, so that mean and deviation are those of the radius itself.
struct LognormalRadii {
  double mean = 0.0;       ///< length, > 0
  double deviation = 0.0;  ///< standard deviation, length, from 0 to 10 times the mean
};
/// All radii from `least` to `most` are equally probable.
struct UniformRadii {
  double least = 0.0, most = 0.0;  ///< length, 0 < least <= most
};
using RadiusLaw = std::variant<LognormalRadii, UniformRadii>;

/// Returns one radius of the law. A law of deviation 0 gives its mean, and limits that are equal give that number, to the last
/// bit. The bits are the same with every C library.
[[nodiscard]] double draw_radius(const RadiusLaw& law, RandomStream& random);

/// Returns e^x and ln(1 + x) to a few units in the last place, for |x| < 700 and x >= 0, by sums and products alone: those of C
/// libraries differ in the last bit.
[[nodiscard]] double same_exp(double x);
[[nodiscard]] double same_log1p(double x);

}  // namespace carom::detail
