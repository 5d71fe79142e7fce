// Prints engine_bits(): compiled with a long double of another width, see CMakeLists.txt and long_double_test.cpp.

#include "golden/engine_bits.hpp"

#include "effects/any_impact.hpp"
#include "effects/elastic.hpp"
#include "effects/plain_world.hpp"
#include "effects/specular.hpp"
#include "effects/world.hpp"
#include "engine/engine_impl.hpp"

#include <cstdio>
#include <memory>
#include <utility>

namespace carom::detail {

// Two engines of the library's seven, for one core, so that they are compiled soon: all of them have the same arithmetic.
namespace {

template <class Engine>
std::unique_ptr<AnyEngine> made(const Scene& scene, const Disks& disks, State start) {
  return std::make_unique<EngineAdapter<Engine>>(scene.box, disks, std::move(start), scene.effects, scene.run.seed);
}

}  // namespace

std::unique_ptr<AnyEngine> make_general(const Scene& scene, const Disks& disks, State start) {
  return made<Engine<AnyImpact<double>, AnyDisks, AnyWorld>>(scene, disks, std::move(start));
}

std::unique_ptr<AnyEngine> make_fast(const Scene& scene, const Disks& disks, State start) {
  if (scene.effects.collision.rule == CollisionRule::reversal) return make_general(scene, disks, std::move(start));
  return made<Engine<Elastic<Specular>, AnyDisks, PlainWorld>>(scene, disks, std::move(start));
}

}  // namespace carom::detail

int main() { std::fputs(carom::test::engine_bits().c_str(), stdout); }
