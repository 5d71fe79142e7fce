// Describes each effect of a scene in words, with its numbers.

#include "pages/effects_words.hpp"

#include "scene/effect_traits.hpp"
#include "scene/wall_names.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace carom {

namespace {

std::string words(const Collision& collision) {
  std::string text = collision.rule == CollisionRule::reversal
                         ? "reversal: a collision reverses the whole relative velocity"
                         : "specular: a collision reverses the relative velocity along the line of centres";
  if (collision.restitution) text += fmt::format("; restitution {:.6g}", *collision.restitution);
  if (collision.roughness) text += fmt::format("; roughness {:.6g}: disks spin", *collision.roughness);
  if (collision.elastic_below) {
    text += fmt::format("; elastic within time {:.6g} of the last collision of either disk", *collision.elastic_below);
  }
  return text;
}

std::string words(const WallProperties& wall, int axis) {
  std::vector<std::string> parts;
  if (wall.mass) parts.push_back(fmt::format("a free piston of mass {:.6g} under load {:.6g}", *wall.mass, *wall.load));
  if (wall.temperature) parts.push_back(fmt::format("thermal, kT = {:.6g}", *wall.temperature));
  if (wall.restitution) parts.push_back(fmt::format("restitution {:.6g}", *wall.restitution));
  if (wall.velocity) parts.push_back(fmt::format("moves at {:.6g} in {}", *wall.velocity, axis == 0 ? "x" : "y"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string words(const std::vector<Obstacle>& obstacles) {
  const auto is_disk = [](const Obstacle& obstacle) { return std::holds_alternative<DiskObstacle>(obstacle); };
  const auto disks = static_cast<std::uint64_t>(std::count_if(obstacles.begin(), obstacles.end(), is_disk));
  const std::uint64_t segments = obstacles.size() - disks;
  std::vector<std::string> parts;
  if (disks > 0) parts.push_back(counted(disks, "fixed disk"));
  if (segments > 0) parts.push_back(counted(segments, "fixed segment"));
  return fmt::format("{}", fmt::join(parts, " and "));
}

}  // namespace

SummaryRows words_of(const Effects& effects) {
  SummaryRows rows;
  const auto put = [&](const char* subject, std::string text) { rows.push_back({subject, std::move(text)}); };
  put("collisions", words(effects.collision));
  for (std::size_t w = 0; w < effects.walls.size(); ++w) {
    if (!effects.walls[w].present()) continue;
    put("wall", fmt::format("{}: {}", wall_names[w], words(effects.walls[w], axis_of_wall(w))));
  }
  if (!effects.obstacles.empty()) put("obstacles", words(effects.obstacles));
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    if (effect.words == nullptr || !effect.is_present(effects)) continue;
    std::string subject(effect.name);
    std::replace(subject.begin(), subject.end(), '_', ' ');
    rows.push_back({std::move(subject), effect.words(effects)});
  }
  return rows;
}

std::string absent(const Effects& effects) {
  std::vector<std::string_view> names;
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    const auto is_there = [&](const detail::EffectTraits& other) {
      return other.absence == effect.absence && other.is_present(effects);
    };
    if (effect.absence.empty() || std::ranges::find(names, effect.absence) != names.end()) continue;
    if (std::ranges::none_of(detail::all_effects(), is_there)) names.push_back(effect.absence);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string conserved(const Box& box, const Effects& effects) {
  using detail::EffectTraits;
  const auto all_conserve = [&](bool EffectTraits::*trait) {
    return std::ranges::none_of(detail::all_effects(),
                                [&](const EffectTraits& effect) { return !(effect.*trait) && effect.acts(effects); });
  };
  const bool x = conserves_momentum(box, effects, 0), y = conserves_momentum(box, effects, 1);
  std::vector<std::string_view> names;
  if (all_conserve(&EffectTraits::conserves_energy)) names.emplace_back("energy");
  if (x || y) names.emplace_back(x && y ? "momentum" : x ? "momentum along x" : "momentum along y");
  if (effects.collision.rule == CollisionRule::specular && all_conserve(&EffectTraits::conserves_angular_momentum))
    names.emplace_back("angular momentum in collisions of disks");
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace carom
