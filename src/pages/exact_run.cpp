#include "pages/exact_run.hpp"

#include "pages/replay.hpp"

#include <fmt/format.h>

namespace carom {

namespace {

std::string why_not_by_its_kind(const RunReader& run, std::uint64_t most_events, std::string_view holder) {
  if (!run.has_event_log()) return "the run kept no event log (carom run --events)";
  if (run.events() > most_events)
    return fmt::format("its {} events are more than the {} that {}", run.events(), most_events, holder);
  return why_no_replay(run.scene());
}

}  // namespace

ExactRun read_exactly(const RunReader& run, std::uint64_t most_events, std::string_view holder) {
  ExactRun exact;
  exact.start = run.sample(0);
  exact.why_not = why_not_by_its_kind(run, most_events, holder);
  if (!exact.exact()) return exact;
  const Scene& scene = run.scene();
  exact.events = run.event_log();
  exact.distance = distance_from_samples(scene, Replay(scene, run.disks(), exact.start), exact.events, run.samples(),
                                         [&](std::uint64_t k) { return run.sample(k); });
  if (!(exact.distance <= replay_tolerance * scene.box.lengths().maxCoeff())) {
    exact.why_not =
        fmt::format("the collisions in its log do not lead to its samples (they are up to {:.2g} apart)", exact.distance);
    exact.events = {};
  }
  return exact;
}

}  // namespace carom
