#include "simulation/start.hpp"

#include "neighbours/sheared_overlap.hpp"
#include "scene/checks.hpp"
#include "scene/contact_scales.hpp"
#include "scene/effect_traits.hpp"
#include "scene/mean_flow.hpp"
#include "scene/refusal.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

namespace carom {

namespace {

/// Predictions multiply squares of lengths and of speeds, which must neither overflow nor vanish.
void require_resolvable_scale(const Scene& scene, const Start& start) {
  if (start.disks.count() == 0) return;
  const double speed = start.state.velocities.cwiseAbs().maxCoeff();
  const double heaviest = *std::max_element(start.disks.mass.begin(), start.disks.mass.end());
  if (!(heaviest * speed * static_cast<double>(start.disks.count()) < 1e150))
    throw detail::scene_error(
        scene, "disks.0",
        fmt::format(
            "the heaviest disk has mass {:g} and the fastest moves at {:g}; the square of their momentum overflows: choose "
            "other units",
            heaviest, speed));
  const double largest = speed * scene.box.lengths().maxCoeff();
  const double smallest = speed * *std::min_element(start.disks.radius.begin(), start.disks.radius.end());
  if (speed == 0.0 || (largest < 1e150 && smallest > 1e-150)) return;
  throw detail::scene_error(
      scene, "disks.0.velocities",
      fmt::format(
          "the fastest disk moves at {:g} in a box {:g} wide, and the smallest disk has radius {:g}; products of speed and "
          "length must lie between 1e-150 and 1e150: choose other units",
          speed, scene.box.lengths().maxCoeff(), *std::min_element(start.disks.radius.begin(), start.disks.radius.end())));
}

/// A disk that just fits between two walls would bounce without end at one instant.
void require_room_to_move(const Scene& scene, const Start& start) {
  for (std::size_t i = 0; i < start.disks.count(); ++i) {
    const Eigen::Vector2d velocity = start.state.velocities.col(static_cast<Eigen::Index>(i));
    for (int a = 0; a < 2; ++a) {
      const double diameter = 2.0 * start.disks.radius[i];
      if (scene.box.periodic(a) || velocity[a] == 0.0 || scene.box.lengths()[a] > diameter * (1.0 + 1e-12)) continue;
      throw detail::scene_error(
          scene, fmt::format("disks.{}.velocities", start.disks.species[i]),
          fmt::format(
              "disk {} of diameter {:g} fills the box from wall to wall in {} and cannot move along it; give it more room, or no "
              "velocity there",
              i, diameter, a == 0 ? "x" : "y"));
    }
  }
}

/// Adds the mean flow to velocities that are drawn; those given one by one are what they are.
void add_flow(const Scene& scene, Start& start) {
  const detail::MeanFlow flow(scene.box, scene.effects);
  if (!flow.present()) return;
  for (std::size_t i = 0; i < start.disks.count(); ++i) {
    const Velocities& law = scene.species[static_cast<std::size_t>(start.disks.species[i])].velocities;
    if (std::holds_alternative<ListedVelocities>(law) || std::holds_alternative<FileVelocities>(law)) continue;
    const auto column = static_cast<Eigen::Index>(i);
    start.state.velocities(0, column) += flow.at(start.state.positions(1, column));
  }
}

/// The walls of a state that may come from another scene: those that stand here stand where the box has them, and those of a
/// velocity of their own have it.
std::vector<WallState> walls_from(const Scene& scene, const std::vector<WallState>& given) {
  if (given.size() != 4 || !any_wall(scene.effects, moves)) return {};
  std::vector<WallState> walls;
  for (std::size_t k = 0; k < 4; ++k) {
    const WallProperties& wall = scene.effects.walls[k];
    walls.push_back(
        {moves(wall) ? given[k].position : edge_of(scene.box, k), wall.mass ? given[k].velocity : wall.velocity.value_or(0.0)});
    if (!std::isfinite(walls.back().position) || !std::isfinite(walls.back().velocity))
      throw std::invalid_argument("a wall of the given state is not finite");
  }
  return walls;
}

void require_inside(const Scene& scene, const State& state, int axis, double lower, double upper, const char* advice) {
  const auto positions = state.positions.row(axis);
  if (positions.size() == 0) return;
  const double most = positions.maxCoeff();
  if (positions.minCoeff() >= lower && (most < upper || (most == upper && !scene.box.periodic(axis)))) return;
  throw std::invalid_argument(
      fmt::format("the given state has a position outside the box in {}; {}", axis == 0 ? "x" : "y", advice));
}

}  // namespace

Disks all_disks(const Scene& scene) {
  check(scene);
  return disks_of(scene);
}

Disks disks_of(const Scene& scene) {
  Disks disks;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    for (std::int64_t i = 0; i < species.count; ++i) {
      disks.radius.push_back(species.radius_of(i));
      disks.mass.push_back(species.mass_of(i));
      disks.species.push_back(static_cast<std::int32_t>(s));
    }
  }
  return disks;
}

