#pragma once
// Disks that fly through one another and only change cells, fold at periodic edges and bounce off walls: what a cell
// grid must follow, without the engine that uses it.

#include "core/simulation_box.hpp"
#include "neighbours/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace carom::test {

/// A neighbour as the grid reports it: its id and the image shift s of r_i - r_j - s * length.
struct Seen {
  std::int32_t disk;
  std::int64_t x;
  std::int64_t y;
  friend bool operator==(const Seen& a, const Seen& b) { return std::tie(a.disk, a.x, a.y) == std::tie(b.disk, b.x, b.y); }
  friend bool operator<(const Seen& a, const Seen& b) { return std::tie(a.disk, a.x, a.y) < std::tie(b.disk, b.x, b.y); }
};

class FreeFlight {
 public:
  struct Disk {
    Vec2<double> r = {0.0, 0.0};
    Vec2<double> v = {0.0, 0.0};
    double t = 0.0;
    CellCrossing<double> crossing = {};
  };

  FreeFlight(const Box& box, double reach, const std::vector<Disk>& disks)
      : domain_(box), reach_(reach), grid_(domain_, reach, disks.size()), disks_(disks) {
    grid_.clear();
    for (std::int32_t i = 0; i < count(); ++i) grid_.insert(i, disk(i).r);
    for (std::int32_t i = 0; i < count(); ++i) plan(i);
  }

  /// The time of the next change, infinite where there is none.
  [[nodiscard]] double next_time() const { return next().time; }

  /// Makes the next change. Returns false where a crossing came too early or brought a neighbour that was not ahead.
  bool step() {
    const Next event = next();
    Disk& d = disk(event.disk);
    if (event.wall_axis >= 0) {
      const int a = event.wall_axis;
      bring_to(event.disk, event.time);
      d.r[a] = d.v[a] > 0 ? domain_.upper[a] : domain_.lower[a];
      d.v[a] = -d.v[a];
      plan(event.disk);
      return true;
    }
    const CellCrossing<double> made = d.crossing;
    std::vector<Seen> known = seen(event.disk);
    grid_.cross(event.disk, made);
    grid_.for_neighbours_ahead(event.disk, made, [&](std::int32_t j, const Winding& s) { known.push_back({j, s[0], s[1]}); });
    std::sort(known.begin(), known.end());
    const std::vector<Seen> now = seen(event.disk);
    plan(event.disk);
    return d.crossing.time >= made.time && std::includes(known.begin(), known.end(), now.begin(), now.end());
  }

  /// Rewrites the record of a disk at time t, folded into the box, as a collision does.
  void bring_to(std::int32_t i, double t) {
    Disk& d = disk(i);
    d.r = position(i, t);
    d.t = t;
    grid_.refold(i, domain_.wrap(d.r));
    plan(i);
  }

  /// What the grid shows of disk i, sorted.
  [[nodiscard]] std::vector<Seen> seen(std::int32_t i) const {
    std::vector<Seen> found;
    grid_.for_neighbours(i, [&](std::int32_t j, const Winding& s) { found.push_back({j, s[0], s[1]}); });
    std::sort(found.begin(), found.end());
    return found;
  }

  /// All images within reach of disk i at time t, by looking at every image of every disk.
  [[nodiscard]] std::vector<Seen> within_reach(std::int32_t i, double t) const {
    std::vector<Seen> found;
    for (std::int32_t j = 0; j < count(); ++j) {
      if (j == i) continue;
      const Vec2<double> apart = position(i, t) - position(j, t);
      std::int64_t centre[2];
      for (int a = 0; a < 2; ++a) centre[a] = domain_.periodic[a] ? std::llround(apart[a] / domain_.length[a]) : 0;
      for (std::int64_t x = -2; x <= 2; ++x) {
        for (std::int64_t y = -2; y <= 2; ++y) {
          if ((x != 0 && !domain_.periodic[0]) || (y != 0 && !domain_.periodic[1])) continue;
          const Seen image{j, centre[0] + x, centre[1] + y};
          const double dx = apart[0] - static_cast<double>(image.x) * domain_.length[0];
          const double dy = apart[1] - static_cast<double>(image.y) * domain_.length[1];
          if (std::hypot(dx, dy) <= reach_) found.push_back(image);
        }
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(disks_.size()); }
  [[nodiscard]] Vec2<double> position(std::int32_t i, double t) const {
    const Disk& d = disks_[static_cast<std::size_t>(i)];
    return d.r + d.v * (t - d.t);
  }

 private:
  struct Next {
    double time;
    std::int32_t disk;
    int wall_axis;
  };

  [[nodiscard]] Disk& disk(std::int32_t i) { return disks_[static_cast<std::size_t>(i)]; }

  void plan(std::int32_t i) { disk(i).crossing = grid_.next_crossing(i, disk(i).r, disk(i).v, Vec2<double>::Zero(), disk(i).t); }

  [[nodiscard]] Next next() const {
    Next first{infinity<double>, 0, -1};
    for (std::int32_t i = 0; i < count(); ++i) {
      const Disk& d = disks_[static_cast<std::size_t>(i)];
      if (d.crossing.time < first.time) first = {d.crossing.time, i, -1};
      for (int a = 0; a < 2; ++a) {
        if (domain_.periodic[a] || d.v[a] == 0) continue;
        const double way = d.v[a] > 0 ? domain_.upper[a] - d.r[a] : domain_.lower[a] - d.r[a];
        const double time = d.t + way / d.v[a];
        if (time < first.time) first = {time, i, a};
      }
    }
    return first;
  }

  SimulationBox<double> domain_;
  double reach_;
  CellGrid<double> grid_;
  std::vector<Disk> disks_;
};

}  // namespace carom::test
