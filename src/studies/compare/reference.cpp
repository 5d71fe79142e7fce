#include "studies/compare/reference.hpp"

#include "observe/energy.hpp"
#include "studies/state_distance.hpp"

#include <carom/simulation.hpp>

#include <utility>

namespace carom {

Reference::Reference(const Scene& scene, const State& start, double step, std::uint64_t samples,
                     const std::function<bool()>& proceed)
    : box_(scene.box) {
  Simulation exact = make_simulation(scene, start, "textbook-quad");
  for (std::uint64_t k = 1; k <= samples; ++k) {
    if (!proceed() || exact.run_until_sample(k, step, {.proceed = proceed}) == StopReason::interrupted) return;
    State state = exact.state();
    energies_.push_back(total_energy(scene.box, scene.effects, exact.disks(), state));
    state.velocities.resize(2, 0);  // not asked for, and half of the memory
    state.images.resize(2, 0);
    samples_.push_back(std::move(state));
  }
  complete_ = true;
}

double Reference::rms_distance(std::uint64_t k, const State& state) const {
  return carom::rms_distance(box_, state, samples_[k - 1]);
}

}  // namespace carom
