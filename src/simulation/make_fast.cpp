// From a scene to the fast engine with the scene's collision rule and the leanest layout that its disks allow.

#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "engine/engine.hpp"
#include "simulation/catalogue.hpp"

namespace carom::detail {

namespace {

template <class Rule>
std::unique_ptr<AnyEngine> make(const Scene& scene, const Start& start) {
  if (EqualDisks::covers(start.disks))
    return std::make_unique<EngineAdapter<Engine<Rule, EqualDisks>>>(scene.box, start.disks, start.state);
  return std::make_unique<EngineAdapter<Engine<Rule, AnyDisks>>>(scene.box, start.disks, start.state);
}

}  // namespace

bool fast_covers(const Scene& scene, const Start& start) { return Engine<Specular, AnyDisks>::covers(scene.box, start.disks); }

std::unique_ptr<AnyEngine> make_fast(const Scene& scene, const Start& start) {
  return scene.rule == CollisionRule::reversal ? make<Reversal>(scene, start) : make<Specular>(scene, start);
}

}  // namespace carom::detail
