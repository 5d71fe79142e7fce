#pragma once
// Standard errors of means over correlated samples: blocking after Flyvbjerg & Petersen, J. Chem. Phys. 91, 461 (1989), done
// while the samples come in, in memory that grows with the logarithm of their number.
//
// Neighbouring samples are joined again and again; the variance of the mean, as the blocks of each length tell it, grows with the
// length until blocks are longer than correlations, and stays from there on. The length that is taken is the shortest B with
// B^3 > 2 n s^2, n samples, s = (variance told by these blocks) / (variance told by single samples): there what is left of the
// correlations and the noise of few blocks are about equal (Lee, Conduit, Nemec, Lopez Rios & Drummond, Phys. Rev. E 83, 066706
// (2011)). Where correlations lower the variance, as of what walls or energy keep within bounds, what short blocks tell too much
// is (1 - s) / s times as large as the rest, so that 1 / s takes the place of s.
//
// What reaches from one block into the next is added as for correlations that fall exponentially: the variance is divided by
// 1 - (s - 1) / 2 B.
//
// What is known of correlations beforehand, as that windows of one lag overlap, blocks need not find: docs/observables.md.
//
// A sample may carry a weight: the mean is then <x> / <w>, a ratio, and its error that of x - mean * w; or <x> / <w>^p likewise.

#include <carom/observe.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom {

class Blocking {
 public:
  void add(double x, double weight = 1.0);

  struct Estimate {
    double mean = 0.0;
    std::optional<double> error;  ///< of the mean; absent with fewer than 16 samples, or 8 that do not overlap
    /// Samples that count as one independent one, at least 1; absent where blocks never became long enough. `error` is then a
    /// lower bound.
    std::optional<double> inefficiency;
    /// Where it is absent: whether the longest blocks tell more than twice the variance that the shortest tell, so that there are
    /// correlations indeed.
    bool lower_bound = false;
  };
  /// <x> / <w>^power. Nothing without samples, or where all weights are zero.
  [[nodiscard]] std::optional<Estimate> estimate(int power = 1) const { return estimate(levels_, power); }

  /// Blocks of 2^level samples; sums of squares are about the mean of all blocks.
  struct Level {
    std::uint64_t blocks = 0;
    double mean_x = 0.0, mean_w = 0.0;
    double xx = 0.0, xw = 0.0, ww = 0.0;
    double waiting_x = 0.0, waiting_w = 0.0;  ///< the block that has no partner yet
    void add(double x, double w);
    [[nodiscard]] double variance_of_mean(double ratio) const;
  };
  /// The same from levels that were gathered elsewhere. `known`: correlation of samples 1, 2, 3, ... apart, 0 beyond, that there
  /// is whatever blocks tell. What blocks of B samples tell is then multiplied by (variance of the mean) / (what they tell of it
  /// on average), both as they would be if that were all.
  [[nodiscard]] static std::optional<Estimate> estimate(std::span<const Level> levels, int power = 1,
                                                        std::span<const double> known = {});

  [[nodiscard]] std::uint64_t samples() const { return levels_.empty() ? 0 : levels_.front().blocks; }

  /// offset + factor <x> / <w>^power with its error and decorrelation time. `step`: time between samples.
  void fill(Scalar& scalar, double step, double factor = 1.0, double offset = 0.0, int power = 1) const;

  /// For archives in cereal's manner.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(levels_);
  }

 private:
  std::vector<Level> levels_;
};

}  // namespace carom
