#include "studies/horizon/difference.hpp"

#include "core/nearest_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

Eigen::Vector2d displacement(const Box& box, const State& a, const State& b, Eigen::Index i) {
  // The doubles of two disks that are close differ by no rounding; the remainders are added to that.
  Eigen::Vector2d apart = nearest_image(box, a.positions.col(i) - b.positions.col(i));
  if (a.remainders.cols() > i) apart += a.remainders.col(i);
  if (b.remainders.cols() > i) apart -= b.remainders.col(i);
  return apart;
}

double largest_distance(const Box& box, const State& a, const State& b) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.positions.cols(); ++i) {
    const double distance = displacement(box, a, b, i).norm();
    if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, distance);
  }
  return largest;
}

double rms_distance(const Box& box, const State& a, const State& b) {
  Eigen::Matrix2Xd apart(2, a.positions.cols());
  for (Eigen::Index i = 0; i < apart.cols(); ++i) apart.col(i) = displacement(box, a, b, i);
  if (!apart.allFinite()) return std::numeric_limits<double>::infinity();
  return apart.cols() == 0 ? 0.0 : std::sqrt(apart.squaredNorm() / static_cast<double>(apart.cols()));
}

void LogComparison::add(std::span<const Event> log, std::span<const Event> better_log) {
  if (found_) return;
  waiting_.insert(waiting_.end(), log.begin(), log.end());
  better_waiting_.insert(better_waiting_.end(), better_log.begin(), better_log.end());
  match();
}

void LogComparison::match() {
  while (!waiting_.empty() && !better_waiting_.empty()) {
    const Event& event = waiting_.front();
    const Event& first = better_waiting_.front();
    const auto at_one_instant = [&](const Event& one) {
      return one.time == first.time && one.time_remainder == first.time_remainder;
    };
    const auto past_ties = std::find_if_not(better_waiting_.begin(), better_waiting_.end(), at_one_instant);
    const auto counterpart = std::find_if(better_waiting_.begin(), past_ties, [&](const Event& one) {
      return one.disk == event.disk && one.partner == event.partner;
    });
    if (counterpart == past_ties) {
      found_ = {matched_, first.time, first.disk, first.partner, event.disk, event.partner};
      waiting_.clear();
      better_waiting_.clear();
      return;
    }
    better_waiting_.erase(counterpart);
    waiting_.pop_front();
    ++matched_;
  }
}

}  // namespace carom
