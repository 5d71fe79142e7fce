#pragma once
// The trajectory that the others are held against: 113 bits, at the samples of the plan.

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace carom {

class Reference {
 public:
  /// Samples at k * step, k = 1 to `samples`. `proceed` is asked at each, and some twenty times a second
  /// between them; false ends it, and complete() is then false.
  Reference(const Scene& scene, const State& start, double step, std::uint64_t samples, const std::function<bool()>& proceed);

  [[nodiscard]] bool complete() const { return complete_; }

  /// Returns the energy in sample k.
  [[nodiscard]] double energy(std::uint64_t k) const { return energies_[k - 1]; }

  /// Root of the mean square distance of the disks from where they are in sample k, to the nearest image.
  [[nodiscard]] double rms_distance(std::uint64_t k, const State& state) const;

 private:
  Box box_;
  std::vector<State> samples_;  ///< positions and remainders alone
  std::vector<double> energies_;
  bool complete_ = false;
};

}  // namespace carom
