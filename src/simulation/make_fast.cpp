// From a scene to the fast engine with the scene's collision rule and the leanest layout that its disks allow.

#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "engine/engine.hpp"
#include "simulation/catalogue.hpp"

#include <utility>

namespace carom::detail {

namespace {

template <class Rule>
std::unique_ptr<AnyEngine> make(const Scene& scene, const Disks& disks, State start) {
  if (EqualDisks::covers(disks))
    return std::make_unique<EngineAdapter<Engine<Rule, EqualDisks>>>(scene.box, disks, std::move(start));
  return std::make_unique<EngineAdapter<Engine<Rule, AnyDisks>>>(scene.box, disks, std::move(start));
}

}  // namespace

bool fast_covers(const Scene& scene, const Disks& disks) {
  return scene.effects.neutral() && Engine<Specular, AnyDisks>::covers(scene.box, disks);
}

std::unique_ptr<AnyEngine> make_fast(const Scene& scene, const Disks& disks, State start) {
  return scene.effects.collision.rule == CollisionRule::reversal ? make<Reversal>(scene, disks, std::move(start))
                                                                 : make<Specular>(scene, disks, std::move(start));
}

}  // namespace carom::detail
