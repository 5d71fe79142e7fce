#include "studies/compare/mistake_law.hpp"

#include <cmath>
#include <cstdint>

namespace carom {

namespace {

/// Beyond, grazes are no longer as x^2: theory::missed_fraction.
constexpr double parabolic_diameters = 0.5;

/// Returns the number of mistakes of a step over c.
double per_constant(const ComparePlan& plan, double dt) {
  return static_cast<double>(plan.disks) * std::pow(plan.in_free_times(dt), 3);
}

struct Counted {
  double a = 0.0;  ///< per_constant of a step
  double right = 0.0;
  double wrong = 0.0;
};

/// Returns how the logarithm of the likelihood grows with c: falling in c.
double score(const std::vector<Counted>& all, double c) {
  double sum = 0.0;
  for (const Counted& one : all) sum += one.wrong * one.a / std::expm1(c * one.a) - one.right * one.a;
  return sum;
}

}  // namespace

double MistakeLaw::fraction(const ComparePlan& plan, double dt) const { return -std::expm1(-c * per_constant(plan, dt)); }

std::optional<MistakeLaw> mistake_law(const ComparePlan& plan, const std::vector<MethodSummary>& summaries) {
  std::vector<Counted> all;
  double right = 0.0, wrong = 0.0;
  for (const MethodSummary& s : summaries) {
    if (s.method.name != "backtrack" || !s.mistakes || s.mistakes->steps == 0 || plan.in_free_times(s.method.dt) > 1.0) continue;
    if (plan.thermal_speed * s.method.dt > parabolic_diameters * plan.sigma) continue;
    all.push_back({per_constant(plan, s.method.dt), static_cast<double>(s.mistakes->steps - s.mistakes->mistaken),
                   static_cast<double>(s.mistakes->mistaken)});
    right += all.back().right;
    wrong += all.back().wrong;
  }
  if (!(right > 0.0 && wrong > 0.0) || plan.disks == 0) return std::nullopt;
  double low = 1.0, high = 1.0;
  while (score(all, low) < 0.0) low /= 2.0;
  while (score(all, high) > 0.0) high *= 2.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double c = std::sqrt(low * high);
    (score(all, c) > 0.0 ? low : high) = c;
  }
  MistakeLaw law{low, 0.0, {}};
  double information = 0.0;
  for (const Counted& one : all) information += (one.right + one.wrong) * one.a * one.a / std::expm1(law.c * one.a);
  law.error = 1.0 / std::sqrt(information);
  if (plan.thermal_speed > 0.0) {
    const double free_path = plan.thermal_speed * plan.mean_free_time / plan.sigma;
    law.grazes = free_path * free_path / 8.0;  // of N / 2 collisions in a mean free time, x^2 / 4
  }
  return law;
}

}  // namespace carom
