#pragma once
// Whether two scenes ask for the same, to the last bit: all fields but text, source, locations and overrides.

#include <carom/scene.hpp>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::testing_support {

/// The name of the first field in which the scenes differ; empty where they are the same.
inline std::string first_difference(const Scene& a, const Scene& b) {
  const auto same = [](double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); };
  const auto same_maybe = [&](const auto& x, const auto& y) { return x.has_value() == y.has_value() && (!x || same(*x, *y)); };
  const auto same_pair = [&](const Eigen::Vector2d& x, const Eigen::Vector2d& y) { return same(x[0], y[0]) && same(x[1], y[1]); };
  const auto same_list = [&](const auto& x, const auto& y, const auto& same_entry) {
    if (x.size() != y.size()) return false;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!same_entry(x[i], y[i])) return false;
    }
    return true;
  };
  if (a.title != b.title) return "title";
  if (!same_pair(a.box.lower, b.box.lower) || !same_pair(a.box.upper, b.box.upper)) return "box limits";
  if (a.box.boundary != b.box.boundary) return "box.boundary";
  if (a.effects.collision.rule != b.effects.collision.rule) return "collision.rule";
  if (!same_maybe(a.run.time, b.run.time)) return "run.time";
  if (a.run.collisions != b.run.collisions) return "run.collisions";
  if (!same_maybe(a.run.sample_every, b.run.sample_every)) return "run.sample_every";
  if (a.run.equilibrate.has_value() != b.run.equilibrate.has_value()) return "run.equilibrate";
  if (a.run.equilibrate && (!same_maybe(a.run.equilibrate->time, b.run.equilibrate->time) ||
                            !same_maybe(a.run.equilibrate->collisions_per_disk, b.run.equilibrate->collisions_per_disk))) {
    return "run.equilibrate's value";
  }
  if (a.run.seed != b.run.seed || a.run.keep_momentum != b.run.keep_momentum) return "run.seed or run.keep_momentum";
  const Output &p = a.output, &q = b.output;
  if (p.trajectory != q.trajectory || p.xyz != q.xyz || p.csv != q.csv || p.events != q.events || p.unwrapped != q.unwrapped) {
    return "output";
  }
  if (a.species.size() != b.species.size()) return "number of species";
  for (std::size_t s = 0; s < a.species.size(); ++s) {
    const Species &x = a.species[s], &y = b.species[s];
    const std::string at = "disks." + std::to_string(s);
    if (x.name != y.name || x.count != y.count) return at + " name or count";
    if (!same(x.radius, y.radius) || !same_list(x.radii, y.radii, same)) return at + " radius";
    if (!same(x.mass, y.mass) || !same_list(x.masses, y.masses, same)) return at + " mass";
    if (x.positions.index() != y.positions.index()) return at + " kind of positions";
    if (const auto* list = std::get_if<ListedPositions>(&x.positions)) {
      if (!same_list(list->values, std::get<ListedPositions>(y.positions).values, same_pair)) return at + " positions";
    }
    if (const auto* file = std::get_if<FilePositions>(&x.positions)) {
      const auto& other = std::get<FilePositions>(y.positions);
      if (file->path != other.path || !same_list(file->values, other.values, same_pair)) return at + " start file";
    }
    if (x.velocities.index() != y.velocities.index()) return at + " kind of velocities";
    const bool same_velocities = std::visit(
        [&](const auto& law) {
          using Law = std::decay_t<decltype(law)>;
          const auto& other = std::get<Law>(y.velocities);
          if constexpr (std::is_same_v<Law, UniformVelocities>)
            return same(law.maximum, other.maximum);
          else if constexpr (std::is_same_v<Law, MaxwellVelocities>)
            return same(law.temperature, other.temperature);
          else if constexpr (std::is_same_v<Law, FixedSpeed>)
            return same(law.speed, other.speed);
          else if constexpr (std::is_same_v<Law, AtRest>)
            return true;
          else
            return same_list(law.values, other.values, same_pair);
        },
        x.velocities);
    if (!same_velocities) return at + " velocities";
  }
  return {};
}

}  // namespace carom::testing_support
