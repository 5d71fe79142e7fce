// From a scene to the fast engine with every effect, with the leanest layout that its disks allow.

#include "effects/any_impact.hpp"
#include "effects/world.hpp"
#include "engine/engine_impl.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/threaded_engine.hpp"

#include <utility>

namespace carom::detail {

namespace {

template <class Layout>
using General = Engine<AnyImpact<double>, Layout, AnyWorld>;

template <class Layout>
std::unique_ptr<AnyEngine> make(const Scene& scene, const Disks& disks, State start) {
  return std::make_unique<ThreadedEngine<AnyImpact<double>, Layout, AnyWorld>>(scene.box, disks, std::move(start), scene.effects,
                                                                               scene.run.seed);
}

}  // namespace

std::string why_not_general(const Scene& scene, const Disks& disks) {
  return General<AnyDisks>::why_not(scene.box, disks, scene.effects);
}

std::unique_ptr<AnyEngine> make_general(const Scene& scene, const Disks& disks, State start) {
  return EqualDisks::covers(disks) ? make<EqualDisks>(scene, disks, std::move(start))
                                   : make<AnyDisks>(scene, disks, std::move(start));
}

}  // namespace carom::detail
