// Fields on a grid of cells: density, velocity of the flow, temperature, stress and heat flux, averaged over the run and in time.
//
// Densities are moments of the disks whose centres are in a cell: of their number, of m, m v, m v v and E v. E is m v^2 / 2, of
// rough disks the energy I w^2 / 2 of their spin besides, and of disks with a pair potential half of the energy of each of their
// pairs. A collision carries momentum and energy at once along the line between the centres, from the partner to the disk: each
// cell gets the share of that line which lies in it (Irving & Kirkwood, J. Chem. Phys. 18, 817 (1950)), so that fluxes are the
// same through every line across a steady flow. The stress is the flux of momentum relative to the flow u, positive under
// pressure, and the heat flux that of energy:
//   P = <m v v> - rho u u + <r dp>,    q = <E v> - u <E> - P u + <r dE>,    per area (and time).
// r dE is half of what the disk gains less what its partner does. At the edge of a step both have equal shares of the energy of
// the pair, which cancel. Spins are followed from collision to collision: by the impulse J along r the spins of both change by -2
// (r x J) / (m R |r|), and walls and obstacles leave them. Nearer to a wall than a radius a part of the momentum is carried from
// the wall to centres, which is not counted here.
//
// Where something changes velocities between collisions, impulses are not known, and the fields are those of states alone:
// density, velocity and temperature.
//
// In a circular box the grid divides the square round the circle. The area of a cell is that of its part inside the circle, which
// is a column of the averages; a cell without any has no fields.
//
// Averages over time: of disks at the steps, of collisions over all the time between. The run is kept as up to thirty-one
// stretches of equal length, each twice as long as before when there would be more. They are the fields in time, and errors come
// from them by the jackknife. All cells together tell how far correlations reach from one stretch into the next.

#include "observe/area_in_circle.hpp"
#include "observe/blocking.hpp"
#include "observe/equilibrium.hpp"
#include "observe/long_blocks.hpp"
#include "observe/near_pairs.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/wall_reach.hpp"
#include "scene/contact_scales.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace carom {

namespace {

/// What is added up in a cell.
struct CellSums {
  double disks = 0.0, mass = 0.0;
  Eigen::Vector2d momentum = Eigen::Vector2d::Zero();        ///< of m v
  Eigen::Matrix2d momentum_flow = Eigen::Matrix2d::Zero();   ///< of m v v
  Eigen::Vector2d energy_flow = Eigen::Vector2d::Zero();     ///< of E v
  Eigen::Matrix2d carried = Eigen::Matrix2d::Zero();         ///< of r dp, row: along r
  Eigen::Vector2d energy_carried = Eigen::Vector2d::Zero();  ///< of r dE
  double lost = 0.0;                                         ///< energy that contacts have taken
  double internal = 0.0;                                     ///< energy of spins and pairs

