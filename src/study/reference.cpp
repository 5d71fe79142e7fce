#include "study/reference.hpp"

#include <carom/simulation.hpp>

#include <cmath>
#include <limits>

namespace carom {

Reference::Reference(const Scene& scene, const State& start, double step, std::uint64_t samples,
                     const std::function<bool()>& proceed)
    : box_(scene.box) {
  Simulation exact = make_simulation(scene, start, "textbook-quad");
  for (std::uint64_t k = 1; k <= samples; ++k) {
    if (!proceed()) return;
    exact.run_until_sample(k, step);
    State state = exact.state();
    samples_.push_back({std::move(state.positions), std::move(state.remainders)});
  }
  complete_ = true;
}

double Reference::rms_distance(std::uint64_t k, const State& state) const {
  const Sample& exact = samples_[k - 1];
  Eigen::Matrix2Xd apart = state.positions - exact.positions;
  for (int axis = 0; axis < 2; ++axis) {
    if (!box_.periodic(axis)) continue;
    const double length = box_.lengths()[axis];
    for (double& d : apart.row(axis)) d -= length * std::nearbyint(d / length);
  }
  if (exact.remainders.cols() > 0) apart -= exact.remainders;
  if (state.remainders.cols() > 0) apart += state.remainders;
  if (!apart.allFinite()) return std::numeric_limits<double>::infinity();
  return apart.cols() == 0 ? 0.0 : std::sqrt(apart.squaredNorm() / static_cast<double>(apart.cols()));
}

}  // namespace carom
