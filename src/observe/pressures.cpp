// Pressure in four ways: Z from the momentum that collisions transfer, from how often disks collide, from the push on the walls;
// and the whole tensor. All are averages over time.
//
//   Z         = 1 + W / (2 t N kT), W the sum over collisions of sigma times the normal impulse
//   Z_rate    = 1 + pi (sum over collisions of sigma sqrt(mu)) / (N t sqrt(2 pi kT) c): disks of one kinetic energy meet as
//               often as those of a Maxwell gas times c = sqrt(d / 2) Gamma(d / 2) / Gamma((d + 1) / 2), d the degrees of
//               freedom; not in a circular box, where they may keep an angular momentum
//   Z_walls   : the virial theorem gives F_x (L_x - 2 r) + F_y (L_y - 2 r) = 2 N kT Z for the mean forces F on opposite walls,
//               when the run is long
//   P_ab A    = <sum m v_a v_b> N / (N - 1) + (sum over collisions of r_a J_b) / t, without N / (N - 1) where momentum is not
//               kept

#include "core/all_equal.hpp"
#include "observe/blocking.hpp"
#include "observe/equilibrium.hpp"
#include "observe/followers.hpp"
#include "observe/geometry.hpp"
#include "observe/observables.hpp"
#include "observe/pressure.hpp"
#include "observe/saved_observable.hpp"
#include "observe/wall_momentum.hpp"
#include "scene/contact_scales.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

using carom::serialize;

constexpr const char* no_log = "the run kept no collisions (--events)";

class Pressure final : public SavedObservable<Pressure>, public FluxFollower {
 public:
  Pressure(const ObservableRequest& request, const ObservedRun& run) : SavedObservable(request, run) {
    const Effects& effects = run.scene.effects;
    follows_ = run.collisions_known && !is_driven(effects) && run.disks.count() > 0;
    equal_ = all_equal(run.disks.radius) && all_equal(run.disks.mass) &&
             contact_scales<double>(run.scene.effects, run.disks).additive();
    equal_radii_ = all_equal(run.disks.radius);
    freedom_ = run.degrees_of_freedom();
    why_no_Z_ = carom::why_no_Z(run.scene);
    has_Z_walls_ = why_no_walls().empty();
  }

  [[nodiscard]] bool needs_positions() const override { return run_.has_flow() || has_Z_walls_; }
  [[nodiscard]] bool follows_collisions() const override { return follows_; }

  void ask(FluxSums& sums) override { sums.transfer = &transfer_; }

  void sample(const State& state, const Totals& totals) override {
    const Snapshot now = look(state, totals);
    if (samples_++ > 0) add_step(now, totals);
    before_ = now;
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    put_Z(found, "Z", virial_, 1.0, std::string(why_no_Z_));
    if (Scalar& Z = found.scalars.front(); Z.value && is_crystal(run_.scene))
      Z.note = "in a crystal most of the virial oscillates: the error is up to 1.4 times too large";
    Scalar reduced{.name = "reduced"};
    if (const Scalar& Z = found.scalars.front(); Z.value) {
      const double factor = 4.0 * run_.scene.packing_fraction() / std::numbers::pi;
      reduced.value = factor * *Z.value;
      if (Z.error) reduced.error = factor * *Z.error;
      reduced.integrated_correlation_time = Z.integrated_correlation_time;
    }
    reduced.note = found.scalars.front().note;
    found.scalars.push_back(reduced);
    put_Z(found, "Z_rate", rate_, 1.0, why_no_rate());
    put_Z(found, "Z_walls", walls_, 0.0, why_no_walls());
    static constexpr std::array<const char*, 4> names = {"P_xx", "P_xy", "P_yx", "P_yy"};
    for (std::size_t c = 0; c < 4; ++c) {
      Scalar scalar{.name = names[c], .unit = "energy / area"};
      if (follows_) tensor_[c].fill(scalar, step_);
      if (!follows_)
        scalar.note = run_.collisions_known ? "velocities change between collisions, so single impulses are not known" : no_log;
      found.scalars.push_back(std::move(scalar));
    }
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(transfer_.virial, transfer_.meetings, samples_, before_, virial_, rate_, walls_, tensor_);
  }

 private:
  struct Snapshot {
    double time = 0.0, kT = 0.0, virial = 0.0, meetings = 0.0, area = 0.0, action = 0.0;
    std::uint64_t pairs = 0;
    std::array<double, 4> flow{}, transfer{}, walls{};
    double circle = 0.0;
  };

