#include "pages/drawing.hpp"

#include "observe/voronoi_cells.hpp"
#include "scene/changes.hpp"
#include "scene/fixed_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <variant>
#include <vector>

namespace carom::detail {

namespace {

constexpr double rimmed_from = 5.0;  // pixels: the radius below which a disk would be all rim
constexpr double tolerance = 0.02;   // pixels: how far from a circle what Cairo draws in its place may be

/// What the cells of the disks say.
struct LocalOrder {
  std::vector<std::complex<double>> psi6;
  std::vector<std::size_t> neighbours;  ///< those behind a side that has a length; 0 where a wall cuts the cell off
};

LocalOrder order_of(const Subject& subject, const Moment& moment) {
  LocalOrder found;
  if (!needs_cells(subject.look.colouring)) return found;
  Box box = subject.scene.box;
  box.lower = {moment.sides[0], moment.sides[2]};
  box.upper = {moment.sides[1], moment.sides[3]};
  const VoronoiCells cells(box, moment.positions, moment.shear_displacement);
  const double spacing = std::sqrt(box.lengths().prod() / std::max(1.0, static_cast<double>(cells.count())));
  const auto is_seen = [&](const VoronoiSide& side) { return side.length >= 1e-9 * spacing; };
  for (std::size_t i = 0; i < cells.count(); ++i) {
    const auto sides = cells.sides(i);
    found.psi6.push_back(sixfold_order(sides));
    found.neighbours.push_back(cells.at_wall(i) ? 0 : static_cast<std::size_t>(std::ranges::count_if(sides, is_seen)));
  }
  return found;
}

class Drawing {
 public:
  Drawing(cairo_t* context, const Subject& subject, const Moment& moment)
      : context_(context),
        of_(subject),
        at_(subject.layout),
        moment_(moment),
        theme_(theme(subject.look.dark)),
        order_(order_of(subject, moment)) {}

  void draw() {
    cairo_set_tolerance(context_, tolerance);
    set_colour(context_, theme_.paper);
    cairo_paint(context_);
    cairo_save(context_);
    outline_box();
    set_colour(context_, theme_.stage);
    cairo_fill_preserve(context_);
    cairo_clip(context_);  // what sticks out of a periodic edge comes in at the other
    draw_trails();
    draw_fixed_shapes();
    draw_disks();
    if (of_.look.velocities) draw_velocities();
    cairo_restore(context_);
    draw_edges();
  }

 private:
  [[nodiscard]] const Box& box() const { return of_.scene.box; }

  void outline_box() {
    const auto& [left, right, bottom, top] = moment_.sides;
    if (box().is_circle) return circle(box().lower + 0.5 * box().lengths(), 0.5 * (right - left) * at_.scale);
    cairo_rectangle(context_, at_.x(left), at_.y(top), (right - left) * at_.scale, (top - bottom) * at_.scale);
  }

  /// Calls draw(shift) for the place itself and for all its periodic images that reach into the box, `reach` round `place`.
  template <class Draw>
  void for_images(const Eigen::Vector2d& place, double reach, Draw&& draw) const {
    const auto& [left, right, bottom, top] = moment_.sides;
    const Eigen::Vector2d lengths = box().lengths();
    const int up = box().periodic(1) ? 1 : 0;
    for (int b = -up; b <= up; ++b) {
      const double y = b * lengths.y();
      if (place.y() + y + reach < bottom || place.y() + y - reach > top) continue;
      const int along = !box().periodic(0) ? 0 : b == 0 ? 1 : 2;  // images above may be displaced by up to a box length
      for (int a = -along; a <= along; ++a) {
        const double x = a * lengths.x() + b * moment_.shear_displacement;
        if (place.x() + x + reach < left || place.x() + x - reach > right) continue;
        draw(Eigen::Vector2d(x, y));
      }
    }
  }

  void circle(const Eigen::Vector2d& centre, double radius) {
    cairo_new_sub_path(context_);
    cairo_arc(context_, at_.x(centre.x()), at_.y(centre.y()), radius, 0.0, 2.0 * std::numbers::pi);
  }
  void move_to(const Eigen::Vector2d& place) { cairo_move_to(context_, at_.x(place.x()), at_.y(place.y())); }
  void line_to(const Eigen::Vector2d& place) { cairo_line_to(context_, at_.x(place.x()), at_.y(place.y())); }

