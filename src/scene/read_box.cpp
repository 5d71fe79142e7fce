// The [box] table: limits or aspect, and the boundary in its three spellings; or a circle.

#include "scene/checks.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <string_view>

namespace carom::detail {
namespace {

constexpr const char* boundary_kinds = R"("walls", "periodic" or one for each axis, { x = "periodic", y = "walls" })";

Boundary read_boundary(const toml::node& node, const std::string& path, const std::string& expected) {
  const auto* text = node.as_string();
  if (text != nullptr && text->get() == "walls") return Boundary::walls;
  if (text != nullptr && text->get() == "periodic") return Boundary::periodic;
  refuse(node, path, expected);
}

std::array<Boundary, 2> read_boundaries(const toml::node& node) {
  if (!node.is_table()) {
    const Boundary both = read_boundary(node, "box.boundary", boundary_kinds);
    return {both, both};
  }
  const TableReader axes(*node.as_table(), "box.boundary", {"x", "y"});
  const std::string advice = R"(name both axes, such as { x = "periodic", y = "walls" })";
  return {read_boundary(axes.require("x", advice), "box.boundary.x", R"("walls" or "periodic")"),
          read_boundary(axes.require("y", advice), "box.boundary.y", R"("walls" or "periodic")")};
}

void read_limits(const TableReader& box, Box& limits) {
  for (int axis = 0; axis < 2; ++axis) {
    const std::string_view key = axis_names[axis], example = keys::limits_example[axis];
    const Eigen::Vector2d ends =
        read_pair(box.require(key, fmt::format("give its limits, such as {}", example)), box.path(key), example);
    limits.lower[axis] = ends[0];
    limits.upper[axis] = ends[1];
  }
}

/// A circle has its size, and is a wall.
void read_circle(const TableReader& box, const toml::table& node, BoxDraft& draft) {
  for (const char* key : {"x", "y", "aspect", "boundary"}) {
    if (box.find(key) == nullptr) continue;
    throw SceneError(box.where("circle"),
                     fmt::format("box.circle and box.{} exclude each other; a circle is a hard wall of its own size, so give it "
                                 "alone, or the limits x and y with a boundary",
                                 key));
  }
  const TableReader table(node, "box.circle", {"centre", "radius"});
  Circle circle;
  circle.centre = read_pair(table.require("centre", fmt::format("give it, such as {}", keys::circle_example)),
                            table.path("centre"), keys::circle_example);
  circle.radius = table.required_number(keys::circle_radius);
  Effects effects;
  put_in_circle(draft.box, effects, circle);
  draft.circle = circle;
}

}  // namespace

BoxDraft read_box(const toml::table& table) {
  const TableReader box(table, "box", {"x", "y", "boundary", "aspect", "circle"});
  BoxDraft draft;
  if (const toml::table* circle = box.table("circle", std::string(keys::circle_example))) {
    read_circle(box, *circle, draft);
    return draft;
  }
  draft.aspect = box.number(keys::aspect);
  if (draft.aspect) {
    for (const char* key : {"x", "y"}) {
      if (box.find(key) != nullptr) {
        throw SceneError(box.where("aspect"),
                         fmt::format("box.aspect and box.{} exclude each other; give the limits x and y, or aspect "
                                     "and a packing_fraction in [[disks]]",
                                     key));
      }
    }
  } else {
    read_limits(box, draft.box);
  }
  draft.box.boundary = read_boundaries(box.require("boundary", fmt::format("choose {}", boundary_kinds)));
  return draft;
}

}  // namespace carom::detail
