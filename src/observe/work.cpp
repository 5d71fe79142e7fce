// Work and heat that the disks have been given since the start, against time: work by each wall that moves, slides or vibrates,
// by a field, by shear and by growing; heat by each thermal wall and by baths, and what collisions and walls dissipate, as
// negative heat. The sum of all is the energy that disks have gained.
//
// A wall gives -E, E the energy that it has received in Totals. What of it is work follows from the momentum that the wall has
// received, outward J and along itself S: work = -(J u + S s) for a wall that moves outward at u and slides at s; the rest is
// heat. A piston does work alone. The numbers at the end are sums, not means, and have no errors: a run has one of them, and the
// seeds of a sweep give their distribution. ThinnedRows keeps them against time.

#include "observe/energy.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/thinned_rows.hpp"
#include "scene/walls.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace carom {

namespace {

class Work final : public SavedObservable<Work> {
 public:
  Work(const ObservableRequest& request, const ObservedRun& run) : SavedObservable(request, run) {
    const Effects& effects = run.scene.effects;
    for (std::size_t side = 0; side < 4; ++side) {
      if (run.scene.box.periodic(axis_of_wall(side))) continue;
      const WallProperties& wall = effects.walls[side];
      const std::string name = wall_names[side];
      if (may_move(wall) || wall.tangential_velocity || wall.vibration) list(work, "work_" + name, work_of_left + side);
      if (wall.temperature || wall.restitution) list(heat, "heat_" + name, heat_of_left + side);
    }
    if (falls()) list(work, "work_field", of_field);
    if (effects.growth) list(work, "work_growth", of_growth);
    if (effects.shear) list(work, "work_shear", of_shear);
    if (effects.thermostat || effects.brownian) list(heat, "heat_bath", of_bath);
    if (effects.collision.restitution || effects.collision.roughness) list(heat, "heat_collisions", of_collisions);
    rows_ = ThinnedRows(parts_.size() + 2);
  }

  [[nodiscard]] bool needs_positions() const override { return falls(); }

  void start(const State& state) override {
    if (falls()) potential_ = potential(state);
  }

  void sample(const State& state, const Totals& totals) override {
    if (falls()) sums_[of_field] = potential_ - potential(state);
    add(totals);
    for (std::size_t side = 0; side < 4; ++side) velocity_[side] = state.walls.size() == 4 ? state.walls[side].velocity : 0.0;
    if (!rows_.takes_next()) return;
    std::vector<double> row = {total(work), total(heat)};
    for (const Part& part : parts_) row.push_back(sums_[part.at]);
    rows_.add(state.time, row);
  }

  [[nodiscard]] Measurement finish(double, const Totals& totals) override {
    add(totals);
    Measurement found{.name = name()};
    const auto put_sum = [&](std::string of, double value) {
      found.scalars.push_back({.name = std::move(of), .unit = "energy", .value = value});
    };
    put_sum("work", total(work));
    put_sum("heat", total(heat));
    for (const Part& part : parts_) put_sum(part.name, sums_[part.at]);
    Table table{
        .name = name(),
        .columns = {{"time", "time", rows_.times()}, {"work", "energy", rows_.column(0)}, {"heat", "energy", rows_.column(1)}}};
    for (std::size_t k = 0; k < parts_.size(); ++k) table.columns.push_back({parts_[k].name, "energy", rows_.column(k + 2)});
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(potential_, sums_, velocity_, energies_, impulses_, shears_, rows_);
  }

 private:
  enum Kind : std::uint8_t { work, heat };
  /// Places in sums_.
  static constexpr std::size_t work_of_left = 0, heat_of_left = 4, of_field = 8, of_growth = 9, of_shear = 10, of_bath = 11,
                               of_collisions = 12, places = 13;
  struct Part {
    Kind kind;
    std::string name;
    std::size_t at;
  };

  void list(Kind kind, std::string name, std::size_t at) { parts_.push_back({kind, std::move(name), at}); }

  [[nodiscard]] bool falls() const { return run_.scene.effects.gravity.has_value(); }
  [[nodiscard]] double total(Kind kind) const {
    double sum = 0.0;
    for (const Part& part : parts_)
      if (part.kind == kind) sum += sums_[part.at];
    return sum;
  }

  [[nodiscard]] double potential(const State& state) const {
    return gravitational_energy(run_.scene.box, run_.scene.effects, run_.disks, state);
  }

  /// Adds what has happened since the totals of before, at the velocities that walls had then.
  void add(const Totals& totals) {
    for (std::size_t side = 0; side < 4; ++side) {
      const WallProperties& wall = run_.scene.effects.walls[side];
      const double given = energies_[side] - totals.wall_energy[side];
      double by_motion = given;
      if (wall.temperature || wall.restitution) {
        const double outward = wall.vibration ? -*wall.vibration : (side % 2 == 1 ? velocity_[side] : -velocity_[side]);
        by_motion = -(totals.wall_impulse[side] - impulses_[side]) * outward -
                    (totals.wall_shear[side] - shears_[side]) * wall.tangential_velocity.value_or(0.0);
      }
      sums_[work_of_left + side] += by_motion;
      sums_[heat_of_left + side] += given - by_motion;
    }
    sums_[of_growth] = totals.growth_energy;
    sums_[of_shear] = totals.shear_energy;
    sums_[of_bath] = totals.thermostat_energy;
    sums_[of_collisions] = -totals.dissipated;
    energies_ = totals.wall_energy;
    impulses_ = totals.wall_impulse;
    shears_ = totals.wall_shear;
  }

  std::vector<Part> parts_;
  double potential_ = 0.0;  ///< at the start
  std::array<double, places> sums_{};
  std::array<double, 4> velocity_{};                          ///< of walls at the last sample
  std::array<double, 4> energies_{}, impulses_{}, shears_{};  ///< at the last sample
  ThinnedRows rows_{0};                                       ///< work, heat, and each part
};

}  // namespace

MadeObservable make_work(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Work>(request, run);
}

}  // namespace carom