  void draw_trails() {
    const bool curved = !of_.scene.effects.acceleration().isZero();
    cairo_set_line_width(context_, std::max(1.2, 0.5 * at_.line));
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    for (std::size_t i = 0; i < moment_.trails.size(); ++i) {
      set_colour(context_, trail_colour(i), 0.75);
      Eigen::Vector2d pen(NAN, NAN);
      for (const Stretch& stretch : moment_.trails[i]) {
        const double reach = std::max((stretch.to - stretch.from).norm(), (stretch.middle - stretch.from).norm());
        for_images(stretch.from, reach, [&](const Eigen::Vector2d& shift) {
          const Eigen::Vector2d from = stretch.from + shift, to = stretch.to + shift, middle = stretch.middle + shift;
          if (pen != from) move_to(from);
          if (curved) {
            const Eigen::Vector2d first = from + (middle - from) * (2.0 / 3.0), second = to + (middle - to) * (2.0 / 3.0);
            cairo_curve_to(context_, at_.x(first.x()), at_.y(first.y()), at_.x(second.x()), at_.y(second.y()), at_.x(to.x()),
                           at_.y(to.y()));
          } else {
            line_to(to);
          }
          pen = to;
        });
      }
      cairo_stroke(context_);
    }
  }
  /// Many trails have one colour, few their disk's.
  [[nodiscard]] Colour trail_colour(std::size_t disk) const {
    return of_.look.colouring == Colouring::species || of_.look.colouring == Colouring::id ? colour_of(disk) : theme_.accent;
  }

  void stroke_shape() {
    cairo_set_line_width(context_, std::max(1.5, 0.67 * at_.line));
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
    cairo_stroke(context_);
  }
  [[nodiscard]] static double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

  void draw_fixed_shapes() {
    set_colour(context_, theme_.solid);
    const Effects effects = effects_at(of_.scene, moment_.time);
    for (const Obstacle& shape : effects.obstacles) {
      if (const auto* disk = std::get_if<DiskObstacle>(&shape)) {
        for_images(disk->centre, disk->radius,
                   [&](const Eigen::Vector2d& shift) { circle(disk->centre + shift, disk->radius * at_.scale); });
        cairo_fill(context_);
      } else if (const auto* segment = std::get_if<SegmentObstacle>(&shape)) {
        for_images(segment->from, (segment->to - segment->from).norm(), [&](const Eigen::Vector2d& shift) {
          move_to(segment->from + shift);
          line_to(segment->to + shift);
        });
        stroke_shape();
      } else if (const auto* arc = std::get_if<ArcObstacle>(&shape)) {
        for_images(arc->centre, arc->radius, [&](const Eigen::Vector2d& shift) {
          const Eigen::Vector2d centre = arc->centre + shift;
          cairo_new_sub_path(context_);  // angles of the picture are clockwise, for y goes down
          cairo_arc_negative(context_, at_.x(centre.x()), at_.y(centre.y()), arc->radius * at_.scale, -radians(arc->from),
                             -radians(arc->to));
        });
        stroke_shape();
      }
    }
  }

  [[nodiscard]] Colour colour_of(std::size_t disk) const {
    if (needs_cells(of_.look.colouring) && order_.neighbours[disk] == 0) return theme_.frame;
    switch (of_.look.colouring) {
      case Colouring::speed:
        return scale_colour(moment_.velocities.col(static_cast<Eigen::Index>(disk)).norm() / of_.ranges.fastest);
      case Colouring::species:
        return kind_colour(static_cast<std::size_t>(of_.disks.species[disk]));
      case Colouring::collisions:
        return moment_.collisions.empty()
                   ? theme_.plain
                   : scale_colour(static_cast<double>(moment_.collisions[disk]) / of_.ranges.most_collisions);
      case Colouring::id:
        return scale_colour(static_cast<double>(disk) / std::max(1.0, static_cast<double>(of_.disks.count()) - 1.0));
      case Colouring::psi6:
        return scale_colour(std::abs(order_.psi6[disk]));
      case Colouring::psi6_angle:
        return circle_colour(std::arg(order_.psi6[disk]) / (2.0 * std::numbers::pi));
      case Colouring::neighbours:
        return neighbours_colour(order_.neighbours[disk], of_.look.dark);
      case Colouring::plain:
        break;
    }
    return theme_.plain;
  }