  CellSums& operator+=(const CellSums& other) {
    disks += other.disks, mass += other.mass, lost += other.lost, internal += other.internal;
    momentum += other.momentum, momentum_flow += other.momentum_flow, energy_flow += other.energy_flow;
    carried += other.carried, energy_carried += other.energy_carried;
    return *this;
  }
  CellSums& operator-=(const CellSums& other) {
    disks -= other.disks, mass -= other.mass, lost -= other.lost, internal -= other.internal;
    momentum -= other.momentum, momentum_flow -= other.momentum_flow, energy_flow -= other.energy_flow;
    carried -= other.carried, energy_carried -= other.energy_carried;
    return *this;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(disks, mass, momentum, momentum_flow, energy_flow, carried, energy_carried, lost, internal);
  }
};

/// The columns of a table: what each is called, and its unit.
struct FieldName {
  const char* name;
  const char* unit;
};
constexpr std::array<FieldName, 11> all_fields = {{{"density", "1 / area"},
                                                   {"velocity_x", "length / time"},
                                                   {"velocity_y", "length / time"},
                                                   {"temperature", "energy"},
                                                   {"stress_xx", "energy / area"},
                                                   {"stress_xy", "energy / area"},
                                                   {"stress_yx", "energy / area"},
                                                   {"stress_yy", "energy / area"},
                                                   {"heat_flux_x", "energy / (length time)"},
                                                   {"heat_flux_y", "energy / (length time)"},
                                                   {"energy_lost", "energy / (area time)"}}};
constexpr std::size_t states_alone = 4;  ///< the first fields, which need no collisions
using FieldValues = std::array<double, all_fields.size()>;
struct FieldEstimates {
  FieldValues mean{}, variance{};
  FieldValues covariance{};  ///< the same sum as `variance`, but of products of each stretch with the next
};

/// Returns the fields in a cell from the sums of so many steps. Without disks there is a density alone, without area nothing.
FieldValues fields_of(const CellSums& sums, double steps, double step, double area) {
  FieldValues found;
  found.fill(unknown);
  if (!(area > 0.0)) return found;
  found[0] = sums.disks / (steps * area);
  if (sums.disks == 0.0 || sums.mass == 0.0) return found;
  const Eigen::Vector2d u = sums.momentum / sums.mass;
  const Eigen::Matrix2d kinetic = (sums.momentum_flow - sums.mass * u * u.transpose()) / (steps * area);
  const Eigen::Matrix2d carried = sums.carried / (steps * step * area), stress = kinetic + carried;
  const double heat = 0.5 * kinetic.trace(), flow = 0.5 * sums.mass * u.squaredNorm() / (steps * area);
  const Eigen::Vector2d energy = sums.energy_flow / (steps * area) + sums.energy_carried / (steps * step * area);
  const double carried_along = heat + flow + sums.internal / (steps * area);
  const Eigen::Vector2d heat_flux = energy - carried_along * u - stress * u;
  found[1] = u.x(), found[2] = u.y();
  // A difference of squares that is 0 may be less to rounding.
  found[3] = std::max(heat / found[0], 0.0);
  found[4] = std::max(kinetic(0, 0), 0.0) + carried(0, 0), found[5] = stress(0, 1);
  found[6] = stress(1, 0), found[7] = std::max(kinetic(1, 1), 0.0) + carried(1, 1);
  found[8] = heat_flux.x(), found[9] = heat_flux.y();
  found[10] = sums.lost / (steps * step * area);
  return found;
}

class Fields final : public SavedObservable<Fields>, public ChangeFollower {
 public:
  Fields(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        cells_(request.cells.value_or(std::array<std::int64_t, 2>{10, 10})),
        follows_(run.collisions_known && !is_driven(run.scene.effects)),
        names_(std::span(all_fields).first(is_driven(run.scene.effects) ? states_alone : all_fields.size())),
        potential_(run.acting->potential_steps()),
        scales_(contact_scales<double>(run.scene.effects, run.disks)),
        coming_(static_cast<std::size_t>(cells_[0] * cells_[1])) {
    lay_grid(run.scene.box);
  }

  [[nodiscard]] bool follows_collisions() const override { return follows_; }
  [[nodiscard]] bool needs_places() const override { return true; }

  void start(const State& state) override {
    lay_grid(reach_of_walls(run_, state));
    spins_ = state.spins;
  }

  void collisions(std::span<const PairCollision> collisions) override {
    for (const PairCollision& met : collisions) {
      const double gained = energy_gained(met.disk, met.velocity_before, met.velocity) + spin_energy_gained(met.disk, met);
      const double partner_gained =
          energy_gained(met.partner, met.partner_velocity_before, met.partner_velocity) + spin_energy_gained(met.partner, met);
      const Eigen::Matrix2d carried = met.separation * met.impulse.transpose();
      const Eigen::Vector2d energy = 0.5 * (gained - partner_gained) * met.separation;
      const double lost = met.contact ? -(gained + partner_gained) : 0.0;
      along_line(met.place - met.separation, met.separation, [&](CellSums& cell, double share) {
        cell.carried += share * carried;
        cell.energy_carried += share * energy;
        cell.lost += share * lost;
      });
    }
  }

  void sample(const State& state, const Totals&) override {
    spins_ = state.spins;           // those that were followed, but for rounding
    if (state.time == 0.0) return;  // every step ends a stretch of time, in which disks have collided
    const std::vector<double> internal = internal_energies(state);
    seen_ += run_.disks.count();
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      CellSums* const cell = cell_at(state.positions.col(k));
      if (cell == nullptr) {  // behind a wall whose way was not known
        ++outside_;
        continue;
      }
      const double mass = run_.disks.mass[i];
      const Eigen::Vector2d v = state.velocities.col(k);
      cell->disks += 1.0;
      cell->mass += mass;
      cell->momentum += mass * v;
      cell->momentum_flow += mass * v * v.transpose();
      cell->energy_flow += (0.5 * mass * v.squaredNorm() + internal[i]) * v;
      cell->internal += internal[i];
    }
    if (++steps_ < steps_of_stretch_) return;
    stretches_.push_back(coming_);
    std::fill(coming_.begin(), coming_.end(), CellSums{});
    steps_ = 0;
    if (stretches_.size() < most_stretches) return;
    for (std::size_t s = 0; s < most_stretches / 2; ++s) {
      if (s > 0) stretches_[s] = std::move(stretches_[2 * s]);
      for (std::size_t c = 0; c < coming_.size(); ++c) stretches_[s][c] += stretches_[2 * s + 1][c];
    }
    stretches_.resize(most_stretches / 2);
    steps_of_stretch_ *= 2;
  }

