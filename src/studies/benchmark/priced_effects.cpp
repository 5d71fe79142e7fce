#include "studies/benchmark/priced_effects.hpp"

#include "scene/effect_traits.hpp"

#include <fmt/format.h>
#include <carom/simulation.hpp>

#include <algorithm>
#include <cmath>

namespace carom::cli {

namespace {

/// About a hundred small fixed disks in the gaps of the lattice from which the gas starts; none so near the edges that it might
/// lie upon the image of a disk.
std::vector<Obstacle> pegs(const Scene& gas) {
  constexpr double radius = 0.05;
  const double disk = gas.species.front().radius;
  const Eigen::Matrix2Xd disks = make_simulation(gas, "textbook").state().positions;
  const auto room = [&](const Eigen::Vector2d& peg) {
    const bool inside = (peg - gas.box.lower).minCoeff() > 2.0 * disk && (gas.box.upper - peg).minCoeff() > 2.0 * disk;
    return inside && (disks.colwise() - peg).colwise().norm().minCoeff() > disk + radius;
  };
  std::vector<Obstacle> pegs;
  const Eigen::Index apart = std::max<Eigen::Index>(1, disks.cols() / 100);
  for (Eigen::Index i = apart / 2; i < disks.cols(); i += apart) {
    // Somewhere between a disk and those next to it.
    const double spacing = std::sqrt(gas.box.area() / static_cast<double>(disks.cols()));
    for (int k = 0; k < 24; ++k) {
      const double angle = 0.2618 * k;  // 15 degrees
      const Eigen::Vector2d peg = disks.col(i) + 0.62 * spacing * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (!room(peg)) continue;
      pegs.push_back(DiskObstacle{peg, radius});
      break;
    }
  }
  return pegs;
}

Effects with_collision(const Collision& collision) {
  Effects effects;
  effects.collision = collision;
  return effects;
}

Effects with_wall(std::size_t side, const WallProperties& wall) {
  Effects effects;
  effects.walls[side] = wall;
  return effects;
}

WallProperties moving(double velocity) {
  WallProperties wall;
  wall.velocity = velocity;
  return wall;
}

/// A wall that vibrates without amplitude.
WallProperties hitting(double velocity) {
  WallProperties wall;
  wall.vibration = velocity;
  return wall;
}

WallProperties vibrating(WaveForm form, double amplitude) {
  WallProperties wall;
  wall.oscillation = Oscillation{form, amplitude, 1.0};
  return wall;
}

Effects with_gravity(double downwards) {
  Effects effects;
  effects.gravity = Gravity{{0.0, -downwards}};
  return effects;
}

/// Returns an effect that is a table of numbers, at their neutral or mild values.
Effects with(const detail::EffectTraits& effect, double detail::EffectNumber::*value) {
  Effects effects;
  detail::set_numbers(effects, effect, value);
  return effects;
}

/// Returns the mild values in words, in the units of the gas: "width 1.5, depth 0.1 kT".
std::string mild_values(const detail::EffectTraits& effect) {
  std::string text;
  for (const detail::EffectNumber& number : effect.numbers)
    text += fmt::format("{}{} {:g}{}", text.empty() ? "" : ", ", number.key->name, number.mild,
                        number.unit == "1 / time" ? " v_T/sigma"
                        : number.unit == "energy" ? " kT"
                                                  : "");
  return text;
}

/// A shoulder and a well around it, of so much energy each.
Effects with_steps(double energy) {
  Effects effects;
  effects.stepped_potential = SteppedPotential{{{.width = 1.2, .energy = energy}, {.width = 1.5, .energy = -energy}}};
  return effects;
}

Collision restitution(double e, std::optional<double> elastic_below = {}) {
  Collision collision;
  collision.restitution = e;
  collision.elastic_below = elastic_below;
  return collision;
}

Collision roughness(double beta) {
  Collision collision;
  collision.roughness = beta;
  return collision;
}

/// Returns all effects that a scene may name together, at their neutral values.
Effects all_neutral(bool walled) {
  Effects effects = with_gravity(0.0);
  effects.collision = restitution(1.0, 0.0);
  effects.collision.roughness = -1.0;
  for (const detail::EffectTraits& effect : detail::all_effects())
    if (std::ranges::none_of(effect.excludes, &detail::Exclusion::at_neutral_value))
      detail::set_numbers(effects, effect, &detail::EffectNumber::neutral);
  if (walled)
    for (WallProperties& wall : effects.walls) wall.restitution = 1.0, wall.velocity = 0.0;
  return effects;
}

}  // namespace

std::vector<PricedEffect> priced_effects(const Scene& gas) {
  const bool walled = !gas.box.periodic(0);
  std::vector<PricedEffect> all = {{"none, in the general engine", "", Effects{}, {}}};
  if (walled) {
    WallProperties thermal, inelastic, neutral;
    thermal.temperature = 1.0;
    inelastic.restitution = 0.9;
    neutral.restitution = 1.0;
    const double weak = 0.1 / gas.box.lengths().y();
    all.push_back({"gravity", "m g L = 0.1 kT", with_gravity(0.0), with_gravity(weak)});
    all.push_back({"inelastic wall", "e = 0.9, one of four", with_wall(0, neutral), with_wall(0, inelastic)});
    all.push_back({"thermal wall", "kT = 1, one of four", {}, with_wall(0, thermal)});
    all.push_back({"moving wall", "0.001 v_T, one of four", with_wall(3, moving(0.0)), with_wall(3, moving(-0.001))});
    all.push_back(
        {"vibrating wall", "0.01 v_T without amplitude, one of four", with_wall(2, hitting(0.0)), with_wall(2, hitting(0.01))});
    all.push_back({"vibrating wall, sine", "0.01 sigma, 1 v_T/sigma, one of four", with_wall(2, vibrating(WaveForm::sine, 0.0)),
                   with_wall(2, vibrating(WaveForm::sine, 0.01))});
    all.push_back({"vibrating wall, sawtooth", "0.01 sigma, 1 v_T/sigma, one of four",
                   with_wall(2, vibrating(WaveForm::sawtooth, 0.0)), with_wall(2, vibrating(WaveForm::sawtooth, 0.01))});
    all.push_back({"all neutral together", "", all_neutral(true), {}});
    return all;
  }
  all.push_back({"restitution", "e = 0.99", with_collision(restitution(1.0)), with_collision(restitution(0.99))});
  all.push_back({"elastic_below", "e = 0.99, 0.001 sigma/v_T", with_collision(restitution(1.0, 0.001)),
                 with_collision(restitution(0.99, 0.001))});
  all.push_back({"roughness", "beta = 1", with_collision(roughness(-1.0)), with_collision(roughness(1.0))});
  Effects pegged;
  pegged.obstacles = pegs(gas);
  all.push_back({"obstacles", "a small one for 100 disks", {}, pegged});
  for (const detail::EffectTraits& effect : detail::all_effects())
    if (!effect.numbers.empty())
      all.push_back({std::string(effect.name), mild_values(effect), with(effect, &detail::EffectNumber::neutral),
                     with(effect, &detail::EffectNumber::mild)});
  all.push_back({"stepped_potential", "0.1 kT to 1.2, -0.1 kT to 1.5", with_steps(0.0), with_steps(0.1)});
  all.push_back({"all neutral together", "", all_neutral(false), {}});
  return all;
}

}  // namespace carom::cli
