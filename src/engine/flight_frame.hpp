#pragma once
// The positions of disks. A disk in flight is a line in fixed-point coordinates (core/flight.hpp); the frame of these lines turns
// a line into what it is in the box at a time since the epoch: position, velocity, distances to disks and walls. It also draws
// lines anew, so that no digit of a position is lost.
//
// Three things are not in the coordinates. How often a disk has passed a periodic edge is counted beside them. Where
// disks fall, the frame falls with them from rest at the epoch, so that lines stay straight; how far it had fallen by then is its
// depth. In a sheared box (effects/shear.hpp) the box in which a disk is, of those one above the other, is that of the centre of
// its neighbourhood, whose height is kept here: coordinates wrap.

#include "core/fixed_axis.hpp"
#include "core/flight.hpp"
#include "core/prediction.hpp"
#include "core/two_doubles.hpp"
#include "core/vec2.hpp"
#include "engine/image_counts.hpp"
#include "neighbours/neighbour_search.hpp"

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace carom {

/// Root of the area per disk. The area itself might overflow, and roots of lengths would round lengths in other units otherwise.
inline double mean_spacing(const Box& box, std::size_t disks) {
  const Eigen::Vector2d lengths = box.lengths();
  return lengths[0] * std::sqrt(lengths[1] / lengths[0] / static_cast<double>(std::max<std::size_t>(disks, 1)));
}

/// The distance beyond a wall at which a line may start at the epoch, in mean spacings.
inline constexpr double free_path = 16.0;

/// An axis of the box with room for lines that start beyond a wall.
inline FixedAxis fixed_axis(const Box& box, int axis, std::size_t disks) {
  return {box, axis, free_path * mean_spacing(box, disks)};
}

template <class Line, class World>
class FlightFrame {
 public:
  /// `world` says how disks fall and images slide; it must outlive the frame.
  FlightFrame(const Box& box, std::size_t disks, const World& world)
      : axes_{fixed_axis(box, 0, disks), fixed_axis(box, 1, disks)},
        half_{axes_[0].at(axes_[0].upper), axes_[1].at(axes_[1].upper)},
        middle_{axes_[0].middle.high, axes_[1].middle.high},
        images_(disks),
        world_(world) {
    if (world_.sheared()) heights_.resize(disks);
    if (world_.falls()) rests_.resize(disks);
  }

  /// The frame of another one, for so many slots of disks.
  FlightFrame(const FlightFrame& other, std::size_t disks, const World& world)
      : axes_{other.axes_[0], other.axes_[1]},
        half_{other.half_[0], other.half_[1]},
        middle_{other.middle_[0], other.middle_[1]},
        depth_{other.depth_[0], other.depth_[1]},
        depth_rest_{other.depth_rest_[0], other.depth_rest_[1]},
        rests_(other.rests_.empty() ? 0 : disks),
        images_(disks),
        heights_(other.heights_.empty() ? 0 : disks),
        world_(world) {}

  /// What a frame knows of one disk beside its line.
  struct DiskRest {
    std::int64_t images[2];
    std::array<StepRest, 2> steps;

    bool operator==(const DiskRest&) const = default;
  };
  /// Writes it where it is to be: what rest_of() returns is put together first and then copied.
  void read_rest(std::int32_t i, DiskRest& rest) const {
    for (int k = 0; k < 2; ++k) rest.images[k] = images_.of(i, k);
    rest.steps = rests_.empty() ? std::array<StepRest, 2>{} : rests_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] DiskRest rest_of(std::int32_t i) const {
    DiskRest rest;
    read_rest(i, rest);
    return rest;
  }
  void prefetch_rest(std::int32_t i) const { images_.prefetch_count(i); }
  void set_rest(std::int32_t i, const DiskRest& rest) {
    for (int k = 0; k < 2; ++k) images_.set(i, k, rest.images[k]);
    if (!rests_.empty()) rests_[static_cast<std::size_t>(i)] = rest.steps;
  }

  [[nodiscard]] const FixedAxis& axis(int k) const { return axes_[k]; }
  [[nodiscard]] double length(int k) const { return axes_[k].upper - axes_[k].lower; }
  /// The distance from the middle of the box to where its upper side was at the start, in steps of a coordinate.
  [[nodiscard]] std::int64_t half(int k) const { return half_[k]; }
  /// The height of the centre of each disk's neighbourhood, in steps of 2^32; for sheared boxes alone.
  [[nodiscard]] const std::int32_t* heights() const { return heights_.data(); }

  // ---------------------------------------------------------------------------------------------- reading lines

  /// The distance from b to a at time `now`, to the nearest image.
  [[nodiscard]] Vec2<double> separation(const Line& a, const Line& b, double now) const {
    Vec2<double> r;
    for (int k = 0; k < 2; ++k)
      r[k] = static_cast<double>(wrapped_difference(a.x[k], b.x[k])) * axes_[k].unit + (a.v[k] - b.v[k]) * now;
    return r;
  }

  /// The position at time `now`, to double precision; along periodic axes it may lie beyond the edges.
  [[nodiscard]] Vec2<double> place(const Line& a, double now) const {
    Vec2<double> r;
    for (int k = 0; k < 2; ++k)
      r[k] = middle_[k] + (axes_[k].unit * static_cast<double>(coordinate(a, k).x) + (a.v[k] * now + world_.fallen(k, now)));
    return r;
  }

  /// The velocity at time `now`.
  [[nodiscard]] Vec2<double> velocity(const Line& a, double now) const {
    if constexpr (World::plain) return {a.v[0], a.v[1]};
    return {a.v[0] + world_.g()[0] * now, a.v[1] + world_.g()[1] * now};
  }
  /// The velocity of a line on which a disk has velocity v at time `now`.
  [[nodiscard]] Vec2<double> line_velocity(const Vec2<double>& v, double now) const {
    return {v[0] - world_.g()[0] * now, v[1] - world_.g()[1] * now};
  }

  /// The distance at time `now` from the edge of a disk to where a side of the box was at the start: the upper side of an axis
  /// (sign 1) or the lower (-1).
  [[nodiscard]] double room(const Line& a, int axis, int sign, double radius, double now) const {
    const std::int64_t limit = half_[axis] - axes_[axis].steps_of(radius);
    const std::int64_t x = coordinate(a, axis).x;
    const double start = axes_[axis].unit * static_cast<double>(sign > 0 ? limit - x : x + limit);
    if constexpr (World::plain) return start - sign * a.v[axis] * now;
    return (start - sign * a.v[axis] * now) - sign * world_.fallen(axis, now);
  }

  /// The distance along an axis from the centre of a neighbourhood (in steps of 2^32) to the disk at time `now`.
  [[nodiscard]] double offset(int axis, const Line& a, std::int32_t centre, double now) const {
    return axes_[axis].unit * static_cast<double>(wrapped_difference(a.x[axis], wide(centre))) + a.v[axis] * now;
  }

  /// The centre of a neighbourhood of that half-width round where disk i is at time `when`, ahead of it by half of the
  /// half-width. Between a quarter and three quarters there is little difference; dilute gases gain from more.
  [[nodiscard]] NeighbourhoodCentre neighbourhood_centre(std::int32_t i, const Line& a, double when, double half_width) const {
    const double fastest = std::max(std::abs(a.v[0]), std::abs(a.v[1]));
    const double ahead = fastest > 0.0 ? 0.5 * half_width / fastest : 0.0;
    if (world_.sheared()) {
      const double up = steps_up(i, a, when) + a.v[1] * ahead * axes_[1].steps;
      return {centre_along(0, a, when, ahead),
              static_cast<std::int32_t>(std::clamp(std::rint(up * 0x1p-32), -0x1p31, 0x1p31 - 1.0))};
    }
    return {centre_along(0, a, when, ahead), centre_along(1, a, when, ahead)};
  }

  /// The position of disk i at time `now` along an axis, inside the box, as it stands in a State.
  struct Coordinate {
    double position;
    double remainder;    ///< what rounding took from the position
    std::int64_t image;  ///< box lengths travelled past the periodic edges
  };
  [[nodiscard]] Coordinate coordinate_in_box(std::int32_t i, const Line& a, int k, double now) const {
    std::int64_t x;
    const AtEpoch begun = coordinate(a, k);
    std::int64_t image = images_.of(i, k) + begun.edges;
    const std::int64_t way = axes_[k].steps_of(a.v[k] * now + world_.fallen(k, now));
    if (__builtin_add_overflow(begun.x, way, &x)) image += way < 0 ? -1 : 1;
    const bool keeps_box = k == 1 && world_.sheared();
    if (keeps_box) keep_in_box(i, x, image);
    double position = axes_[k].position(x);
    if (axes_[k].periodic && position < axes_[k].lower) position = axes_[k].lower;  // rounded an ulp below
    if (keeps_box && position >= axes_[k].upper) position = std::nextafter(axes_[k].upper, axes_[k].lower);
    const double remainder = axes_[k].remainder(x, position);
    if (axes_[k].periodic && position >= axes_[k].upper) position = axes_[k].lower, ++image;
    return {position, remainder, image};
  }

  // ---------------------------------------------------------------------------------------------- drawing lines

  /// Draws the line of disk i from where a state has it, in column `id`. A disk of that radius that falls and begins in contact
  /// with a wall is so in steps too: else the gap that rounding makes would be there at every bounce, since nothing is lost
  /// between them.
  void begin(std::int32_t i, Line& a, const State& start, std::int32_t id, double radius) {
    for (int k = 0; k < 2; ++k) {
      const double position = start.positions(k, id);
      a.x[k] = axes_[k].at(position);
      a.v[k] = start.velocities(k, id);
      if (start.images.cols() > id) images_.set(i, k, start.images(k, id));
      const bool rounded_up = axes_[k].periodic && a.x[k] == INT64_MIN && position > axes_[k].lower;
      if (k == 1 && world_.sheared()) {
        if (rounded_up) a.x[1] = INT64_MAX;
        height(i) = static_cast<std::int32_t>(a.x[1] >> 32);
      } else if (rounded_up) {
        images_.step(i, k, 1);
      }
      if (!world_.falls() || axes_[k].periodic) continue;
      const std::int64_t contact = half_[k] - axes_[k].steps_of(radius);
      for (const std::int64_t x : {-contact, contact})
        if (std::abs(a.x[k] - x) <= 2) a.x[k] = x;
    }
  }

  /// Gives disk i a line on which it is at time `now` where it was on the old one, and has velocity v.
  void change_velocity(std::int32_t i, Line& a, const Vec2<double>& v, double now) {
    const Vec2<double> along = line_velocity(v, now);
    for (int k = 0; k < 2; ++k) {
      a.x[k] = moved(i, a, k, along[k], now, world_.falls() ? lift(a, k, now, v[k], along[k], now) : 0.0);
      a.v[k] = along[k];
    }
  }

  /// Lets the line of disk i start at time `now`, which becomes the epoch.
  void rebase(std::int32_t i, Line& a, double now) {
    for (int k = 0; k < 2; ++k) {
      const double v = a.v[k] + world_.g()[k] * now;
      a.x[k] = moved(i, a, k, 0.0, now, world_.falls() ? lift(a, k, now, v, v, 0.0) : 0.0);
      if constexpr (!World::plain) a.v[k] = v;
    }
    if (world_.sheared()) {
      std::int64_t image = images_.of(i, 1);
      keep_in_box(i, a.x[1], image);
      images_.set(i, 1, image);
    }
  }
  /// Lets the frame fall until time `now`, which becomes the epoch.
  void fall(double now) {
    for (int k = 0; k < 2; ++k) depth_[k] += depth_rest_[k].steps_of(world_.g()[k] * now, now / 2.0, axes_[k].steps);
  }
  /// How far the frame has fallen from where it began, in steps of 2^32 of a coordinate.
  [[nodiscard]] std::array<std::int64_t, 2> fallen() const {
    return {(depth_[0] + 0x80000000) >> 32, (depth_[1] + 0x80000000) >> 32};
  }
  /// Whether the frame has fallen as far as that from where it began, or by an eighth of a periodic axis.
  [[nodiscard]] bool has_fallen(double far) const {
    const auto fallen = [&](int k) {
      const double depth = axes_[k].unit * std::abs(static_cast<double>(depth_[k]));
      return depth >= (axes_[k].periodic ? std::min(far, length(k) / 8.0) : far);
    };
    return fallen(0) || fallen(1);
  }
  /// Puts the frame back to where it began, at the epoch; all lines stay where they are in the box.
  template <class Lines>
  void reset_fall(Lines& lines) {
    for (int k = 0; k < 2; ++k) {
      const std::int64_t fallen = std::exchange(depth_[k], 0);
      std::int32_t i = 0;
      for (Line& a : lines) {
        if (__builtin_add_overflow(a.x[k], fallen, &a.x[k])) images_.step(i, k, fallen < 0 ? -1 : 1);
        ++i;
      }
    }
  }
  /// Doubles the step of the coordinates along an axis, so that nothing but their last digits changes.
  template <class Lines>
  void coarsen(int k, Lines& lines) {
    axes_[k].unit *= 2.0;
    axes_[k].steps /= 2.0;
    half_[k] /= 2;
    for (Line& a : lines) a.x[k] >>= 1;
    depth_[k] = depth_rest_[k].coarsened(depth_[k]);
  }

  /// Makes coordinates coarser, before lines are drawn, until those of all positions fit, and `with_distances` their distances
  /// from each other: walls may have moved far from where the box says.
  void make_room(const Eigen::Matrix2Xd& positions, bool with_distances) {
    std::vector<Line> no_lines;
    for (int k = 0; k < 2; ++k) {
      if (axes_[k].periodic || positions.cols() == 0) continue;
      const double lowest = positions.row(k).minCoeff() - middle_[k], highest = positions.row(k).maxCoeff() - middle_[k];
      const double farthest = std::max({-lowest, highest, with_distances ? highest - lowest : 0.0});
      while (farthest >= 0x1p63 * axes_[k].unit) coarsen(k, no_lines);
    }
  }

  /// Counts the edges that a pair whose lines the kernel has drawn passed in it.
  [[gnu::noinline, gnu::cold]] void count_images(const CollidedPair& pair) {
    for (int k = 0; k < 4; ++k)
      if ((pair.wrapped >> k & 1) != 0) images_.step(pair.disk[k / 2], k % 2, (pair.downwards >> k & 1) != 0 ? -1 : 1);
  }

  // ---------------------------------------------------------------------------------------------- sheared boxes

  /// The height of the centre of the neighbourhood of disk i.
  [[nodiscard]] std::int32_t& height(std::int32_t i) { return heights_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::int32_t height(std::int32_t i) const { return heights_[static_cast<std::size_t>(i)]; }
  /// The number of boxes above j at which that image of it lies which is nearest to i: -1, 0 or 1; 0 where no images slide.
  [[nodiscard]] std::int32_t boxes_above(std::int32_t i, std::int32_t j) const {
    return world_.sheared() ? boxes_between(height(i), height(j)) : 0;
  }
  /// The height of disk i in its box at a time, in steps of a coordinate from the middle.
  [[nodiscard]] double steps_up(std::int32_t i, const Line& a, double when) const {
    const std::int64_t centre = wide(height(i));
    return static_cast<double>(centre) +
           (static_cast<double>(wrapped_difference(a.x[1], centre)) + a.v[1] * when * axes_[1].steps);
  }
  /// The height of disk i above the lower side of its box at a time, from there where the box is.
  [[nodiscard]] double height_in_box(std::int32_t i, const Line& a, double when) const {
    return middle_[1] + axes_[1].unit * steps_up(i, a, when);
  }
  /// Lets disk i, on the edge of a sheared box, go on as its image one box lower (up = 1) or higher (-1): images above are
  /// displaced by `displacement` steps at the epoch, and by `whole_lengths` box lengths now.
  void cross_sheared_edge(std::int32_t i, Line& a, std::int32_t up, std::int64_t displacement, std::int64_t whole_lengths) {
    // The image one box lower has its line where this one has it at the epoch, but for the displacement. Its coordinate y wraps.
    if (up > 0 ? __builtin_sub_overflow(a.x[0], displacement, &a.x[0]) : __builtin_add_overflow(a.x[0], displacement, &a.x[0]))
      images_.step(i, 0, (displacement < 0) == (up > 0) ? 1 : -1);
    // Coordinates are displaced by the nearest number of steps, disks to the left by what is left without whole box lengths.
    images_.set(i, 0, images_.of(i, 0) + up * (whole_lengths - (displacement < 0 ? 1 : 0)));
    height(i) = up > 0 ? INT32_MIN : INT32_MAX;
  }

  [[nodiscard]] std::size_t bytes() const {
    return images_.bytes() + rests_.capacity() * sizeof(rests_[0]) + heights_.capacity() * sizeof(std::int32_t);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(axes_[0], axes_[1], half_[0], half_[1], images_, heights_);
    archive(depth_[0], depth_[1], depth_rest_[0], depth_rest_[1], rests_);
  }

 private:
  [[nodiscard]] static std::int64_t wide(std::int32_t centre) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(centre) << 32);
  }

  /// The coordinate of a line at the epoch, in steps from the middle of the box, and how many periodic edges the frame in which
  /// it is drawn has carried it past by then: -1, 0 or 1.
  struct AtEpoch {
    std::int64_t x;
    std::int64_t edges;
  };
  [[nodiscard]] AtEpoch coordinate(const Line& a, int axis) const {
    if constexpr (World::plain) return {a.x[axis], 0};
    std::int64_t x;
    const bool wraps = __builtin_add_overflow(a.x[axis], depth_[axis], &x);
    return {x, !wraps ? 0 : depth_[axis] < 0 ? -1 : 1};
  }

  [[nodiscard]] std::int32_t centre_along(int axis, const Line& a, double when, double ahead) const {
    const auto x = static_cast<std::uint64_t>(a.x[axis]) + static_cast<std::uint64_t>(axes_[axis].steps_of(a.v[axis] * when)) +
                   static_cast<std::uint64_t>(axes_[axis].steps_of(a.v[axis] * ahead));
    return static_cast<std::int32_t>((x + 0x80000000U) >> 32);
  }

  /// The coordinate at the epoch from which disk i gets at a speed to where it is at a time, lifted where disks fall. Counts an
  /// edge where the coordinate wraps.
  [[nodiscard]] std::int64_t moved(std::int32_t i, const Line& a, int axis, double speed, double time, double lift) {
    std::int64_t x;
    const double before = a.v[axis];
    const std::int64_t steps =
        world_.falls() ? fallen_steps(i, axis, before, speed, time, lift) : axes_[axis].steps_of((before - speed) * time);
    if (__builtin_add_overflow(a.x[axis], steps, &x)) [[unlikely]]
      images_.step(i, axis, steps < 0 ? -1 : 1);
    return x;
  }
  /// The steps of moved() where disks fall: height is energy there, so rounding must add up to nothing.
  [[nodiscard]] std::int64_t fallen_steps(std::int32_t i, int axis, double before, double speed, double time, double lift) {
    StepRest& rest = rests_[static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)];
    const double per_length = axes_[axis].steps;
    return rest.steps_of(before, time, per_length) + rest.steps_of(-speed, time, per_length) +
           rest.steps_of(lift, 1.0, per_length);
  }
  /// The height by which a disk is to be lifted where its line changes, so that the energy of height makes up for what rounding
  /// does to that of speed. Its velocity was velocity(a) at `now`, and is to be v where its new line has the velocity `along` at
  /// time `then`.
  [[nodiscard]] double lift(const Line& a, int axis, double now, double v, double along, double then) const {
    const double g = world_.g()[axis], before = a.v[axis] + g * now;
    if (g == 0.0) return 0.0;
    const double lost = before * missing(a.v[axis], g, now, before), gained = v * missing(along, g, then, v);
    const double height = (gained - lost) / g;
    // Where weights are next to nothing, no height makes up for a digit of the speed; nor need it.
    return std::abs(height) <= 0x1p-50 * length(axis) ? height : 0.0;
  }
  /// line + g t - v, which v is rounded from or that was rounded to `line`.
  [[nodiscard]] static double missing(double line, double g, double t, double v) {
    const TwoDoubles fall = TwoDoubles::product(g, t), sum = TwoDoubles::sum(line, fall.high);
    return ((sum.high - v) + sum.low) + fall.low;
  }

  /// Puts a disk of a sheared box that rounding has carried over an edge back to the side of its own box.
  void keep_in_box(std::int32_t i, std::int64_t& y, std::int64_t& image) const {
    const std::int64_t centre = wide(height(i)), off = wrapped_difference(y, centre);
    if (std::int64_t inside; !__builtin_add_overflow(centre, off, &inside)) return;
    y = off > 0 ? INT64_MAX : INT64_MIN;
    image -= off > 0 ? 1 : -1;
  }

  FixedAxis axes_[2];
  std::int64_t half_[2];
  double middle_[2];            ///< of the box
  std::int64_t depth_[2] = {};  ///< that the frame has fallen, at the epoch, in steps
  StepRest depth_rest_[2];
  std::vector<std::array<StepRest, 2>> rests_;  ///< of the coordinates of disks that fall
  ImageCounts images_;
  std::vector<std::int32_t> heights_;  ///< in a sheared box
  const World& world_;
};

}  // namespace carom
