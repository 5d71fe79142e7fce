#pragma once
// The places of the box and its caption in a picture.

#include <Eigen/Core>

#include <array>

namespace carom {

struct PictureSize {
  int width = 0, height = 0;  ///< pixels
};

/// The map from lengths of the run to pixels, whose y runs downwards.
struct Layout {
  PictureSize size;
  double scale = 1.0;                             ///< pixels per length
  double left = 0.0, top = 0.0;                   ///< pixels: where the box begins
  std::array<double, 4> extent{};                 ///< lengths: left, right, bottom, top of the box
  double line = 1.0;                              ///< pixels: the thickness of a wall
  double letters = 0.0;                           ///< pixels: the size of letters in the caption; 0: no caption
  double caption_top = 0.0, caption_right = 0.0;  ///< pixels

  [[nodiscard]] double x(double length) const { return left + (length - extent[0]) * scale; }
  [[nodiscard]] double y(double length) const { return top + (extent[3] - length) * scale; }
};

/// Returns the size of a picture of this extent whose longer side has `longer` pixels.
[[nodiscard]] PictureSize fitted_size(const std::array<double, 4>& extent, int longer, bool caption);

/// Returns the box as large as it fits, in the middle.
[[nodiscard]] Layout layout_of(const std::array<double, 4>& extent, const PictureSize& size, bool caption);

}  // namespace carom
