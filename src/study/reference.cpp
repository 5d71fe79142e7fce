#include "study/reference.hpp"

#include "study/horizon_difference.hpp"

#include <carom/simulation.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace carom {

Reference::Reference(const Scene& scene, const State& start, double step, std::uint64_t samples,
                     const std::function<bool()>& proceed)
    : box_(scene.box) {
  Simulation exact = make_simulation(scene, start, "textbook-quad");
  for (std::uint64_t k = 1; k <= samples; ++k) {
    if (!proceed()) return;
    exact.run_until_sample(k, step);
    State state = exact.state();
    state.velocities.resize(2, 0);  // not asked for, and half of the memory
    state.images.resize(2, 0);
    samples_.push_back(std::move(state));
  }
  complete_ = true;
}

double Reference::rms_distance(std::uint64_t k, const State& state) const {
  const State& exact = samples_[k - 1];
  Eigen::Matrix2Xd apart(2, state.positions.cols());
  for (Eigen::Index i = 0; i < apart.cols(); ++i) apart.col(i) = displacement(box_, state, exact, i);
  if (!apart.allFinite()) return std::numeric_limits<double>::infinity();
  return apart.cols() == 0 ? 0.0 : std::sqrt(apart.squaredNorm() / static_cast<double>(apart.cols()));
}

}  // namespace carom
