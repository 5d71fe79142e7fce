#pragma once
// Memory that numpy and the library share, and the exceptions and interruptions of calls that take long.

#include <carom/state.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::python {

namespace nb = nanobind;

/// An array for numpy, which cannot write to it.
template <class Value>
using Array = nb::ndarray<nb::numpy, const Value>;

/// Arrays of numpy's: a row of two numbers for each disk, and a number for each.
using Pairs = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using Numbers = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// Returns the values as an array that owns them: nothing is copied.
template <class Value, class Holder>
[[nodiscard]] Array<Value> array_that_owns(Holder&& values, std::initializer_list<std::size_t> shape) {
  using Held = std::remove_cvref_t<Holder>;
  auto* const held = new Held(std::forward<Holder>(values));
  const nb::capsule owner(held, [](void* p) noexcept { delete static_cast<Held*>(p); });
  return Array<Value>(reinterpret_cast<const Value*>(held->data()), shape.size(), shape.begin(), owner);
}

/// Returns radii, masses and species.
[[nodiscard]] inline auto arrays_of(const Disks& disks) {
  const std::size_t n = disks.count();
  return std::tuple(array_that_owns<double>(disks.radius, {n}), array_that_owns<double>(disks.mass, {n}),
                    array_that_owns<std::int32_t>(disks.species, {n}));
}

/// Returns values that `owner` holds as an array that keeps the owner alive.
template <class Value>
[[nodiscard]] Array<Value> array_within(const Value* values, std::initializer_list<std::size_t> shape, nb::handle owner) {
  return Array<Value>(values, shape.size(), shape.begin(), owner);
}

/// Writes the positions and velocities of the four walls to `room`, which has room for `numbers_of_walls`; none of them is a
/// number where no wall moves.
inline constexpr std::size_t numbers_of_walls = 8;
inline void write_walls(const std::vector<WallState>& walls, double* room) {
  if (walls.empty()) std::fill_n(room, numbers_of_walls, std::numeric_limits<double>::quiet_NaN());
  for (const WallState& wall : walls) *room++ = wall.position, *room++ = wall.velocity;
}

/// Takes the lock of the interpreter, and lets pending signals and the caller's `report` raise what they like: KeyboardInterrupt
/// comes out of the call at hand. Signals are those of the main thread.
inline void look_at_python(const std::function<void()>& report = {}) {
  const nb::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
  if (report) report();
}

}  // namespace carom::python
