#pragma once
// From a scene to the fast engine where nothing but a collision rule and hard walls act, with the smallest layout that its disks
// allow. One rule is compiled in one file.

#include "effects/elastic.hpp"
#include "effects/plain_world.hpp"
#include "engine/engine_impl.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/threaded_engine.hpp"

#include <memory>
#include <utility>

namespace carom::detail {

template <class Rule, class Layout>
using FastEngine = ThreadedEngine<Elastic<Rule>, Layout, PlainWorld>;

template <class Rule>
std::unique_ptr<AnyEngine> make_fast_engine(const Scene& scene, const Disks& disks, State start) {
  if (EqualDisks::covers(disks))
    return std::make_unique<FastEngine<Rule, EqualDisks>>(scene.box, disks, std::move(start), scene.effects, scene.run.seed);
  return std::make_unique<FastEngine<Rule, AnyDisks>>(scene.box, disks, std::move(start), scene.effects, scene.run.seed);
}

}  // namespace carom::detail
