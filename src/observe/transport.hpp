#pragma once
// Transport coefficients from the fluctuations of a flux that flies along with the disks and jumps over from disk to disk at
// collisions. Its integral over time, Helfand's moment G, is known exactly: it grows evenly between collisions and jumps at each
// by r_ij times what disk i got. From G on a grid come
//   Green-Kubo:        the running integral of <J(0) J(t)>, J the mean flux over a step, the increase of G over its time;
//   Einstein-Helfand:  <(G(t) - G(0))^2> / 2 t.
// Both are averages over time, of two components that isotropy makes equal.
//
// Velocities are relative to the common motion.

#include "observe/blocking.hpp"
#include "observe/followers.hpp"
#include "observe/multiple_tau.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <array>
#include <cstdint>
#include <string>

namespace carom {

/// A coefficient, its flux, and what leads from the integral of <J J> to it.
struct TransportCoefficient {
  std::string name, unit, unit_of_flux;
  Eigen::Vector2d (*flow)(double mass, const Eigen::Vector2d& velocity);  ///< the flux that one disk carries
  FluxSum* FluxSums::*sum;                                                ///< the sum of what collisions transfer
  double part;                                                            ///< fraction of this sum that the flux is
  double (*factor)(double kT, double area);
};

class Transport final : public SavedObservable<Transport>, public FluxFollower {
 public:
  Transport(const ObservableRequest& request, const ObservedRun& run, TransportCoefficient coefficient);

  [[nodiscard]] double step() const override { return 0.0; }  ///< no samples: it takes its own steps, by the clock
  [[nodiscard]] bool follows_collisions() const override { return true; }
  void start(const State& state) override;
  void ask(FluxSums& sums) override { sums.*coefficient_.sum = &sum_; }
  [[nodiscard]] double until() const override { return next_; }
  void reach(double time) override { tick(time); }
  [[nodiscard]] Measurement finish(double time, const Totals& totals) override;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(kT_, next_, ticks_, sum_.change, sum_.moment, sum_.since, flow_, moment_, noted_, products_, moments_, mean_flux_);
  }

 private:
  void tick(double time);

  TransportCoefficient coefficient_;
  double kT_ = 0.0;
  double next_ = step_;
  std::uint64_t ticks_ = 0;
  FluxSum sum_;                                     ///< since the last tick
  std::array<Blocking, 2> mean_flux_;               ///< over each step
  Eigen::Vector2d flow_ = Eigen::Vector2d::Zero();  ///< the part of the flux that flies
  Eigen::Vector2d moment_ = Eigen::Vector2d::Zero(), noted_ = Eigen::Vector2d::Zero();
  MultipleTau products_{2, MultipleTau::Pairs::products}, moments_{2, MultipleTau::Pairs::squared_differences};
};

}  // namespace carom
