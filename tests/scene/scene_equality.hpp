#pragma once
// Whether two scenes ask for the same, to the last bit: all fields but text, source, locations and overrides.

#include "scene/changes.hpp"

#include <carom/scene.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom::test {

inline bool same_bits(double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); }
inline bool same_bits(const std::optional<double>& x, const std::optional<double>& y) {
  return x.has_value() == y.has_value() && (!x || same_bits(*x, *y));
}
inline bool same_bits(const Eigen::Vector2d& x, const Eigen::Vector2d& y) {
  return same_bits(x[0], y[0]) && same_bits(x[1], y[1]);
}

inline bool same_shape(const Obstacle& a, const Obstacle& b) {
  if (a.index() != b.index()) return false;
  if (const auto* disk = std::get_if<DiskObstacle>(&a)) {
    const auto& other = std::get<DiskObstacle>(b);
    return same_bits(disk->centre, other.centre) && same_bits(disk->radius, other.radius);
  }
  if (const auto* arc = std::get_if<ArcObstacle>(&a)) {
    const auto& other = std::get<ArcObstacle>(b);
    return same_bits(arc->centre, other.centre) && same_bits(arc->radius, other.radius) && same_bits(arc->from, other.from) &&
           same_bits(arc->to, other.to);
  }
  const auto &segment = std::get<SegmentObstacle>(a), &other = std::get<SegmentObstacle>(b);
  return same_bits(segment.from, other.from) && same_bits(segment.to, other.to);
}

/// The name of the first effect in which two scenes differ; empty where they call for the same.
inline std::string first_difference(const Effects& a, const Effects& b) {
  const auto differ = [](const auto& x, const auto& y, const auto&... members) {
    if (x.has_value() != y.has_value()) return true;
    return x && !(same_bits((*x).*members, (*y).*members) && ...);
  };
  const Collision &c = a.collision, &d = b.collision;
  if (c.rule != d.rule) return "collision.rule";
  if (!same_bits(c.restitution, d.restitution)) return "collision.restitution";
  if (!same_bits(c.roughness, d.roughness)) return "collision.roughness";
  if (!same_bits(c.elastic_below, d.elastic_below)) return "collision.elastic_below";
  if (differ(a.gravity, b.gravity, &Gravity::acceleration)) return "gravity";
  for (std::size_t w = 0; w < a.walls.size(); ++w) {
    const WallProperties &x = a.walls[w], &y = b.walls[w];
    if (!same_bits(x.restitution, y.restitution) || !same_bits(x.temperature, y.temperature) ||
        !same_bits(x.velocity, y.velocity) || !same_bits(x.tangential_velocity, y.tangential_velocity) ||
        !same_bits(x.vibration, y.vibration) || x.oscillation != y.oscillation || !same_bits(x.mass, y.mass) ||
        !same_bits(x.load, y.load)) {
      return "walls." + std::to_string(w);
    }
  }
  if (a.circle.has_value() != b.circle.has_value()) return "box.circle";
  if (a.circle && !(same_bits(a.circle->centre, b.circle->centre) && same_bits(a.circle->radius, b.circle->radius)))
    return "numbers of box.circle";
  if (a.obstacles.size() != b.obstacles.size()) return "number of obstacles";
  for (std::size_t o = 0; o < a.obstacles.size(); ++o) {
    if (!same_shape(a.obstacles[o], b.obstacles[o])) return "obstacles." + std::to_string(o);
  }
  if (differ(a.growth, b.growth, &Growth::rate, &Growth::packing_fraction, &Growth::reduced_pressure)) return "growth";
  if (differ(a.thermostat, b.thermostat, &Thermostat::temperature, &Thermostat::rate)) return "thermostat";
  if (differ(a.tumbling, b.tumbling, &Tumbling::rate)) return "tumbling";
  if (differ(a.brownian, b.brownian, &Brownian::temperature, &Brownian::rate)) return "brownian";
  if (differ(a.shear, b.shear, &Shear::rate)) return "shear";
  if (differ(a.square_well, b.square_well, &SquareWell::width, &SquareWell::depth)) return "square_well";
  if (differ(a.non_additivity, b.non_additivity, &NonAdditivity::delta)) return "non_additivity";
  if (a.non_additivity && a.non_additivity->pairs != b.non_additivity->pairs) return "pairs of non_additivity";
  const auto steps = [](const Effects& effects) {
    return effects.stepped_potential ? effects.stepped_potential->steps : std::vector<PotentialStep>{};
  };
  const auto same_step = [](const PotentialStep& s, const PotentialStep& t) {
    return s.width == t.width && s.energy == t.energy;
  };
  if (a.stepped_potential.has_value() != b.stepped_potential.has_value() || !std::ranges::equal(steps(a), steps(b), same_step))
    return "stepped_potential";
  return {};
}

