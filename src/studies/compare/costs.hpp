#pragma once
// Processor time for Z to 1 % at other sizes and densities: exact events against fixed steps whose bias is 1 %.

#include "studies/compare/comparison.hpp"

#include <carom/scene.hpp>

#include <functional>
#include <string>

namespace carom {

/// Adds to comparison.costs what is missing there: the scene's own density at sizes from 64 to 16,384 disks, and packing
/// fractions from 0.05 to 0.7 at 1,024 disks. False where `proceed` has stopped it.
[[nodiscard]] bool measure_costs(const Scene& scene, Comparison& comparison,
                                 const std::function<bool(const std::string& doing, double fraction)>& proceed,
                                 const std::function<void(const CostPoint&)>& done);

}  // namespace carom
