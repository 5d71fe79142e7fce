#pragma once
// From a scene to the textbook engine.

#include "engine/textbook_impl.hpp"
#include "simulation/catalogue.hpp"

namespace carom::detail {

template <class Real>
std::unique_ptr<AnyEngine> make_textbook(const Scene& scene, const Disks& disks, State start) {
  return std::make_unique<EngineAdapter<TextbookEngine<Real>>>(scene.box, disks, start, scene.effects, scene.run.seed);
}

}  // namespace carom::detail
