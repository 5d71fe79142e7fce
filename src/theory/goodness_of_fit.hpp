#pragma once
// Probabilities that chance alone explains a measurement.

namespace carom::theory {

/// Returns the deviation in standard errors that a normal variable exceeds, to either side, with this probability. Requires 0 < p
/// <= 1.
[[nodiscard]] double standard_errors(double probability);

/// Kolmogorov and Smirnov's test of speeds against the law of Microcanonical, for whole snapshots of one run. `distance` is
/// sqrt(n) D, n the speeds in all snapshots. Their squares have a fixed sum in every snapshot, which leaves less room for chance
/// than n independent numbers have: the points that 5 and 1 in 100 exceed are 1.087 and 1.287, not 1.358 and
/// 1.628.
///
/// The difference of the two distributions is, for many disks, a Gaussian process over x = v^2 / <v^2> with variance e^-x (1 -
/// e^-x (1 + x^2)), whose largest value is s^2 = 0.1491. The probability to exceed d is C exp(-d^2 / 2 s^2) for large d
/// (Piterbarg, Asymptotic Methods in the Theory of Gaussian Processes and Fields (1996), for such a maximum); C = 2.65 is above
/// what simulation gives (goodness_of_fit_test).
[[nodiscard]] double snapshot_probability(double distance);

}  // namespace carom::theory
