#include "observe/pressure.hpp"

#include <boost/math/special_functions/gamma.hpp>

#include <cmath>

namespace carom {

void BlockedRate::add(double time, double total) {
  if (!(time > time_)) return;
  const Block step{time - time_, total - total_};
  time_ = time;
  total_ = total;
  if (pending_ == 0 || pending_ == joined_) {
    blocks_.push_back(step);
    pending_ = 1;
  } else {
    blocks_.back().duration += step.duration;
    blocks_.back().increase += step.increase;
    ++pending_;
  }
  if (blocks_.size() == 64 && pending_ == joined_) {
    for (std::size_t i = 0; i < 32; ++i)
      blocks_[i] = {blocks_[2 * i].duration + blocks_[2 * i + 1].duration, blocks_[2 * i].increase + blocks_[2 * i + 1].increase};
    blocks_.resize(32);
    joined_ *= 2;
    pending_ = joined_;
  }
}

std::optional<double> BlockedRate::rate() const {
  if (!(time_ > 0.0)) return std::nullopt;
  return total_ / time_;
}

std::optional<double> BlockedRate::standard_error() const {
  const double n = static_cast<double>(blocks_.size());
  if (blocks_.size() < 8) return std::nullopt;
  const double mean = total_ / time_;
  double squares = 0.0;
  for (const Block& block : blocks_) squares += std::pow(block.increase - mean * block.duration, 2);
  return std::sqrt(n / (n - 1.0) * squares) / time_;
}

double mean_speed_factor(double d) { return d > 0.0 ? std::sqrt(0.5 * d) * boost::math::tgamma_delta_ratio(0.5 * d, 0.5) : 1.0; }

}  // namespace carom
