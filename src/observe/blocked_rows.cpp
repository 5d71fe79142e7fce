#include "observe/blocked_rows.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace carom {

namespace {

/// Returns the first block of a row that begins at step `row`.
std::uint64_t first_block(std::size_t row, std::size_t level) { return (row + (std::uint64_t{1} << level) - 1) >> level; }

}  // namespace

void BlockedRows::add(std::span<double> samples) {
  while (!samples.empty()) {
    const std::uint64_t until_power = std::bit_ceil(steps() + 1) - steps();
    const std::size_t count = std::min(samples.size(), static_cast<std::size_t>(until_power) * rows_);
    add_some(samples.first(count));
    samples = samples.subspan(count);
    if (count != static_cast<std::size_t>(until_power) * rows_) continue;
    at_power_before_ = std::move(at_power_);
    at_power_ = levels_;
  }
}

void BlockedRows::add_some(std::span<double> samples) {
  std::size_t lines = samples.size() / rows_;
  const std::uint64_t before = steps();
  for (std::uint64_t row = before; row < std::min<std::uint64_t>(rows_, before + lines); ++row)
    first_[row] = samples[(row - before) * rows_ + row];
  double* x = samples.data();
  std::size_t level = 0;
  if (lines == LagRowsKernel::tree_lines && before > 0 && before % lines == 0 && before + 1 >= rows_) {
    add_tree(x);
    level = LagRowsKernel::tree_levels;
    lines = 1;
  } else {
    kernel_->since(x, first_.data(), rows_, lines);
  }
  for (; lines > 0; ++level) {
    if (level == levels_.size())
      levels_.push_back({0, std::vector<double>(rows_), std::vector<double>(rows_), std::vector<double>(rows_)});
    lines = add(level, x, lines);
  }
}

/// Leaves the mean of all in the first line. Requires that all rows have begun, and blocks of all these levels begin.
void BlockedRows::add_tree(double* x) {
  std::array<BlockSums, LagRowsKernel::tree_levels> sums;
  for (std::size_t level = 0; level < sums.size(); ++level) {
    sums[level] = sums_of(level);
    levels_[level].blocks += LagRowsKernel::tree_lines >> level;
  }
  kernel_->blocks_of_tree(x, first_.data(), sums.data());
}

/// Joins two and two blocks to their means, at the front of all; returns how many there are.
std::size_t BlockedRows::add(std::size_t level, double* x, std::size_t lines) {
  Level& here = levels_[level];
  BlockSums sums = sums_of(level);
  double* means = x;
  const auto look_at = [&](std::size_t count) {
    const std::uint64_t second = here.blocks % 2;
    kernel_->blocks(x, sums, second == 1, count, means);
    x += count * rows_;
    means += (count + second) / 2 * rows_;
    here.blocks += count;
  };
  const double* end = x + lines * rows_;
  const std::size_t joined = (lines + here.blocks % 2) / 2;
  // At first not all rows have the whole of a block.
  for (const std::uint64_t whole = first_block(rows_ - 1, level); here.blocks < whole && x < end;) {
    sums.rows = static_cast<std::size_t>(here.blocks << level) + 1;
    look_at(1);
  }
  sums.rows = rows_;
  look_at(static_cast<std::size_t>(end - x) / rows_);
  return joined;
}

std::vector<Blocking::Level> BlockedRows::levels_of(const std::vector<Level>& levels, std::size_t row) const {
  std::vector<Blocking::Level> row_levels;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const std::uint64_t before = first_block(row, level);
    if (levels[level].blocks <= before) break;
    const std::uint64_t blocks = levels[level].blocks - before;
    const double n = static_cast<double>(blocks), sum = levels[level].sum[row];
    Blocking::Level& found = row_levels.emplace_back();
    found.blocks = blocks;
    found.mean_x = first_[row] + sum / n;
    found.mean_w = 1.0;
    found.xx = std::max(0.0, levels[level].square[row] - sum * sum / n);
  }
  return row_levels;
}

std::optional<Blocking::Estimate> BlockedRows::estimate(std::size_t row, std::span<const double> known) const {
  if (row >= steps()) return std::nullopt;
  return Blocking::estimate(levels_of(levels_, row), 1, known);
}

std::optional<Halves> BlockedRows::halves(std::size_t row, std::span<const double> known) const {
  return Blocking::halves(levels_of(levels_, row), levels_of(at_power_, row), levels_of(at_power_before_, row), 1, known);
}

}  // namespace carom
