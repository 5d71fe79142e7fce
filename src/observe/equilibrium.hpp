#pragma once
// When a compressibility factor Z = P A / (N kT) is one number that a run can measure.

#include "scene/effect_traits.hpp"

#include <carom/scene.hpp>

#include <string>
#include <string_view>

namespace carom {

/// Returns why there is no such number, as the end of a sentence; empty where there is one. An effect at its neutral value does
/// no harm, and one with the trait `passed_over`, where that is given, is not asked.
[[nodiscard]] std::string_view why_no_Z(const Effects& effects, bool detail::EffectTraits::*passed_over = nullptr);
/// Does so for a scene, whose effects may change during the run.
[[nodiscard]] std::string_view why_no_Z(const Scene& scene);
/// Returns why the run is not that of one gas in equilibrium throughout, as the end of a sentence; empty where nothing is changed
/// on the way.
[[nodiscard]] std::string_view why_not_one_gas(const Scene& scene);

/// Returns whether the kinetic energy fluctuates, because a heat bath, spins or wells take part in it. Z is then computed with
/// the mean of the temperature, and not with that of one state.
[[nodiscard]] bool temperature_fluctuates(const Effects& effects);

/// Returns whether the disks of a circular box keep their angular momentum.
[[nodiscard]] bool keeps_turning(const Scene& scene);

/// Returns the reason why errors of one run do not cover the scatter between starts, as a sentence without its stop; empty where
/// they do. A mixture beyond a packing fraction of 0.72 keeps its arrangement for long. Reversal of equal masses never changes
/// the set of speeds. In a circular box all disks together keep turning as they did at the start. Where energy is conserved and
/// is stored otherwise than in motion too, it depends on where the disks of the start are, and kT with it.
[[nodiscard]] std::string_view why_errors_are_of_one_start(const Scene& scene);

/// Returns the reason why errors are lower bounds, as a sentence without its stop; empty where the run lasts 32 times as long as
/// its slowest motion. The summary's Z has 32 blocks or more. The slowest motion, in collisions of a disk, lasts for:
/// - disks of masses m to M: (m + M)^2 / 2 m M. A collision passes on the inverse of it of the difference of their mean energies;
/// - N equal disks between liquid and solid (packing fractions 0.695 to 0.72): N. Domains of 128^2 disks form and dissolve within
///   about as many (docs/validation.md);
/// - N disks that cannot pass each other: (N / 2 pi)^2, within which heat spreads among them.
[[nodiscard]] std::string_view why_errors_are_lower_bounds(const Scene& scene, double collisions_per_disk);

/// Returns the remark on the errors of all numbers of a run: why_errors_are_of_one_start(), also because no two disks have
/// collided, and why_errors_are_lower_bounds().
[[nodiscard]] std::string note_on_errors(const Scene& scene, double collisions_per_disk);

/// Returns whether the scene has equal disks so dense (packing fraction beyond 0.72) that they rattle in a crystal. Most of the
/// virial then oscillates, and blocks overestimate the error of its mean.
[[nodiscard]] bool is_crystal(const Scene& scene);

}  // namespace carom
