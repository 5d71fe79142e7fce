#pragma once
// A recorded run once more: the positions of disks at each of its collisions, the disks near, and their domains.
// For periodic boxes and equal disks.

#include "event_graph.hpp"

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace carom::bench {

/// A box cut into columns and rows of equal size.
struct Domains {
  Box box;
  Id columns = 1;
  Id rows = 1;

  [[nodiscard]] Id count() const { return columns * rows; }
  [[nodiscard]] Eigen::Vector2d size() const { return box.lengths().cwiseQuotient(Eigen::Vector2d(columns, rows)); }

  /// The domain of `r`, anywhere in space.
  [[nodiscard]] Id home(const Eigen::Vector2d& r) const { return slice(r, 0, columns) + columns * slice(r, 1, rows); }

  /// The domains that `r` is in, or no farther from than `distance` along either axis.
  [[nodiscard]] DomainSet within(const Eigen::Vector2d& r, double distance) const {
    DomainSet set = 0;
    for (Id row = 0; row < rows; ++row) {
      if (gap(r, 1, row) > distance) continue;
      for (Id column = 0; column < columns; ++column)
        if (gap(r, 0, column) <= distance) set |= only(column + columns * row);
    }
    return set;
  }

 private:
  [[nodiscard]] Id slice(const Eigen::Vector2d& r, int axis, Id slices) const {
    const double turns = (r[axis] - box.lower[axis]) / box.lengths()[axis];
    return std::min(static_cast<Id>((turns - std::floor(turns)) * slices), slices - 1);
  }
  [[nodiscard]] double gap(const Eigen::Vector2d& r, int axis, Id slice) const {
    const double length = box.lengths()[axis], half = 0.5 * size()[axis];
    const double from_middle = r[axis] - box.lower[axis] - (2 * slice + 1) * half;
    return std::abs(from_middle - length * std::round(from_middle / length)) - half;
  }
};

class EventReplay {
 public:
  /// `reach`: the largest distance that near() will be asked for. Requires a box of at least three times sigma + reach + 1.
  EventReplay(const Box& box, const State& start, double sigma, double reach)
      : length_(box.lengths()), lower_(box.lower), sigma_(sigma), line_(static_cast<std::size_t>(start.positions.cols())) {
    for (int a = 0; a < 2; ++a) {
      cells_[a] = static_cast<Id>(length_[a] / (reach + 0.5 * sigma + margin()));
      if (cells_[a] < 3) throw std::invalid_argument("the box is shorter than three cells");
    }
    for (std::size_t k = 0; k < line_.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      line_[k] = {start.positions.col(column), start.velocities.col(column), start.time, 0};
      fastest_ = std::max(fastest_, line_[k].v.norm());
    }
    sort_into_cells(start.time);
  }

  [[nodiscard]] std::size_t disks() const { return line_.size(); }
  [[nodiscard]] Eigen::Vector2d place(Id k, double time) const {
    const Line& line = line_[index(k)];
    return line.r + line.v * (time - line.time);
  }

  /// The disks whose centres are within `distance` of one of i and j, these among them, in any order.
  void near(Id i, Id j, double time, double distance, std::vector<Id>& found) {
    if (fastest_ * (time - sorted_at_) > margin()) sort_into_cells(time);
    const Eigen::Vector2d ri = place(i, time), rj = place(j, time);
    const Eigen::Vector2d middle = ri + 0.5 * nearest(rj - ri);
    const Id x = cell(middle, 0), y = cell(middle, 1);
    found.clear();
    for (Id dy = -1; dy <= 1; ++dy)
      for (Id dx = -1; dx <= 1; ++dx) {
        const std::size_t at = index((x + dx + cells_[0]) % cells_[0] + cells_[0] * ((y + dy + cells_[1]) % cells_[1]));
        for (std::size_t n = first_[at]; n < first_[at + 1]; ++n) {
          const Eigen::Vector2d r = place(in_cell_[n], time);
          const double squared = std::min(nearest(r - ri).squaredNorm(), nearest(r - rj).squaredNorm());
          if (squared <= distance * distance) found.push_back(in_cell_[n]);
        }
      }
  }

  /// Carries the collision out. False where the disks are not in contact then, to rounding: three operations in each flight, and
  /// its time, are rounded to within 2^-53 of the place that the disk has come to and of the way that it could have come.
  [[nodiscard]] bool collide(const Event& event) {
    Line& a = line_[index(event.disk)];
    Line& b = line_[index(event.partner)];
    a = {place(event.disk, event.time), event.velocity, event.time, a.flights + 1};
    b = {place(event.partner, event.time), event.partner_velocity, event.time, b.flights + 1};
    fastest_ = std::max({fastest_, a.v.norm(), b.v.norm()});
    const double farthest = std::max(a.r.cwiseAbs().maxCoeff(), b.r.cwiseAbs().maxCoeff()) + fastest_ * event.time;
    const double tolerance = 4.0 * (a.flights + b.flights) * farthest * 0x1p-53;
    return std::abs(nearest(b.r - a.r).norm() - sigma_) <= tolerance;
  }

 private:
  struct Line {
    Eigen::Vector2d r, v;
    double time = 0.0;
    int flights = 0;
  };

  /// The distance that a disk may be from where it was sorted in: half a spacing or so keeps both sorting and searching cheap.
  [[nodiscard]] double margin() const { return 0.5 * sigma_; }

  [[nodiscard]] Eigen::Vector2d nearest(const Eigen::Vector2d& r) const {
    return {r[0] - length_[0] * std::round(r[0] / length_[0]), r[1] - length_[1] * std::round(r[1] / length_[1])};
  }

  [[nodiscard]] Id cell(const Eigen::Vector2d& r, int axis) const {
    const double turns = (r[axis] - lower_[axis]) / length_[axis];
    return std::min(static_cast<Id>((turns - std::floor(turns)) * cells_[axis]), cells_[axis] - 1);
  }

  void sort_into_cells(double time) {
    sorted_at_ = time;
    std::vector<Id> at(line_.size());
    first_.assign(index(cells_[0] * cells_[1]) + 1, 0);
    for (std::size_t k = 0; k < line_.size(); ++k) {
      const Eigen::Vector2d r = place(static_cast<Id>(k), time);
      at[k] = cell(r, 0) + cells_[0] * cell(r, 1);
      ++first_[index(at[k]) + 1];
    }
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    in_cell_.resize(line_.size());
    for (std::size_t k = 0; k < line_.size(); ++k) in_cell_[next[index(at[k])]++] = static_cast<Id>(k);
  }

  Eigen::Vector2d length_, lower_;
  double sigma_;
  std::vector<Line> line_;
  double fastest_ = 0.0;
  Id cells_[2] = {0, 0};
  double sorted_at_ = 0.0;
  std::vector<std::size_t> first_;
  std::vector<Id> in_cell_;
};

}  // namespace carom::bench
