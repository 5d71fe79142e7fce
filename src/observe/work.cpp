// Work and heat that the disks have been given since the start, against time: work by each wall that moves, slides or vibrates,
// by a field, by shear, by growing and by the changes of the scene; heat by each thermal wall and by baths, and what drag,
// collisions and walls dissipate, as negative heat. The sum of all is the energy that disks have gained: of motion, of spin and
// of pairs in wells or steps.
//
// A wall gives what it has received in Totals, with the other sign: wall_work as work, and the rest of wall_energy as heat. A
// wall without temperature or restitution does work alone. What disks get at one that neither moves, slides nor vibrates is work
// of their own surfaces as they grow, as it is at obstacles and other disks. No engine sums what drag takes, and what growing
// rough disks gain with their moments of inertia: it is the energy gained that no other part explains. The numbers at the end are
// sums, not means, and have no errors: a run has one of them, and the seeds of a sweep give their distribution. ThinnedRows keeps
// them against time.

#include "observe/energy.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/thinned_rows.hpp"
#include "scene/walls.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom {

namespace {

class Work final : public SavedObservable<Work>, public ChangeFollower {
 public:
  Work(const ObservableRequest& request, const ObservedRun& run) : SavedObservable(request, run), acting_(*run.acting) {
    const Effects& effects = run.scene.effects;
    for (std::size_t side = 0; side < 4; ++side) {
      if (run.scene.box.periodic(axis_of_wall(side))) continue;
      const WallProperties& wall = effects.walls[side];
      const std::string name = wall_names[side];
      does_work_[side] = may_move(wall) || wall.tangential_velocity || wall.vibration;
      if (does_work_[side]) list(work, "work_" + name, work_of_left + side);
      if (wall.temperature || wall.restitution) list(heat, "heat_" + name, heat_of_left + side);
    }
    if (falls()) list(work, "work_field", of_field);
    if (effects.growth) list(work, "work_growth", of_growth);
    if (effects.shear) list(work, "work_shear", of_shear);
    if (!run.scene.changes.empty()) list(work, "work_changes", of_changes);
    if (effects.thermostat || effects.brownian) list(heat, "heat_bath", of_bath);
    if (effects.collision.restitution || effects.collision.roughness) list(heat, "heat_collisions", of_collisions);
    if (effects.drag) list(heat, "heat_drag", of_drag);
    if (effects.drag)
      rest_ = of_drag;
    else if (effects.growth && effects.collision.roughness)
      rest_ = of_growth;
    rows_ = ThinnedRows(parts_.size() + 2);
  }

  [[nodiscard]] bool needs_positions() const override { return falls() || rest_; }

  void start(const State& state) override {
    potential_ = potential(state);
    energy_ = energy(state);
  }

  void sample(const State& state, const Totals& totals) override {
    add(state, totals);
    if (!rows_.takes_next()) return;
    std::vector<double> row = {total(work), total(heat)};
    for (const Part& part : parts_) row.push_back(sums_[part.at]);
    rows_.add(state.time, row);
  }

  /// The energy of a change is work done by it. That of heights in a field is none of the disks' own: a field that begins does
  /// work from then on.
  void change(bool made, const Effects& effects, const State& state, const Totals& totals) override {
    if (!made) {
      add(state, totals);
      field_before_ = sums_[of_field];
      energy_before_ = energy(state);
      return;
    }
    acting_ = effects;
    sums_[of_changes] += energy(state) - energy_before_;
    potential_ = potential(state);
  }

  void end(const State& state, const Totals& totals) override { add(state, totals); }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    const auto put_sum = [&](std::string of, double value) {
      found.scalars.push_back({.name = std::move(of), .unit = "energy", .average = Average::sum, .value = value});
    };
    put_sum("work", total(work));
    put_sum("heat", total(heat));
    for (const Part& part : parts_) put_sum(part.name, sums_[part.at]);
    Table table{
        .name = name(),
        .average = Average::sum,
        .columns = {{"time", "time", rows_.times()}, {"work", "energy", rows_.column(0)}, {"heat", "energy", rows_.column(1)}}};
    for (std::size_t k = 0; k < parts_.size(); ++k) table.columns.push_back({parts_[k].name, "energy", rows_.column(k + 2)});
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(potential_, field_before_, energy_, sums_, energies_, works_, rows_);
  }

 private:
  enum Kind : std::uint8_t { work, heat };
  /// Places in sums_.
  static constexpr std::size_t work_of_left = 0, heat_of_left = 4, of_field = 8, of_growth = 9, of_shear = 10, of_bath = 11,
                               of_collisions = 12, of_changes = 13, of_drag = 14, places = 15;
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

  /// Returns the energy of heights in the field that acts now; 0 without one.
  [[nodiscard]] double potential(const State& state) const {
    return acting_.gravity ? gravitational_energy(run_.scene.box, acting_, run_.disks, state) : 0.0;
  }
  /// Returns the energy of the disks themselves. Requires a state with positions, or smooth disks without wells.
  [[nodiscard]] double energy(const State& state) const {
    const Energies all = energies_of(run_.scene.box, without_field(), run_.disks, state);
    return all.kinetic + all.spin + all.potential;
  }
  /// Returns the effects that give pairs an energy.
  [[nodiscard]] Effects without_field() const {
    Effects pairs;
    pairs.square_well = acting_.square_well;
    pairs.stepped_potential = acting_.stepped_potential;
    return pairs;
  }

  /// Adds what has happened since the totals of before, under the effects that have acted since.
  void add(const State& state, const Totals& totals) {
    if (acting_.gravity) sums_[of_field] = field_before_ + (potential_ - potential(state));
    for (std::size_t side = 0; side < 4; ++side) {
      const WallProperties& wall = acting_.walls[side];
      const double given = energies_[side] - totals.wall_energy[side];
      const bool heats = wall.temperature || wall.restitution.value_or(1.0) != 1.0;
      const double by_motion = heats ? works_[side] - totals.wall_work[side] : given;
      sums_[work_of_left + side] += by_motion;
      sums_[heat_of_left + side] += given - by_motion;
    }
    sums_[of_growth] = totals.growth_energy;
    for (std::size_t side = 0; side < 4; ++side)
      if (!does_work_[side]) sums_[of_growth] += sums_[work_of_left + side];
    sums_[of_shear] = totals.shear_energy;
    sums_[of_bath] = totals.thermostat_energy;
    sums_[of_collisions] = 0.0 - totals.dissipated;  // no negative zero
    energies_ = totals.wall_energy;
    works_ = totals.wall_work;
    if (!rest_) return;
    sums_[*rest_] = 0.0;
    sums_[*rest_] = energy(state) - energy_ - total(work) - total(heat);
  }

  std::vector<Part> parts_;
  Effects acting_;
  std::optional<std::size_t> rest_ = {};  ///< place of the part that is known from the energy gained alone
  double potential_ = 0.0;                ///< at the start, or after the last change
  double field_before_ = 0.0;             ///< work of fields before the last change
  double energy_ = 0.0;                   ///< of the disks at the start
  double energy_before_ = 0.0;            ///< of the disks before the change that is being made
  std::array<bool, 4> does_work_{};       ///< whether a wall has a part of its own in the work
  std::array<double, places> sums_{};
  std::array<double, 4> energies_{}, works_{};  ///< that walls had received at the last sample
  ThinnedRows rows_{0};                         ///< work, heat, and each part
};

}  // namespace

MadeObservable make_work(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Work>(request, run);
}

}  // namespace carom
