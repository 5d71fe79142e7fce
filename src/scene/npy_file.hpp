#pragma once
// Start files that numpy.save has written: the .npy format, versions 1 to 3 (numpy.lib.format).

#include "scene/start_file.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace carom::detail {

/// Returns whether the bytes begin as an .npy file does, whatever the file is called.
bool is_npy(std::string_view bytes);

/// Returns the rows of an array of numbers with 2 columns (x, y) or 4 (x, y, vx, vy), or of a structured array whose fields are
/// named like the columns of a start file. Floats of 4 and 8 bytes and whole numbers of any size and byte order, in C and Fortran
/// order. Throws SceneError at the path, with the row where one is to blame, counted from 0.
StartFile parse_npy(std::string_view bytes, const std::string& path);

/// The numbers of a trajectory, frame by frame and disk by disk.
struct NpyFrames {
  std::size_t frames = 0;
  std::size_t disks = 0;
  std::size_t columns = 2;     ///< 2 (x, y) or 4 (x, y, vx, vy)
  std::vector<double> values;  ///< frames * disks * columns
};

/// Returns the frames of an array of numbers of shape (frames, disks, 2) or (frames, disks, 4), of the types that parse_npy
/// reads. Throws SceneError at the path.
NpyFrames parse_npy_frames(std::string_view bytes, const std::string& path);

}  // namespace carom::detail
