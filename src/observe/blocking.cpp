#include "observe/blocking.hpp"

#include <fmt/format.h>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace carom {

namespace {
constexpr std::uint64_t least_samples = 16;
/// Correlations that are longer than blocks pass now and then for short ones, and with few blocks more often: the error is then
/// far too small, which a mean forgives and a test does not.
constexpr double least_for_halves = 16.0;

/// Returns the variance of the mean of `count` samples over that of one sample.
double variance_of_mean_of(std::uint64_t count, std::span<const double> correlation) {
  const double n = static_cast<double>(count);
  double sum = 1.0;
  for (std::size_t j = 1; j <= correlation.size() && j < count; ++j)
    sum += 2.0 * (1.0 - static_cast<double>(j) / n) * correlation[j - 1];
  return sum / n;
}

/// Returns the factor by which the variance from blocks of B samples is too small for correlations that fall exponentially with
/// statistical inefficiency s: 1 / (1 - (s - 1) / 2 B), which counts the correlations between blocks; at most 2. `of_block` is 1
/// / B, or the variance of the mean of a block where correlations are known.
double left_across_blocks(double s, double of_block) { return 1.0 / (1.0 - std::clamp(0.5 * (s - 1.0) * of_block, 0.0, 0.5)); }

/// Returns (sum of w)^2 / (sum of w^2): how many samples there are beside which the others weigh little. Requires a mean weight
/// other than 0.
double heavy_samples(const Blocking::Level& single) {
  const double n = static_cast<double>(single.blocks);
  return n / (1.0 + single.ww / (n * single.mean_w * single.mean_w));
}

/// Returns the ratio to its mean that the scatter of so many independent Gaussian blocks exceeds once in a thousand.
double most_by_chance(std::uint64_t blocks) {
  const double freedom = static_cast<double>(blocks) - 1.0;
  return boost::math::quantile(boost::math::complement(boost::math::chi_squared_distribution<double>(freedom), 1e-3)) / freedom;
}

bool is_of_many(const Blocking::Level& single) { return heavy_samples(single) >= static_cast<double>(least_blocks); }

/// Returns whether blocks of `length` among n samples are long enough for a statistical inefficiency of s.
bool long_enough(double length, double n, double s) {
  const double slowness = std::max(s, 1.0 / s);
  return length * length * length > 2.0 * n * slowness * slowness;
}
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
  const double squares = xx - 2.0 * ratio * xw + ratio * ratio * ww;
  return squares < 0.0 ? 0.0 : squares / (n * (n - 1.0));
}

