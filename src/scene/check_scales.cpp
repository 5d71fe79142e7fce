// Ranges in which the arithmetic of every engine keeps its digits, and in which a run can come to its end. What is held against
// them are not the numbers of a scene but what follows from them: how fast what acts makes disks, where walls get to, how far a
// disk moves from one event of the thermostat, or one sample, to the next. Each refusal says the range of the number itself in
// this scene.
//
// Predictions square products of speed and length; both must be normal numbers: 1e-150 < v r, v L < 1e150. docs/numerics.md

#include "scene/checks.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace carom::detail {
namespace {

/// Bounds of products of speed and length.
constexpr double least = 1e-150;
constexpr double most = 1e150;
constexpr double least_mass = 1e-300, most_mass = 1e300;
/// Places must be known to this share of the smallest radius.
constexpr double resolution = 1e-3;
/// The distance of two doubles at x is at most this share of x.
constexpr double spacing = 0x1p-52;
/// Distance from the origin, in smallest radii, up to which coordinates have that resolution: 4.5e12.
constexpr double most_radii = resolution / spacing;
/// Fraction of the smallest radius that a disk must move from one of its events to the next (simulation/standstill.hpp).
constexpr double least_way = 0x1p-50;

/// The lengths, masses and times of a scene by which its numbers are judged.
struct Sizes {
  double smallest = 0.0;  ///< radius
  double lightest = 0.0, heaviest = 0.0;
  double longest = 0.0;            ///< side of the box
  double shortest = 0.0;           ///< the other
  std::optional<double> duration;  ///< of a run that ends by its time alone
};

double lightest_of(const Species& species) {
  return species.masses.empty() ? species.mass : *std::min_element(species.masses.begin(), species.masses.end());
}

Sizes sizes_of(const Scene& scene) {
  Sizes sizes;
  sizes.smallest = radii_of(scene).smallest;
  sizes.lightest = std::numeric_limits<double>::infinity();
  for (const Species& species : scene.species) {
    if (species.count == 0) continue;
    sizes.lightest = std::min(sizes.lightest, lightest_of(species));
    sizes.heaviest = std::max(
        sizes.heaviest, species.masses.empty() ? species.mass : *std::max_element(species.masses.begin(), species.masses.end()));
  }
  sizes.longest = scene.box.lengths().maxCoeff();
  sizes.shortest = scene.box.lengths().minCoeff();
  if (scene.run.time && !scene.run.collisions) sizes.duration = *scene.run.time;
  return sizes;
}

/// A number of a scene and the speeds that it gives to disks. In long double: a speed that is refused may be none in double.
struct Drive {
  std::string path;
  double value = 0.0;
  long double slowest = 0.0L, fastest = 0.0L;  ///< of the heaviest disks and of the lightest
  int power = 1;                               ///< of the speed that the number is proportional to
  bool lasts = true;                           ///< disks go on moving so
};

std::vector<Drive> drives_of(const Scene& scene, const Sizes& sizes) {
  std::vector<Drive> drives;
  const Effects& effects = scene.effects;
  const Eigen::Vector2d lengths = scene.box.lengths();
  const auto put = [&](const std::string& path, double value, long double slowest, long double fastest, int power, bool lasts) {
    if (value != 0.0) drives.push_back({path, value, slowest, fastest, power, lasts});
  };
  const auto from_energy = [&](const std::string& path, double value, long double energy, double lightest, double heaviest) {
    put(path, value, std::sqrt(energy / heaviest), std::sqrt(energy / lightest), 2, true);
  };
  // Slow starts are checked when velocities are drawn.
  for (std::size_t s = 0; s < scene.species.size(); ++s)
    if (const auto* law = std::get_if<MaxwellVelocities>(&scene.species[s].velocities))
      put(fmt::format("disks.{}.velocities.temperature", s), law->temperature, std::numeric_limits<long double>::infinity(),
          std::sqrt(static_cast<long double>(law->temperature) / lightest_of(scene.species[s])), 2, false);
  for (std::size_t w = 0; w < effects.walls.size(); ++w) {
    const WallProperties& wall = effects.walls[w];
    const std::string path = fmt::format("walls.{}", wall_names[w]);
    if (wall.velocity) put(path + ".velocity", *wall.velocity, std::abs(*wall.velocity), std::abs(*wall.velocity), 1, false);
    if (wall.tangential_velocity) {
      const long double speed = std::abs(static_cast<long double>(*wall.tangential_velocity));
      put(path + ".tangential_velocity", *wall.tangential_velocity, speed, speed, 1, true);
    }
    if (wall.vibration) put(path + ".vibration", *wall.vibration, *wall.vibration, *wall.vibration, 1, true);
    if (wall.oscillation) {
      const Oscillation& motion = *wall.oscillation;
      const long double way = motion.form == WaveForm::sine ? 2.0L * std::numbers::pi_v<long double> : 2.0L;
      const long double speed = way * motion.amplitude * motion.frequency;
      if (motion.moves()) put(path + ".vibration.frequency", motion.frequency, speed, speed, 1, true);
    }
    if (wall.temperature)
      from_energy(path + ".temperature", *wall.temperature, *wall.temperature, sizes.lightest, sizes.heaviest);
    if (wall.mass && wall.load)  // what it gives a disk that it pushes through the box
      from_energy(path + ".load", *wall.load, 2.0L * *wall.load * lengths.x() * lengths.y(), std::min(sizes.lightest, *wall.mass),
                  std::max(sizes.heaviest, *wall.mass));
  }
  if (effects.gravity)
    for (int axis = 0; axis < 2; ++axis) {
      const double g = effects.gravity->acceleration[axis];
      const long double fallen = std::sqrt(2.0L * std::abs(g) * lengths[axis]);
      put(fmt::format("gravity.acceleration.{}", axis), g, fallen, fallen, 2, true);
    }
  if (const auto& growth = effects.growth)
    put("growth.rate", growth->rate, 2.0L * growth->rate * sizes.smallest,
        static_cast<long double>(growth->rate) * sizes.shortest, 1, false);
  if (const auto& bath = effects.thermostat; bath && bath->rate > 0.0)
    from_energy("thermostat.temperature", bath->temperature, bath->temperature, sizes.lightest, sizes.heaviest);
  if (const auto& bath = effects.brownian; bath && bath->rate > 0.0)
    from_energy("brownian.temperature", bath->temperature, bath->temperature, sizes.lightest, sizes.heaviest);
  if (const auto& shear = effects.shear) {
    const long double flow = std::abs(static_cast<long double>(shear->rate)) * lengths.y();
    put("shear.rate", shear->rate, flow, flow, 1, true);
  }
  if (const auto& well = effects.square_well)  // of a pair: its mass is half of that of a disk
    from_energy("square_well.depth", well->depth, 2.0L * std::abs(well->depth), 0.5 * sizes.lightest, 0.5 * sizes.heaviest);
  if (effects.stepped_potential)
    for (std::size_t k = 0; k < effects.stepped_potential->steps.size(); ++k) {
      const double energy = effects.stepped_potential->steps[k].energy;
      from_energy(path_of_step(k) + ".energy", energy, 2.0L * std::abs(energy), 0.5 * sizes.lightest, 0.5 * sizes.heaviest);
    }
  return drives;
}

/// Returns the speed that the disks of a species start with, roughly.
double start_speed(const Species& species) {
  const auto largest = [](const std::vector<Eigen::Vector2d>& values) {
    double most_of_all = 0.0;
    for (const Eigen::Vector2d& v : values) most_of_all = std::max(most_of_all, v.cwiseAbs().maxCoeff());
    return most_of_all;
  };
  if (species.count == 0) return 0.0;
  if (const auto* law = std::get_if<UniformVelocities>(&species.velocities)) return law->maximum;
  if (const auto* law = std::get_if<FixedSpeed>(&species.velocities)) return law->speed;
  if (const auto* law = std::get_if<ListedVelocities>(&species.velocities)) return largest(law->values);
  if (const auto* law = std::get_if<FileVelocities>(&species.velocities)) return largest(law->values);
  if (const auto* law = std::get_if<MaxwellVelocities>(&species.velocities))
    return std::sqrt(law->temperature / lightest_of(species));
  return 0.0;
}

double fastest_of(const Scene& scene, const std::vector<Drive>& drives) {
  long double fastest = 0.0L;
  for (const Species& species : scene.species) fastest = std::max<long double>(fastest, start_speed(species));
  for (const Drive& drive : drives)
    if (drive.lasts) fastest = std::max(fastest, drive.fastest);
  return static_cast<double>(fastest);
}

/// Returns the value at which the speed of a drive would be `speed`, with its sign.
double value_at(const Drive& drive, long double speed, long double present) {
  return static_cast<double>(drive.value * std::pow(speed / present, static_cast<long double>(drive.power)));
}

void check_drive(const Drive& drive, const Sizes& sizes) {
  const auto refuse = [&](const char* side, long double speed, long double present, const std::string& why) {
    throw Refusal(drive.path, fmt::format("{} is {}; it must be {} {:.3g} here: {}", drive.path, drive.value, side,
                                          value_at(drive, speed, present), why));
  };
  const char* below = drive.value > 0.0 ? "below" : "above";
  if (!(drive.fastest * sizes.longest < most))
    refuse(below, most / static_cast<long double>(sizes.longest), drive.fastest,
           fmt::format("disks would move at {:.3g} by it, and speed times the length of the box, {:.6g}, must stay below {:.0e}",
                       drive.fastest, sizes.longest, most));
  if (!(drive.slowest * sizes.smallest > least))
    refuse(drive.value > 0.0 ? "above" : "below", least / static_cast<long double>(sizes.smallest), drive.slowest,
           fmt::format("disks would move at {:.3g} by it, and speed times the smallest radius, {:.6g}, must stay above {:.0e}",
                       drive.slowest, sizes.smallest, least));
  if (!drive.lasts || !sizes.duration) return;
  const long double passes = drive.fastest * *sizes.duration / sizes.shortest;
  if (passes > most_countable)
    refuse(
        below, most_countable, passes,
        fmt::format("until time {} disks would pass the box {:.3g} times, at {:.3g}, and more than 2^53 times cannot be computed",
                    *sizes.duration, passes, drive.fastest));
}

void check_mass(const std::string& path, double mass) {
  if (mass >= least_mass && mass <= most_mass) return;
  throw Refusal(path, fmt::format("{} is {}; it must lie between {:.0e} and {:.0e}, or its inverse would lose digits", path, mass,
                                  least_mass, most_mass));
}

void check_masses(const Scene& scene, const Sizes& sizes) {
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    if (species.count > 0 && species.masses.empty()) check_mass(fmt::format("disks.{}.mass", s), species.mass);
    for (std::size_t i = 0; i < species.masses.size(); ++i)
      if (!(species.masses[i] >= least_mass && species.masses[i] <= most_mass))
        check_mass(fmt::format("disks.{}.mass.{}", s, i), species.masses[i]);
  }
  for (std::size_t w = 0; w < scene.effects.walls.size(); ++w) {
    const WallProperties& wall = scene.effects.walls[w];
    if (!wall.mass) continue;
    const std::string path = fmt::format("walls.{}.mass", wall_names[w]);
    check_mass(path, *wall.mass);
    if (wall.load == 0.0 || *wall.mass * most_countable > sizes.heaviest) continue;
    throw Refusal(path,
                  fmt::format("{} is {}; it must be above {:.3g} here: the lighter a piston under load, the more often it must "
                              "hit a disk to reverse it, and more than 2^53 times cannot be computed",
                              path, *wall.mass, sizes.heaviest / most_countable));
  }
}

