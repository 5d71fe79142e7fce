#include "io/h5md_observables.hpp"

#include "io/frame_layout.hpp"
#include "observe/energy.hpp"
#include "observe/geometry.hpp"
#include "observe/mechanics.hpp"

#include <algorithm>
#include <array>

namespace carom::detail {

namespace {

bool moves(const WallProperties& wall) { return wall.mass || wall.velocity; }

void positions_of_walls(const Box& box, const Effects&, const Disks&, const State& state, std::span<double> row) {
  const Box now = box_of(box, state);
  const std::array<double, 4> positions = {now.lower.x(), now.upper.x(), now.lower.y(), now.upper.y()};
  std::copy(positions.begin(), positions.end(), row.begin());
}

/// An engine that finds disks to be smooth keeps no spins, and they are zero.
void spins(const Box&, const Effects&, const Disks&, const State& state, std::span<double> row) {
  std::copy(state.spins.begin(), state.spins.end(), row.begin());
}

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
  const bool walls_move = std::any_of(effects_.walls.begin(), effects_.walls.end(), moves);

  put(true, "kinetic_energy", {},
      [](const Box&, const Effects&, const Disks& d, const State& s, Row row) { row[0] = carom::kinetic_energy(d, s); });
  put(true, "temperature", {},
      [](const Box& b, const Effects& e, const Disks& d, const State& s, Row row) { row[0] = kinetic_temperature(b, e, d, s); });
  put(rough, "spin", {disks.count()}, spins);
  put(rough, "spin_energy", {},
      [](const Box&, const Effects&, const Disks& d, const State& s, Row row) { row[0] = carom::spin_energy(d, s); });
  put(rough, "spin_temperature", {},
      [](const Box&, const Effects&, const Disks& d, const State& s, Row row) { row[0] = carom::spin_temperature(d, s); });
  put(has_potential(effects_), "potential_energy", {},
      [](const Box& b, const Effects& e, const Disks& d, const State& s, Row row) {
        row[0] = carom::potential_energy(b, e, d, s);
      });
  put(has_pistons(effects_), "piston_energy", {},
      [](const Box&, const Effects& e, const Disks&, const State& s, Row row) { row[0] = carom::piston_energy(e, s); });
  put(has_more_than_kinetic_energy(effects_), "total_energy", {},
      [](const Box& b, const Effects& e, const Disks& d, const State& s, Row row) { row[0] = carom::total_energy(b, e, d, s); });
  put(effects_.square_well.has_value(), "bonds", {},
      [](const Box&, const Effects&, const Disks&, const State& s, Row row) { row[0] = static_cast<double>(s.bonds); });
  put(walls_move, "walls", {4}, positions_of_walls);
  put(effects_.growth.has_value(), "scale", {},
      [](const Box&, const Effects&, const Disks&, const State& s, Row row) { row[0] = s.scale; });
  put(walls_move || effects_.growth, "packing_fraction", {},
      [](const Box& b, const Effects&, const Disks& d, const State& s, Row row) { row[0] = carom::packing_fraction(b, d, s); });
  put(effects_.shear.has_value(), "shear_displacement", {},
      [](const Box&, const Effects&, const Disks&, const State& s, Row row) { row[0] = s.shear_displacement; });
}

void H5mdObservables::append(const Disks& disks, const State& state) {
  for (Column& column : columns_) column.measure(box_, effects_, disks, state, column.values.add_row());
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
