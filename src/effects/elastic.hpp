#pragma once
// What happens when two disks meet, where nothing but the collision rule acts: the plain alternative to any_impact.hpp.

#include "core/running_totals.hpp"
#include "effects/impact.hpp"

#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>

namespace carom {

template <class Rule>
class Elastic {
 public:
  Elastic(const Effects& /*effects*/, std::size_t /*disks*/) {}

  static constexpr bool plain = true;

  /// The impact of disks in so many slots of their own.
  [[nodiscard]] Elastic with_slots(std::size_t /*slots*/) const { return *this; }
  /// What it knows of one disk.
  struct DiskRest {
    bool operator==(const DiskRest&) const = default;
  };
  [[nodiscard]] static DiskRest rest_of(std::int32_t /*i*/) { return {}; }
  static void set_rest(std::int32_t /*i*/, const DiskRest& /*rest*/) {}

  struct Body {
    std::int32_t disk;
    double mass;
    double radius;
    Vec2<double>& v;
  };

  /// Disks i and j meet at separation r = r_i - r_j.
  static void meet(const Vec2<double>& r, double /*sigma*/, double /*expansion*/, const Body& i, const Body& j, double /*now*/,
                   RunningTotals& totals) {
    const ImpactResult<double> impact = collide<Rule, double>(r, i.mass, i.v, j.mass, j.v);
    ++totals.pair;
    totals.virial.add(impact.virial);
  }

  [[nodiscard]] static bool spinning() { return false; }
  [[nodiscard]] static bool is_elastic(std::int32_t /*i*/, double /*now*/) { return false; }
  static void record_collision_time(std::int32_t /*i*/, double /*now*/) {}
  static void rebase(double /*now*/) {}
  [[nodiscard]] static std::size_t bytes() { return 0; }
};

}  // namespace carom