void check_coordinates(const Scene& scene, const Sizes& sizes) {
  for (int axis = 0; axis < 2; ++axis) {
    const double reach = largest_coordinate(scene.box, axis);
    if (reach <= most_radii * sizes.smallest) continue;
    throw Refusal(
        fmt::format("box.{}", axis_names[axis]),
        fmt::format("box.{} reaches to {:.6g}, where doubles are {:.2g} apart, and positions must be resolved to a thousandth of "
                    "the smallest radius, {:.6g}; move the box to the origin, make it smaller, or disks larger",
                    axis_names[axis], reach, spacing * reach, sizes.smallest));
  }
}

/// Walls that run away, until the end of the run, or where that is not known while a disk moves by its radius.
void check_runaways(const Scene& scene, const Sizes& sizes, double fastest) {
  for (std::size_t w = 0; w < scene.effects.walls.size(); ++w) {
    const bool upper = is_upper_wall(w);
    const double outward = (upper ? 1.0 : -1.0) * scene.effects.walls[w].velocity.value_or(0.0);
    const double room = most_radii * sizes.smallest - std::abs(edge_of(scene.box, w));
    const double before = scene.run.equilibrate ? scene.run.equilibrate->time.value_or(0.0) : 0.0;
    const double time = scene.run.time ? before + *scene.run.time : fastest > 0.0 ? sizes.smallest / fastest : 0.0;
    if (!(outward > 0.0) || outward * time <= room) continue;
    const std::string path = fmt::format("walls.{}.velocity", wall_names[w]);
    throw Refusal(
        path, fmt::format("{} is {}; it must be {} {:.3g} here: at time {:.6g} the wall would be where doubles are {:.2g} "
                          "apart, and positions must be resolved to a thousandth of the smallest radius, {:.6g}",
                          path, upper ? outward : -outward, upper ? "below" : "above", (upper ? 1.0 : -1.0) * room / time, time,
                          spacing * outward * time, sizes.smallest));
  }
}

