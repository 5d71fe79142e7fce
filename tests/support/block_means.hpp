#pragma once
// The mean of a series, with its standard error over blocks that are longer than its memory.

#include <cmath>
#include <cstddef>
#include <vector>

namespace carom::test {

class BlockMeans {
 public:
  explicit BlockMeans(std::size_t per_block) : per_block_(per_block) {}

  void add(double value) {
    sum_ += value;
    if (++pending_ < per_block_) return;
    blocks_.push_back(sum_ / static_cast<double>(per_block_));
    sum_ = 0.0;
    pending_ = 0;
  }

  /// Of whole blocks.
  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const double block : blocks_) sum += block;
    return sum / static_cast<double>(blocks_.size());
  }
  [[nodiscard]] double error() const {
    const double middle = mean();
    double squares = 0.0;
    for (const double block : blocks_) squares += (block - middle) * (block - middle);
    const auto n = static_cast<double>(blocks_.size());
    return std::sqrt(squares / (n * (n - 1)));
  }

 private:
  std::size_t per_block_;
  std::size_t pending_ = 0;
  double sum_ = 0.0;
  std::vector<double> blocks_;
};

/// The mean of independent values.
template <class Values>
BlockMeans mean_of(const Values& values) {
  BlockMeans mean(1);
  for (const double value : values) mean.add(value);
  return mean;
}

}  // namespace carom::test
