#pragma once
// The error of a fixed step for an isolated pair of equal disks, averaged over the collisions of a dilute gas in equilibrium.
// Derived in docs/accuracy.md.

namespace carom::theory {

/// The overlapping pairs that a method detects as collisions.
enum class Detects {
  contact,     ///< all (naive)
  approaching  ///< approaching pairs only (guarded)
};

/// Returns the fraction of collisions that a step passes over. `step` = v_T dt / sigma with v_T = sqrt(kT / m). For small steps
/// step^2 / 4 where contact is detected, step^2 where approach is.
[[nodiscard]] double missed_fraction(double step, Detects detects);

/// Mean of (sigma - |r|) / sigma at the step at which a collision is detected, of pairs that approach. For small steps
/// (sqrt(pi) / 2) step.
[[nodiscard]] double mean_depth(double step);

/// Returns the relative bias of Z of a method that reverses disks where it finds them overlapping, to first order in `step`, at
/// packing fraction eta (0 < eta <= densest_fluid): -(3 / sqrt(pi)) step eta Z'(eta) / Z(eta). To the pressure, such disks have
/// the diameter sigma (1 - 3 step / (2 sqrt(pi))).
[[nodiscard]] double bias_of_Z(double step, double eta);

}  // namespace carom::theory