  [[nodiscard]] Snapshot look(const State& state, const Totals& totals) const {
    Snapshot now{.time = state.time,
                 .virial = totals.virial,
                 .meetings = transfer_.meetings,
                 .pairs = totals.pair,
                 .walls = totals.wall_impulse,
                 .circle = totals.circle_impulse};
    for (std::size_t c = 0; c < 4; ++c) now.transfer[c] = transfer_.virial[c].sum();
    now.area = box_of(run_.scene.box, state).area();
    const bool in_flow = run_.has_flow();
    const Eigen::Matrix2Xd v = in_flow ? peculiar_velocities(run_, state) : Eigen::Matrix2Xd();
    const Eigen::Vector2d common = in_flow ? Eigen::Vector2d(0.0, 0.0) : non_thermal_velocity(run_, state);
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      const Eigen::Vector2d u = (in_flow ? v : state.velocities).col(static_cast<Eigen::Index>(i)) - common;
      now.flow[0] += run_.disks.mass[i] * u.x() * u.x();
      now.flow[1] += run_.disks.mass[i] * u.x() * u.y();
      now.flow[3] += run_.disks.mass[i] * u.y() * u.y();
    }
    now.flow[2] = now.flow[1];
    for (int axis = 0; axis < 2 && has_Z_walls_; ++axis) now.action += wall_momentum(run_, state, axis).action;
    now.kT = freedom_ > 0.0 ? (now.flow[0] + now.flow[3]) / freedom_ : 0.0;
    // N disks of which N - 1 move freely carry the momentum of N kT all the same: the trace is that of Z.
    const double count = static_cast<double>(run_.disks.count());
    const auto share = [&](int axis) {
      return !run_.centre_of_mass_is_thermal(axis) && count > 1.0 ? std::sqrt(count / (count - 1.0)) : 1.0;
    };
    for (std::size_t c = 0; c < 4; ++c) now.flow[c] *= share(c < 2 ? 0 : 1) * share(c % 2 == 0 ? 0 : 1);
    return now;
  }

  void add_step(const Snapshot& now, const Totals&) {
    const double dt = now.time - before_.time, count = static_cast<double>(run_.disks.count());
    const double kT = 0.5 * (now.kT + before_.kT), thermal = 0.5 * (std::sqrt(now.kT) + std::sqrt(before_.kT));
    virial_.add(now.virial - before_.virial, 2.0 * count * kT * dt);
    const double met =
        equal_ ? static_cast<double>(now.pairs - before_.pairs) * 2.0 * run_.disks.radius[0] * std::sqrt(0.5 * run_.disks.mass[0])
               : now.meetings - before_.meetings;
    rate_.add(std::numbers::pi * met, count * dt * std::sqrt(2.0 * std::numbers::pi) * thermal * mean_speed_factor(freedom_));
    double push = (now.circle - before_.circle) * (0.5 * run_.scene.box.lengths().x() - run_.disks.radius[0]);
    for (int axis = 0; axis < 2; ++axis) {
      const std::size_t low = 2 * static_cast<std::size_t>(axis);
      push += 0.5 * (now.walls[low] - before_.walls[low] + now.walls[low + 1] - before_.walls[low + 1]) *
              (run_.scene.box.lengths()[axis] - 2.0 * run_.disks.radius[0]);
    }
    walls_.add(push, 2.0 * count * kT * dt, before_.action, now.action);
    const double area = 0.5 * (now.area + before_.area);
    for (std::size_t c = 0; c < 4; ++c)
      tensor_[c].add((0.5 * (now.flow[c] + before_.flow[c]) + (now.transfer[c] - before_.transfer[c]) / dt) / area);
  }

  void fill(const Blocking& series, Scalar& scalar, double offset) const { series.fill(scalar, step_, 1.0, offset); }
  void fill(const RateWithBoundedPart& series, Scalar& scalar, double offset) const { series.fill(scalar, step_, offset); }
  template <class Series>
  void put_Z(Measurement& found, const char* name, const Series& series, double offset, const std::string& why_not) const {
    Scalar scalar{.name = name};
    if (why_not.empty()) fill(series, scalar, offset);
    // Z - 1 is a sum over collisions; of none it is exactly zero, and its error is unknown.
    if (offset == 1.0 && scalar.value == offset) scalar = {.name = name, .note = "no pair of disks has collided"};
    if (!scalar.value && scalar.note.empty()) scalar.note = why_not.empty() ? "nothing was measured" : why_not;
    found.scalars.push_back(std::move(scalar));
  }

  [[nodiscard]] std::string why_no_rate() const {
    const Effects& effects = run_.scene.effects;
    if (!why_no_Z_.empty()) return std::string(why_no_Z_);
    if (effects.collision.rule == CollisionRule::reversal) return "under reversal velocities need not be Maxwell's";
    if (keeps_turning(run_.scene)) return "in a circular box disks keep an angular momentum, and meet at another rate";
    if (!effects.potential_steps().empty())
      return effects.stepped_potential ? "steps of the potential transfer momentum too"
                                       : "wells transfer momentum at their edges too";
    if (!equal_ && !follows_)
      return run_.collisions_known ? "in a mixture collisions must be followed, and velocities change between them" : no_log;
    return {};
  }
  [[nodiscard]] std::string why_no_walls() const {
    const Box& box = run_.scene.box;
    if (box.periodic(0) && box.periodic(1)) return "the box has no walls";
    if (box.periodic(0)) return "walls along one axis feel P_yy alone, and Z is of both";
    if (box.periodic(1)) return "walls along one axis feel P_xx alone, and Z is of both";
    if (!why_no_Z_.empty()) return std::string(why_no_Z_);
    if (!equal_radii_) return "disks of several sizes come to the walls at several distances";
    return {};
  }

  bool follows_, equal_, equal_radii_;
  double freedom_;
  std::string_view why_no_Z_;
  TransferSum transfer_;
  std::uint64_t samples_ = 0;
  Snapshot before_;
  bool has_Z_walls_ = false;
  Blocking virial_, rate_;
  RateWithBoundedPart walls_;
  std::array<Blocking, 4> tensor_;
};

}  // namespace

MadeObservable make_pressure(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Pressure>(request, run);
}

}  // namespace carom
