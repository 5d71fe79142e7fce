#pragma once
// Processor time for Z to 1 % at other sizes and densities: exact events against fixed steps whose bias is 1 %. The scenes are
// like a given one at another size or density: the same species in the same shares, the same rule and boundaries, in thermal
// motion.

#include "studies/compare/comparison.hpp"

#include <carom/scene.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace carom {

/// Adds to comparison.costs what is missing there: the scene's own density at sizes from 64 to 16,384 disks, and packing
/// fractions from 0.05 to 0.7 at 1,024 disks. False where `proceed` has stopped it.
[[nodiscard]] bool measure_costs(const Scene& scene, Comparison& comparison,
                                 const std::function<bool(const std::string& doing, double fraction)>& proceed,
                                 const std::function<void(const CostPoint&)>& done);

/// About that many disks (every species keeps its share, one disk at least) at that packing fraction and temperature: on a
/// hexagonal lattice, or at random places where that would overlap. Empty where neither can be done.
[[nodiscard]] std::optional<Scene> scene_like(const Scene& scene, std::int64_t disks, double packing_fraction,
                                              double temperature);

}  // namespace carom