void Blocking::add(double x, double weight) {
  for (std::size_t level = 0;; ++level) {
    if (level == levels_.size()) {
      at_power_before_ = std::move(at_power_);
      at_power_ = levels_;
      levels_.emplace_back();
    }
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

std::optional<Blocking::Estimate> Blocking::estimate(std::span<const Level> levels, int power, std::span<const double> known) {
  if (levels.empty()) return std::nullopt;
  const Level& single = levels.front();
  if (single.mean_w == 0.0) return std::nullopt;
  const double scale = std::pow(single.mean_w, power);
  const double slope = power * single.mean_x / single.mean_w;  // x - slope * w is what the mean errs by, times scale
  Estimate estimate{single.mean_x / scale, std::nullopt, std::nullopt};
  if (is_of_many(single)) find_error(estimate, levels, slope, scale, known);
  return estimate;
}

std::optional<Blocking::Estimate> Blocking::estimate_of_variance() const {
  if (levels_.empty() || levels_.front().mean_w == 0.0) return std::nullopt;
  const Level& single = levels_.front();
  Estimate estimate{single.mean_x - single.mean_w * single.mean_w, std::nullopt, std::nullopt};
  if (is_of_many(single)) find_error(estimate, levels_, 2.0 * single.mean_w, 1.0, {});
  return estimate;
}

void Blocking::find_error(Estimate& estimate, std::span<const Level> levels, double slope, double scale,
                          std::span<const double> known) {
  const Level& single = levels.front();
  const double n = static_cast<double>(single.blocks);
  const double of_all = variance_of_mean_of(single.blocks, known);
  if (single.blocks < least_samples || of_all * static_cast<double>(least_blocks) > 1.0) return;
  // The mean square of n blocks about their mean is as much too small as that is too large.
  const auto variance_told_by = [&](std::size_t level) {
    const double told = levels[level].variance_of_mean(slope);
    if (known.empty()) return told;
    const std::uint64_t blocks = levels[level].blocks, length = std::uint64_t{1} << level;
    const double within = variance_of_mean_of(length, known) - variance_of_mean_of(blocks * length, known);
    return within > 0.0 ? told * (static_cast<double>(blocks) - 1.0) * of_all / within : told;
  };
  const double first = variance_told_by(0), white = first / (n * of_all);
  for (std::size_t level = 0; level < levels.size() && levels[level].blocks >= least_blocks; ++level) {
    const double told = variance_told_by(level), length = std::ldexp(1.0, static_cast<int>(level));
    const double variance =
        told * left_across_blocks(first > 0.0 ? told / first : 1.0, variance_of_mean_of(1ULL << level, known));
    const double s = white > 0.0 ? variance / white : 1.0;
    if (!std::isfinite(variance)) return;  // squares of very large samples overflow
    estimate.error = std::sqrt(variance) / std::abs(scale);
    estimate.blocks = levels[level].blocks;
    estimate.lower_bound = told > 2.0 * first && told > first * most_by_chance(estimate.blocks);
    if (!long_enough(length, n, s)) continue;
    estimate.statistical_inefficiency = std::max(1.0, s);
    estimate.lower_bound = false;
    break;
  }
}

std::optional<Halves> Blocking::halves(std::span<const Level> levels, std::span<const Level> late, std::span<const Level> early,
                                       int power, std::span<const double> known) {
  const auto count = [](std::span<const Level> part) { return part.empty() ? 0.0 : static_cast<double>(part[0].blocks); };
  constexpr double most_of_all = 0.6;
  const bool is_late = count(late) <= most_of_all * count(levels);
  const std::span<const Level> first = is_late ? late : early;
  std::vector<Level> rest;
  for (std::size_t level = 0; level < first.size(); ++level) {
    const Level& whole = levels[level];
    const Level& part = first[level];
    Level& left = rest.emplace_back();
    left.blocks = whole.blocks - part.blocks;
    if (left.blocks == 0) break;
    const double n = static_cast<double>(whole.blocks), of_part = static_cast<double>(part.blocks) / n, of_left = 1.0 - of_part;
    left.mean_x = (whole.mean_x - of_part * part.mean_x) / of_left;
    left.mean_w = (whole.mean_w - of_part * part.mean_w) / of_left;
    const double dx = left.mean_x - part.mean_x, dw = left.mean_w - part.mean_w, between = n * of_part * of_left;
    left.xx = std::max(0.0, whole.xx - part.xx - between * dx * dx);
    left.xw = whole.xw - part.xw - between * dx * dw;
    left.ww = std::max(0.0, whole.ww - part.ww - between * dw * dw);
  }
  const std::optional<Estimate> before = estimate(first, power, known), after = estimate(rest, power, known);
  if (!before || !after || !after->error || !after->statistical_inefficiency) return {};
  // Sums of squares of the rest are differences: of a rest that does not scatter they are what rounding leaves.
  const auto squares = [&](const Level& level) {
    const double slope = power * after->mean * std::pow(rest[0].mean_w, power - 1);
    return level.xx - 2.0 * slope * level.xw + slope * slope * level.ww;
  };
  constexpr double rounding = 1e-10;
  if (!(squares(rest[0]) > rounding * (levels[0].xx + squares(levels[0])))) return {};
  // A few heavy samples among light ones scatter less than they should: one of a single event not at all.
  const double samples = static_cast<double>(rest[0].blocks);
  const double independent =
      std::min({static_cast<double>(after->blocks), samples / *after->statistical_inefficiency, heavy_samples(rest[0])});
  if (independent < least_for_halves) return {};
  return compared_halves(count(first) / count(levels), before->mean, after->mean, *after->error, independent);
}

void Blocking::fill(Scalar& scalar, double step, double factor, double offset, int power) const {
  const std::optional<Estimate> found = estimate(power);
  if (!found) return;
  scalar.value = offset + factor * found->mean;
  if (found->error) scalar.error = std::abs(factor) * *found->error;
  scalar.halves = in_proportion(halves(power), factor, offset);
  if (found->statistical_inefficiency) scalar.integrated_correlation_time = 0.5 * step * *found->statistical_inefficiency;
  // A conserved quantity scatters by rounding alone, which need not look like noise.
  const bool conserved = found->error && *found->error <= 1e-13 * std::abs(found->mean);
  if (found->error && !found->statistical_inefficiency && !conserved && scalar.note.empty())
    scalar.note = fmt::format("{}: the error is a lower bound", too_short);
}

std::optional<Halves> compared_halves(double share, double first, double rest, double error_of_rest, double blocks) {
  Halves found{.share = share, .first = first, .rest = rest, .error = error_of_rest / std::sqrt(share)};
  // Sums of squares that are differences have no more digits than this; nor have quantities that are conserved.
  const double t = std::abs(first - rest) / found.error;
  if (!std::isfinite(t) || !(found.error > 1e-12 * std::max(std::abs(first), std::abs(rest)))) return {};
  const boost::math::students_t_distribution<double> student(blocks - 1.0);
  found.probability = 2.0 * boost::math::cdf(boost::math::complement(student, t));
  return found;
}

std::size_t first_of_long_blocks(std::size_t blocks) {
  if (blocks < static_cast<std::size_t>(least_samples)) return 0;
  return blocks - 2 * static_cast<std::size_t>(std::lround(0.32 * static_cast<double>(blocks)));
}

std::optional<Halves> in_proportion(std::optional<Halves> halves, double factor, double offset) {
  if (!halves) return {};
  halves->first = offset + factor * halves->first;
  halves->rest = offset + factor * halves->rest;
  halves->error *= std::abs(factor);
  return halves;
}

std::optional<Halves> if_known(const std::optional<Halves>& halves, double most_error) {
  return halves && halves->error * std::sqrt(halves->share) <= most_error * std::abs(halves->rest) ? halves : std::nullopt;
}

void ColumnComparison::add(const std::optional<Halves>& halves, double factor, double offset) {
  const std::size_t row = row_++;
  if (!if_known(halves, most_error_)) return;
  ++most_.compared;
  if (most_.compared > 1 && !(halves->probability < most_.halves.probability)) return;
  row_of_most_ = row;
  most_.halves = *in_proportion(halves, factor, offset);
}

void ColumnComparison::put(Table& table, const std::string& column, std::size_t dimensions) const {
  if (most_.compared == 0) return;
  ColumnHalves& found = table.halves.emplace_back(most_);
  found.column = column;
  for (std::size_t axis = 0; axis < dimensions; ++axis) found.at.push_back(table.columns.at(axis).values.at(row_of_most_));
}

void note_lower_bounds(Measurement& found, bool some_are) {
  if (!some_are) return;
  if (!found.note.empty()) found.note += "; ";
  found.note += "the run is too short for some correlations: errors there are lower bounds";
}

void LowerBounds::add(const Blocking::Estimate& found) {
  if (!found.error) return;
  ++known_;
  bounds_ += found.lower_bound ? 1 : 0;
}

bool BlockedColumn::has_lower_bounds() const {
  constexpr double of_sixteen_events = 0.25;
  LowerBounds bounds;
  for (const Blocking& row : rows_)
    if (const std::optional<Blocking::Estimate> found = row.estimate();
        found && found->error && *found->error <= of_sixteen_events * std::abs(found->mean))
      bounds.add(*found);
  return bounds.are_many();
}

void BlockedColumn::put(Table& table, const std::string& name, const std::string& unit, double factor) const {
  Column values{name, unit, {}}, errors{name + "_error", unit, {}};
  ColumnComparison comparison;
  for (const Blocking& row : rows_) {
    comparison.add(row.halves(), factor);
    const std::optional<Blocking::Estimate> found = row.estimate();
    values.values.push_back(found ? factor * found->mean : unknown);
    errors.values.push_back(found && found->error ? std::abs(factor) * *found->error : unknown);
  }
  comparison.put(table, name);
  table.columns.push_back(std::move(values));
  table.columns.push_back(std::move(errors));
}

}  // namespace carom
