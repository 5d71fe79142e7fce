// Writes the tables of the effects: doubles with as many digits as it takes to read the same bits again.

#include "scene/resolved_effects.hpp"

#include "scene/effect_traits.hpp"
#include "scene/value_text.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <vector>

namespace carom::detail {
namespace {

std::string line(std::string_view key, double value) { return fmt::format("{} = {}\n", key, number_text(value)); }

std::string line(std::string_view key, const std::optional<double>& value) { return value ? line(key, *value) : std::string(); }

std::string collision(const Collision& collision) {
  std::string text =
      fmt::format("\n[collision]\nrule = \"{}\"\n", collision.rule == CollisionRule::reversal ? "reversal" : "specular");
  text += line("restitution", collision.restitution) + line("roughness", collision.roughness);
  if (collision.elastic_below) text += fmt::format("elastic_below = {{ time = {} }}\n", number_text(*collision.elastic_below));
  return text;
}

std::string wall(const char* name, const WallProperties& wall) {
  std::vector<std::string> entries;
  const auto put = [&](const char* key, const std::optional<double>& value) {
    if (value) entries.push_back(fmt::format("{} = {}", key, number_text(*value)));
  };
  put("restitution", wall.restitution);
  put("temperature", wall.temperature);
  put("velocity", wall.velocity);
  put("tangential_velocity", wall.tangential_velocity);
  put("vibration", wall.vibration);
  if (const auto& motion = wall.oscillation)
    entries.push_back(fmt::format("vibration = {{ form = \"{}\", amplitude = {}, frequency = {}, phase = {} }}",
                                  motion->form == WaveForm::sine ? "sine" : "sawtooth", number_text(motion->amplitude),
                                  number_text(motion->frequency), number_text(motion->phase)));
  put("mass", wall.mass);
  put("load", wall.load);
  return fmt::format("{} = {{ {} }}\n", name, fmt::join(entries, ", "));
}

std::string walls(const std::array<WallProperties, 4>& walls) {
  std::string text;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (walls[w].present()) text += wall(wall_names[w], walls[w]);
  }
  return text.empty() ? text : "\n[walls]\n" + text;
}

std::string stepped_potential(const SteppedPotential& potential) {
  std::vector<std::string> entries;
  for (const PotentialStep& step : potential.steps)
    entries.push_back(fmt::format("{{ width = {}, energy = {} }}", number_text(step.width), number_text(step.energy)));
  return fmt::format("\n[stepped_potential]\nsteps = [{}]\n", fmt::join(entries, ", "));
}

std::string until(const Growth& growth) {
  const auto end = [](const char* key, double value) { return fmt::format("until = {{ {} = {} }}\n", key, number_text(value)); };
  if (growth.packing_fraction) return end("packing_fraction", *growth.packing_fraction);
  return growth.reduced_pressure ? end("pressure", *growth.reduced_pressure) : std::string();
}

std::string pairs(const std::vector<NonAdditivity::Pair>& pairs) {
  if (pairs.empty()) return {};
  std::vector<std::string> entries;
  for (const NonAdditivity::Pair& pair : pairs)
    entries.push_back(
        fmt::format("{{ species = [{}, {}], delta = {} }}", pair.species[0], pair.species[1], number_text(pair.delta)));
  return fmt::format("pairs = [{}]\n", fmt::join(entries, ", "));
}

}  // namespace

std::string pair_text(const Eigen::Vector2d& value) {
  return fmt::format("[{}, {}]", number_text(value.x()), number_text(value.y()));
}

std::string obstacle_text(const Obstacle& obstacle) {
  if (const auto* disk = std::get_if<DiskObstacle>(&obstacle))
    return fmt::format("disk = {{ centre = {}, radius = {} }}", pair_text(disk->centre), number_text(disk->radius));
  if (const auto* arc = std::get_if<ArcObstacle>(&obstacle))
    return fmt::format("arc = {{ centre = {}, radius = {}, from = {}, to = {} }}", pair_text(arc->centre),
                       number_text(arc->radius), number_text(arc->from), number_text(arc->to));
  const auto& segment = std::get<SegmentObstacle>(obstacle);
  return fmt::format("segment = {{ from = {}, to = {} }}", pair_text(segment.from), pair_text(segment.to));
}

std::string effects_toml(const Effects& effects) {
  std::string text = collision(effects.collision);
  if (effects.gravity) text += fmt::format("\n[gravity]\nacceleration = {}\n", pair_text(effects.gravity->acceleration));
  text += walls(effects.walls);
  for (const Obstacle& each : effects.obstacles) text += fmt::format("\n[[obstacles]]\n{}\n", obstacle_text(each));
  if (effects.stepped_potential) text += stepped_potential(*effects.stepped_potential);
  for (const EffectTraits& effect : all_effects()) {
    if (effect.numbers.empty() || !effect.is_present(effects)) continue;
    text += fmt::format("\n[{}]\n", effect.name);
    for (const EffectNumber& number : effect.numbers) text += line(number.key->name, number.value(effects));
    if (effect.name == "growth") text += until(*effects.growth);
    if (effect.name == "non_additivity") text += pairs(effects.non_additivity->pairs);
  }
  return text;
}

}  // namespace carom::detail
