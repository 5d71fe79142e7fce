#include "python/given_state.hpp"

#include "observe/geometry.hpp"
#include "scene/contact_scales.hpp"
#include "scene/fixed_shapes.hpp"
#include "simulation/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::python {

namespace {

/// Returns the overlap that single precision leaves, as part of the contact distance: its places are as exact as 2^-24 of the
/// largest coordinate.
double rounding_in(const Box& box, double smallest_radius) {
  const double farthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
  return std::clamp(std::ldexp(farthest / smallest_radius, -22), 1e-9, 1e-3);
}

std::invalid_argument refusal(const std::string& what, double depth, double contact, const char* from) {
  return std::invalid_argument(
      fmt::format("{} by {:.6g} in the given state; put its centre at least {:.6g} away from {}, or take it as it is with "
                  "accept_overlap = true in [run]",
                  what, depth, contact, from));
}

}  // namespace

void require_apart(const Scene& scene, const State& given) {
  const Start start = start_from(scene, given);
  const State& state = start.state;
  require_between_walls(scene, state);
  if (scene.run.accept_overlap || start.disks.count() == 0) return;

  Box box = box_of(scene.box, state);
  const std::vector<double> radii = radii_of(start.disks, state);
  const double rounding = rounding_in(box, *std::min_element(radii.begin(), radii.end()));
  std::vector<Eigen::Vector2d> centres;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const Eigen::Vector2d& centre = centres.emplace_back(state.positions.col(static_cast<Eigen::Index>(i)));
    for (const int axis : {0, 1}) {
      const double room = std::min(centre[axis] - box.lower[axis], box.upper[axis] - centre[axis]);
      if (box.periodic(axis) || room >= radii[i] * (1.0 - 2.0 * rounding)) continue;
      throw refusal(fmt::format("disk {} overlaps a wall in {}", i, axis == 0 ? "x" : "y"), radii[i] - room, radii[i], "it");
    }
    if (const auto found = overlapped_shape(box, scene.effects, centre, radii[i], 2.0 * rounding))
      throw refusal(fmt::format("disk {} overlaps {}", i, path_of_shape(scene.effects, found->shape)), found->depth,
                    found->contact, "it");
  }
  // The first search is fast however many disks lie in one place; the second knows where the images of a sheared box are.
  if (state.shear_displacement != 0.0) box.boundary[1] = Boundary::walls;
  const ContactScales<double> scales = contact_scales<double>(scene.effects, start.disks);
  DeepestOverlap found = first_overlap(box, radii, centres, rounding, scales);
  if (found.relative == 0.0 && state.shear_displacement != 0.0)
    found = deepest_overlap(scene.box, scene.effects, start.disks, state);
  if (!(found.relative > rounding)) return;
  const double contact = (radii[static_cast<std::size_t>(found.first)] + radii[static_cast<std::size_t>(found.second)]) *
                         scales.of_disks(found.first, found.second);
  throw refusal(fmt::format("disk {} overlaps disk {}", found.second, found.first), found.relative * contact, contact,
                "that one");
}

}  // namespace carom::python
