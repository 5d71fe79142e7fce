#include <carom/threads.hpp>

#include "scene/effect_traits.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace carom::detail {

Threads with_domains(Threads threads, int ranks) {
  const auto count = static_cast<std::size_t>(ranks);
  constexpr std::size_t most = 32;  // threads of one process: more would wait for each other longer than they compute
  const std::size_t most_domains = count == 1 ? most : 1024;
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  if (threads.threads < 1 || threads.threads > most)
    refuse(fmt::format("a simulation runs on 1 to {} threads, not on {}", most, threads.threads));
  if (threads.domains == 0) threads.domains = threads.threads * count;
  if (threads.domains > most_domains)
    refuse(fmt::format("a simulation has at most {} domains, not {}{}", most_domains, threads.domains,
                       count == 1 ? "" : fmt::format(": that is one for each thread of each of {} processes", count)));
  if (threads.domains < count) refuse(fmt::format("{} processes cannot share {} domains", count, threads.domains));
  if (!(threads.halo >= 0.0) || !std::isfinite(threads.halo))
    refuse(fmt::format("the width of a halo is {:g}; it must be positive and finite, or 0 for one that suits the density",
                       threads.halo));
  if (!(threads.events_per_window > 0.0) || !std::isfinite(threads.events_per_window))
    refuse(fmt::format("a window has {:g} events of each disk; that must be positive and finite", threads.events_per_window));
  return threads;
}

std::string why_not_threads(const Effects& effects) {
  if (effects.tumbling && effects.tumbling->rate > 0.0) return "tumbles draw the directions of all disks in one order";
  if (effects.brownian && effects.brownian->rate > 0.0) return "the velocities of all disks are redrawn in one order";
  if (effects.bath_temperature()) return "the thermostat draws the velocities of all disks in one order";
  if (effects.shear_rate() != 0.0) return "the box is sheared";
  if (effects.drag_rate() > 0.0) return "drag slows the clock";
  // No more than 18 disks fit within two diameters of one, and a message about a disk has room for 24.
  if (effects.square_well && effects.square_well->depth != 0.0 && effects.square_well->width > 2.0)
    return "wells are wider than two diameters";
  if (effects.square_well && effects.square_well->depth != 0.0 && detail::effect_named("non_additivity").acts(effects))
    return "in wells of disks whose diameters are not additive there may be more disks than a message holds";
  for (const WallProperties& wall : effects.walls) {
    if (wall.mass || wall.velocity.value_or(0.0) != 0.0) return "a wall moves";
    if (wall.temperature) return "a wall with a temperature draws the velocities of all disks in one order";
  }
  return {};
}

}  // namespace carom::detail