  void draw_disks() {
    for (std::size_t i = 0; i < of_.disks.count(); ++i) {
      const Eigen::Vector2d place = moment_.positions.col(static_cast<Eigen::Index>(i));
      const double length = of_.disks.radius[i] * moment_.scale, radius = length * at_.scale;
      const Colour colour = colour_of(i);
      for_images(place, length, [&](const Eigen::Vector2d& shift) {
        circle(place + shift, radius);
        set_colour(context_, colour);
        cairo_fill(context_);
        if (radius < rimmed_from) return;
        // Inside, so that the disk is as large as it is.
        const double rim = std::max(0.75, std::min(0.33 * at_.line, 0.06 * radius));
        circle(place + shift, radius - 0.5 * rim);
        set_colour(context_, theme_.rim, 0.4);
        cairo_set_line_width(context_, rim);
        cairo_stroke(context_);
      });
    }
  }

  /// Draws velocities from the rim on; the typical speed is 3.5 % of the box long.
  void draw_velocities() {
    const auto& [left, right, bottom, top] = of_.ranges.extent;
    const double unit = 0.035 * std::min(right - left, top - bottom) / of_.ranges.typical_speed;
    set_colour(context_, theme_.ink);
    cairo_set_line_width(context_, std::max(1.0, 0.5 * at_.line));
    for (std::size_t i = 0; i < of_.disks.count(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const Eigen::Vector2d arrow = moment_.velocities.col(column) * unit;
      const double length = arrow.norm();
      if (!(length * at_.scale > 1.0)) continue;
      const Eigen::Vector2d ahead = arrow / length, aside(-ahead.y(), ahead.x());
      const Eigen::Vector2d rim = moment_.positions.col(column) + ahead * (of_.disks.radius[i] * moment_.scale);
      const Eigen::Vector2d tip = rim + arrow;
      const double head = std::min(2.0 * at_.line / at_.scale + 2.0 / at_.scale, 0.5 * length);
      for_images(rim, length, [&](const Eigen::Vector2d& shift) {
        move_to(rim + shift);
        line_to(tip + shift);
        move_to(tip + shift - head * (ahead + 0.6 * aside));
        line_to(tip + shift);
        line_to(tip + shift - head * (ahead - 0.6 * aside));
      });
      cairo_stroke(context_);
    }
  }

  /// Walls as solid lines outside the box, periodic edges as faint dashes.
  void draw_edges() {
    const auto& [left, right, bottom, top] = moment_.sides;
    if (box().is_circle) {
      circle(box().lower + 0.5 * box().lengths(), 0.5 * (right - left) * at_.scale + 0.5 * at_.line);
      set_colour(context_, theme_.ink);
      cairo_set_line_width(context_, at_.line);
      return cairo_stroke(context_);
    }
    const double x0 = at_.x(left), x1 = at_.x(right), y0 = at_.y(bottom), y1 = at_.y(top);
    const double off = 0.5 * at_.line;
    const auto edge = [&](int axis, double ax, double ay, double bx, double by) {
      const bool periodic = box().periodic(axis);
      set_colour(context_, periodic ? theme_.frame : theme_.ink);
      cairo_set_line_width(context_, periodic ? std::max(1.0, 0.5 * at_.line) : at_.line);
      const double dash = 3.0 * at_.line;
      cairo_set_dash(context_, &dash, periodic ? 1 : 0, 0.0);
      cairo_set_line_cap(context_, periodic ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_SQUARE);
      cairo_move_to(context_, ax, ay);
      cairo_line_to(context_, bx, by);
      cairo_stroke(context_);
    };
    const double off_x = box().periodic(0) ? 0.0 : off, off_y = box().periodic(1) ? 0.0 : off;
    // Dashes first, below walls.
    for (const bool periodic : {true, false}) {
      if (box().periodic(0) == periodic) {
        edge(0, x0 - off_x, y0, x0 - off_x, y1);
        edge(0, x1 + off_x, y0, x1 + off_x, y1);
      }
      if (box().periodic(1) == periodic) {
        edge(1, x0, y0 + off_y, x1, y0 + off_y);
        edge(1, x0, y1 - off_y, x1, y1 - off_y);
      }
    }
    cairo_set_dash(context_, nullptr, 0, 0.0);
  }

  cairo_t* context_;
  const Subject& of_;
  const Layout& at_;
  const Moment& moment_;
  const Theme& theme_;
  LocalOrder order_;
};

}  // namespace

void draw_moment(cairo_t* context, const Subject& subject, const Moment& moment) {
  Drawing(context, subject, moment).draw();
  if (subject.look.caption) draw_caption(context, subject, moment);
}

}  // namespace carom::detail
