#pragma once
// Start files: comma-separated columns, one row per disk, under a header row that names them; or an array that numpy.save has
// written.

#include <Eigen/Core>

#include "scene/draft.hpp"

#include <string>
#include <vector>

namespace carom::detail {

struct StartFile {
  std::vector<Eigen::Vector2d> positions;   ///< columns x, y: always there
  std::vector<Eigen::Vector2d> velocities;  ///< columns vx, vy
  std::vector<double> radii;                ///< column radius
  std::vector<double> masses;               ///< column mass
  bool has_velocities = false;              ///< also true where the column is there and no row is
  bool has_radii = false;
  bool has_masses = false;
  Rows rows;
};

/// Reads the columns in any order, of a table as CsvTable takes it. What begins as .npy is read as that.
/// Throws SceneError at "file:line:column" for an unknown, missing or repeated column, a row of the wrong length, a
/// number that is none or not finite, and a radius or mass that is not above zero.
StartFile read_start_file(const std::string& path);

/// Reads a start file from text.
StartFile parse_start_file(std::string_view text, const std::string& path);

}  // namespace carom::detail
