#pragma once
// Engines by their names in the catalogue, on systems that are put together by hand.

#include "simulation/catalogue.hpp"
#include "support/systems.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {

using AnyEngine = detail::AnyEngine;

inline std::unique_ptr<AnyEngine> make_engine(const std::string& name, const System& system, const Effects& effects) {
  Scene scene;
  scene.box = system.box;
  scene.effects = effects;
  const Start start{system.disks, system.state};
  for (const auto& entry : detail::catalogue()) {
    if (entry.name != name) continue;
    if (!entry.covers(scene, start.disks)) throw std::invalid_argument(name + " does not cover this system");
    return entry.make(scene, start.disks, start.state);
  }
  throw std::invalid_argument("there is no engine " + name);
}

inline std::unique_ptr<AnyEngine> make_engine(const std::string& name, const System& system,
                                              CollisionRule rule = CollisionRule::specular) {
  Effects effects;
  effects.collision.rule = rule;
  return make_engine(name, system, effects);
}

/// The same for a scene with all that acts in it.
inline std::unique_ptr<AnyEngine> make_engine(const std::string& name, const Scene& scene) {
  Start start = draw_start(scene);
  return detail::make_engine(detail::choose_engine(scene, start.disks, name), scene, start.disks, std::move(start.state));
}

/// The next `count` collisions, or all up to `until`. Goes in stretches of `stretch` events of any kind, after each of which
/// look(engine) is called.
template <class Look>
std::vector<Event> next_events(AnyEngine& engine, std::size_t count, const Instant& until, std::uint64_t stretch, Look&& look) {
  std::vector<Event> log;
  engine.record_events(true);
  for (bool arrived = false; !arrived && log.size() < count && !engine.idle();) {
    arrived = engine.run_until(until, no_limit, stretch);
    const std::vector<Event> more = engine.take_events();
    log.insert(log.end(), more.begin(), more.end());
    look(engine);
  }
  engine.record_events(false);
  log.resize(std::min(count, log.size()));
  return log;
}

inline std::vector<Event> next_events(AnyEngine& engine, std::size_t count, const Instant& until = forever,
                                      std::uint64_t stretch = 1000) {
  return next_events(engine, count, until, stretch, [](AnyEngine&) {});
}

}  // namespace carom::test
