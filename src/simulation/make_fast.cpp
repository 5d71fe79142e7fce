// From a scene to the fast engine: lean where nothing but the collision rule and hard walls act, with every effect where more
// does; and with the leanest layout that its disks allow.

#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "engine/engine.hpp"
#include "simulation/catalogue.hpp"

#include <utility>

namespace carom::detail {

namespace {

template <class Rule, class Layout>
using Lean = Engine<Elastic<Rule>, Layout, PlainWorld>;
template <class Layout>
using General = Engine<AnyImpact<double>, Layout, AnyWorld>;

template <class Engine>
std::unique_ptr<AnyEngine> make(const Scene& scene, const Disks& disks, State start) {
  return std::make_unique<EngineAdapter<Engine>>(scene.box, disks, std::move(start), scene.effects, scene.run.seed);
}

template <class Rule>
std::unique_ptr<AnyEngine> make_lean(const Scene& scene, const Disks& disks, State start) {
  return EqualDisks::covers(disks) ? make<Lean<Rule, EqualDisks>>(scene, disks, std::move(start))
                                   : make<Lean<Rule, AnyDisks>>(scene, disks, std::move(start));
}

}  // namespace

std::string why_not_fast(const Scene& scene, const Disks& disks) {
  return Lean<Specular, AnyDisks>::why_not(scene.box, disks, scene.effects);
}

std::unique_ptr<AnyEngine> make_fast(const Scene& scene, const Disks& disks, State start) {
  return scene.effects.collision.rule == CollisionRule::reversal ? make_lean<Reversal>(scene, disks, std::move(start))
                                                                 : make_lean<Specular>(scene, disks, std::move(start));
}

std::string why_not_general(const Scene& scene, const Disks& disks) {
  return General<AnyDisks>::why_not(scene.box, disks, scene.effects);
}

std::unique_ptr<AnyEngine> make_general(const Scene& scene, const Disks& disks, State start) {
  return EqualDisks::covers(disks) ? make<General<EqualDisks>>(scene, disks, std::move(start))
                                   : make<General<AnyDisks>>(scene, disks, std::move(start));
}

}  // namespace carom::detail