/// Checks the rate of an effect that redraws velocities: `speed` is one that it gives, or leaves, to a heavy disk.
void check_redraws(const Scene& scene, const Sizes& sizes, const std::string& path, double rate, double speed,
                   const std::string& which) {
  const auto refuse = [&](double limit, const std::string& why) {
    throw Refusal(path, fmt::format("{} is {}; it must be below {:.3g} here: {}", path, rate, limit, why));
  };
  const double way = least_way * sizes.smallest;
  if (rate * way > speed && speed > 0.0)
    refuse(speed / way, fmt::format("{} would move by {:.3g} from one redraw of its velocity to the next, less than coordinates "
                                    "resolve",
                                    which, speed / rate));
  const auto disks = static_cast<double>(scene.disk_count());
  if (sizes.duration && rate * disks * *sizes.duration > most_countable)
    refuse(most_countable / disks / *sizes.duration,
           fmt::format("until time {} there would be {:.3g} redraws of velocities, and there can be at most "
                       "2^53",
                       *sizes.duration, rate * disks * *sizes.duration));
}

void check_baths(const Scene& scene, const Sizes& sizes) {
  const auto check_bath = [&](const std::string& path, double rate, double temperature) {
    check_redraws(scene, sizes, path, rate, std::sqrt(temperature / sizes.heaviest),
                  fmt::format("at temperature {} the heaviest disk", temperature));
  };
  if (const auto& bath = scene.effects.thermostat) check_bath("thermostat.rate", bath->rate, bath->temperature);
  if (const auto& bath = scene.effects.brownian) check_bath("brownian.rate", bath->rate, bath->temperature);
}

}  // namespace

