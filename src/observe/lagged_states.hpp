#pragma once
// Pairs of states over all lags of a run, for what is no correlation of numbers: memory grows with the logarithm of the run's
// length.
//
// Level l keeps every 2^l-th state, sixteen of them: lags of 0 to 15 steps on the lowest, of 8 to 15 times 2^l steps on the
// others. Pairs that end at every eighth state of a level are looked at: those in between share most of their time with these.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

class LaggedStates {
 public:
  /// Makes an empty one, for reading into.
  LaggedStates() = default;
  /// Requires states of so many numbers.
  explicit LaggedStates(std::size_t channels) : channels_(channels) {}

  /// Takes the state of the next step, and calls visit(row, earlier) for each lag at which a pair ends with it. Row r has the lag
  /// lag(r); row 0 is that of the state with itself.
  template <class Visit>
  void add(std::span<const double> now, Visit&& visit) {
    for (std::size_t l = 0; steps_ % (std::uint64_t{1} << l) == 0; ++l) {
      if (l == levels_.size()) add_level();
      Level& level = levels_[l];
      const std::uint64_t number = steps_ >> l;
      std::copy(now.begin(), now.end(), level.states.begin() + static_cast<std::ptrdiff_t>(number % lags * channels_));
      if (number % apart == 0)
        for (std::size_t k = l == 0 ? 0 : lags / 2; k < lags && k <= number; ++k)
          visit(l == 0 ? k : lags + (l - 1) * (lags / 2) + k - lags / 2,
                std::span<const double>(level.states).subspan((number - k) % lags * channels_, channels_));
      if (steps_ == 0) break;
    }
    ++steps_;
  }

  /// Returns the lag of a row, in steps.
  [[nodiscard]] static double lag(std::size_t row) {
    if (row < lags) return static_cast<double>(row);
    const std::size_t above = row - lags;
    const std::size_t level = above / (lags / 2) + 1, states = lags / 2 + above % (lags / 2);
    return std::ldexp(static_cast<double>(states), static_cast<int>(level));
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(channels_, steps_, levels_);
  }

  /// Pairs end at states of a level that are so many apart.
  static constexpr std::size_t apart = 8;

 private:
  static constexpr std::size_t lags = 16;

  struct Level {
    std::vector<double> states;  ///< a ring

    template <class Archive>
    void serialize(Archive& archive) {
      archive(states);
    }
  };

  /// The first state is the first of every level.
  void add_level() {
    Level& level = levels_.emplace_back();
    level.states.resize(lags * channels_);
    if (levels_.size() > 1) std::copy_n(levels_[levels_.size() - 2].states.begin(), channels_, level.states.begin());
  }

  std::size_t channels_ = 0;
  std::uint64_t steps_ = 0;
  std::vector<Level> levels_;
};

}  // namespace carom
