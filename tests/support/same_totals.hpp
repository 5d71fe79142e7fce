#pragma once
// In what the counts and sums of two runs differ.

#include <carom/state.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace carom::test {

/// Names the numbers of events that change a velocity, and the sums over these events, that differ: sums by more than
/// `tolerance`. Empty where none does.
inline std::string different_events(const Totals& a, const Totals& b, double tolerance = 0.0) {
  std::string names;
  const auto count = [&](const char* name, std::uint64_t x, std::uint64_t y) {
    if (x != y) names += fmt::format("{}: {} and {}; ", name, x, y);
  };
  const auto sum = [&](const std::string& name, double x, double y) {
    if (x != y && !(std::abs(x - y) <= tolerance)) names += fmt::format("{}: {} and {}; ", name, x, y);
  };
  const auto sums = [&](const std::string& name, const auto& x, const auto& y) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(x.size()); ++k)
      sum(fmt::format("{}[{}]", name, k), x.data()[k], y.data()[k]);
  };
  count("pair", a.pair, b.pair);
  count("wall", a.wall, b.wall);
  count("obstacle", a.obstacle, b.obstacle);
  count("well", a.well, b.well);
  count("thermostat", a.thermostat, b.thermostat);
  sum("virial", a.virial, b.virial);
  sum("virial_yx", a.virial_yx, b.virial_yx);
  sums("wall_impulse", a.wall_impulse, b.wall_impulse);
  sums("wall_shear", a.wall_shear, b.wall_shear);
  sums("wall_energy", a.wall_energy, b.wall_energy);
  sums("wall_work", a.wall_work, b.wall_work);
  sum("dissipated", a.dissipated, b.dissipated);
  sum("thermostat_energy", a.thermostat_energy, b.thermostat_energy);
  sum("growth_energy", a.growth_energy, b.growth_energy);
  sum("shear_energy", a.shear_energy, b.shear_energy);
  sums("obstacle_impulse", a.obstacle_impulse, b.obstacle_impulse);
  sum("circle_impulse", a.circle_impulse, b.circle_impulse);
  return names;
}

/// Names all that differs, bookkeeping and near misses of the arithmetic included; empty where nothing does.
inline std::string different_totals(const Totals& a, const Totals& b) {
  std::string names = different_events(a, b);
  const auto number = [&](const char* name, auto x, auto y) {
    if (x != y) names += fmt::format("{}: {} and {}; ", name, x, y);
  };
  number("other", a.other, b.other);
  number("stale", a.stale, b.stale);
  const Numerics &n = a.numerics, &m = b.numerics;
  number("simultaneous", n.simultaneous, m.simultaneous);
  number("overlapping", n.overlapping, m.overlapping);
  number("deepest_overlap", n.deepest_overlap, m.deepest_overlap);
  number("grazing", n.grazing, m.grazing);
  number("already_receding", n.already_receding, m.already_receding);
  number("epochs", n.epochs, m.epochs);
  number("early_epochs", n.early_epochs, m.early_epochs);
  number("list_rebuilds", n.list_rebuilds, m.list_rebuilds);
  number("longest_neighbour_list", n.longest_neighbour_list, m.longest_neighbour_list);
  return names;
}

/// The same for a run on several cores, which count collisions at one time each by itself.
inline std::string different_totals_of_cores(const Totals& alone, Totals shared) {
  shared.numerics.simultaneous = alone.numerics.simultaneous;
  return different_totals(alone, shared);
}

}  // namespace carom::test
