#include "studies/validate/speed_law.hpp"

#include "theory/goodness_of_fit.hpp"

#include <algorithm>
#include <cmath>

namespace carom::validation {

void SpeedCounts::add(const Eigen::Matrix2Xd& velocities) {
  const Eigen::VectorXd squares = velocities.colwise().squaredNorm().transpose();
  mean_square_ = squares.mean();
  for (const double square : squares) {
    const double share = law_.speeds_below(square / mean_square_);
    ++counts_[std::min(bins - 1, static_cast<std::size_t>(share * static_cast<double>(bins)))];
    ++total_;
  }
}

double SpeedCounts::distance_from(const std::function<double(double)>& below) const {
  double largest = 0.0;
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < bins; ++k) {
    sum += counts_[k];
    const double share = static_cast<double>(k + 1) / static_cast<double>(bins);
    largest = std::max(largest, std::abs(static_cast<double>(sum) / static_cast<double>(total_) - below(share)));
  }
  return largest * std::sqrt(static_cast<double>(total_));
}

double SpeedCounts::distance() const {
  return distance_from([](double share) { return share; });
}

double SpeedCounts::distance_from_maxwell() const {
  return distance_from(
      [this](double share) { return share < 1.0 ? theory::maxwell_speeds_below(law_.square_below_which(share)) : 1.0; });
}

Curve SpeedCounts::density(const std::string& plot, const std::string& name) const {
  // Bins of equal width; a bin of the counts belongs where its middle is.
  constexpr std::size_t wide = 50;
  const double width = 3.5 * std::sqrt(0.5 * mean_square_) / wide;
  std::vector<double> disks(wide);
  for (std::size_t k = 0; k < bins; ++k) {
    if (counts_[k] == 0) continue;
    const double speed =
        std::sqrt(mean_square_ * law_.square_below_which((static_cast<double>(k) + 0.5) / static_cast<double>(bins)));
    const auto bin = static_cast<std::size_t>(speed / width);
    if (bin < wide) disks[bin] += static_cast<double>(counts_[k]);
  }
  Curve curve{.plot = plot, .name = name};
  for (std::size_t k = 0; k < wide; ++k) {
    const double per = 1.0 / (static_cast<double>(total_) * width);
    curve.x.push_back((static_cast<double>(k) + 0.5) * width);
    curve.y.push_back(disks[k] * per);
    curve.error.push_back(std::sqrt(disks[k]) * per);
  }
  return curve;
}

Check speed_check(const std::string& what, const SpeedCounts& counts) {
  const double distance = counts.distance();
  return {.name = "distribution of speeds, sqrt(n) times the largest difference (Kolmogorov-Smirnov), " + what,
          .theory =
              "1 - (1 - v^2 / n <v^2>)^(n - 1), n = number of disks, less one where momentum is conserved; below 1.29 in 99 of "
              "100 cases",
          .source = "Scalas et al., Phys. Rev. E 92, 022140 (2015)",
          .expected = 0.0,
          .measured = {distance, 0.0},
          .equivalent = theory::standard_errors(theory::snapshot_probability(distance))};
}

Curve speed_curve(const std::string& plot, const theory::Microcanonical& law, double mean_square) {
  Curve curve{.plot = plot, .name = "finite-N law", .theory = true};
  for (int k = 0; k <= 100; ++k) {
    const double v = 0.035 * k * std::sqrt(0.5 * mean_square);
    curve.x.push_back(v);
    curve.y.push_back(law.speed_density(v, mean_square));
  }
  return curve;
}

}  // namespace carom::validation
