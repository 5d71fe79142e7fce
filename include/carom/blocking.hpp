#pragma once
// Standard errors of means over correlated samples, by blocking after Flyvbjerg & Petersen, J. Chem. Phys. 91, 461 (1989).
// Samples are blocked as they come in; memory grows with the logarithm of their number.
//
// Pairs of neighbouring samples are averaged into blocks, again and again. The variance of the mean that is estimated from blocks
// of one length grows with that length until blocks are longer than correlations, and is constant from there on. The length that
// is used is the shortest B with B^3 > 2 n g^2, where n is the number of samples and g = (variance estimated from these blocks) /
// (variance estimated from single samples): there the bias by remaining correlations and the noise of few blocks are about equal
// (Lee, Conduit, Nemec, Lopez Rios & Drummond, Phys. Rev. E 83, 066706 (2011)). Where correlations lower the variance, as for
// quantities that walls or energy keep within bounds, the relative bias of short blocks is (1 - g) / g, and 1 / g takes the place
// of g.
//
// Correlations from one block into the next are added as if they fell exponentially: the variance is divided by
// 1 - (g - 1) / 2 B.
//
// Correlations that are known beforehand, such as those of overlapping windows of one lag, need not be found by blocks:
// docs/observables.md.
//
// A sample may carry a weight w. The mean is then the ratio <x> / <w>, and its error is that of x - mean * w; likewise for
// <x> / <w>^p.

#include <carom/observe.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom {

/// The mean of a series of correlated samples, with its standard error. Samples are equidistant in time (or in number of
/// collisions); memory is O(log n).
class Blocking {
 public:
  /// Adds the next sample `x` of the series, with its weight.
  void add(double x, double weight = 1.0);

  struct Estimate {
    double mean = 0.0;  ///< <x> / <w>^power, in the unit of the samples
    /// Standard error of `mean`. It is absent with fewer than 16 samples, or 8 that do not overlap, or where the weights w are
    /// those of so few samples that (sum of w)^2 < 8 (sum of w^2): a mean of one or two events has no scatter.
    std::optional<double> error;
    /// Statistical inefficiency g = n var(mean) / var(x), at least 1: n correlated samples are worth n / g independent ones. It
    /// is absent where no blocks are long enough; `error` is then a lower bound.
    std::optional<double> statistical_inefficiency;
    /// Whether correlations were found but no blocks are long enough for them: the longest blocks estimate more than twice the
    /// variance that the shortest do, and more than chance makes of independent samples once in a thousand. False where
    /// `statistical_inefficiency` is present.
    bool lower_bound = false;
    std::uint64_t blocks = 0;  ///< number of blocks whose scatter gave `error`
  };
  /// Estimates <x> / <w>^power. Returns nothing without samples, or where all weights are zero.
  [[nodiscard]] std::optional<Estimate> estimate(int power = 1) const { return estimate(levels_, power); }

  /// Estimates <x> - <w>^2, which is the variance of w where every x is w^2. Returns nothing without samples, or where all
  /// weights are zero; the error is absent where that of <x> / <w> is.
  [[nodiscard]] std::optional<Estimate> estimate_of_variance() const;

  /// Compares <x> / <w>^power of the first part of the samples with that of the rest. The standard error is that of the rest, as
  /// blocking finds it, by which in equilibrium the first part fluctuates too: a start that has not yet come to equilibrium does
  /// not hide itself behind its own scatter. The probability is that of Student's t with the number of these blocks. Returns
  /// nothing where the rest has too few samples, correlations that are too long, or no scatter but rounding.
  [[nodiscard]] std::optional<Halves> halves(int power = 1) const { return halves(levels_, at_power_, at_power_before_, power); }

  /// Sums over all blocks of 2^level samples. Sums of squares are about the mean of all blocks.
  struct Level {
    std::uint64_t blocks = 0;                 ///< number of whole blocks
    double mean_x = 0.0, mean_w = 0.0;        ///< means over them
    double xx = 0.0, xw = 0.0, ww = 0.0;      ///< sums of products of deviations from these means
    double waiting_x = 0.0, waiting_w = 0.0;  ///< the block that has no partner yet
    /// Adds one block.
    void add(double x, double w);
    /// Returns the variance of the mean of x - ratio * w, as these blocks estimate it; requires two blocks.
    [[nodiscard]] double variance_of_mean(double ratio) const;
  };
  /// Estimates <x> / <w>^power from levels that were gathered elsewhere. `known` holds the correlations of samples 1, 2, 3, ...
  /// apart (0 beyond) that are there whatever the blocks find. The variance that blocks of B samples estimate is then multiplied
  /// by (variance of the mean) / (its expected estimate from such blocks), both for these correlations alone.
  [[nodiscard]] static std::optional<Estimate> estimate(std::span<const Level> levels, int power = 1,
                                                        std::span<const double> known = {});

  /// Compares two parts of samples that were gathered elsewhere: `late` and `early` are the levels as they were at the last two
  /// numbers of samples that may be the end of the first part, of which the one is taken that is nearer to half of all.
  [[nodiscard]] static std::optional<Halves> halves(std::span<const Level> levels, std::span<const Level> late,
                                                    std::span<const Level> early, int power = 1,
                                                    std::span<const double> known = {});

  /// Returns the number of samples.
  [[nodiscard]] std::uint64_t samples() const { return levels_.empty() ? 0 : levels_.front().blocks; }

  /// Sets value, error, integrated correlation time and halves of `scalar` to those of offset + factor <x> / <w>^power. `step` is
  /// the time between samples. Where no blocks are long enough, the note says that the error is a lower bound.
  void fill(Scalar& scalar, double step, double factor = 1.0, double offset = 0.0, int power = 1) const;

  /// Saves or loads all samples, with an archive in the manner of cereal.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(levels_, at_power_, at_power_before_);
  }

 private:
  /// Finds the error of estimate.mean, which errs by that of the mean of (x - slope w) / scale.
  static void find_error(Estimate& estimate, std::span<const Level> levels, double slope, double scale,
                         std::span<const double> known);

  std::vector<Level> levels_;
  std::vector<Level> at_power_, at_power_before_;  ///< as they were at the last two numbers of samples that are powers of two
};

}  // namespace carom
