#include "observe/blocking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace carom {

namespace {
/// Below this many blocks their scatter says little: the error has an error of 1 / sqrt(2 (n - 1)), a fifth at 16.
constexpr std::uint64_t least_blocks = 16;
}  // namespace

void Blocking::Level::add(double x, double w) {
  ++blocks;
  const double share = 1.0 / static_cast<double>(blocks);
  const double dx = x - mean_x, dw = w - mean_w;
  mean_x += share * dx;
  mean_w += share * dw;
  xx += dx * (x - mean_x);
  xw += dx * (w - mean_w);
  ww += dw * (w - mean_w);
}

double Blocking::Level::variance_of_mean(double ratio) const {
  const double n = static_cast<double>(blocks);
  return std::max(0.0, xx - 2.0 * ratio * xw + ratio * ratio * ww) / (n * (n - 1.0));
}

void Blocking::add(double x, double weight) {
  for (std::size_t level = 0;; ++level) {
    if (level == levels_.size()) levels_.emplace_back();
    Level& here = levels_[level];
    here.add(x, weight);
    if (here.blocks % 2 == 1) {
      here.waiting_x = x;
      here.waiting_w = weight;
      return;
    }
    x = 0.5 * (here.waiting_x + x);
    weight = 0.5 * (here.waiting_w + weight);
  }
}

std::optional<Blocking::Estimate> Blocking::estimate(std::span<const Level> levels, int power) {
  if (levels.empty()) return std::nullopt;
  const Level& single = levels.front();
  if (single.mean_w == 0.0) return std::nullopt;
  const double scale = std::pow(single.mean_w, power);
  const double slope = power * single.mean_x / single.mean_w;  // x - slope * w is what the mean errs by, times scale
  Estimate estimate{single.mean_x / scale, std::nullopt, std::nullopt};
  const double n = static_cast<double>(single.blocks);
  if (single.blocks < least_blocks) return estimate;
  const double naive = single.variance_of_mean(slope);
  double largest = naive;
  for (std::size_t level = 0; level < levels.size() && levels[level].blocks >= least_blocks; ++level) {
    const double variance = levels[level].variance_of_mean(slope);
    const double s = naive > 0.0 ? variance / naive : 1.0;
    largest = std::max(largest, variance);
    estimate.error = std::sqrt(largest) / std::abs(scale);
    if (std::pow(std::ldexp(1.0, static_cast<int>(level)), 3) <= 2.0 * n * s * s) continue;
    estimate.error = std::sqrt(variance) / std::abs(scale);
    estimate.inefficiency = std::max(1.0, s);
    break;
  }
  return estimate;
}

void Blocking::fill(Scalar& scalar, double step, double factor, double offset, int power) const {
  const std::optional<Estimate> found = estimate(power);
  if (!found) return;
  scalar.value = offset + factor * found->mean;
  if (found->error) scalar.error = std::abs(factor) * *found->error;
  if (found->inefficiency) scalar.decorrelation_time = step * *found->inefficiency;
  // What is conserved scatters by rounding alone, which need not look like noise.
  const bool conserved = found->error && *found->error <= 1e-13 * std::abs(found->mean);
  if (found->error && !found->inefficiency && !conserved && scalar.note.empty())
    scalar.note = "the run is too short for its correlations: the error is a lower bound";
}

void BlockedColumn::put(Table& table, const std::string& name, const std::string& unit, double factor) const {
  Column values{name, unit, {}}, errors{name + "_error", unit, {}};
  for (const Blocking& row : rows_) {
    const std::optional<Blocking::Estimate> found = row.estimate();
    values.values.push_back(found ? factor * found->mean : unknown);
    errors.values.push_back(found && found->error ? std::abs(factor) * *found->error : unknown);
  }
  table.columns.push_back(std::move(values));
  table.columns.push_back(std::move(errors));
}

}  // namespace carom
