#pragma once
// What a Simulation is made of; seen by the code of this room alone.

#include <carom/simulation.hpp>

#include "simulation/any_engine.hpp"

#include <memory>
#include <optional>
#include <string>

namespace carom {

struct Simulation::Parts {
  Scene scene;
  Disks disks;
  std::string engine_name;
  std::unique_ptr<detail::AnyEngine> engine;
  std::optional<double> time_step = {};  ///< of a fixed-step method
};

}  // namespace carom
