#pragma once
// Correlations over all lags of a run in memory that grows with the logarithm of its length: the multiple-tau correlator of
// Ramirez, Sukumaran, Vorselaars & Likhtman, J. Chem. Phys. 133, 154103 (2010). Level l keeps the last few values on a grid 2^l
// times as coarse.
//
// Two kinds of pairs:
//   products: <x(0) x(t)> of values that are means over a step. Level l joins two values of the level below to their mean, so its
//   values
//     are the means over 2^l steps, and what it finds at a lag is the correlation averaged over a triangle of twice that width.
//     Fed with exact means over time (a displacement over its time, the integral of a flux over its time), its running integral
//     is exact: integral from 0 to (k + 1/2) w, w the width, = (<D^2((k + 1) w)> - <D^2(k w)>) / 2 w, D the integral of x.
//   squared_differences: <(x(t) - x(0))^2> of values at instants. Level l takes every 2^l-th value.
//
// A value has any number of channels, over which pairs are averaged. Errors come from blocking over time.

#include "observe/blocked_rows.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace carom {

class MultipleTau {
 public:
  enum class Pairs { products, squared_differences };

  /// Makes an empty correlator, for reading into.
  MultipleTau() = default;
  /// `lags`: values kept per level, even. `levels`: at most that many.
  MultipleTau(std::size_t channels, Pairs pairs, std::size_t lags = 16, std::size_t levels = 64);

  /// The value of the next step. Requires as many numbers as channels.
  void add(std::span<const double> value);

  struct Row {
    double lag = 0.0;    ///< the lag, in steps
    double width = 1.0;  ///< length of a value of this level, in steps
    Blocking::Estimate pairs;
    std::optional<Halves> halves = {};  ///< of `pairs`
    /// Products only: the integral from 0 to lag + width / 2, per step.
    std::optional<Blocking::Estimate> integral = {};
    std::optional<Halves> integral_halves = {};
    /// Returns the integral where there is one, else the pairs.
    [[nodiscard]] const Blocking::Estimate& estimate() const { return integral ? *integral : pairs; }
    /// Sets a scalar to `factor` times estimate(), with error, correlation time and halves where they are known. `step` is the
    /// time of a step; the note gets a sentence where the error is a lower bound. Requires that the error is known.
    void fill(Scalar& scalar, double step, double factor) const;
  };
  /// Returns the rows in order of the lag, as far as there are pairs. Squared differences begin with lag 1.
  [[nodiscard]] std::vector<Row> rows();
  /// Returns a remark on the errors of these rows, as a sentence without its stop; empty where there is none.
  [[nodiscard]] static std::string note_on_errors(const std::vector<Row>& rows);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(channels_, kind_, lags_, most_levels_, levels_);
  }

 private:
  struct Level {
    std::vector<double> coming;   ///< values that were not processed yet
    std::vector<double> earlier;  ///< lags x channels of those before
    std::vector<double> waiting;  ///< for a second one
    bool has_waiting = false;
    std::size_t count = 0;         ///< of values that the ring has got; of two channels there is none
    BlockedRows pairs, integrals;  ///< by lag

    template <class Archive>
    void serialize(Archive& archive) {
      archive(coming, earlier, waiting, has_waiting, count, pairs, integrals);
    }
  };
  /// Values of few channels come so many together: what has not been looked at for long is far away.
  [[nodiscard]] std::size_t together() const { return channels_ == 2 ? LagRowsKernel::tree_lines : 1; }
  void add_level();
  void look_at_coming(std::size_t level);
  void join(Level& level, std::vector<double>& next);
  void find_pairs(Level& level, std::size_t count);
  void find_pairs_of_two(Level& level, std::size_t count);

  std::size_t channels_ = 0;
  Pairs kind_ = Pairs::products;
  std::size_t lags_ = 0;
  std::size_t most_levels_ = 0;
  std::vector<Level> levels_;
  std::vector<double> latest_first_, found_, integrals_;  ///< scratch; the latter by lag, a line for each value
  const LagRowsKernel* kernel_ = &lag_rows_kernel();
};

}  // namespace carom
