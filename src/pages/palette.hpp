#pragma once
// Colours of pictures and films, the same as the player's (src/pages/player/palettes.js and player.css): a scale that rises
// evenly in lightness, which colour-blind readers can follow, and those of Okabe and Ito for kinds of disks.

#include <cstddef>

namespace carom {

/// Each from 0 to 1.
struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0;
};

/// Viridis, of van der Walt and Smith. What is outside [0, 1] has the colour of its end.
[[nodiscard]] Colour scale_colour(double share);

/// A circle of colours of about equal lightness: 0 and 1 are the same.
[[nodiscard]] Colour circle_colour(double share);

/// The colour of a disk with so many neighbours: none stands out but those that are not six.
[[nodiscard]] Colour neighbours_colour(std::size_t neighbours, bool dark);

/// Eight that differ, and then again from the first.
[[nodiscard]] Colour kind_colour(std::size_t kind);

struct Theme {
  Colour paper;   ///< round the box
  Colour stage;   ///< in it
  Colour ink;     ///< walls and letters
  Colour muted;   ///< smaller letters
  Colour frame;   ///< periodic edges
  Colour solid;   ///< what disks bounce off
  Colour accent;  ///< trails
  Colour plain;   ///< disks whose colour says nothing
  Colour rim;     ///< of disks, half transparent
};
[[nodiscard]] const Theme& theme(bool dark);

}  // namespace carom
