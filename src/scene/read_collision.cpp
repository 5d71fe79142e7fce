// The [collision] table: what contact of two disks does to them.

#include "scene/read_tables.hpp"

namespace carom::detail {
namespace {

CollisionRule read_rule(const TableReader& table) {
  const std::string kinds = R"("reversal" (the whole relative velocity) or "specular" (its part along the line of centres))";
  const toml::node& rule = table.require("rule", "choose " + kinds);
  const auto* name = rule.as_string();
  if (name != nullptr && name->get() == "reversal") return CollisionRule::reversal;
  if (name != nullptr && name->get() == "specular") return CollisionRule::specular;
  refuse(rule, "collision.rule", kinds);
}

}  // namespace

Collision read_collision(const toml::table& node) {
  const TableReader table(node, "collision", {"rule", "restitution", "roughness", "elastic_below"});
  Collision collision;
  collision.rule = read_rule(table);
  collision.restitution = table.number(keys::restitution);
  collision.roughness = table.number(keys::roughness);
  if (const toml::table* below = table.table("elastic_below", "{ time = 1e-6 }")) {
    collision.elastic_below = TableReader(*below, "collision.elastic_below", {"time"}).required_number(keys::elastic_below);
  }
  return collision;
}

}  // namespace carom::detail
