// From a scene to the fast engine where nothing but the collision rule and hard walls act.

#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "simulation/make_fast_engine.hpp"

#include <utility>

namespace carom::detail {

extern template std::unique_ptr<AnyEngine> make_fast_engine<Specular>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_fast_engine<Reversal>(const Scene&, const Disks&, State);

std::string why_not_fast(const Scene& scene, const Disks& disks) {
  return Engine<Elastic<Specular>, AnyDisks, PlainWorld>::why_not(scene.box, disks, scene.effects);
}

std::unique_ptr<AnyEngine> make_fast(const Scene& scene, const Disks& disks, State start) {
  return scene.effects.collision.rule == CollisionRule::reversal ? make_fast_engine<Reversal>(scene, disks, std::move(start))
                                                                 : make_fast_engine<Specular>(scene, disks, std::move(start));
}

}  // namespace carom::detail