/// The name of the first field in which the scenes differ; empty where they are the same.
inline std::string first_difference(const Scene& a, const Scene& b) {
  const auto same_list = [](const auto& x, const auto& y) {
    return std::ranges::equal(x, y, [](const auto& one, const auto& other) { return same_bits(one, other); });
  };
  if (a.title != b.title) return "title";
  if (!same_bits(a.box.lower, b.box.lower) || !same_bits(a.box.upper, b.box.upper)) return "box limits";
  if (a.box.boundary != b.box.boundary) return "box.boundary";
  if (const std::string difference = first_difference(a.effects, b.effects); !difference.empty()) return difference;
  if (!same_bits(a.run.time, b.run.time)) return "run.time";
  if (a.run.collisions != b.run.collisions) return "run.collisions";
  if (!same_bits(a.run.sample_every, b.run.sample_every)) return "run.sample_every";
  if (a.run.sample_every_collisions != b.run.sample_every_collisions) return "run.sample_every's collisions";
  if (a.run.sample_log.has_value() != b.run.sample_log.has_value()) return "run.sample_log";
  if (a.run.sample_log &&
      (!same_bits(a.run.sample_log->base, b.run.sample_log->base) || a.run.sample_log->per_block != b.run.sample_log->per_block ||
       !same_bits(a.run.sample_log->block, b.run.sample_log->block)))
    return "run.sample_log's value";
  if (a.run.equilibrate.has_value() != b.run.equilibrate.has_value()) return "run.equilibrate";
  if (a.run.equilibrate && (!same_bits(a.run.equilibrate->time, b.run.equilibrate->time) ||
                            !same_bits(a.run.equilibrate->collisions_per_disk, b.run.equilibrate->collisions_per_disk))) {
    return "run.equilibrate's value";
  }
  if (a.run.seed != b.run.seed || a.run.keep_momentum != b.run.keep_momentum) return "run.seed or run.keep_momentum";
  if (a.run.accept_overlap != b.run.accept_overlap) return "run.accept_overlap";
  const Output &p = a.output, &q = b.output;
  if (p.trajectory != q.trajectory || p.xyz != q.xyz || p.csv != q.csv || p.events != q.events || p.unwrapped != q.unwrapped) {
    return "output";
  }
  if (a.observe.size() != b.observe.size()) return "number of observables";
  for (std::size_t k = 0; k < a.observe.size(); ++k) {
    const ObservableRequest &x = a.observe[k], &y = b.observe[k];
    if (x.name != y.name || !same_bits(x.every, y.every) || x.bins != y.bins || !same_bits(x.range, y.range) ||
        !same_bits(x.largest, y.largest) || x.axis != y.axis || x.disks != y.disks || x.cells != y.cells ||
        !same_list(x.wave_numbers, y.wave_numbers)) {
      return "observe." + x.name;
    }
  }
  if (a.changes.size() != b.changes.size()) return "number of changes";
  for (std::size_t k = 0; k < a.changes.size(); ++k)
    if (changes_text(a.changes[k]) != changes_text(b.changes[k])) return "changes." + std::to_string(k);
  if (a.species.size() != b.species.size()) return "number of species";
  for (std::size_t s = 0; s < a.species.size(); ++s) {
    const Species &x = a.species[s], &y = b.species[s];
    const std::string at = "disks." + std::to_string(s);
    if (x.name != y.name || x.count != y.count) return at + " name or count";
    if (!same_bits(x.radius, y.radius) || !same_list(x.radii, y.radii)) return at + " radius";
    if (!same_bits(x.mass, y.mass) || !same_list(x.masses, y.masses)) return at + " mass";
    if (x.positions.index() != y.positions.index()) return at + " kind of positions";
    if (const auto* random = std::get_if<RandomPositions>(&x.positions)) {
      const auto& other = std::get<RandomPositions>(y.positions).region;
      if (random->region.has_value() != other.has_value()) return at + " region";
      if (other && random->region->index() != other->index()) return at + " kind of region";
      if (other && std::holds_alternative<CircleRegion>(*other)) {
        const auto &mine = std::get<CircleRegion>(*random->region), &its = std::get<CircleRegion>(*other);
        if (!same_bits(mine.centre, its.centre) || !same_bits(mine.radius, its.radius)) return at + " circle";
      } else if (other) {
        const auto &mine = std::get<RectangleRegion>(*random->region), &its = std::get<RectangleRegion>(*other);
        if (!same_bits(mine.lower, its.lower) || !same_bits(mine.upper, its.upper)) return at + " rectangle";
      }
    }
    if (const auto* list = std::get_if<ListedPositions>(&x.positions)) {
      if (!same_list(list->values, std::get<ListedPositions>(y.positions).values)) return at + " positions";
    }
    if (const auto* file = std::get_if<FilePositions>(&x.positions)) {
      const auto& other = std::get<FilePositions>(y.positions);
      if (file->path != other.path || !same_list(file->values, other.values)) return at + " start file";
    }
    if (const auto* grown = std::get_if<GrownPositions>(&x.positions)) {
      if (!same_bits(grown->packing_fraction, std::get<GrownPositions>(y.positions).packing_fraction))
        return at + " packing fraction";
    }
    if (x.velocities.index() != y.velocities.index()) return at + " kind of velocities";
    const bool same_velocities = std::visit(
        [&](const auto& law) {
          using Law = std::decay_t<decltype(law)>;
          const auto& other = std::get<Law>(y.velocities);
          if constexpr (std::is_same_v<Law, UniformVelocities>)
            return same_bits(law.maximum, other.maximum);
          else if constexpr (std::is_same_v<Law, MaxwellVelocities>)
            return same_bits(law.temperature, other.temperature);
          else if constexpr (std::is_same_v<Law, FixedSpeed>)
            return same_bits(law.speed, other.speed);
          else if constexpr (std::is_same_v<Law, AtRest>)
            return true;
          else
            return same_list(law.values, other.values);
        },
        x.velocities);
    if (!same_velocities) return at + " velocities";
  }
  return {};
}

}  // namespace carom::test