void check_step(const Scene& scene, const std::string& path, double step, double per_step) {
  if (scene.run.time) {
    const double samples = std::floor(*scene.run.time / step) * per_step;
    if (samples < most_countable) return;
    throw Refusal(path, fmt::format("{} = {} asks for {:.3g} samples up to time {}; there can be at most 2^53, so make it larger",
                                    path, step, samples, *scene.run.time));
  }
  if (!scene.run.collisions || scene.disk_count() == 0) return;
  const Sizes sizes = sizes_of(scene);
  const double fastest = fastest_of(scene, drives_of(scene, sizes)), way = least_way * sizes.smallest;
  if (step * fastest >= way || fastest == 0.0) return;
  throw Refusal(path,
                fmt::format("{} is {}; it must be above {:.3g} here: from one sample to the next the fastest disk would move by "
                            "{:.3g}, less than coordinates resolve",
                            path, step, way / fastest, step * fastest));
}

double fastest_speed(const Scene& scene) {
  const std::vector<Drive> drives = drives_of(scene, sizes_of(scene));
  long double fastest = fastest_of(scene, drives);
  for (const Drive& drive : drives) fastest = std::max(fastest, drive.fastest);
  return static_cast<double>(fastest);
}

void check_scales(const Scene& scene) {
  if (scene.disk_count() == 0) return;
  const Sizes sizes = sizes_of(scene);
  check_coordinates(scene, sizes);
  check_masses(scene, sizes);
  const std::vector<Drive> drives = drives_of(scene, sizes);
  for (const Drive& drive : drives) check_drive(drive, sizes);
  check_runaways(scene, sizes, fastest_of(scene, drives));
  check_baths(scene, sizes);
  if (const auto& tumbling = scene.effects.tumbling)
    check_redraws(scene, sizes, "tumbling.rate", tumbling->rate, fastest_of(scene, drives), "the fastest disk");
}

}  // namespace carom::detail
