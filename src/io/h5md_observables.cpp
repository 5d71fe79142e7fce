#include "io/h5md_observables.hpp"

#include "io/h5md_parts.hpp"
#include "observe/energy.hpp"
#include "observe/geometry.hpp"
#include "observe/mechanics.hpp"
#include "scene/effect_traits.hpp"
#include "scene/walls.hpp"

#include <algorithm>
#include <array>

namespace carom::detail {

namespace {

/// An engine that finds disks to be smooth keeps no spins, and they are zero.
void copy(const Eigen::VectorXd& values, std::span<double> row) { std::copy(values.begin(), values.end(), row.begin()); }
void copy(const std::array<double, 4>& values, std::span<double> row) { std::copy(values.begin(), values.end(), row.begin()); }

}  // namespace

H5mdObservables::H5mdObservables(hid_t file, const Scene& scene, const Disks& disks) : box_(scene.box), effects_(scene.effects) {
  const Hdf5Id observables = create_group(file, "observables");
  const auto put = [&](bool present, const std::string& name, std::vector<hsize_t> row, Measure measure) {
    if (!present) return;
    const Hdf5Id group = create_group(observables.get(), name);
    columns_.push_back({measure, {group.get(), "value", frame_layout(scene, sizeof(double), std::move(row))}});
    link_steps_and_times(file, "observables/" + name);
  };
  using Row = std::span<double>;
  const bool rough = effects_.collision.roughness.has_value();
  const bool walls_move = any_wall(effects_, moves);
  const bool walled = !box_.periodic(0) || !box_.periodic(1);

  put(true, "kinetic_energy", {}, [](const Sample& s, Row row) { row[0] = carom::kinetic_energy(s.disks, s.state); });
  put(true, "temperature", {},
      [](const Sample& s, Row row) { row[0] = kinetic_temperature(s.box, s.effects, s.disks, s.state); });
  put(true, "pair_collisions", {}, [](const Sample& s, Row row) { row[0] = static_cast<double>(s.totals.pair); });
  put(true, "virial", {}, [](const Sample& s, Row row) { row[0] = s.totals.virial; });
  const bool stepped = effects_.square_well || effects_.stepped_potential;
  put(stepped, "well_passages", {}, [](const Sample& s, Row row) { row[0] = static_cast<double>(s.totals.well); });
  put(walled, "wall_impulse", {4}, [](const Sample& s, Row row) { copy(s.totals.wall_impulse, row); });
  put(effects_.circle.has_value(), "circle_impulse", {}, [](const Sample& s, Row row) { row[0] = s.totals.circle_impulse; });
  const bool thermal = any_wall(effects_, [](const WallProperties& wall) { return wall.temperature.has_value(); });
  put(thermal, "wall_shear", {4}, [](const Sample& s, Row row) { copy(s.totals.wall_shear, row); });
  put(walled, "wall_energy", {4}, [](const Sample& s, Row row) { copy(s.totals.wall_energy, row); });
  put(rough, "spin", {disks.count()}, [](const Sample& s, Row row) { copy(s.state.spins, row); });
  put(rough, "spin_energy", {}, [](const Sample& s, Row row) { row[0] = carom::spin_energy(s.disks, s.state); });
  put(rough, "spin_temperature", {}, [](const Sample& s, Row row) { row[0] = carom::spin_temperature(s.disks, s.state); });
  put(has_potential(effects_), "potential_energy", {},
      [](const Sample& s, Row row) { row[0] = carom::potential_energy(s.box, s.effects, s.disks, s.state); });
  put(has_pistons(effects_), "piston_energy", {},
      [](const Sample& s, Row row) { row[0] = carom::piston_energy(s.effects, s.state); });
  put(has_more_than_kinetic_energy(effects_), "total_energy", {},
      [](const Sample& s, Row row) { row[0] = carom::total_energy(s.box, s.effects, s.disks, s.state); });
  put(stepped, "bonds", {}, [](const Sample& s, Row row) { row[0] = static_cast<double>(s.state.bonds); });
  const auto steps = static_cast<hsize_t>(effects_.potential_steps().size());
  put(effects_.stepped_potential.has_value() && steps > 0, "pairs_in_steps", {steps}, [](const Sample& s, Row row) {
    for (std::size_t k = 0; k < std::min(row.size(), s.state.pairs_in_steps.size()); ++k)
      row[k] = static_cast<double>(s.state.pairs_in_steps[k]);
  });
  put(walls_move, "walls", {4}, [](const Sample& s, Row row) {
    const Box now = box_of(s.box, s.state);
    copy(std::array{now.lower.x(), now.upper.x(), now.lower.y(), now.upper.y()}, row);
  });
  put(walls_move, "wall_velocity", {4}, [](const Sample& s, Row row) {
    for (std::size_t k = 0; k < std::min(row.size(), s.state.walls.size()); ++k) row[k] = s.state.walls[k].velocity;
  });
  const bool radii_change = any_present(effects_, &EffectTraits::changes_radii);
  put(radii_change, "scale", {}, [](const Sample& s, Row row) { row[0] = s.state.scale; });
  put(walls_move || radii_change, "packing_fraction", {},
      [](const Sample& s, Row row) { row[0] = carom::packing_fraction(s.box, s.disks, s.state); });
  put(effects_.shear.has_value(), "shear_displacement", {},
      [](const Sample& s, Row row) { row[0] = s.state.shear_displacement; });
}

void H5mdObservables::append(const Disks& disks, const State& state, const Totals& totals) {
  for (Column& column : columns_) column.measure({box_, effects_, disks, state, totals}, column.values.add_row());
}

void H5mdObservables::write() {
  for (Column& column : columns_) column.values.write();
}

void H5mdObservables::close() {
  for (Column& column : columns_) column.values.close();
}

std::size_t H5mdObservables::buffered_bytes() const {
  std::size_t bytes = 0;
  for (const Column& column : columns_) bytes += column.values.buffered_bytes();
  return bytes;
}

}  // namespace carom::detail
