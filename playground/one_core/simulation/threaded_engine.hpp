#pragma once
// In the place of src/simulation/threaded_engine.hpp: a page computes in one thread, so its engines are never shared out.

#include "engine/engine.hpp"
#include "simulation/any_engine.hpp"

namespace carom::detail {

template <class Impact, class Layout, class World>
using ThreadedEngine = EngineAdapter<Engine<Impact, Layout, World>>;

}  // namespace carom::detail
