#pragma once
// The cell grid of the textbook engine: square-ish cells at least one contact distance wide, so that disks in contact are always
// in the same or in adjacent cells. A disk changes cells at crossing times of its own; this never touches its position
// or velocity, so the grid leaves no trace in the bits of a trajectory.
//
// On periodic axes cells repeat for ever. A disk's `winding` counts the box lengths between the frame of its recorded
// position and its cell; neighbours come with the image shift s for which r_i - r_j - s * length is the separation.
// Works with one or two cells per axis too: then one disk is its neighbour's neighbour through several images.
//
// Where the images above and below slide (effects/shear.hpp), the rows of cells beyond the upper and lower edge are those of the
// other end, displaced by any amount; slide() says by how much they may be.

#include "core/fall_time.hpp"
#include "core/simulation_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// The time at which a disk leaves its cell, and the side that it crosses.
template <class Real>
struct CellCrossing {
  Real time = infinity<Real>;
  std::int8_t axis = 0;
  std::int8_t step = 0;  ///< +1 or -1

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, axis, step);
  }
};

template <class Real>
class CellGrid {
 public:
  /// `reach`: the largest contact distance. Cells hold about one disk each where that is wider than reach.
  CellGrid(const SimulationBox<Real>& domain, Real reach, std::size_t disks) : domain_(domain) {
    // An exact width would do in exact arithmetic; one part in 128 covers every rounding of crossing times.
    const double at_least = static_cast<double>(reach) * (1.0 + 1.0 / 128.0);
    const double area = static_cast<double>(domain.length[0]) * static_cast<double>(domain.length[1]);
    const double width = std::max(at_least, std::sqrt(area / static_cast<double>(std::max<std::size_t>(disks, 1))));
    for (int a = 0; a < 2; ++a) {
      // A thin box could have any number of cells along its length: no more than four per disk.
      const double cells = std::floor(static_cast<double>(domain.length[a]) / width);
      count_[a] = static_cast<std::int32_t>(std::clamp(cells, 1.0, 4.0 * static_cast<double>(disks) + 1.0));
      width_[a] = domain.length[a] / Real(count_[a]);
    }
    first_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]));
    places_.resize(disks);
  }

  /// Puts disk i, at position r inside the box, into its cell. Requires clear() before the first of a new round.
  void insert(std::int32_t i, const Vec2<Real>& r) {
    using std::floor;
    Place& place = at(i);
    place.winding.setZero();
    for (int a = 0; a < 2; ++a) {
      const Real x = floor((r[a] - domain_.lower[a]) / width_[a]);
      place.cell[a] = x > 0 ? std::min(static_cast<std::int32_t>(x), count_[a] - 1) : 0;
    }
    link(i);
  }

  /// Makes axis y one without images of its own, beyond whose edges lie images displaced along x by anything from `least` to
  /// `most` upwards, and by as much the other way downwards.
  void slide(Real least, Real most) {
    using std::ceil;
    using std::floor;
    sliding_ = true;
    slid_least_ = static_cast<std::int32_t>(floor(least / width_[0]));
    slid_most_ = static_cast<std::int32_t>(ceil(most / width_[0]));
  }

  /// Moves disk i to position r, inside the box.
  void move(std::int32_t i, const Vec2<Real>& r) {
    unlink(i);
    insert(i, r);
  }

  void clear() { std::fill(first_.begin(), first_.end(), none); }

  /// Returns when and where disk i, at position r with velocity v at time t and acceleration g, leaves its cell, not before t.
  /// With an acceleration, t must be the present: a path that comes back might else be found to have left long ago.
  [[nodiscard, gnu::flatten]] CellCrossing<Real> next_crossing(std::int32_t i, const Vec2<Real>& r, const Vec2<Real>& v,
                                                               const Vec2<Real>& g, Real t) const {
    const Place& place = at(i);
    CellCrossing<Real> next;
    for (int a = 0; a < 2; ++a) {
      for (const bool up : {false, true}) {
        if (!domain_.periodic[a] && place.cell[a] == (up ? count_[a] - 1 : 0)) continue;  // a wall is there
        if (g[a] == 0 && !(up ? v[a] > 0 : v[a] < 0)) continue;                           // never, and no time to find it out
        const Real edge =
            domain_.lower[a] + Real(place.cell[a] + (up ? 1 : 0)) * width_[a] + Real(place.winding[a]) * domain_.length[a];
        const Real time = t + (up ? fall_time<Real>(edge - r[a], -v[a], -g[a]) : fall_time<Real>(r[a] - edge, v[a], g[a]));
        if (time < next.time) next = {time, static_cast<std::int8_t>(a), static_cast<std::int8_t>(up ? 1 : -1)};
      }
    }
    return next;
  }

  /// Moves disk i to the cell beyond the given crossing.
  void cross(std::int32_t i, const CellCrossing<Real>& crossing) {
    unlink(i);
    Place& place = at(i);
    std::int32_t& cell = place.cell[crossing.axis];
    cell += crossing.step;
    if (cell == count_[crossing.axis]) cell = 0, ++place.winding[crossing.axis];
    if (cell == -1) cell = count_[crossing.axis] - 1, --place.winding[crossing.axis];
    link(i);
  }

  /// Adapts to a recorded position of disk i that was moved by -winding * length.
  void refold(std::int32_t i, const Winding& winding) { at(i).winding -= winding; }

  /// Calls visit(j, shift) for every disk j != i in the nine cells around disk i, and for images of j as often as they
  /// are there.
  template <class Visit>
  void for_neighbours(std::int32_t i, Visit&& visit) const {
    const Place& place = at(i);
    for (int side = -1; side <= 1; ++side) visit_row(i, place.cell[1] + side, -1, 1, visit);
  }

  /// Visits the disks in the three cells that come into reach when disk i has just made the given crossing.
  template <class Visit>
  void for_neighbours_ahead(std::int32_t i, const CellCrossing<Real>& crossing, Visit&& visit) const {
    const Place& place = at(i);
    if (crossing.axis == 1) return visit_row(i, place.cell[1] + crossing.step, -1, 1, visit);
    for (int side = -1; side <= 1; ++side) visit_row(i, place.cell[1] + side, crossing.step, crossing.step, visit);
  }

  /// Returns the lower corner of the cell of disk i, in the frame of its recorded position.
  [[nodiscard]] Vec2<Real> cell_lower(std::int32_t i) const {
    const Place& place = at(i);
    Vec2<Real> corner;
    for (int a = 0; a < 2; ++a)
      corner[a] = domain_.lower[a] + Real(place.cell[a]) * width_[a] + Real(place.winding[a]) * domain_.length[a];
    return corner;
  }
  [[nodiscard]] std::size_t disks() const { return places_.size(); }
  [[nodiscard]] std::size_t bytes() const {
    return first_.capacity() * sizeof(std::int32_t) + places_.capacity() * sizeof(Place);
  }
  [[nodiscard]] Vec2<Real> width() const { return {width_[0], width_[1]}; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(domain_, count_[0], count_[1], width_[0], width_[1], sliding_, slid_least_, slid_most_, first_, places_);
  }

 private:
  static constexpr std::int32_t none = -1;

  struct Place {
    std::int32_t cell[2];
    std::int32_t next;  ///< in the same cell
    std::int32_t previous;
    Winding winding;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(cell, next, previous, winding);
    }
  };

  [[nodiscard]] Place& at(std::int32_t i) { return places_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Place& at(std::int32_t i) const { return places_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::size_t index(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(x);
  }

  void link(std::int32_t i) {
    Place& place = at(i);
    std::int32_t& first = first_[index(place.cell[0], place.cell[1])];
    place.previous = none;
    place.next = first;
    if (first != none) at(first).previous = i;
    first = i;
  }

  void unlink(std::int32_t i) {
    const Place& place = at(i);
    if (place.next != none) at(place.next).previous = place.previous;
    (place.previous != none ? at(place.previous).next : first_[index(place.cell[0], place.cell[1])]) = place.next;
  }

  /// A column or a row of cells: its number inside the box, and how many box lengths away its image lies.
  struct Line {
    std::int32_t cell;  ///< none beyond a wall
    std::int32_t beyond;
  };

  [[nodiscard]] Line line(int axis, std::int32_t cell) const {
    if (cell >= 0 && cell < count_[axis]) return {cell, 0};
    if (!domain_.periodic[axis]) return {none, 0};
    return cell < 0 ? Line{cell + count_[axis], -1} : Line{cell - count_[axis], 1};
  }

  /// Visits the cells of a row from `first` to `last` columns away from disk i, and as many more as its images may have slid.
  template <class Visit>
  void visit_row(std::int32_t i, std::int32_t row, int first, int last, Visit& visit) const {
    const std::int32_t column = at(i).cell[0];
    if (sliding_ && (row < 0 || row >= count_[1])) {
      const bool above = row >= count_[1];
      const Line beyond{above ? row - count_[1] : row + count_[1], above ? 1 : -1};
      const std::int32_t from = first - (above ? slid_most_ : -slid_least_), to = last + (above ? -slid_least_ : slid_most_);
      for (std::int32_t k = from; k <= to; ++k) visit_cell(i, repeated(column + k), beyond, visit);
      return;
    }
    for (int k = first; k <= last; ++k) visit_cell(i, line(0, column + k), line(1, row), visit);
  }

  /// Returns the column of a periodic axis, any number of boxes away.
  [[nodiscard]] Line repeated(std::int32_t column) const {
    const std::int32_t beyond = column >= 0 ? column / count_[0] : -((count_[0] - 1 - column) / count_[0]);
    return {column - beyond * count_[0], beyond};
  }

  template <class Visit>
  void visit_cell(std::int32_t i, const Line& column, const Line& row, Visit& visit) const {
    if (column.cell == none || row.cell == none) return;
    const Winding here = at(i).winding + Winding(column.beyond, row.beyond);
    for (std::int32_t j = first_[index(column.cell, row.cell)]; j != none; j = at(j).next)
      if (j != i) visit(j, Winding(here - at(j).winding));
  }

  SimulationBox<Real> domain_;
  std::int32_t count_[2];
  Real width_[2];
  bool sliding_ = false;
  std::int32_t slid_least_ = 0;  ///< whole columns by which images above are displaced at least
  std::int32_t slid_most_ = 0;
  std::vector<std::int32_t> first_;
  std::vector<Place> places_;
};

}  // namespace carom
