#pragma once
// From a scene to the textbook engine with the scene's collision rule.

#include "effects/reversal.hpp"
#include "effects/specular.hpp"
#include "engine/textbook.hpp"
#include "simulation/catalogue.hpp"

namespace carom::detail {

template <class Real>
std::unique_ptr<AnyEngine> make_textbook(const Scene& scene, const Disks& disks, State start) {
  if (scene.effects.collision.rule == CollisionRule::reversal)
    return std::make_unique<EngineAdapter<TextbookEngine<Real, Reversal>>>(scene.box, disks, start);
  return std::make_unique<EngineAdapter<TextbookEngine<Real, Specular>>>(scene.box, disks, start);
}

}  // namespace carom::detail
