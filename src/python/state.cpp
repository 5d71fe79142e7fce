// States and events, as Python sees them: their memory is handed over or shared, never copied.

#include "python/buffers.hpp"
#include "python/parts.hpp"

#include <carom/state.hpp>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::python {

namespace {

// numpy reads events where they are: carom._events.EVENT has these places.
static_assert(sizeof(Event) == 64 && offsetof(Event, time_remainder) == 8 && offsetof(Event, disk) == 16 &&
              offsetof(Event, partner) == 20 && offsetof(Event, velocity) == 32 && offsetof(Event, partner_velocity) == 48);

using Turns = nb::ndarray<const std::int64_t, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;

template <class Matrix>
Array<typename Matrix::Scalar> columns_of(nb::handle self, Matrix State::*member) {
  const Matrix& matrix = nb::cast<const State&>(self).*member;
  return array_within(matrix.data(), {static_cast<std::size_t>(matrix.cols()), 2}, self);
}

/// A state from arrays: what a user gives, and what a pickle holds. Arrays of velocities, images and spins may be absent.
State state_of(const Pairs& positions, const std::optional<Pairs>& velocities, const std::optional<Turns>& images,
               const std::optional<Numbers>& spins, double time, double scale,
               const std::vector<std::pair<double, double>>& walls, std::uint64_t bonds, double shear_displacement,
               const std::optional<Pairs>& remainders, const std::vector<std::uint64_t>& pairs_in_steps) {
  const auto disks = static_cast<Eigen::Index>(positions.shape(0));
  State state;
  state.time = time;
  state.scale = scale;
  state.bonds = bonds;
  state.pairs_in_steps = pairs_in_steps;
  state.shear_displacement = shear_displacement;
  state.positions = Eigen::Map<const Eigen::Matrix2Xd>(positions.data(), 2, disks);
  state.velocities = Eigen::Matrix2Xd::Zero(2, disks);
  state.images = Images::Zero(2, disks);
  const auto columns = [](const auto& array) { return static_cast<Eigen::Index>(array.shape(0)); };
  if (velocities) state.velocities = Eigen::Map<const Eigen::Matrix2Xd>(velocities->data(), 2, columns(*velocities));
  if (images) state.images = Eigen::Map<const Images>(images->data(), 2, columns(*images));
  if (spins) state.spins = Eigen::Map<const Eigen::VectorXd>(spins->data(), columns(*spins));
  if (remainders) state.remainders = Eigen::Map<const Eigen::Matrix2Xd>(remainders->data(), 2, columns(*remainders));
  for (const auto& [position, velocity] : walls) state.walls.push_back({position, velocity});
  return state;
}

}  // namespace

void add_state(nb::module_& module) {
  nb::class_<State>(module, "State")
      .def(
          "__init__",
          [](State* self, const Pairs& positions, const std::optional<Pairs>& velocities, const std::optional<Turns>& images,
             const std::optional<Numbers>& spins, double time, double scale, const std::vector<std::pair<double, double>>& walls,
             std::uint64_t bonds, double shear_displacement, const std::optional<Pairs>& remainders,
             const std::vector<std::uint64_t>& pairs_in_steps) {
            new (self) State(state_of(positions, velocities, images, spins, time, scale, walls, bonds, shear_displacement,
                                      remainders, pairs_in_steps));
          },
          nb::arg("positions"), nb::arg("velocities").none() = nb::none(), nb::arg("images").none() = nb::none(),
          nb::arg("spins").none() = nb::none(), nb::arg("time") = 0.0, nb::arg("scale") = 1.0,
          nb::arg("walls") = std::vector<std::pair<double, double>>{}, nb::arg("bonds") = 0, nb::arg("shear_displacement") = 0.0,
          nb::arg("remainders").none() = nb::none(), nb::arg("pairs_in_steps") = std::vector<std::uint64_t>{})
      .def_ro("time", &State::time)
      .def_ro("scale", &State::scale)
      .def_ro("bonds", &State::bonds)
      .def_ro("pairs_in_steps", &State::pairs_in_steps)
      .def_ro("shear_displacement", &State::shear_displacement)
      .def_prop_ro("positions", [](nb::handle self) { return columns_of(self, &State::positions); })
      .def_prop_ro("velocities", [](nb::handle self) { return columns_of(self, &State::velocities); })
      .def_prop_ro("images", [](nb::handle self) { return columns_of(self, &State::images); })
      .def_prop_ro("remainders", [](nb::handle self) { return columns_of(self, &State::remainders); })
      .def_prop_ro("spins",
                   [](nb::handle self) {
                     const auto& spins = nb::cast<const State&>(self).spins;
                     return array_within(spins.data(), {static_cast<std::size_t>(spins.size())}, self);
                   })
      .def_prop_ro("walls",
                   [](const State& state) {
                     std::vector<std::pair<double, double>> walls;
                     for (const WallState& wall : state.walls) walls.emplace_back(wall.position, wall.velocity);
                     return walls;
                   })
      .def_prop_ro("state_hash", [](const State& state) { return state_hash(state); });
}

}  // namespace carom::python
