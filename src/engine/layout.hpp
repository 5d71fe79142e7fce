#pragma once
// The data of a disk on the hot path: nothing but its line where all are equal; its radius and mass too where
// they differ, and its species where contact distances are not the sums of two radii.

#include "core/all_equal.hpp"
#include "core/flight.hpp"
#include "core/prediction.hpp"
#include "core/vec2.hpp"
#include "effects/non_additivity.hpp"

#include <carom/state.hpp>

#include <cstddef>

namespace carom {

struct EqualDisks {
  using Line = Flight;

  static bool covers(const Disks& disks) { return all_equal(disks.radius) && all_equal(disks.mass); }

  EqualDisks(const Disks& disks, const Effects& /*effects*/)
      : radius_(disks.count() > 0 ? disks.radius[0] : 1.0), mass_(disks.count() > 0 ? disks.mass[0] : 1.0) {}

  [[nodiscard]] double radius(const Line& /*line*/) const { return radius_; }
  [[nodiscard]] double contact_distance(const Line& /*a*/, const Line& /*b*/) const { return radius_ + radius_; }
  [[nodiscard]] double mass(const Line& /*line*/) const { return mass_; }
  [[nodiscard]] Vec2<double> momentum(const Line& line) const { return mass_ * Vec2<double>(line.v[0], line.v[1]); }
  /// Stores in a line what this layout keeps there of the disk `id`.
  void store_properties(Line& /*line*/, const Disks& /*disks*/, std::size_t /*id*/) const {}

 private:
  double radius_;
  double mass_;
};

struct AnyDisks {
  using Line = SizedFlight;

  static bool covers(const Disks& /*disks*/) { return true; }

  AnyDisks(const Disks& /*disks*/, const Effects& /*effects*/) {}

  [[nodiscard]] double radius(const Line& line) const { return line.radius; }
  [[nodiscard]] double contact_distance(const Line& a, const Line& b) const { return a.radius + b.radius; }
  [[nodiscard]] double mass(const Line& line) const { return line.mass; }
  [[nodiscard]] Vec2<double> momentum(const Line& line) const { return line.mass * Vec2<double>(line.v[0], line.v[1]); }
  /// Stores in a line what this layout keeps there of the disk `id`.
  void store_properties(Line& line, const Disks& disks, std::size_t id) const {
    line.radius = disks.radius[id];
    line.mass = disks.mass[id];
  }
};

struct MixedDisks {
  using Line = MixedFlight;

  static bool covers(const Disks& /*disks*/) { return true; }

  MixedDisks(const Disks& disks, const Effects& effects) : scales_(contact_scales<double>(effects, disks).of_kinds()) {}

  [[nodiscard]] double radius(const Line& line) const { return line.radius; }
  [[nodiscard]] double contact_distance(const Line& a, const Line& b) const {
    return (a.radius + b.radius) * scales_.of_species(a.species, b.species);
  }
  [[nodiscard]] double mass(const Line& line) const { return line.mass; }
  [[nodiscard]] Vec2<double> momentum(const Line& line) const { return line.mass * Vec2<double>(line.v[0], line.v[1]); }
  /// Stores in a line what this layout keeps there of the disk `id`.
  void store_properties(Line& line, const Disks& disks, std::size_t id) const {
    line.radius = disks.radius[id];
    line.mass = disks.mass[id];
    line.species = disks.species[id];
  }
  /// Tells predictions which disks touch where. The frame must not outlive this.
  void describe(PredictionFrame& frame) const {
    frame.contact_scales = scales_.rows();
    frame.kinds = scales_.kinds();
  }

 private:
  ContactScales<double> scales_;
};

}  // namespace carom
