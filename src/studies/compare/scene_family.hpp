#pragma once
// Scenes like a given one at another size or density: the same species in the same shares, the same rule and boundaries, in
// thermal motion.

#include <carom/scene.hpp>

#include <cstdint>
#include <optional>

namespace carom {

/// About that many disks (every species keeps its share, one disk at least) at that packing fraction and temperature: on a
/// hexagonal lattice, or at random places where that would overlap. Empty where neither can be done.
[[nodiscard]] std::optional<Scene> scene_like(const Scene& scene, std::int64_t disks, double packing_fraction,
                                              double temperature);

}  // namespace carom
