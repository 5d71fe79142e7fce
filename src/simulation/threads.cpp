#include <carom/threads.hpp>

#include "simulation/parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace carom::detail {

void check_threads(const Threads& threads) {
  constexpr std::size_t most = 32;  // a domain has a bit for each of its neighbours
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  if (threads.threads < 1 || threads.threads > most)
    refuse(fmt::format("a simulation runs on 1 to {} threads, not on {}", most, threads.threads));
  if (threads.domains > most) refuse(fmt::format("a simulation has at most {} domains, not {}", most, threads.domains));
  if (!(threads.halo > 0.0) || !std::isfinite(threads.halo))
    refuse(fmt::format("the width of a halo is {:g}; it must be positive and finite", threads.halo));
  if (!(threads.events_per_window > 0.0) || !std::isfinite(threads.events_per_window))
    refuse(fmt::format("a window has {:g} events of each disk; that must be positive and finite", threads.events_per_window));
}

}  // namespace carom::detail
