#pragma once
// Draws moments of a run, true to scale: as the pixels of a frame, or as a PNG, SVG or PDF file.

#include "pages/clock_format.hpp"
#include "pages/layout.hpp"
#include "pages/moment.hpp"
#include "pages/palette.hpp"

#include <carom/scene.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

class Playback;

/// `psi6` is the size of the sixfold order of each disk, `psi6_angle` the direction of its axes, `neighbours` their number; all
/// of them by Voronoi cells.
enum class Colouring { speed, species, collisions, id, psi6, psi6_angle, neighbours, plain };
[[nodiscard]] constexpr bool needs_cells(Colouring colouring) {
  return colouring == Colouring::psi6 || colouring == Colouring::psi6_angle || colouring == Colouring::neighbours;
}

struct Look {
  Colouring colouring = Colouring::speed;
  bool dark = false;
  bool velocities = false;  ///< arrows
  bool caption = true;      ///< the clock, and what the colours mean
};

/// The data that all pictures of a film share.
struct Ranges {
  std::array<double, 4> extent{};  ///< largest extent of the box: left, right, bottom, top
  double typical_speed = 1.0;      ///< the largest root mean square speed
  double fastest = 1.0;            ///< speed at the end of the colour scale
  double most_collisions = 1.0;    ///< largest number of collisions of any disk
  ClockFormat clock = {};
};
/// Looks at a few moments between two times, and at how far the walls of the scene vibrate.
[[nodiscard]] Ranges ranges_of(Playback& playback, const Scene& scene, double from, double to);

enum class PictureFormat { png, svg, pdf };

class Painter {
 public:
  /// `scene` and `disks` must live as long as this. `species_names` has a name for each species of the disks.
  Painter(const Scene& scene, const Disks& disks, std::vector<std::string> species_names, const Look& look, const Ranges& ranges,
          const PictureSize& size);

  [[nodiscard]] const PictureSize& size() const { return layout_.size; }
  [[nodiscard]] const Layout& layout() const { return layout_; }

  /// Rows from the top, in each pixel 0xRRGGBB.
  [[nodiscard]] std::vector<std::uint32_t> frame(const Moment& moment) const;
  /// Returns the bytes of a file; a pixel is a point of SVG and PDF.
  [[nodiscard]] std::string picture(const Moment& moment, PictureFormat format) const;

 private:
  const Scene& scene_;
  const Disks& disks_;
  std::vector<std::string> species_names_;
  Look look_;
  Ranges ranges_;
  Layout layout_;
};

}  // namespace carom
