// Says what each effect of a scene does, with its numbers.

#include "pages/effects_words.hpp"

#include "observe/any_wall.hpp"
#include "scene/wall_names.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace carom {

namespace {

std::string words(const Collision& collision) {
  std::string text = collision.rule == CollisionRule::reversal
                         ? "reversal: the whole relative velocity turns round, in the centre-of-mass frame"
                         : "specular: the relative velocity along the line of centres turns round";
  if (collision.restitution) text += fmt::format("; restitution {:.6g}", *collision.restitution);
  if (collision.roughness) text += fmt::format("; roughness {:.6g}, so that disks spin", *collision.roughness);
  if (collision.elastic_below) {
    text += fmt::format("; elastic within time {:.6g} of a partner's last collision", *collision.elastic_below);
  }
  return text;
}

std::string words(const WallProperties& wall, int axis) {
  std::vector<std::string> parts;
  if (wall.mass) parts.push_back(fmt::format("a free piston of mass {:.6g} under load {:.6g}", *wall.mass, *wall.load));
  if (wall.temperature) parts.push_back(fmt::format("velocities drawn anew at kT = {:.6g}", *wall.temperature));
  if (wall.restitution) parts.push_back(fmt::format("restitution {:.6g}", *wall.restitution));
  if (wall.velocity) parts.push_back(fmt::format("moves at {:.6g} in {}", *wall.velocity, axis == 0 ? "x" : "y"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string words(const std::vector<Obstacle>& obstacles) {
  const auto is_disk = [](const Obstacle& obstacle) { return std::holds_alternative<DiskObstacle>(obstacle.shape); };
  const auto disks = static_cast<std::uint64_t>(std::count_if(obstacles.begin(), obstacles.end(), is_disk));
  const std::uint64_t segments = obstacles.size() - disks;
  std::vector<std::string> parts;
  if (disks > 0) parts.push_back(counted(disks, "fixed disk"));
  if (segments > 0) parts.push_back(counted(segments, "fixed segment"));
  return fmt::format("{}", fmt::join(parts, " and "));
}

std::string words(const Growth& growth) {
  std::string text = fmt::format("all radii grow at rate {:.6g} of their first size", growth.rate);
  if (growth.packing_fraction) text += fmt::format(", until packing fraction {:.6g}", *growth.packing_fraction);
  if (growth.reduced_pressure) text += fmt::format(", until reduced pressure {:.6g}", *growth.reduced_pressure);
  return text;
}

std::string words(const SquareWell& well) {
  return fmt::format("{} {:.6g} from one to {:.6g} diameters apart",
                     well.depth < 0.0 ? "a repulsive shoulder of height" : "an attractive well of depth", std::abs(well.depth),
                     well.width);
}

}  // namespace

SummaryRows words_of(const Effects& effects) {
  SummaryRows rows;
  const auto put = [&](const char* subject, std::string text) { rows.push_back({subject, std::move(text)}); };
  put("collisions", words(effects.collision));
  if (effects.gravity) {
    const Eigen::Vector2d& g = effects.gravity->acceleration;
    put("gravity", fmt::format("acceleration ({:.6g}, {:.6g})", g.x(), g.y()));
  }
  for (std::size_t w = 0; w < effects.walls.size(); ++w) {
    if (!effects.walls[w].present()) continue;
    put("wall", fmt::format("{}: {}", wall_names[w], words(effects.walls[w], axis_of_wall(w))));
  }
  if (!effects.obstacles.empty()) put("obstacles", words(effects.obstacles));
  if (effects.growth) put("growth", words(*effects.growth));
  if (effects.thermostat) {
    put("thermostat", fmt::format("each disk's velocity is drawn anew at kT = {:.6g}, at rate {:.6g}",
                                  effects.thermostat->temperature, effects.thermostat->rate));
  }
  if (effects.shear) put("shear", fmt::format("the flow is v_x = {:.6g} y (Lees-Edwards)", effects.shear->rate));
  if (effects.square_well) put("square well", words(*effects.square_well));
  return rows;
}

std::string absent(const Effects& effects) {
  std::vector<const char*> names;
  const auto put = [&](bool present, const char* name) {
    if (!present) names.push_back(name);
  };
  put(effects.collision.restitution.has_value(), "loss of energy in collisions");
  put(effects.collision.roughness.has_value(), "friction and spin");
  put(effects.gravity.has_value(), "gravity");
  put(any_wall(effects, [](const WallProperties& wall) { return wall.present(); }), "moving, thermal or inelastic walls");
  put(!effects.obstacles.empty(), "obstacles");
  put(effects.growth.has_value(), "growth");
  put(effects.thermostat.has_value(), "a thermostat");
  put(effects.shear.has_value(), "shear");
  put(effects.square_well.has_value(), "attraction at a distance");
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace carom
