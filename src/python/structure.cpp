// What is round each disk of a state, as Python sees it: its Voronoi cell, and the cluster that it belongs to.

#include "observe/disk_clusters.hpp"
#include "observe/geometry.hpp"
#include "observe/voronoi_cells.hpp"
#include "python/buffers.hpp"
#include "python/parts.hpp"
#include "scene/checks.hpp"
#include "scene/contact_scales.hpp"
#include "simulation/start.hpp"

#include <nanobind/stl/tuple.h>

#include <fmt/format.h>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::python {

namespace {

/// Returns the disks of a scene in a given state, between the walls of that state. Throws as start_from() does, and where one
/// lies beyond a wall.
Start placed(const Scene& scene, const State& given) {
  Start start = start_from(scene, given);
  if (given.walls.size() == numbers_of_walls / 2) start.state.walls = given.walls;  // a change may have moved them
  require_between_walls(scene, start.state);
  return start;
}

template <class Value>
Array<Value> one_for_each(std::vector<Value> values) {
  const std::size_t count = values.size();
  return array_that_owns<Value>(std::move(values), {count});
}

using Voronoi = std::tuple<Array<double>, Array<std::int64_t>, Array<double>, Array<double>, Array<std::uint8_t>>;

/// Returns the areas of the cells, their numbers of neighbours, size and angle of their sixfold order (not a number where a wall
/// cuts the cell off), and whether a wall does.
Voronoi voronoi(const Scene& scene, const State& given) {
  const Start start = placed(scene, given);
  const VoronoiCells cells(box_of(scene.box, start.state), start.state.positions, start.state.shear_displacement);
  std::vector<double> areas(cells.count()), order(cells.count()), angle(cells.count());
  std::vector<std::int64_t> neighbours(cells.count());
  std::vector<std::uint8_t> at_wall(cells.count());
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < cells.count(); ++i) {
    areas[i] = cells.area(i);
    for (const VoronoiSide& side : cells.sides(i)) neighbours[i] += side.neighbour >= 0 ? 1 : 0;
    at_wall[i] = cells.at_wall(i) ? 1 : 0;
    const std::complex<double> psi = cells.at_wall(i) ? none : sixfold_order(cells.sides(i));
    order[i] = std::abs(psi);
    angle[i] = cells.at_wall(i) ? none : std::arg(psi);
  }
  return {one_for_each(std::move(areas)), one_for_each(std::move(neighbours)), one_for_each(std::move(order)),
          one_for_each(std::move(angle)), one_for_each(std::move(at_wall))};
}

using Clusters = std::tuple<Array<std::int64_t>, Array<std::int64_t>, Array<std::uint8_t>, Array<std::uint8_t>>;

/// Returns the number of each disk's cluster, that cluster's size, and whether it percolates along x and along y. `gap` is a
/// length.
Clusters clusters(const Scene& scene, const State& given, double gap) {
  if (scene.effects.shear_rate() != 0.0)
    throw std::invalid_argument("clusters: under [shear] images slide past each other; clusters are those of a fluid at rest");
  const Start start = placed(scene, given);
  const std::vector<double> radii = radii_of(start.disks, start.state);
  for (int axis = 0; axis < 2; ++axis)
    if (scene.box.periodic(axis) && gap > scene.box.lengths()[axis])
      throw std::invalid_argument(fmt::format(
          "gap={:g}: the periodic box is {:g} long in {}, so that every disk would be near its own image; make the gap "
          "smaller",
          gap, scene.box.lengths()[axis], detail::axis_names[axis]));
  const DiskClusters found(box_of(scene.box, start.state), start.state.positions, radii, gap,
                           contact_scales<double>(scene.effects, start.disks));
  std::vector<std::int64_t> numbers(radii.size()), sizes(radii.size());
  std::vector<std::uint8_t> along_x(radii.size()), along_y(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const std::size_t cluster = found.cluster(i);
    numbers[i] = static_cast<std::int64_t>(cluster);
    sizes[i] = static_cast<std::int64_t>(found.size(cluster));
    along_x[i] = found.percolates(cluster, 0) ? 1 : 0;
    along_y[i] = found.percolates(cluster, 1) ? 1 : 0;
  }
  return {one_for_each(std::move(numbers)), one_for_each(std::move(sizes)), one_for_each(std::move(along_x)),
          one_for_each(std::move(along_y))};
}

}  // namespace

void add_structure(nb::module_& module) {
  module.def("voronoi", &voronoi, nb::arg("scene"), nb::arg("state"));
  module.def("clusters", &clusters, nb::arg("scene"), nb::arg("state"), nb::arg("gap"));
}

}  // namespace carom::python
