#include "studies/validate/brillouin_fit.hpp"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <stdexcept>

namespace carom::validation {

namespace {

using Parameters = Eigen::Matrix<double, 5, 1>;

BrillouinFit fit_of(const Parameters& p) { return {p[0], p[1], p[2], p[3], p[4]}; }

}  // namespace

double BrillouinFit::at(double time) const {
  const double wave = std::exp(-damping * time), sine = wave * std::sin(frequency * time) / frequency;
  return heat * (std::exp(-heat_decay * time) + heat_decay * sine) + sound * (wave * std::cos(frequency * time) + damping * sine);
}

BrillouinFit fit_brillouin(const std::vector<double>& times, const std::vector<double>& F, const BrillouinFit& guess) {
  const auto n = static_cast<Eigen::Index>(times.size());
  const auto misses = [&](const Parameters& p) {
    Eigen::VectorXd values(n);
    for (Eigen::Index k = 0; k < n; ++k)
      values[k] = fit_of(p).at(times[static_cast<std::size_t>(k)]) - F[static_cast<std::size_t>(k)];
    return values;
  };
  Parameters p(guess.heat, guess.sound, guess.heat_decay, guess.damping, guess.frequency);
  Eigen::VectorXd miss = misses(p);
  double caution = 1e-3;
  for (int step = 0; step < 200; ++step) {
    Eigen::Matrix<double, Eigen::Dynamic, 5> slopes(n, 5);
    for (int c = 0; c < 5; ++c) {
      Parameters up = p, down = p;
      const double h = 1e-6 * std::abs(p[c]);
      up[c] += h, down[c] -= h;
      slopes.col(c) = (misses(up) - misses(down)) / (2.0 * h);
    }
    const Eigen::Matrix<double, 5, 5> square = slopes.transpose() * slopes;
    Eigen::Matrix<double, 5, 5> cautious = square;
    cautious.diagonal() *= 1.0 + caution;
    const Parameters change = -cautious.ldlt().solve(slopes.transpose() * miss);
    const Parameters next = p + change;
    const Eigen::VectorXd there = misses(next);
    if (there.squaredNorm() <= miss.squaredNorm()) {
      const bool found = (change.array().abs() <= 1e-9 * p.array().abs()).all();
      p = next, miss = there, caution *= 0.1;
      if (found) return fit_of(p);
    } else if (caution > 1e12) {
      return fit_of(p);  // no step makes it better: rounding
    } else {
      caution *= 10.0;
    }
  }
  throw std::runtime_error("no damped cosine was found in F(k,t)");
}

}  // namespace carom::validation
