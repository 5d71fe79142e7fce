// From a scene to the fast engine for mixtures whose diameters are not additive.

#include "simulation/make_with_effects.hpp"

#include <utility>

namespace carom::detail {

std::unique_ptr<AnyEngine> make_mixed(const Scene& scene, const Disks& disks, State start) {
  return make_with_effects<MixedDisks>(scene, disks, std::move(start));
}

}  // namespace carom::detail
