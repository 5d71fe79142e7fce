#pragma once
// The box and its disks as lines of text, for `carom run --watch`.

#include "terminal/dot_canvas.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <string>
#include <vector>

namespace carom {

/// The size of a picture, in characters.
struct TextArea {
  int columns = 0;
  int rows = 0;
};

/// The state with true radii (a disk smaller than a dot is one), walls and whatever else stands where it is, to scale and as
/// large as fits into `room` with its frame: full lines are walls, broken ones periodic edges. Disks of the median speed in
/// equilibrium are grey, slower ones blue, faster ones orange. All lines have the same width; there may be fewer of them than
/// rows. Requires room for 8 x 4.
[[nodiscard]] std::vector<std::string> terminal_picture(const Scene& scene, const Disks& disks, const State& state, TextArea room,
                                                        TerminalColours colours);

}  // namespace carom
