#pragma once
// The start of a run: which disks there are, where they are and how they move, as the scene asks.

#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

namespace carom {

struct Start {
  Disks disks;
  State state;  ///< at time 0; without images where positions are drawn
};

/// Draws positions and velocities; the same scene and seed give the same bits.
/// Throws SceneError where check(scene) does, where disks cannot be placed, or move across a gap that they fill.
Start draw_start(const Scene& scene, const PlacingHook& placing = {});

/// The scene's disks in a given state, at time 0. Throws std::invalid_argument where the state does not belong to the scene's
/// number of disks, or is not finite, or a position lies outside the box along a periodic axis; SceneError for what the scene
/// itself lacks. Disks may overlap; remainders are dropped, so that every engine starts from the same numbers.
Start start_from(const Scene& scene, const State& state);

/// Does as check() for a scene that begins in this state. Overlaps are not looked for where the images of a sheared box have
/// slid: how far they have is in the state alone.
void check_begun(const Scene& scene, const State& state);

/// Throws SceneError where images that have slid make disks overlap, as check() does where none have, unless the scene accepts
/// overlaps. The radii are `scale` times those of the scene.
void require_apart_in_shear(const Scene& scene, const State& state, double scale);

/// Does as start_from() for a scene that has been checked, and for these disks.
Start start_of(const Scene& scene, Disks disks, const State& state);

/// Throws std::invalid_argument where a centre is beyond a wall: a fixed-step method gets there, exact events never do.
void require_between_walls(const Scene& scene, const State& state);

/// All disks of a scene, in the order of its species. Throws SceneError where check(scene) does.
Disks all_disks(const Scene& scene);
/// Returns all disks of a scene that has been checked.
Disks disks_of(const Scene& scene);

/// Column i of `positions` for every disk of every species, in the order of ids. Throws as draw_start.
Eigen::Matrix2Xd draw_positions(const Scene& scene, const Disks& disks, const PlacingHook& placing);

/// The dense start. Throws SceneError where the disks jam before they have their size.
Eigen::Matrix2Xd grown_positions(const Scene& scene, const Disks& disks, const PlacingHook& placing);

/// Column i of `velocities` for every disk of every species, in the order of ids. Throws as draw_start. Where no velocity is
/// given one by one, the total momentum along periodic axes is removed; temperatures are met exactly. Neither is done where the
/// scene keeps momentum.
Eigen::Matrix2Xd draw_velocities(const Scene& scene, const Disks& disks);

/// `count` sites of a lattice that fills the box, evenly thinned where the lattice has more. `diameter` is the room that
/// a disk needs at a wall. `spacing` is the smallest distance of two sites, across periodic edges too.
struct Lattice {
  Eigen::Matrix2Xd sites;
  double spacing = 0.0;
};
Lattice square_lattice(const Box& box, std::int64_t count, double diameter);
Lattice hexagonal_lattice(const Box& box, std::int64_t count, double diameter);

}  // namespace carom
