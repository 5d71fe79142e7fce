// Numbers and lists that a program gave: those of a file are within their bounds, and of the right length, when they have been
// read.

#include "scene/checks.hpp"
#include "scene/effect_traits.hpp"
#include "scene/number_keys.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <variant>

namespace carom::detail {
namespace {

void require_pairs(const std::string& path, const std::vector<Eigen::Vector2d>& pairs, std::string_view example) {
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!pairs[i].allFinite()) require_pair(fmt::format("{}.{}", path, i), pairs[i], example);
}

/// Checks a list that replaces the number for all disks of a species: empty, or one entry per disk.
void check_list(const std::string& path, const std::vector<double>& list, std::int64_t count, const NumberKey& key) {
  if (!list.empty() && static_cast<std::int64_t>(list.size()) != count)
    throw Refusal(path, unequal_list(path, list.size(), count, key.name));
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!key.holds(list[i])) refuse_number(fmt::format("{}.{}", path, i), list[i], key);
}

void check_region(const std::string& path, const std::variant<RectangleRegion, CircleRegion>& region) {
  if (const auto* circle = std::get_if<CircleRegion>(&region)) {
    require_pair(path + ".centre", circle->centre, keys::region_circle_example);
    require(path, circle->radius, keys::region_radius);
    return;
  }
  const auto& rectangle = std::get<RectangleRegion>(region);
  for (int axis = 0; axis < 2; ++axis) {
    const double lower = rectangle.lower[axis], upper = rectangle.upper[axis];
    const std::string limits = fmt::format("{}.{}", path, axis_names[axis]);
    require_pair(limits, {lower, upper}, keys::rectangle_example);
    if (!(lower < upper))
      throw Refusal(limits, fmt::format("{} runs from {} to {}; the lower limit must come first, such as {}", limits, lower,
                                        upper, keys::rectangle_example));
  }
}

void check_positions(const std::string& path, const Species& species) {
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        if constexpr (requires { kind.values; }) {
          if (static_cast<std::int64_t>(kind.values.size()) != species.count)
            throw Refusal(path + ".count", unequal_counts(path + ".count", species.count, kind.values.size()));
          require_pairs(path + ".positions", kind.values, keys::position_example);
        }
        if constexpr (std::is_same_v<Kind, RandomPositions>)
          if (kind.region) check_region(path + ".positions.random", *kind.region);
        if constexpr (std::is_same_v<Kind, GrownPositions>)
          require(path + ".positions", kind.packing_fraction, keys::grown_fraction);
      },
      species.positions);
}

void check_velocities(const std::string& path, const Species& species) {
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        if constexpr (requires { kind.values; }) {
          if (static_cast<std::int64_t>(kind.values.size()) != species.count)
            throw Refusal(path, fmt::format("{} has length {}, but there are {} disks; give one [vx, vy] per disk", path,
                                            kind.values.size(), species.count));
          require_pairs(path, kind.values, keys::velocity_example);
        }
        if constexpr (std::is_same_v<Kind, UniformVelocities>) require(path, kind.maximum, keys::uniform);
        if constexpr (std::is_same_v<Kind, MaxwellVelocities>) require(path, kind.temperature, keys::start_temperature);
        if constexpr (std::is_same_v<Kind, FixedSpeed>) require(path, kind.speed, keys::speed);
      },
      species.velocities);
}

void check_species(const std::string& path, const Species& species) {
  check_count(species.count, path + ".count");
  check_list(path + ".radius", species.radii, species.count, keys::radius);
  check_list(path + ".mass", species.masses, species.count, keys::mass);
  if (species.radii.empty() && species.count > 0) require(path, species.radius, keys::radius);
  if (species.masses.empty() && species.count > 0) require(path, species.mass, keys::mass);
  check_positions(path, species);
  check_velocities(path + ".velocities", species);
}

void check_wall(const std::string& path, const WallProperties& wall) {
  require(path, wall.restitution, keys::wall_restitution);
  require(path, wall.temperature, keys::wall_temperature);
  require(path, wall.velocity, keys::wall_velocity);
  require(path, wall.tangential_velocity, keys::tangential_velocity);
  require(path, wall.vibration, keys::vibration);
  if (wall.oscillation) {
    const std::string table = path + ".vibration";
    require(table, wall.oscillation->amplitude, keys::oscillation_amplitude);
    require(table, wall.oscillation->frequency, keys::oscillation_frequency);
    require(table, wall.oscillation->phase, keys::oscillation_phase);
  }
  require(path, wall.mass, keys::piston_mass);
  require(path, wall.load, keys::piston_load);
}

void check_numbers_of(const Effects& effects) {
  require("collision", effects.collision.restitution, keys::restitution);
  require("collision", effects.collision.roughness, keys::roughness);
  require("collision.elastic_below", effects.collision.elastic_below, keys::elastic_below);
  for (std::size_t w = 0; w < effects.walls.size(); ++w) check_wall(fmt::format("walls.{}", wall_names[w]), effects.walls[w]);
  if (effects.stepped_potential)
    for (std::size_t k = 0; k < effects.stepped_potential->steps.size(); ++k) {
      require(path_of_step(k), effects.stepped_potential->steps[k].width, keys::step_width);
      require(path_of_step(k), effects.stepped_potential->steps[k].energy, keys::step_energy);
    }
  for (const EffectTraits& effect : all_effects()) {
    if (!effect.is_present(effects)) continue;
    for (const EffectNumber& number : effect.numbers) require(std::string(effect.name), number.value(effects), *number.key);
  }
}

void check_numbers_of(const Run& run) {
  require("run", run.time, keys::run_time);
  require("run", run.sample_every, keys::sample_every);
  if (run.sample_log) {
    require("run.sample_log", run.sample_log->base, keys::log_base);
    require("run.sample_log", run.sample_log->block, keys::log_block);
  }
  if (run.equilibrate) {
    require("run.equilibrate", run.equilibrate->collisions_per_disk, keys::equilibrate_collisions);
    require("run.equilibrate", run.equilibrate->time, keys::equilibrate_time);
  }
}

}  // namespace

void check_count(std::int64_t count, const std::string& path) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (count < 0)
    throw Refusal(path, fmt::format("{} is an integer ({}); it must be a whole number, zero or more, such as {}", path, count,
                                    keys::count_example));
  if (count > most) throw Refusal(path, fmt::format("{} is {}; at most {} disks can be numbered", path, count, most));
}

void check_numbers(const Scene& scene) {
  require_pair("box.x", {scene.box.lower.x(), scene.box.upper.x()}, keys::limits_example[0]);
  require_pair("box.y", {scene.box.lower.y(), scene.box.upper.y()}, keys::limits_example[1]);
  for (std::size_t s = 0; s < scene.species.size(); ++s) check_species(fmt::format("disks.{}", s), scene.species[s]);
  check_numbers_of(scene.effects);
  check_numbers_of(scene.run);
}

}  // namespace carom::detail
