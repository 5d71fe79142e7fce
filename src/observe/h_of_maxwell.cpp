#include "observe/h_of_maxwell.hpp"

#include <boost/math/distributions/binomial.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace carom {

namespace {

/// Returns the mean of (n / N) ln(n / N) over the number n of disks in a bin, each of N being there with probability p.
double mean_of_share_times_log(double disks, double p) {
  const double odds = p / (1.0 - p), most_likely = std::floor((disks + 1.0) * p);
  const auto term = [&](double chance, double count) {
    return count > 0.0 ? chance * (count / disks) * std::log(count / disks) : 0.0;
  };
  // From the most likely number outwards to where nothing is left to add: chances are in proportion to their neighbours'.
  constexpr double least_chance = 1e-20;
  const double at_most_likely = boost::math::pdf(boost::math::binomial(disks, p), most_likely);
  double sum = term(at_most_likely, most_likely);
  double chance = at_most_likely;
  for (double count = most_likely; count > 0.0 && chance > least_chance; count -= 1.0) {
    chance *= count / ((disks - count + 1.0) * odds);
    sum += term(chance, count - 1.0);
  }
  chance = at_most_likely;
  for (double count = most_likely + 1.0; count <= disks && chance > least_chance; count += 1.0) {
    chance *= (disks - count + 1.0) / count * odds;
    sum += term(chance, count);
  }
  return sum;
}

}  // namespace

double h_of_maxwell(std::int64_t disks) {
  constexpr int bins = 18;  // of each sign: not one velocity in 10^18 is beyond
  const auto below = [](int edge) { return 0.5 * std::erfc(-edge * h_bin / std::numbers::sqrt2); };
  std::vector<double> axis;
  for (int k = 0; k < bins; ++k) axis.push_back(below(-k) - below(-k - 1));
  const auto all = static_cast<double>(disks);
  double h = 0.0, occupied = 0.0;
  for (const double x : axis)
    for (const double y : axis) {
      constexpr double quadrants = 4.0;
      const double p = x * y;
      h += quadrants * mean_of_share_times_log(all, p);
      occupied -= quadrants * std::expm1(all * std::log1p(-p));
    }
  return h - 2.0 * std::log(h_bin) - (occupied - 1.0) / (2.0 * all);
}

}  // namespace carom
