#include "observe/blocked_rows.hpp"

#include <algorithm>

namespace carom {

namespace {

/// The first block of a row that begins at step `row`.
std::uint64_t first_block(std::size_t row, std::size_t level) { return (row + (std::uint64_t{1} << level) - 1) >> level; }

}  // namespace

void BlockedRows::add(std::span<const double> samples) {
  if (first_.size() < samples.size()) first_.push_back(samples.back());
  now_.resize(rows_);
  kernel_->since(samples.data(), first_.data(), samples.size(), now_.data());
  std::size_t begun = samples.size();  // rows that have the whole of this block
  for (std::size_t level = 0;; ++level) {
    if (level == levels_.size())
      levels_.push_back({0, std::vector<double>(rows_), std::vector<double>(rows_), std::vector<double>(rows_)});
    Level& here = levels_[level];
    const std::uint64_t block = here.blocks++;
    const bool second = block % 2 == 1;
    kernel_->block(second, begun, now_.data(), here.sum.data(), here.square.data(), here.waiting.data());
    if (!second) return;
    // Those who had the block before too, which began at step (block - 1) 2^level.
    begun = static_cast<std::size_t>(std::min<std::uint64_t>(begun, ((block - 1) << level) + 1));
  }
}

std::optional<Blocking::Estimate> BlockedRows::estimate(std::size_t row) const {
  if (row >= first_.size()) return std::nullopt;
  std::vector<Blocking::Level> levels;
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    const std::uint64_t before = first_block(row, level);
    if (levels_[level].blocks <= before) break;
    const std::uint64_t blocks = levels_[level].blocks - before;
    const double n = static_cast<double>(blocks), sum = levels_[level].sum[row];
    Blocking::Level& found = levels.emplace_back();
    found.blocks = blocks;
    found.mean_x = first_[row] + sum / n;
    found.mean_w = 1.0;
    found.xx = std::max(0.0, levels_[level].square[row] - sum * sum / n);
  }
  return Blocking::estimate(levels);
}

}  // namespace carom
