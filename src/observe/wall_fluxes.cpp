// Momentum and energy that go through each wall, per time and length of wall, outward positive: pressure, shear stress on thermal
// walls, and heat and work. The rim of a circular box is one wall, smooth and elastic: it has the pressure alone.
// Averages over time.
//
// Where one wall alone exchanges energy, or momentum along it, what it has taken is what the disks have lost: it does not grow
// with time, and its error is that of two states.

#include "observe/energy.hpp"
#include "observe/mechanics.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/wall_momentum.hpp"
#include "scene/effect_traits.hpp"
#include "scene/walls.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace carom {

namespace {

class WallFluxes final : public SavedObservable<WallFluxes> {
 public:
  WallFluxes(const ObservableRequest& request, const ObservedRun& run) : SavedObservable(request, run) {
    if (!run.scene.changes.empty()) return;
    for (std::size_t side = 0; side < 4; ++side) {
      const Effects& with = run.scene.effects;
      Effects without = with;
      without.walls[side] = {};
      const int along = 1 - axis_of_wall(side);
      is_alone_with_energy_[side] = !detail::conserve_energy(with) && detail::conserve_energy(without);
      is_alone_with_momentum_[side] =
          !conserves_momentum(run.scene.box, with, along) && conserves_momentum(run.scene.box, without, along);
    }
  }

  void sample(const State& state, const Totals& totals) override {
    const Eigen::Vector2d lengths = box_of(run_.scene.box, state).lengths();
    const double dt = state.time - time_;
    const BoundedParts bounded = bounded_parts(state);
    for (std::size_t side = 0; side < 4 && dt > 0.0; ++side) {
      const int along = 1 - axis_of_wall(side);
      const double weight = 0.5 * (lengths[along] + lengths_[along]) * dt;
      momentum_[side].add(totals.wall_impulse[side] - impulse_[side], weight, bounded_.momentum[side], bounded.momentum[side]);
      shear_[side].add(totals.wall_shear[side] - shears_[side], weight, bounded_.shear[side], bounded.shear[side]);
      energy_[side].add(totals.wall_energy[side] - energies_[side], weight, bounded_.energy[side], bounded.energy[side]);
    }
    time_ = state.time;
    lengths_ = lengths;
    bounded_ = bounded;
    impulse_ = totals.wall_impulse;
    shears_ = totals.wall_shear;
    energies_ = totals.wall_energy;
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    for (std::size_t side = 0; side < 4; ++side) {
      if (run_.scene.box.periodic(axis_of_wall(side))) continue;
      put(found, {.name = std::string("momentum_") + wall_names[side], .unit = "energy / area"}, momentum_[side]);
      if (run_.scene.effects.walls[side].temperature)
        put(found, {.name = std::string("shear_") + wall_names[side], .unit = "energy / area"}, shear_[side]);
      put(found, {.name = std::string("energy_") + wall_names[side], .unit = "energy / (length time)"}, energy_[side]);
    }
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time_, lengths_, impulse_, shears_, energies_, bounded_.momentum, bounded_.shear, bounded_.energy);
    archive(momentum_, shear_, energy_);
  }

 private:
  /// The bounded parts of what each wall receives; 0 where none is known.
  struct BoundedParts {
    std::array<double, 4> momentum{}, shear{}, energy{};
  };
  [[nodiscard]] BoundedParts bounded_parts(const State& state) const {
    BoundedParts parts;
    for (int axis = 0; axis < 2; ++axis) {
      const double reach = reach_between_walls(run_, axis);
      if (run_.scene.box.periodic(axis) || reach == 0.0) continue;
      const WallMomentum of_disks = wall_momentum(run_, state, axis);
      const auto low = 2 * static_cast<std::size_t>(axis);
      parts.momentum[low] = 0.5 * (of_disks.action / reach - of_disks.momentum);
      parts.momentum[low + 1] = 0.5 * (of_disks.action / reach + of_disks.momentum);
    }
    for (std::size_t side = 0; side < 4; ++side) {
      if (is_alone_with_momentum_[side]) parts.shear[side] = total_momentum(run_.disks, state)[1 - axis_of_wall(side)];
      if (is_alone_with_energy_[side]) parts.energy[side] = total_energy(run_.scene.box, run_.scene.effects, run_.disks, state);
    }
    return parts;
  }

  double time_ = 0.0;
  Eigen::Vector2d lengths_ = Eigen::Vector2d::Zero();
  std::array<double, 4> impulse_{}, shears_{}, energies_{};
  BoundedParts bounded_;
  std::array<bool, 4> is_alone_with_energy_{}, is_alone_with_momentum_{};
  std::array<RateWithBoundedPart, 4> momentum_, shear_, energy_;
};

/// The momentum through the rim of a circular box. Its bounded part is that of wall_momentum.hpp on a circle: the action G = sum
/// of m (r - centre) . v changes by dG = S dt - h I for disks whose centres come as far as h, so I = S dt / h - d(G / h).
class RimFluxes final : public SavedObservable<RimFluxes> {
 public:
  RimFluxes(const ObservableRequest& request, const ObservedRun& run) : SavedObservable(request, run) {}

  void sample(const State& state, const Totals& totals) override {
    const double radius = 0.5 * run_.scene.box.lengths().x(), reach = std::max(0.0, radius - 0.5 * run_.mean_diameter);
    double bounded = 0.0;
    for (int axis = 0; axis < 2 && reach > 0.0; ++axis) bounded += wall_momentum(run_, state, axis).action / reach;
    const double dt = state.time - time_, perimeter = 2.0 * std::numbers::pi * radius;
    if (dt > 0.0) momentum_.add(totals.circle_impulse - impulse_, perimeter * dt, bounded_, bounded);
    time_ = state.time;
    bounded_ = bounded;
    impulse_ = totals.circle_impulse;
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    put(found, {.name = "momentum_rim", .unit = "energy / area"}, momentum_);
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time_, impulse_, bounded_, momentum_);
  }

 private:
  double time_ = 0.0, impulse_ = 0.0, bounded_ = 0.0;
  RateWithBoundedPart momentum_;
};

}  // namespace

MadeObservable make_wall_fluxes(const ObservableRequest& request, const ObservedRun& run) {
  if (run.scene.box.is_circle) return std::make_unique<RimFluxes>(request, run);
  return std::make_unique<WallFluxes>(request, run);
}

}  // namespace carom