  void pass(const Change& change, const Effects& acting) override {
    potential_ = acting.potential_steps();
    if (const auto* scale = std::get_if<ScaleVelocities>(&change.what)) spins_ *= scale->factor;
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name(), .note = note_on_disks_outside(outside_, seen_)};
    const auto remark = [&](const std::string& why) { found.note += (found.note.empty() ? "" : "; ") + why; };
    const bool is_whole = names_.size() == all_fields.size();
    if (!is_whole)
      remark(fmt::format(
          "without stress and heat flux: {} changes velocities between collisions, so what these transfer is not known",
          what_drives(run_.scene.effects)));
    if (is_whole && !follows_)
      remark("collisions were not recorded, so stress and heat flux are those that disks carry in flight");
    if (is_whole && run_.scene.effects.collision.roughness.value_or(-1.0) != -1.0 && spins_.size() == 0)
      remark("spins were not recorded, so heat flux and energy lost lack their energy");
    if (is_crystal(run_.scene)) remark("in a crystal the flow swings to and fro: its errors are up to 3 times too large");
    if (stretches_.empty()) {
      found.note = "the run is too short";
      return found;
    }
    bool correlated = false;
    found.tables = {averages(correlated), in_time()};
    note_lower_bounds(found, correlated);
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lower_, upper_, width_, areas_, stretches_, coming_, steps_, steps_of_stretch_, spins_, seen_, outside_);
  }

 private:
  static constexpr std::size_t most_stretches = 32, least_for_errors = 16;

  [[nodiscard]] double energy_gained(std::int32_t disk, const Eigen::Vector2d& before, const Eigen::Vector2d& after) const {
    return 0.5 * run_.disks.mass[static_cast<std::size_t>(disk)] * (after.squaredNorm() - before.squaredNorm());
  }

  /// Returns the energy of spin that a disk gains in a collision, and gives it its spin after that: 0 for smooth disks.
  [[nodiscard]] double spin_energy_gained(std::int32_t disk, const PairCollision& met) {
    if (spins_.size() == 0) return 0.0;
    const auto i = static_cast<std::size_t>(disk);
    const double radius = run_.disks.radius[i], mass = run_.disks.mass[i];
    const double along = (met.separation.x() * met.impulse.y() - met.separation.y() * met.impulse.x()) / met.separation.norm();
    double& spin = spins_[disk];
    const double before = spin;
    spin -= 2.0 * along / (mass * radius);
    return 0.25 * mass * radius * radius * (spin * spin - before * before);
  }

  /// Returns the energy of spin of each disk, and half of that of its pairs.
  [[nodiscard]] std::vector<double> internal_energies(const State& state) const {
    std::vector<double> energies(run_.disks.count());
    for (std::size_t i = 0; i < energies.size() && state.spins.size() > 0; ++i) {
      const double edge_speed = run_.disks.radius[i] * state.spins[static_cast<Eigen::Index>(i)];
      energies[i] = 0.25 * run_.disks.mass[i] * edge_speed * edge_speed;
    }
    if (potential_.empty() || energies.empty()) return energies;
    const double largest = *std::max_element(run_.disks.radius.begin(), run_.disks.radius.end());
    for_each_near(box_of(run_.scene.box, state), state.positions, potential_.back().width * 2.0 * largest * scales_.largest(),
                  [&](std::size_t i, std::size_t j, const std::array<std::int64_t, 2>&, const Eigen::Vector2d& r) {
                    const double scale = scales_.of_disks(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
                    const double distance = r.norm() / ((run_.disks.radius[i] + run_.disks.radius[j]) * scale);
                    const auto step = std::find_if(potential_.begin(), potential_.end(),
                                                   [&](const PotentialStep& one) { return distance < one.width; });
                    if (step == potential_.end()) return;
                    energies[i] += 0.5 * step->energy;
                    energies[j] += 0.5 * step->energy;
                  });
    return energies;
  }

  /// Divides the rectangle of a box into cells.
  void lay_grid(const Box& box) {
    lower_ = box.lower, upper_ = box.upper;
    for (int axis = 0; axis < 2; ++axis)
      width_[axis] = box.lengths()[axis] / static_cast<double>(cells_[static_cast<std::size_t>(axis)]);
    areas_.assign(coming_.size(), width_[0] * width_[1]);
    for (std::size_t c = 0; c < areas_.size() && box.is_circle; ++c) areas_[c] = area_in_circle(rectangle_of(c), box);
  }

  /// Returns the rectangle of a cell.
  [[nodiscard]] Rectangle rectangle_of(std::size_t c) const {
    const auto across = static_cast<std::size_t>(cells_[0]);
    const std::size_t column = c % across, row = c / across;
    const Eigen::Vector2d at(static_cast<double>(column), static_cast<double>(row));
    const Eigen::Vector2d lower = lower_ + at.cwiseProduct(width_);
    return {lower, lower + width_};
  }

  /// Returns the cell at a place; along periodic axes the place may be outside the box. Null where there is none.
  [[nodiscard]] CellSums* cell_at(const Eigen::Vector2d& place) {
    std::array<std::int64_t, 2> at{};
    for (int axis = 0; axis < 2; ++axis) {
      const std::int64_t count = cells_[static_cast<std::size_t>(axis)];
      const double cell = std::floor((place[axis] - lower_[axis]) / width_[axis]);
      auto number = static_cast<std::int64_t>(cell);
      if (run_.scene.box.periodic(axis))
        number = ((number % count) + count) % count;
      else if (number == count && place[axis] <= upper_[axis])
        --number;
      if (number < 0 || number >= count) return nullptr;
      at[static_cast<std::size_t>(axis)] = number;
    }
    return &coming_[static_cast<std::size_t>(at[1] * cells_[0] + at[0])];
  }

  /// Calls f(cell, share) for each cell that the line from `start` to start + line runs through, with the share of the line in
  /// it.
  template <class F>
  void along_line(const Eigen::Vector2d& start, const Eigen::Vector2d& line, F&& f) {
    crossings_.clear();
    for (int axis = 0; axis < 2; ++axis) {
      const double from = (start[axis] - lower_[axis]) / width_[axis], to = from + line[axis] / width_[axis];
      const double low = std::min(from, to), high = std::max(from, to);
      for (double edge = std::floor(low) + 1.0; edge < high; edge += 1.0) crossings_.push_back((edge - from) / (to - from));
    }
    std::sort(crossings_.begin(), crossings_.end());
    crossings_.push_back(1.0);
    double begun = 0.0;
    for (const double end : crossings_) {
      if (CellSums* const cell = cell_at(start + 0.5 * (begun + end) * line)) f(*cell, end - begun);
      begun = end;
    }
  }

  [[nodiscard]] std::array<Column, 2> middles() const {
    std::array<Column, 2> places{{{"x", "length", {}}, {"y", "length", {}}}};
    for (std::int64_t row = 0; row < cells_[1]; ++row)
      for (std::int64_t column = 0; column < cells_[0]; ++column) {
        places[0].values.push_back(lower_[0] + (static_cast<double>(column) + 0.5) * width_[0]);
        places[1].values.push_back(lower_[1] + (static_cast<double>(row) + 0.5) * width_[1]);
      }
    return places;
  }

  /// Returns the fields averaged over all whole stretches, with errors by the jackknife over these, and halves compared. Sets
  /// `correlated` where stretches are too short for the correlations of a field.
  [[nodiscard]] Table averages(bool& correlated) const {
    Table table{.name = "fields"};
    for (Column& column : middles()) table.columns.push_back(std::move(column));
    if (run_.scene.box.is_circle) table.columns.push_back({"area", "area", areas_});
    const std::size_t first = table.columns.size();
    for (const FieldName& field : names_) {
      table.columns.push_back({field.name, field.unit, {}});
      table.columns.push_back({std::string(field.name) + "_error", field.unit, {}});
    }
    const std::size_t count = stretches_.size(), begin = first_of_long_blocks(count);
    const double share = static_cast<double>(begin) / static_cast<double>(count);
    std::vector<NextBlockCorrelation> correlations(names_.size(), NextBlockCorrelation(count));
    for (std::size_t c = 0; c < coming_.size(); ++c) {
      const FieldEstimates all = estimates(c, 0, count);
      for (std::size_t f = 0; f < names_.size(); ++f) {
        table.columns[first + 2 * f].values.push_back(all.mean[f]);
        table.columns[first + 2 * f + 1].values.push_back(count < least_for_errors ? unknown : std::sqrt(all.variance[f]));
        if (std::isfinite(all.variance[f])) correlations[f].add(all.mean[f], all.variance[f], all.covariance[f]);
      }
    }
    for (std::size_t f = 0; f < (count < least_for_errors ? 0 : names_.size()); ++f) {
      const double correlation = correlations[f].value(), factor = variance_by_correlated_blocks(correlation, count);
      correlated = correlated || correlation > most_correlation_of_blocks;
      for (double& error : table.columns[first + 2 * f + 1].values) error *= std::sqrt(factor);
    }
    if (begin == 0) return table;
    std::vector<FieldEstimates> before, rest;
    std::vector<NextBlockCorrelation> of_rest(names_.size(), NextBlockCorrelation(count - begin));
    for (std::size_t c = 0; c < coming_.size(); ++c) {
      before.push_back(estimates(c, 0, begin));
      rest.push_back(estimates(c, begin, count));
      for (std::size_t f = 0; f < names_.size(); ++f)
        if (std::isfinite(rest[c].variance[f])) of_rest[f].add(rest[c].mean[f], rest[c].variance[f], rest[c].covariance[f]);
    }
    for (std::size_t f = 0; f < names_.size(); ++f) {
      const double factor = variance_by_correlated_blocks(of_rest[f].value(), count - begin);
      ColumnComparison comparison;
      for (std::size_t c = 0; c < coming_.size(); ++c)
        comparison.add(compared_halves(share, before[c].mean[f], rest[c].mean[f], std::sqrt(factor * rest[c].variance[f]),
                                       0.5 * static_cast<double>(count - begin)));
      comparison.put(table, names_[f].name, 2);
    }
    return table;
  }

  /// Returns the fields in a cell over the stretches from `begin` to before `end`, with variances by the jackknife over these.
  /// They are unknown in a cell whose disks came in few of them.
  [[nodiscard]] FieldEstimates estimates(std::size_t c, std::size_t begin, std::size_t end) const {
    const auto steps_of = [&](std::size_t stretches) {
      return static_cast<double>(stretches) * static_cast<double>(steps_of_stretch_);
    };
    CellSums all;
    double squares = 0.0;  // of numbers of disks
    for (std::size_t s = begin; s < end; ++s) {
      all += stretches_[s][c];
      squares += stretches_[s][c].disks * stretches_[s][c].disks;
    }
    FieldEstimates found{.mean = fields_of(all, steps_of(end - begin), step_, areas_[c])};
    if (!(all.disks * all.disks >= static_cast<double>(least_blocks) * squares) || squares == 0.0) {
      found.variance.fill(unknown);
      return found;
    }
    FieldValues before{};
    for (std::size_t s = begin; s < end; ++s) {
      CellSums others = all;
      others -= stretches_[s][c];
      const FieldValues without = fields_of(others, steps_of(end - begin - 1), step_, areas_[c]);
      for (std::size_t f = 0; f < without.size(); ++f) {
        const double changed = without[f] - found.mean[f];
        found.variance[f] += changed * changed;
        found.covariance[f] += changed * std::exchange(before[f], changed);
      }
    }
    const auto left_out = static_cast<double>(end - begin);  // one at a time
    for (FieldValues* sums : {&found.variance, &found.covariance})
      for (double& sum : *sums) sum *= (left_out - 1.0) / left_out;
    return found;
  }

  /// Returns the fields of each stretch, with the middle of its time.
  [[nodiscard]] Table in_time() const {
    Table table{.name = "fields_in_time"};
    table.columns.push_back({"time", "time", {}});
    const std::array<Column, 2> places = middles();
    for (const Column& column : places) table.columns.push_back({column.name, column.unit, {}});
    for (const FieldName& field : names_) table.columns.push_back({field.name, field.unit, {}});
    const auto steps = static_cast<double>(steps_of_stretch_);
    for (std::size_t s = 0; s < stretches_.size(); ++s)
      for (std::size_t c = 0; c < coming_.size(); ++c) {
        table.columns[0].values.push_back((static_cast<double>(s) + 0.5) * steps * step_);
        for (std::size_t axis = 0; axis < 2; ++axis) table.columns[1 + axis].values.push_back(places[axis].values[c]);
        const FieldValues values = fields_of(stretches_[s][c], steps, step_, areas_[c]);
        for (std::size_t f = 0; f < names_.size(); ++f) table.columns[3 + f].values.push_back(values[f]);
      }
    return table;
  }

  std::array<std::int64_t, 2> cells_;
  bool follows_;
  std::span<const FieldName> names_;
  std::vector<PotentialStep> potential_;  ///< of pairs; empty without one
  ContactScales<double> scales_;
  Eigen::Vector2d lower_, upper_, width_;         ///< of the grid, and of a cell
  std::vector<double> areas_;                     ///< of the cells, within a circular box
  std::vector<std::vector<CellSums>> stretches_;  ///< that have ended, in order of time; each by cell, row after row
  std::vector<CellSums> coming_;                  ///< the stretch that has begun
  std::uint64_t steps_ = 0, steps_of_stretch_ = 1;
  Eigen::VectorXd spins_;                 ///< after the last collision of each disk; empty where they are smooth
  std::uint64_t seen_ = 0, outside_ = 0;  ///< disks at the steps, in all and beyond the grid
  std::vector<double> crossings_;         ///< scratch
};

}  // namespace

MadeObservable make_fields(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Fields>(request, run);
}

}  // namespace carom
