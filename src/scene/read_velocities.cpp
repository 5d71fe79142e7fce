// The key `velocities` of a [[disks]] table, in every spelling.

#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <utility>

namespace carom::detail {
namespace {

constexpr const char* velocity_kinds = R"({ uniform = 1.0 }, { temperature = 1.0 }, { speed = 1.0 }, [[vx, vy], ...] or "rest")";

Velocities drawn(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"uniform", "temperature", "speed"});
  if (node.size() != 1) {
    throw SceneError(table.where(), fmt::format("{} has {} keys; it must be one of {}", path, node.size(), velocity_kinds));
  }
  if (const auto maximum = table.number(keys::uniform)) return UniformVelocities{*maximum};
  if (const auto kT = table.number(keys::start_temperature)) return MaxwellVelocities{*kT};
  return FixedSpeed{*table.number(keys::speed)};
}

}  // namespace

void read_velocities(const TableReader& table, DisksDraft& disks) {
  const std::string path = table.path("velocities");
  const toml::node& node = table.require("velocities", fmt::format("choose {}", velocity_kinds));
  if (const auto* name = node.as_string(); name != nullptr && name->get() == "rest") {
    disks.species.velocities = AtRest{};
  } else if (const auto* list = node.as_array()) {
    disks.species.velocities = ListedVelocities{read_pairs(*list, path, keys::velocity_example)};
  } else if (const auto* law = node.as_table()) {
    disks.species.velocities = drawn(*law, path);
  } else {
    refuse(node, path, velocity_kinds);
  }
}

}  // namespace carom::detail