Start draw_start(const Scene& scene, const PlacingHook& placing) {
  Start start;
  start.disks = all_disks(scene);
  start.state.positions = draw_positions(scene, start.disks, placing);
  start.state.velocities = draw_velocities(scene, start.disks);
  add_flow(scene, start);
  require_room_to_move(scene, start);
  require_resolvable_scale(scene, start);
  start.state.images = Images::Zero(2, start.state.positions.cols());
  return start;
}

void check_begun(const Scene& scene, const State& state) {
  if (state.shear_displacement == 0.0 || !detail::MeanFlow(scene.box, scene.effects).present()) return check(scene);
  Scene slid = scene;
  slid.run.accept_overlap = true;
  check(slid);
}

void require_apart_in_shear(const Scene& scene, const State& state, double scale) {
  if (scene.run.accept_overlap || state.shear_displacement == 0.0 || !detail::MeanFlow(scene.box, scene.effects).present())
    return;
  const Disks disks = disks_of(scene);
  std::vector<double> radii = disks.radius;
  for (double& radius : radii) radius *= scale;
  const ContactScales<double> scales = contact_scales<double>(scene.effects, disks);
  const DeepestOverlap found = deepest_overlap_in_shear(scene.box, radii, state, scales);
  if (!(found.relative > detail::touching)) return;
  const double contact = (radii[static_cast<std::size_t>(found.first)] + radii[static_cast<std::size_t>(found.second)]) *
                         scales.of_disks(found.first, found.second);
  throw SceneError({}, detail::sentence_of_overlap(found.first, found.second, found.relative * contact, contact));
}

Start start_from(const Scene& scene, const State& state) {
  check_begun(scene, state);
  return start_of(scene, disks_of(scene), state);
}

Start start_of(const Scene& scene, Disks all, const State& state) {
  Start start;
  start.disks = std::move(all);
  const auto disks = static_cast<Eigen::Index>(start.disks.count());
  if (state.positions.cols() != disks || state.velocities.cols() != disks)
    throw std::invalid_argument(fmt::format("a state of {} positions and {} velocities is given for {} disks; give one per disk",
                                            state.positions.cols(), state.velocities.cols(), disks));
  if (!state.positions.allFinite() || !state.velocities.allFinite())
    throw std::invalid_argument("a position or velocity of the given state is not finite");
  const auto require_one_each = [&](Eigen::Index given, const char* what) {
    if (given != 0 && given != disks)
      throw std::invalid_argument(
          fmt::format("a state of {} {} is given for {} disks; give one per disk, or none", given, what, disks));
  };
  require_one_each(state.images.cols(), "images");
  require_one_each(state.spins.size(), "spins");
  if (!state.walls.empty() && state.walls.size() != 4)
    throw std::invalid_argument(fmt::format("a state of {} walls is given; give all four, or none", state.walls.size()));
  start.state.positions = state.positions;
  start.state.velocities = state.velocities;
  start.state.images = state.images;
  if (state.images.cols() != disks) start.state.images = Images::Zero(2, disks);
  if (scene.effects.collision.roughness && state.spins.size() == disks) start.state.spins = state.spins;
  if (detail::any_acting(scene.effects, &detail::EffectTraits::changes_radii)) start.state.scale = state.scale;
  if (detail::MeanFlow(scene.box, scene.effects).present()) start.state.shear_displacement = state.shear_displacement;
  if (!start.state.spins.allFinite() || !std::isfinite(start.state.shear_displacement))
    throw std::invalid_argument("a spin, or the displacement by shear, of the given state is not finite");
  if (!(start.state.scale > 0.0 && std::isfinite(start.state.scale)))
    throw std::invalid_argument("the scale of the given state is not positive and finite");
  start.state.walls = walls_from(scene, state.walls);
  for (const int axis : {0, 1})
    if (scene.box.periodic(axis))
      require_inside(scene, start.state, axis, scene.box.lower[axis], scene.box.upper[axis], "fold it into [lower, upper)");
  require_room_to_move(scene, start);
  require_resolvable_scale(scene, start);
  return start;
}

void require_between_walls(const Scene& scene, const State& state) {
  const Box box = box_of(scene.box, state);
  for (const int axis : {0, 1})
    if (!box.periodic(axis)) require_inside(scene, state, axis, box.lower[axis], box.upper[axis], "put it between the walls");
  if (const auto& circle = scene.effects.circle; circle && state.positions.size() > 0)
    if ((state.positions.colwise() - circle->centre).colwise().norm().maxCoeff() > circle->radius)
      throw std::invalid_argument("the given state has a position outside the circular box; put it inside");
}

}  // namespace carom
