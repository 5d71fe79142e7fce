// From a scene to the fast engine with every effect, with the smallest layout that its disks allow.

#include "simulation/make_with_effects.hpp"

#include <utility>

namespace carom::detail {

std::string why_not_general(const Scene& scene, const Disks& disks) {
  return Engine<AnyImpact<double>, AnyDisks, AnyWorld>::why_not(scene.box, disks, scene.effects);
}

std::unique_ptr<AnyEngine> make_general(const Scene& scene, const Disks& disks, State start) {
  if (is_non_additive(scene.effects, disks)) return make_mixed(scene, disks, std::move(start));
  return EqualDisks::covers(disks) ? make_with_effects<EqualDisks>(scene, disks, std::move(start))
                                   : make_with_effects<AnyDisks>(scene, disks, std::move(start));
}

}  // namespace carom::detail
