#pragma once
// The edges of the box as the textbook engine sees them: which image of a disk is met, how it moves, and what becomes of a disk
// that leaves the box. On periodic axes images are whole box lengths apart and move alike. In a sheared box (effects/shear.hpp)
// those above are displaced along x and faster than the disk itself; no wall is there, but a disk that comes to an edge gets an
// event.

#include "core/fall_time.hpp"
#include "core/running_totals.hpp"
#include "core/simulation_box.hpp"
#include "core/vec2.hpp"
#include "effects/shear.hpp"

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace carom {

template <class Real>
class Edges {
 public:
  Edges(const Box& box, const Effects& effects, double displacement)
      : domain_(LeesEdwards<Real>::acts(effects.shear) ? without_images_above(box) : box),
        images_(box, effects.shear, displacement) {}

  /// The box as it was at the start; a sheared box repeats along x only, as far as cells and coordinates are concerned.
  [[nodiscard]] const SimulationBox<Real>& domain() const { return domain_; }
  /// Whether images above and below move against the box.
  [[nodiscard]] bool sheared() const { return images_.present(); }
  /// Whether walls are at both ends of an axis.
  [[nodiscard]] bool walled(int axis) const { return !domain_.periodic[axis] && !sheared(); }

  // Images: `shift` counts the box lengths from a disk to its image.

  /// Turns r, the distance to a disk from another at time t, into that from the image of the other. In place, as the functions
  /// below: a vector that is passed on by value is copied by way of memory.
  void take_image(const Winding& shift, Real t, Vec2<Real>& r) const {
    if (shift[0] != 0) r[0] -= Real(shift[0]) * domain_.length[0];
    if (shift[1] != 0) r[1] -= Real(shift[1]) * domain_.length[1];
    if (shift[1] != 0 && sheared()) r[0] -= Real(shift[1]) * images_.displacement(t);
  }
  /// Gives v, the velocity of a disk, the value that its image has. Returns the component along x then.
  Real enter_image(const Winding& shift, Vec2<Real>& v) const { return v[0] += image_speed(shift); }
  /// Undoes enter_image() after a collision of the image, which began with the component `before`, and counts the work that the
  /// images did on the disks.
  void leave_image(const Winding& shift, Real mass, Real before, Vec2<Real>& v, RunningTotals& totals) const {
    const Real speed = image_speed(shift);
    if (speed != 0) totals.shear_energy.add(static_cast<double>(mass * (before - v[0]) * speed));
    v[0] -= speed;
  }
  /// Turns v, the velocity of a disk against another, into that against the image of the other.
  void take_image_velocity(const Winding& shift, Vec2<Real>& v) const {
    if (shift[1] != 0) v[0] -= image_speed(shift);
  }
  /// The shift of the nearest image at time t of a disk that is `apart` from another.
  [[nodiscard]] Winding nearest_image(Vec2<Real> apart, Real t) const {
    using std::floor;
    Winding nearest = Winding::Zero();
    if (sheared()) {
      nearest[1] = static_cast<std::int64_t>(floor(apart[1] / domain_.length[1] + Real(0.5)));
      apart[0] -= Real(nearest[1]) * images_.displacement(t);
    }
    for (int axis = 0; axis < 2; ++axis)
      if (domain_.periodic[axis])
        nearest[axis] = static_cast<std::int64_t>(floor(apart[axis] / domain_.length[axis] + Real(0.5)));
    return nearest;
  }

  // Disks that leave a sheared box.

  /// The time that a disk at r that moves outward at a speed takes to an edge of a sheared box.
  [[nodiscard]] Real time_to_edge(bool upper, const Vec2<Real>& r, Real outward) const {
    return fall_time<Real>(upper ? domain_.upper[1] - r[1] : r[1] - domain_.lower[1], -outward, 0);
  }
  /// Lets a disk on an edge of a sheared box go on as its image on the other side. Returns the box lengths that its position was
  /// moved back by.
  Winding cross(bool upper, Real mass, Vec2<Real>& r, Vec2<Real>& v, Real now, RunningTotals& totals) const {
    const Real up = upper ? 1 : -1;
    const Real before = v.squaredNorm();
    r.y() = upper ? domain_.lower.y() : domain_.upper.y();
    r.x() -= up * images_.displacement(now);
    v.x() -= up * images_.speed();
    totals.shear_energy.add(static_cast<double>(mass * (v.squaredNorm() - before)) / 2);
    Winding passed = domain_.wrap(r);
    passed[0] += (upper ? 1 : -1) * images_.whole_lengths(now);
    passed[1] += upper ? 1 : -1;
    return passed;
  }
  /// The speed along x of the flow of a sheared box at height y; 0 in other boxes.
  [[nodiscard]] Real flow(Real y) const { return images_.flow(y); }
  /// The displacement of the images above at time t, without whole box lengths.
  [[nodiscard]] double displacement(Real t) const { return static_cast<double>(images_.reduced(t)); }
  /// The least and the largest displacement of the images above between times 0 and t.
  [[nodiscard]] std::pair<Real, Real> slide(Real t) const {
    return std::minmax<Real>({images_.displacement(0), images_.displacement(t)});
  }
  /// The time in which images slide by `distance`, and `otherwise` where none slide.
  [[nodiscard]] Real time_to_slide(Real distance, Real otherwise) const {
    using std::abs;
    return sheared() ? std::min<Real>(otherwise, distance / abs(images_.speed())) : otherwise;
  }

  /// Moves the clock's zero to `now`.
  void rebase(Real now) { images_.rebase(now); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(images_);
  }

 private:
  /// The velocity along x of an image relative to its disk.
  [[nodiscard]] Real image_speed(const Winding& shift) const { return Real(shift[1]) * images_.speed(); }

  static Box without_images_above(Box box) {
    box.boundary[1] = Boundary::walls;
    return box;
  }

  SimulationBox<Real> domain_;
  LeesEdwards<Real> images_;
};

}  // namespace carom
