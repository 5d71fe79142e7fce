#pragma once
// The data of the reader before the short forms are completed: the tables as they were written, and their places.

#include "scene/radius_law.hpp"

#include <carom/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom::detail {

/// The place of each disk in a start file, so that a refusal can name the row.
struct Rows {
  std::string source;
  std::vector<std::array<int, 2>> places;  ///< line and column, one per disk

  [[nodiscard]] Location of(std::size_t disk) const { return {source, places[disk][0], places[disk][1]}; }
};

/// The [box] table: limits, or an aspect ratio where the size follows from a packing fraction.
struct BoxDraft {
  Box box;                       ///< limits valid only where `aspect` is empty
  std::optional<double> aspect;  ///< Lx / Ly
  std::optional<Circle> circle;  ///< in the place of both
};

/// One [[disks]] table.
struct DisksDraft {
  Species species;
  std::string path;  ///< "disks.0"
  Rows rows;         ///< empty unless the positions are in a start file
  std::optional<std::int64_t> count;
  std::optional<double> radius;
  std::optional<RadiusLaw> radius_law;  ///< by which one radius per disk is drawn
  std::optional<double> mass_per_area;  ///< mass over pi r^2 of every disk
  bool has_radii = false;               ///< one radius per disk, in a list or a start file; true also where there is no disk
  bool has_masses = false;              ///< the same of masses
  bool velocities_from_file = false;
  std::optional<double> packing_fraction;  ///< this species' share of the box: sum of pi r^2 / area
};

struct SceneDraft {
  Scene scene;  ///< box and species only once the short forms are complete
  BoxDraft box;
  std::vector<DisksDraft> disks;
};

}  // namespace carom::detail
