// A simulation written down and brought back.

#include <carom/simulation.hpp>

#include "core/state_archive.hpp"
#include "simulation/parts.hpp"
#include "simulation/start.hpp"

#include <istream>
#include <ostream>
#include <utility>

namespace carom {

void Simulation::save(std::ostream& out) const {
  SavingArchive archive(out);
  archive(parts_->engine_name, parts_->engine_reason, parts_->time_step, state());
  parts_->engine->save(archive);
}

/// An engine is made for the state that was saved, and then told what the state does not show.
Simulation restore_simulation(const Scene& scene, std::istream& in) {
  LoadingArchive archive(in);
  std::string name, reason;
  std::optional<double> time_step;
  Start start{all_disks(scene), {}};
  archive(name, reason, time_step, start.state);
  Simulation simulation = time_step ? Simulation::begin(scene, std::move(start), FixedStep{name, *time_step})
                                    : Simulation::begin(scene, std::move(start), name);
  simulation.parts_->engine_reason = std::move(reason);
  simulation.parts_->engine->load(archive);
  return simulation;
}

}  // namespace carom
