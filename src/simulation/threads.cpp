#include <carom/threads.hpp>

#include "parallel/disk_message.hpp"
#include "scene/effect_traits.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace carom {

void ThreadCounts::add(const ThreadCounts& other) {
  threads = std::max(threads, other.threads);
  ranks = std::max(ranks, other.ranks);
  domains = std::max(domains, other.domains);
  windows += other.windows;
  windows_redone += other.windows_redone;
  shared_out += other.shared_out;
  events += other.events;
  events_alone += other.events_alone;
  copied_events += other.copied_events;
  copies += other.copies;
  copies_wrong += other.copies_wrong;
  processor_seconds += other.processor_seconds;
  critical_seconds += other.critical_seconds;
}

double ThreadCounts::share_alone() const {
  const auto alone = static_cast<double>(events_alone), shared = static_cast<double>(events);
  return alone > 0.0 ? alone / (alone + shared) : 0.0;
}

}  // namespace carom

namespace carom::detail {

Threads with_domains(Threads threads, int ranks) {
  const auto count = static_cast<std::size_t>(ranks);
  constexpr auto most = static_cast<std::size_t>(most_threads);
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

namespace {

/// Returns a bound of the number of disks within `width` contact distances of one: each holds a disk of the smallest size, as
/// near to that one as it goes, and these fill no more than pi / sqrt(12) of the ring that they are in. Of equal disks and width
/// 2: 21.
double most_within(double width, const Disks& disks) {
  if (disks.count() == 0) return 0.0;
  const auto [smallest, largest] = std::minmax_element(disks.radius.begin(), disks.radius.end());
  const double outer = width * 2.0 * *largest - *largest + 2.0 * *smallest;
  return std::numbers::pi / std::sqrt(12.0) * (outer * outer - *largest * *largest) / (*smallest * *smallest);
}

}  // namespace

std::string why_not_threads(const Effects& effects, const Disks& disks) {
  if (effects.shear_rate() != 0.0) return "the box is sheared";
  if (effects.drag_rate() > 0.0) return "drag slows the clock";
  if (const std::vector<PotentialStep> steps = effects.potential_steps(); !steps.empty()) {
    if (steps.back().width > 2.0)
      return effects.stepped_potential ? "the potential reaches farther than two diameters"
                                       : "wells are wider than two diameters";
    if (detail::effect_named("non_additivity").acts(effects))
      return "in wells of disks whose diameters are not additive there may be more disks than a message holds";
    if (most_within(steps.back().width, disks) > static_cast<double>(StepsOfPairs::most))
      return "sizes differ so much that a disk may have too many others within reach of the potential";
  }
  for (const WallProperties& wall : effects.walls) {
    if (wall.mass) return "a piston moves by the contacts of all disks";
    if (wall.temperature) return "a wall with a temperature draws the velocities of all disks in one order";
  }
  return {};
}

}  // namespace carom::detail
