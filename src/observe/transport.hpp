#pragma once
// Transport coefficients from the fluctuations of a flux that flies along with the disks and jumps over from disk to disk at
// collisions. Its integral over time, Helfand's moment G, is known exactly: it grows evenly between collisions and jumps at each
// by r_ij times what disk i got. From G on a grid come
//   Green-Kubo:        the running integral of <J(0) J(t)>, J the mean flux over a step, G's growth over its time;
//   Einstein-Helfand:  <(G(t) - G(0))^2> / 2 t.
// Both are averages over time, of two components that isotropy makes equal.
//
// `Flux` says what flies and what jumps:
//   static Eigen::Vector2d flow(double mass, const Eigen::Vector2d& velocity);   of one disk
//   static Eigen::Vector2d change(const PairCollision& met);                      of that by a collision, both disks
//   static Eigen::Vector2d jump(const PairCollision& met);
// Velocities are relative to the common motion, which must be zero in collisions.

#include "observe/mechanics.hpp"
#include "observe/multiple_tau.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace carom {

/// Half the time that sound takes through the box (Henderson's equation of state): beyond, a fluctuation meets its own image.
[[nodiscard]] double sound_time(const ObservedRun& run);

/// The numbers and the table of a coefficient. `factor` times the integral of <J J> is the coefficient.
[[nodiscard]] Measurement transport_measurement(const std::string& name, const std::string& unit, const std::string& unit_of_flux,
                                                double step, double factor, double longest, const MultipleTau& products,
                                                const MultipleTau& moments);

template <class Flux>
class Transport final : public SavedObservable<Transport<Flux>> {
 public:
  struct Words {
    std::string name, unit, unit_of_flux;
  };
  /// `factor`: from the integral of <J J> to the coefficient, given kT and area.
  Transport(const ObservableRequest& request, const ObservedRun& run, Words words, double (*factor)(double kT, double area))
      : run_(run), words_(std::move(words)), factor_(factor), step_(run.step(request, 0.25)) {}

  [[nodiscard]] std::string name() const override { return words_.name; }
  [[nodiscard]] bool follows_collisions() const override { return true; }

  void start(const State& state) override {
    double mass = 0.0;
    for (const double m : run_.disks.mass) mass += m;
    common_ = total_momentum(run_.disks, state) / mass;
    // What rounding leaves of a total momentum of zero is none.
    const double thermal = std::sqrt(run_.temperature * static_cast<double>(run_.disks.count()) / mass);
    if (common_.norm() <= 1e-12 * thermal) common_.setZero();
    kT_ = kinetic_temperature(run_.scene.box, run_.disks, state);
    for (std::size_t i = 0; i < run_.disks.count(); ++i)
      flow_ += Flux::flow(run_.disks.mass[i], state.velocities.col(static_cast<Eigen::Index>(i)) - common_);
    moments_.add(std::array{0.0, 0.0});
  }

  void collisions(std::span<const PairCollision> collisions) override {
    const bool drifts = !common_.isZero(0.0);
    while (!collisions.empty()) {
      if (collisions.front().time > next_) tick(collisions.front().time);
      drifts ? take<true>(collisions) : take<false>(collisions);
    }
  }

  [[nodiscard]] Measurement finish(double time, const Totals&) override {
    if (time >= next_) tick(time);
    return transport_measurement(words_.name, words_.unit, words_.unit_of_flux, step_, factor_(kT_, run_.scene.box.area()),
                                 sound_time(run_), products_, moments_);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(kT_, time_, next_, ticks_, common_, flow_, moment_, noted_, products_, moments_);
  }

 private:
  /// Those up to the next tick; they are taken from the list. The integral of a flow that changes by c at time t grows by c (end
  /// - t): sums without a product between one collision and the next.
  template <bool drifts>
  void take(std::span<const PairCollision>& collisions) {
    Eigen::Vector2d flow = flow_, moment = moment_;
    std::size_t taken = 0;
    for (; taken < collisions.size() && !(collisions[taken].time > next_); ++taken) {
      const auto& met = seen<drifts>(collisions[taken]);
      const Eigen::Vector2d change = Flux::change(met);
      flow += change;
      moment += Flux::jump(met) - (met.time - time_) * change;
    }
    flow_ = flow;
    moment_ = moment;
    collisions = collisions.subspan(taken);
  }
  /// By one who moves with all disks together.
  template <bool drifts>
  [[nodiscard]] decltype(auto) seen(const PairCollision& collision) const {
    if constexpr (drifts) {
      PairCollision met = collision;
      for (Eigen::Vector2d* v : {&met.velocity, &met.velocity_before, &met.partner_velocity, &met.partner_velocity_before})
        *v -= common_;
      return met;
    } else {
      return (collision);
    }
  }

  /// Notes the moment at every grid time up to `time`.
  void tick(double time) {
    while (next_ <= time) {
      moment_ += (next_ - time_) * flow_;
      time_ = next_;
      const Eigen::Vector2d mean = (moment_ - noted_) / step_;
      products_.add(std::array{mean.x(), mean.y()});
      moments_.add(std::array{moment_.x(), moment_.y()});
      noted_ = moment_;
      next_ = static_cast<double>(++ticks_ + 1) * step_;
    }
  }

  ObservedRun run_;
  Words words_;
  double (*factor_)(double kT, double area);
  double step_;
  double kT_ = 0.0;
  double time_ = 0.0;  ///< of the last tick, from which moment_ counts the time of changes
  double next_ = step_;
  std::uint64_t ticks_ = 0;
  Eigen::Vector2d common_ = Eigen::Vector2d::Zero();  ///< velocity of all together
  Eigen::Vector2d flow_ = Eigen::Vector2d::Zero();    ///< the part of the flux that flies
  Eigen::Vector2d moment_ = Eigen::Vector2d::Zero(), noted_ = Eigen::Vector2d::Zero();
  MultipleTau products_{2, MultipleTau::Pairs::products}, moments_{2, MultipleTau::Pairs::squared_differences};
};

}  // namespace carom
