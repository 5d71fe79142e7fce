#pragma once
// The checks of a whole scene, one file each, and what they share. They read a Scene alone, so that a scene from a file and one
// that a program has made are refused in the same words. The code that catches a Refusal adds the place in the file.

#include "scene/refusal.hpp"

#include <carom/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom::detail {

/// Returns the place of a step of the pair potential in a scene file: "stepped_potential.steps.0".
std::string path_of_step(std::size_t k);

/// Given positions may miss a wall or each other by this fraction of the contact distance: what decimal input rounds away.
inline constexpr double touching = 1e-9;
/// pi / (2 sqrt 3): no arrangement of equal disks is denser, in a rectangle or on a torus.
inline constexpr double closest_packing = std::numbers::pi / (2.0 * std::numbers::sqrt3);
/// The jamming density of random sequential addition of equal disks in the plane.
inline constexpr double random_limit = 0.547;
/// Numbers of samples, steps and events of the thermostat are exact in double precision below it.
inline constexpr double most_countable = 9007199254740992.0;  // 2^53
inline constexpr const char* axis_names[] = {"x", "y"};

/// Returns what is wrong with two disks that overlap by a length, and how far apart their centres must be at least.
std::string sentence_of_overlap(std::int64_t one, std::int64_t other, double overlap, double contact);
/// Returns the positions of a species that gives them one by one; else none.
std::span<const Eigen::Vector2d> given_positions(const Species& species);

/// The smallest and the largest radius of all disks, both 0 where there is no disk, and the number of disks.
struct Radii {
  double smallest = 0.0;
  double largest = 0.0;
  std::int64_t disks = 0;

  [[nodiscard]] bool equal() const { return largest <= smallest * (1.0 + touching); }
  /// No packing fraction is above it. One disk may fill a circle.
  [[nodiscard]] double densest() const { return equal() && disks > 1 ? closest_packing : 1.0; }
};
Radii radii_of(const Scene& scene);
/// Requires that the species has disks.
Radii radii_of(const Species& species);
/// The contact distances of disks of two different species.
struct UnlikeContact {
  std::int64_t one, other;  ///< species
  double scale;             ///< contact distance over the sum of two radii
  double smallest, largest;
};
/// Returns those of all pairs of species that have disks, where [non_additivity] acts; else none.
std::vector<UnlikeContact> unlike_contacts(const Scene& scene);
/// Returns the largest speed, roughly: at the start, of walls and surfaces, or by what else acts.
double fastest_speed(const Scene& scene);
/// Returns whether disks of some two species may come nearer than the sum of their radii.
bool brings_unlike_nearer(const Scene& scene);
/// Returns the largest of them; 0 where there are none.
double largest_unlike_contact(const Scene& scene);
/// Returns the distance of the origin to the farther limit of the box along an axis.
double largest_coordinate(const Box& box, int axis);
/// Over all disks. Requires one.
double mean_diameter(const Scene& scene);

/// Throws Refusal where the parts of a scene do not make sense, alone or together.
void check_scene(const Scene& scene);

// The steps of check_scene(), in order. Each throws Refusal, and relies on those before it.

/// Every number is in its range, and every list has one entry per disk.
void check_numbers(const Scene& scene);
/// `path` is that of the count.
void check_count(std::int64_t count, const std::string& path);
void check_box(const Box& box);
/// The box is a circle where the effects have one, which fills the square.
void check_circle(const Scene& scene);
/// Disks are grown together or not at all, and to what they are.
void check_grown(const Scene& scene);
/// Fixed shapes lie in the box, and given disks clear of them.
void check_fixed_shapes(const Scene& scene);
/// Effects that cannot act together, or not in this box.
void check_effects(const Scene& scene);
/// The deltas of [non_additivity] are those of species, and two disks can touch without a third image between them.
void check_non_additivity(const Scene& scene);
void check_walls(const Scene& scene);
void check_growth(const Scene& scene);
/// Speeds, places and masses are such that the arithmetic of every engine keeps its digits, and runs come to their end.
void check_scales(const Scene& scene);
/// The list of changes, and effects before and after each; in the place of check_effects() and check_scales(). Requires a change.
void check_changes(const Scene& scene);
void check_run(const Scene& scene);
void check_observe(const Scene& scene);
/// Gives a request the range of its histogram where it has none: no more than half of the box.
void complete_request(const Scene& scene, ObservableRequest& request);
/// The time from one sample to the next, at `path`: until the end of the run there can be fewer than 2^53 samples, of which there
/// are `per_step` in each step; where that is not known, disks must move from one to the next.
void check_step(const Scene& scene, const std::string& path, double step, double per_step = 1.0);

// Sentences that the reader of files says too, of what no Scene can hold.

inline constexpr const char* endless_run = "[run] has no end; give time = 5.0, collisions = 1_000_000, or both";
std::string unequal_counts(const std::string& path, std::int64_t count, std::size_t positions);
/// `path` is that of a list of one number per disk; `name` is that of the number.
std::string unequal_list(const std::string& path, std::size_t length, std::int64_t count, std::string_view name);
std::string ends_of_growth(const char* has);

}  // namespace carom::detail
