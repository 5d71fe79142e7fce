#pragma once
// The sizes of disks and their spacing, for the neighbour lists of a run in which they may grow.

#include "effects/non_additivity.hpp"
#include "engine/flight_frame.hpp"
#include "neighbours/neighbourhood_tuning.hpp"

#include <carom/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace carom {

/// The largest contact distance of any two disks, or more where diameters are not additive: the largest sum of two radii times
/// the largest scale.
inline double largest_contact_distance(const Disks& disks, const Effects& effects) {
  double largest = 0.0, second = 0.0;
  for (const double radius : disks.radius) {
    second = std::max(second, std::min(radius, largest));
    largest = std::max(largest, radius);
  }
  return (largest + second) * contact_scales<double>(effects, disks).largest();
}

/// The factor by which contact distances may grow in a run: disks until they fill the box, times the reach of the pair
/// potential.
inline double largest_scale(const Box& box, const Disks& disks, const Effects& effects) {
  const std::vector<PotentialStep> steps = effects.potential_steps();
  const double scale = steps.empty() ? 1.0 : steps.back().width;
  if (!effects.growth || effects.growth->rate == 0.0) return scale;
  double squares = 0.0;
  for (const double radius : disks.radius) squares += radius * radius;
  const double fraction = std::numbers::pi * squares / box.area();
  const double full = std::max(1, contact_scales<double>(effects, disks).kinds());  // no disks of a kind fill more than the box
  return scale * std::sqrt(effects.growth->packing_fraction.value_or(full) / fraction);
}

struct DiskSizes {
  DiskSizes(const Box& box, const Disks& disks, const Effects& effects)
      : spacing(mean_spacing(box, disks.count())),
        mean_diameter(disks.mean_diameter()),
        contact_scale(contact_scales<double>(effects, disks).largest()),
        largest_contact(largest_contact_distance(disks, effects)) {}

  /// The half-width of neighbourhoods to begin with, for disks of the size that lists are for.
  [[nodiscard]] double suitable_half_width() const {
    return HalfWidthSearch::first_half_width(mean_diameter * listed_scale, area);
  }

  double spacing;                     ///< root of the area per disk
  double mean_diameter;               ///< at scale 1
  double contact_scale;               ///< the largest contact distance over a sum of radii, at least 1
  double largest_contact;             ///< the largest contact distance, at scale 1
  double area = 0.0;                  ///< per disk, where most of them were at the start
  std::vector<double> radius;         ///< by slot, where lists have to be made for larger disks; else empty
  double listed_scale = 1.0;          ///< of the radii for which lists are made
  double reach = 0.0;                 ///< the largest distance at which two disks act on each other, at that scale
  double widest_neighbourhood = 0.0;  ///< the largest half-width for which nearest images are right

  template <class Archive>
  void serialize(Archive& archive) {
    archive(area, radius, listed_scale, reach, widest_neighbourhood);
  }
};

}  // namespace carom
