#pragma once
// From bytes to a small scene, for property tests and fuzzing: any effects, extreme numbers. Every string of bytes is a scene,
// though the scene check may refuse it; what is refused is as much a part of the game as what runs.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace carom::test {

/// Reads bytes one by one; after the last one there are zeros. To be asked for one number in an expression: which of two
/// arguments is computed first is up to the compiler, and bytes would be another scene.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t next() { return at_ < bytes_.size() ? bytes_[at_++] : std::uint8_t{0}; }
  /// In [0, n).
  int below(int n) { return next() % n; }
  bool flag() { return (next() & 1) != 0; }
  /// In [0, 1], both ends included.
  double unit() { return static_cast<double>(next()) / 255.0; }
  /// Positive: most are ordinary, some far from it.
  double positive() {
    constexpr std::array<double, 16> values = {1.0,  1.0,  1.0,   2.0,   0.5, 0.1, 3.0,  0.75,
                                               1e-3, 1e-6, 1e-12, 1e-30, 1e3, 1e6, 1e12, 0x1.fffffffffffffp0};
    return values[next() % values.size()];
  }
  /// A component of a velocity.
  double component() {
    constexpr std::array<double, 8> odd = {0.0, -0.0, 1.0, -1.0, 1e-9, -1e-30, 1e4, -1e7};
    const std::uint8_t byte = next();
    return byte < 32 ? odd[byte % odd.size()] : (static_cast<double>(byte) - 143.5) / 64.0;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

namespace decoding {

/// Disks on the places of a lattice, each somewhere in its own square: as large as it fits, touching its neighbours at most.
/// `heaviest` becomes the largest mass.
inline std::string decoded_disks(Bytes& bytes, const std::array<double, 4>& box, double& heaviest) {
  const int columns = 1 + bytes.below(4), rows = 1 + bytes.below(3);
  const double a = (box[1] - box[0]) / columns, b = (box[3] - box[2]) / rows;
  const double largest = 0.5 * std::fmin(a, b), speed = bytes.flag() ? 1.0 : bytes.positive();
  const bool alike = bytes.flag();
  double radius = 0.0, mass = 1.0;
  std::string text;
  for (int i = 0; i < columns * rows; ++i) {
    if (i == 0 || !alike) {
      constexpr std::array<double, 8> share = {0.999999, 1.0, 0.9, 0.7, 0.5, 0.3, 0.1, 1e-3};
      radius = largest * share[static_cast<std::size_t>(bytes.below(8))];
      mass = bytes.positive();
    }
    if (!alike && bytes.below(8) == 7) continue;  // a hole
    const auto somewhere = [&](double lower, double width, int place) {
      const double room = 0.5 * width - radius, centre = lower + width * (place + 0.5);
      const std::uint8_t byte = bytes.next();
      return byte == 255 ? centre : centre + 0.998 * room * (static_cast<double>(byte) / 127.0 - 1.0);
    };
    const double x = somewhere(box[0], a, i % columns), y = somewhere(box[2], b, i / columns);
    const double vx = speed * bytes.component(), vy = speed * bytes.component();
    heaviest = std::fmax(heaviest, mass);
    text += fmt::format("[[disks]]\nradius = {}\nmass = {}\npositions = [[{}, {}]]\nvelocities = [[{}, {}]]\n", radius, mass, x,
                        y, vx, vy);
  }
  return text;
}

inline std::string decoded_wall(Bytes& bytes, double heaviest) {
  switch (bytes.below(6)) {
    case 0:
      return fmt::format("{{ temperature = {} }}", bytes.positive());
    case 1:
      return fmt::format("{{ velocity = {} }}", 0.1 * bytes.component());
    case 2: {
      const double mass = std::fmax(bytes.positive(), 0x1p-52 * heaviest), load = bytes.positive();
      return fmt::format("{{ mass = {}, load = {} }}", mass, load);
    }
    case 3:
      return fmt::format("{{ restitution = {} }}", bytes.unit());
    case 4: {
      const double velocity = 0.1 * bytes.component(), restitution = bytes.unit();
      return fmt::format("{{ velocity = {}, restitution = {} }}", velocity, restitution);
    }
    default:
      return "{ restitution = 1.0 }";
  }
}

inline std::string decoded_effects(Bytes& bytes, const std::array<double, 4>& box, bool walls_x, bool walls_y, double heaviest) {
  const double side = std::fmin(box[1] - box[0], box[3] - box[2]);
  const int which = bytes.next();
  std::string text;
  if ((which & 1) != 0) {
    const double x = walls_x ? bytes.component() : 0.0, y = walls_y ? bytes.component() : 0.0;
    text += fmt::format("[gravity]\nacceleration = [{}, {}]\n", x, y);
  }
  if ((which & 2) != 0 && (walls_x || walls_y)) {
    text += "[walls]\n";
    for (const char* wall : {"left", "right", "bottom", "top"}) {
      const bool along_x = wall[0] == 'l' || wall[0] == 'r';
      if ((along_x ? walls_x : walls_y) && bytes.flag()) text += fmt::format("{} = {}\n", wall, decoded_wall(bytes, heaviest));
    }
  }
  if ((which & 4) != 0) text += fmt::format("[growth]\nrate = {}\n", 0.01 * bytes.positive());
  if ((which & 8) != 0) {
    const double temperature = bytes.positive(), rate = bytes.positive();
    text += fmt::format("[thermostat]\ntemperature = {}\nrate = {}\n", temperature, rate);
  }
  if ((which & 16) != 0) text += fmt::format("[shear]\nrate = {}\n", bytes.component());
  if ((which & 32) != 0) {
    const double width = 1.0 + 0.5 * bytes.unit(), depth = bytes.component();
    if (bytes.flag()) {
      const double wider = width + 0.5 * bytes.unit(), energy = bytes.component();
      text += fmt::format("[stepped_potential]\nsteps = [{{ width = {}, energy = {} }}, {{ width = {}, energy = {} }}]\n", width,
                          depth, wider, energy);
    } else {
      text += fmt::format("[square_well]\nwidth = {}\ndepth = {}\n", width, depth);
    }
  }
  const auto along = [&](std::size_t axis) { return box[2 * axis] + bytes.unit() * (box[2 * axis + 1] - box[2 * axis]); };
  if ((which & 64) != 0) {
    const double x = along(0), y = along(1), radius = 0.2 * side * bytes.positive();
    text += fmt::format("[[obstacles]]\ndisk = {{ centre = [{}, {}], radius = {} }}\n", x, y, radius);
  }
  if ((which & 128) != 0) {
    const double x = along(0), y = along(1), to_x = along(0), to_y = along(1);
    text += fmt::format("[[obstacles]]\nsegment = {{ from = [{}, {}], to = [{}, {}] }}\n", x, y, to_x, to_y);
  }
  if ((which & 192) == 192) {
    const double radius = 0.4 * side * bytes.unit(), from = 360.0 * bytes.unit(), span = 360.0 * bytes.unit();
    const auto clear = [&](std::size_t axis) {
      return box[2 * axis] + radius + bytes.unit() * (box[2 * axis + 1] - box[2 * axis] - 2.0 * radius);
    };
    const double x = clear(0), y = clear(1);
    text += fmt::format("[[obstacles]]\narc = {{ centre = [{}, {}], radius = {}, from = {}, to = {} }}\n", x, y, radius, from,
                        from + span);
  }
  return text;
}

/// Walls that vibrate or slide, where the scene has no others.
inline std::string decoded_moving_walls(Bytes& bytes, const std::string& scene, double side, bool walls_x, bool walls_y) {
  std::string text;
  for (const char* wall : {"left", "right", "bottom", "top"}) {
    const bool along_x = wall[0] == 'l' || wall[0] == 'r';
    if (!(along_x ? walls_x : walls_y) || scene.find(fmt::format("\n{} = ", wall)) != std::string::npos || !bytes.flag())
      continue;
    text += fmt::format("[walls.{}]\n", wall);
    const int kind = bytes.below(4);
    if (kind == 0) {
      const double temperature = bytes.positive(), velocity = bytes.component();
      text += fmt::format("temperature = {}\ntangential_velocity = {}\n", temperature, velocity);
      continue;
    }
    if (kind == 1) {
      text += fmt::format("vibration = {}\n", bytes.unit());
    } else {
      const double amplitude = 0.1 * side * bytes.unit(), frequency = bytes.positive(), phase = bytes.unit();
      text += fmt::format("vibration = {{ form = \"{}\", amplitude = {}, frequency = {}, phase = {} }}\n",
                          kind == 2 ? "sine" : "sawtooth", amplitude, frequency, phase);
    }
    if (bytes.flag()) text += fmt::format("restitution = {}\n", bytes.unit());
  }
  return text;
}

}  // namespace decoding

/// The scene in the words of the scene format.
inline std::string decoded_scene(std::span<const std::uint8_t> data) {
  Bytes bytes(data);
  const double side = bytes.positive(), aspect = bytes.flag() ? 1.0 : 1.0 + 2.0 * bytes.unit();
  constexpr std::array<double, 4> origins = {0.0, 0.0, -1.0, 1000.0};
  const double x = side * origins[static_cast<std::size_t>(bytes.below(4))], y = bytes.flag() ? -0.5 * side : 0.0;
  const std::array<double, 4> box = {x, x + side * aspect, y, y + side};
  const int boundary = bytes.below(4);
  const bool walls_x = (boundary & 1) != 0, walls_y = (boundary & 2) != 0;
  std::string box_text = fmt::format("[box]\nx = [{}, {}]\ny = [{}, {}]\nboundary = {{ x = \"{}\", y = \"{}\" }}\n", box[0],
                                     box[1], box[2], box[3], walls_x ? "walls" : "periodic", walls_y ? "walls" : "periodic");
  double heaviest = 0.0;
  std::string text = decoding::decoded_disks(bytes, box, heaviest);
  const bool specular = bytes.flag();
  text += fmt::format("[collision]\nrule = \"{}\"\n", specular ? "specular" : "reversal");
  const int contact = bytes.next();
  if ((contact & 1) != 0) text += fmt::format("restitution = {}\n", bytes.unit());
  if ((contact & 2) != 0 && specular) text += fmt::format("roughness = {}\n", 2.0 * bytes.unit() - 1.0);
  if ((contact & 4) != 0) text += fmt::format("elastic_below = {{ time = {} }}\n", 1e-3 * bytes.positive());
  if (bytes.flag()) text += decoding::decoded_effects(bytes, box, walls_x, walls_y, heaviest);
  text += fmt::format("[run]\ntime = 1.0\nkeep_momentum = true\nseed = {}\n", 1 + bytes.below(4));
  if (const int unlike = bytes.below(3); unlike > 0) {  // each disk is of a species of its own
    const double delta = (unlike == 1 ? -0.999 : 0.1) * bytes.unit(), of_first_two = 2.0 * bytes.unit() - 1.0;
    text += fmt::format("[non_additivity]\ndelta = {}\n", delta);
    if (bytes.flag()) text += fmt::format("pairs = [{{ species = [0, 1], delta = {} }}]\n", of_first_two);
  }
  const auto has = [&](const char* table) { return text.find(table) != std::string::npos; };
  switch (bytes.below(8)) {
    case 1:
      if (!has("[thermostat]") && !has("[shear]")) text += fmt::format("[tumbling]\nrate = {}\n", bytes.positive());
      break;
    case 2:
      if (!has("[thermostat]")) {
        const double temperature = bytes.positive(), rate = bytes.positive();
        text += fmt::format("[brownian]\ntemperature = {}\nrate = {}\n", temperature, rate);
      }
      break;
    case 3:  // round the corners of the box
      if (!has("[walls]") && !has("[shear]"))
        box_text = fmt::format("[box]\ncircle = {{ centre = [{}, {}], radius = {} }}\n", (box[0] + box[1]) / 2.0,
                               (box[2] + box[3]) / 2.0, 0.5001 * std::hypot(box[1] - box[0], box[3] - box[2]));
      break;
    case 4:
    case 5:
    case 6:
      text += decoding::decoded_moving_walls(bytes, text, side, walls_x, walls_y);
      break;
    default:
      break;
  }
  return box_text + text;
}

}  // namespace carom::test
