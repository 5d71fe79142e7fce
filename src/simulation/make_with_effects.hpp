#pragma once
// From a scene to the fast engine with every effect and one layout.

#include "effects/any_impact.hpp"
#include "effects/world.hpp"
#include "engine/engine_impl.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/threaded_engine.hpp"

#include <memory>
#include <utility>

namespace carom::detail {

template <class Layout>
std::unique_ptr<AnyEngine> make_with_effects(const Scene& scene, const Disks& disks, State start) {
  return std::make_unique<ThreadedEngine<AnyImpact<double>, Layout, AnyWorld>>(scene.box, disks, std::move(start), scene.effects,
                                                                               scene.run.seed);
}

}  // namespace carom::detail
