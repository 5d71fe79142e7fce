#include "studies/compare/prices.hpp"

#include "studies/compare/time_to_z.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// The steps of a method are taken to follow the first-order law if error / dt differs by this factor at most among the last
/// three.
constexpr double steady = 3.0;

/// Errors below this may be rounding, which grows with the number of steps. A missed collision moves disks by more.
constexpr double largest_rounding = 1e-8;

/// One step of a method from one start.
struct Point {
  double dt = 0.0;
  double error = 0.0;
  double seconds = 0.0;
};

struct StartPrice {
  double seconds = 0.0;
  double dt = 0.0;
  double extrapolation = 1.0;
  bool longest = false;  ///< no longer step was run
};

/// Returns the points of a method from one start by falling dt.
std::vector<Point> points_of(const Comparison& comparison, const std::string& method, std::uint64_t seed) {
  std::vector<Point> points;
  const std::size_t early = comparison.plan.early;
  for (const MethodRun& run : comparison.runs)
    if (run.method.name == method && run.seed == seed && early >= 1 && run.error.size() >= early)
      points.push_back({run.method.dt, run.error[early - 1], run.seconds_early});
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.dt > b.dt; });
  return points;
}

/// Returns the step with that error on the line through two points, in logarithms.
Point between(const Point& coarse, const Point& fine, double error) {
  const double at = std::log(error / fine.error) / std::log(coarse.error / fine.error);
  return {between_logarithms(fine.dt, coarse.dt, at), error, between_logarithms(fine.seconds, coarse.seconds, at)};
}

std::optional<StartPrice> extrapolated(const std::vector<Point>& points, double error) {
  if (points.size() < 3) return std::nullopt;
  std::vector<double> per_dt;
  for (std::size_t k = points.size() - 3; k < points.size(); ++k) {
    if (!shows_law(points[k].error)) return std::nullopt;
    per_dt.push_back(points[k].error / points[k].dt);
  }
  std::sort(per_dt.begin(), per_dt.end());
  if (per_dt.back() > steady * per_dt.front()) return std::nullopt;
  const Point& last = points.back();
  const double factor = last.dt * per_dt[1] / error;
  return StartPrice{last.seconds * factor, last.dt / factor, factor, false};
}

/// `has_order`: the errors of the method fall with dt by a law, and not in one fall from a mistake to rounding.
std::optional<StartPrice> price_from(const std::vector<Point>& points, double error, bool has_order) {
  std::size_t first = points.size();  // of the steps that are right, together with all shorter ones but for rounding
  while (first > 0 && points[first - 1].error <= std::max(error, largest_rounding)) --first;
  while (first < points.size() && points[first].error > error) ++first;
  if (first == points.size()) return has_order ? extrapolated(points, error) : std::nullopt;
  Point best = points[first];
  for (std::size_t k = first; k < points.size(); ++k)
    if (points[k].error <= error && points[k].seconds < best.seconds) best = points[k];
  if (first > 0 && shows_law(points[first - 1].error) && shows_law(points[first].error)) {
    const Point longer = between(points[first - 1], points[first], error);
    if (longer.seconds < best.seconds) best = longer;
  }
  return StartPrice{best.seconds, best.dt, 1.0, best.dt == points.front().dt};
}

Price price_of_position(const Comparison& comparison, const Method& method, const Target& target) {
  Price price{.method = method.name, .target = target.name, .ratio = {}, .dt = {}, .seconds = {}, .remark = ""};
  std::vector<double> ratios, seconds, steps, factors, errors;
  std::size_t starts = 0, longest = 0;
  for (const std::uint64_t seed : comparison.plan.seeds) {
    const std::vector<Point> exact = points_of(comparison, comparison.plan.horizon.engine, seed);
    const std::vector<Point> points = points_of(comparison, method.name, seed);
    if (exact.empty() || points.empty()) continue;
    ++starts;
    errors.push_back(points.back().error);
    const std::optional<StartPrice> from_here = price_from(points, target.accuracy, !finds_contacts(method.name));
    ratios.push_back(from_here ? from_here->seconds / exact.front().seconds : INFINITY);
    seconds.push_back(from_here ? from_here->seconds : INFINITY);
    if (!from_here) continue;
    steps.push_back(from_here->dt);
    factors.push_back(from_here->extrapolation);
    if (from_here->longest) ++longest;
  }
  if (starts == 0) return price.remark = "not run", price;
  const double median = spread_of(ratios).median;
  price.lowest = *std::min_element(ratios.begin(), ratios.end());
  price.highest = *std::max_element(ratios.begin(), ratios.end());
  if (!std::isfinite(median)) {
    price.remark = fmt::format("not reached: the error is {:.1e} {}", spread_of(errors).median,
                               method.exact() ? "in this precision" : "with the shortest step that was run");
    return price;
  }
  price.ratio = median;
  price.seconds = spread_of(seconds).median;
  if (!method.exact()) price.dt = spread_of(steps).median;
  price.extrapolation = spread_of(factors).median;
  price.at_most = price.dt && 2 * longest > steps.size() && *price.dt < comparison.plan.early_time();
  return price;
}

