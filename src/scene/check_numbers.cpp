// Numbers and lists that a program gave: those of a file are within their bounds, and of the right length, when they have been
// read.

#include "scene/checks.hpp"
#include "scene/number_keys.hpp"
#include "scene/wall_names.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

namespace carom::detail {
namespace {

/// Checks a number of the key `key` in its table; does nothing where the number is absent.
void require(const std::string& table, const std::optional<double>& value, const NumberKey& key) {
  if (value && !key.holds(*value)) refuse_number(fmt::format("{}.{}", table, key.name), *value, key);
}
void require_pair(const std::string& path, const Eigen::Vector2d& pair, std::string_view example) {
  if (pair.allFinite()) return;
  const int axis = std::isfinite(pair[0]) ? 1 : 0;
  refuse_number(fmt::format("{}.{}", path, axis), pair[axis], {"", example});
}
void require_pairs(const std::string& path, const std::vector<Eigen::Vector2d>& pairs, std::string_view example) {
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!pairs[i].allFinite()) require_pair(fmt::format("{}.{}", path, i), pairs[i], example);
}

/// Checks a list that replaces the number for all disks of a species: empty, or one entry per disk.
void check_list(const std::string& path, const std::vector<double>& list, std::int64_t count, const NumberKey& key) {
  if (!list.empty() && static_cast<std::int64_t>(list.size()) != count)
    throw Refusal(path, fmt::format("{} has length {}, but there are {} disks; give one {} per disk, or none", path, list.size(),
                                    count, key.name));
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!key.holds(list[i])) refuse_number(fmt::format("{}.{}", path, i), list[i], key);
}

void check_positions(const std::string& path, const Species& species) {
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        if constexpr (requires { kind.values; }) {
          if (static_cast<std::int64_t>(kind.values.size()) != species.count)
            throw Refusal(path + ".count", unequal_counts(path + ".count", species.count, kind.values.size()));
          require_pairs(path + ".positions", kind.values, keys::position_example);
        }
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
  check_list(path + ".radii", species.radii, species.count, keys::radius);
  check_list(path + ".masses", species.masses, species.count, keys::mass);
  if (species.radii.empty() && species.count > 0) require(path, species.radius, keys::radius);
  if (species.masses.empty() && species.count > 0) require(path, species.mass, keys::mass);
  check_positions(path, species);
  check_velocities(path + ".velocities", species);
}

void check_wall(const std::string& path, const WallProperties& wall) {
  require(path, wall.restitution, keys::wall_restitution);
  require(path, wall.temperature, keys::wall_temperature);
  require(path, wall.velocity, keys::wall_velocity);
  require(path, wall.mass, keys::piston_mass);
  require(path, wall.load, keys::piston_load);
}

void check_obstacle(const std::string& path, const Obstacle& obstacle) {
  if (const auto* disk = std::get_if<DiskObstacle>(&obstacle.shape)) {
    require_pair(path + ".disk.centre", disk->centre, keys::disk_example);
    require(path + ".disk", disk->radius, keys::obstacle_radius);
  } else {
    require_pair(path + ".segment.from", std::get<SegmentObstacle>(obstacle.shape).from, keys::segment_example);
    require_pair(path + ".segment.to", std::get<SegmentObstacle>(obstacle.shape).to, keys::segment_example);
  }
}

void check_numbers_of(const Effects& effects) {
  require("collision", effects.collision.restitution, keys::restitution);
  require("collision", effects.collision.roughness, keys::roughness);
  require("collision.elastic_below", effects.collision.elastic_below, keys::elastic_below);
  if (effects.gravity) require_pair("gravity.acceleration", effects.gravity->acceleration, keys::acceleration_example);
  for (std::size_t w = 0; w < effects.walls.size(); ++w) check_wall(fmt::format("walls.{}", wall_names[w]), effects.walls[w]);
  for (std::size_t k = 0; k < effects.obstacles.size(); ++k) check_obstacle(fmt::format("obstacles.{}", k), effects.obstacles[k]);
  if (const auto& growth = effects.growth) {
    require("growth", growth->rate, keys::growth_rate);
    require("growth.until", growth->packing_fraction, keys::until_fraction);
    require("growth.until", growth->reduced_pressure, keys::until_pressure);
  }
  if (const auto& thermostat = effects.thermostat) {
    require("thermostat", thermostat->temperature, keys::bath_temperature);
    require("thermostat", thermostat->rate, keys::bath_rate);
  }
  if (effects.shear) require("shear", effects.shear->rate, keys::shear_rate);
  if (const auto& well = effects.square_well) {
    require("square_well", well->width, keys::well_width);
    require("square_well", well->depth, keys::well_depth);
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
