#pragma once
// Numbers against time of which a bounded number is kept: every one at first, then every second, every fourth, and so on.

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace carom {

class ThinnedRows {
 public:
  explicit ThinnedRows(std::size_t columns) : columns_(columns) {}

  /// Returns whether the row of this instant is to be kept. Call it once for every instant, and add() where it is true.
  [[nodiscard]] bool takes_next() {
    if (calls_++ % stride_ != 0) return false;
    if (times_.size() < most) return true;
    halve();
    return (calls_ - 1) % stride_ == 0;
  }

  /// Requires as many values as there are columns.
  void add(double time, std::span<const double> values) {
    times_.push_back(time);
    for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].push_back(values[c]);
  }
  void add(double time, std::initializer_list<double> values) { add(time, std::span(values.begin(), values.size())); }

  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] const std::vector<double>& column(std::size_t c) const { return columns_[c]; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(calls_, stride_, times_);
    for (std::vector<double>& column : columns_) archive(column);
  }

 private:
  static constexpr std::size_t most = 1024;

  static void halve(std::vector<double>& list) {
    for (std::size_t k = 0; 2 * k < list.size(); ++k) list[k] = list[2 * k];
    list.resize((list.size() + 1) / 2);
  }
  void halve() {
    halve(times_);
    for (std::vector<double>& column : columns_) halve(column);
    stride_ *= 2;
  }

  std::uint64_t calls_ = 0, stride_ = 1;
  std::vector<double> times_;
  std::vector<std::vector<double>> columns_;
};

}  // namespace carom
