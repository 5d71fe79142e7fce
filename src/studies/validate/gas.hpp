#pragma once
// The systems that trials run, and how they are run. Disks have diameter 1 and mass 1; kT is 1 where the scene says so.

#include "studies/validate/trial.hpp"

#include <carom/observe.hpp>
#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <memory>
#include <string>
#include <vector>

namespace carom::validation {

/// A square that disks of diameter 1 fill to a packing fraction.
[[nodiscard]] Box square_box(std::int64_t disks, double packing_fraction, Boundary boundary = Boundary::periodic);

/// So many collisions of all disks together, after so many per disk.
[[nodiscard]] Run run_of(double collisions, double equilibrate, std::uint64_t seed);

/// A gas of one species in a square box.
struct Gas {
  std::int64_t disks = 0;
  double packing_fraction = 0.0;
  double collisions = 0.0;  ///< number of collisions of all disks together
  std::vector<ObservableRequest> observe = {};
  CollisionRule rule = CollisionRule::specular;
  Boundary boundary = Boundary::periodic;
  Positions positions = HexagonalLattice{};
  Velocities velocities = MaxwellVelocities{1.0};
  double equilibrate = 100.0;  ///< collisions per disk
};
[[nodiscard]] Scene scene_of(const Gas& gas, std::uint64_t seed);

/// The results of a run.
struct Found {
  Simulation simulation;
  std::vector<Measurement> measurements;

  [[nodiscard]] const Scalar& scalar(const std::string& observable, const std::string& name) const;
  /// Returns a number with its error. NaN where there is none; it agrees with nothing.
  [[nodiscard]] Measured measured(const std::string& observable, const std::string& name) const;
  [[nodiscard]] const std::vector<double>& column(const std::string& observable, const std::string& name) const;
};

/// Something in place of what a scene begins with.
using Change = std::function<void(State& start)>;

/// Runs a scene's schedule, which is added to `result`. Throws Interrupted.
[[nodiscard]] Found run(const Scene& scene, const Effort& effort, TrialResult& result,
                        std::vector<std::unique_ptr<Observable>> own = {}, const Change& change = {});

/// Returns a start without order for a dense system: disks of diameter 1 in a square periodic box, a liquid that has been
/// compressed slowly to packing fraction `eta`. Requires a density that a liquid can be compressed to, some 0.72. Throws
/// Interrupted.
[[nodiscard]] State compressed_liquid(std::int64_t disks, double eta, const Effort& effort, std::uint64_t seed);

/// Returns the mean of independent values, and its error from their scatter.
[[nodiscard]] Measured mean_of(const std::vector<double>& values);

}  // namespace carom::validation
