#include "observe/pressure.hpp"

#include "observe/blocking.hpp"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
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
    blocks_.back() += step;
    ++pending_;
  }
  if (blocks_.size() == 64 && pending_ == joined_) {
    for (std::size_t i = 0; i < 32; ++i) (blocks_[i] = blocks_[2 * i]) += blocks_[2 * i + 1];
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
  if (blocks_.size() < 8) return std::nullopt;
  return error_of_increase(0, 1, {time_, total_}) / time_;
}

double BlockedRate::error_of_increase(std::size_t begin, std::size_t length, const Block& all) const {
  const std::size_t joined_blocks = (blocks_.size() - begin) / length;
  const double mean = all.increase / all.duration, n = static_cast<double>(joined_blocks);
  double squares = 0.0;
  for (std::size_t b = begin; b < blocks_.size(); b += length) {
    Block joined{0.0, 0.0};
    for (std::size_t k = b; k < b + length; ++k) joined += blocks_[k];
    squares += std::pow(joined.increase - mean * joined.duration, 2);
  }
  return std::sqrt(n / (n - 1.0) * squares);
}

std::optional<Halves> BlockedRate::halves() const {
  const std::size_t begin = first_of_long_blocks(blocks_.size());
  if (begin == 0) return std::nullopt;
  Block first{0.0, 0.0};
  for (std::size_t b = 0; b < begin; ++b) first += blocks_[b];
  const Block rest{time_ - first.duration, total_ - first.increase};
  const double error = std::max(error_of_increase(begin, 1, rest), error_of_increase(begin, 2, rest)) / rest.duration;
  return if_known(compared_halves(first.duration / time_, first.increase / first.duration, rest.increase / rest.duration, error,
                                  0.5 * static_cast<double>(blocks_.size() - begin)));
}

double mean_speed_factor(double d) { return d > 0.0 ? std::sqrt(0.5 * d) * boost::math::tgamma_delta_ratio(0.5 * d, 0.5) : 1.0; }

}  // namespace carom