/// Returns time_to_Z's ratio to the exact engine for a method and accuracy; NaN where there is none.
double ratio_for_Z(const std::vector<TimeToZ>& rows, const std::string& exact, const std::string& method, double accuracy) {
  double own = NAN, of_exact = NAN;
  for (const TimeToZ& row : rows) {
    if (row.accuracy != accuracy || !row.seconds) continue;
    if (row.method == method) own = *row.seconds;
    if (row.method == exact) of_exact = *row.seconds;
  }
  return own / of_exact;
}

/// The rows of time_to_Z without one start each.
std::vector<std::vector<TimeToZ>> without_one_start(const Comparison& comparison) {
  std::vector<std::vector<TimeToZ>> all;
  for (const std::uint64_t seed : comparison.plan.seeds) {
    Comparison rest = comparison;
    std::erase_if(rest.runs, [&](const MethodRun& run) { return run.seed == seed; });
    all.push_back(time_to_Z(rest, summaries_of(rest)));
  }
  return all;
}

/// Returns the standard error of a ratio by the jackknife, sqrt((n - 1) / n sum (x_k - mean)^2), which is n - 1 times that of the
/// mean; NaN where a start is needed.
double jackknife_error(const std::vector<double>& without_one) {
  const std::optional<Estimate> mean = mean_of(without_one);
  return mean ? (static_cast<double>(without_one.size()) - 1.0) * mean->error : NAN;
}

}  // namespace

const std::vector<Target>& price_targets() {
  static const std::vector<Target> targets = {{Goal::position, 1e-6, "error 1e-6"},
                                              {Goal::position, 1e-10, "error 1e-10"},
                                              {Goal::Z, 0.01, "Z 1 %"},
                                              {Goal::Z, 0.001, "Z 0.1 %"}};
  return targets;
}

std::vector<Price> prices_of(const Comparison& comparison, const std::vector<MethodSummary>& summaries) {
  std::vector<Price> prices;
  const std::string& exact = comparison.plan.horizon.engine;
  std::vector<Method> methods;
  for (const MethodSummary& summary : summaries)
    if (std::none_of(methods.begin(), methods.end(), [&](const Method& m) { return m.name == summary.method.name; }))
      methods.push_back(summary.method);
  if (std::none_of(methods.begin(), methods.end(), [&](const Method& m) { return m.name == exact; })) return prices;
  const std::vector<TimeToZ> rows = time_to_Z(comparison, summaries);
  const std::vector<std::vector<TimeToZ>> parts =
      rows.empty() ? std::vector<std::vector<TimeToZ>>() : without_one_start(comparison);
  for (const Target& target : price_targets()) {
    if (target.goal == Goal::position) {
      for (const Method& method : methods) prices.push_back(price_of_position(comparison, method, target));
      continue;
    }
    for (const TimeToZ& row : rows) {
      if (row.accuracy != target.accuracy) continue;
      Price price{.method = row.method,
                  .target = target.name,
                  .ratio = {},
                  .lowest = NAN,
                  .highest = NAN,
                  .dt = row.dt,
                  .seconds = row.seconds,
                  .remark = row.remark};
      if (const double ratio = ratio_for_Z(rows, exact, row.method, target.accuracy); std::isfinite(ratio)) {
        price.ratio = ratio;
        std::vector<double> others;
        for (const std::vector<TimeToZ>& part : parts) others.push_back(ratio_for_Z(part, exact, row.method, target.accuracy));
        const double error = jackknife_error(others);
        price.lowest = ratio - error;
        price.highest = ratio + error;
        price.at_most = row.dt && std::none_of(summaries.begin(), summaries.end(), [&](const MethodSummary& summary) {
                          return summary.method.name == row.method && summary.Z && summary.method.dt > *row.dt;
                        });
      }
      prices.push_back(price);
    }
  }
  return prices;
}

const Price* best_fixed_step(const std::vector<Price>& prices, const std::string& target) {
  const Price* best = nullptr;
  for (const Price& price : prices) {
    if (price.target != target || !price.ratio || !price.dt || price.extrapolation > largest_extrapolation) continue;
    if (best == nullptr || *price.ratio < *best->ratio) best = &price;
  }
  return best;
}

}  // namespace carom
