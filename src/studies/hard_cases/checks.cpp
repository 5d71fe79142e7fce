#include "studies/hard_cases/checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace carom {

namespace {

using Checks = std::vector<CaseCheck>;

CaseCheck exactly(std::string what, const EngineRun& run, double found, double expected) {
  CaseCheck check = within(std::move(what), run, std::abs(found - expected), 0.0);
  if (!check.holds) check.remark = fmt::format("{} in place of {}", found, expected);
  return check;
}

CaseCheck exactly(std::string what, const EngineRun& run, const std::string& found, const std::string& expected) {
  CaseCheck check = within(std::move(what), run, found == expected ? 0.0 : 1.0, 0.0);
  if (!check.holds) check.remark = fmt::format("\"{}\" in place of \"{}\"", found, expected);
  return check;
}

CaseCheck invariant(std::string what, const EngineRun& run, std::size_t faults, const std::string& remark) {
  CaseCheck check = within(std::move(what), run, static_cast<double>(faults), 0.0);
  check.invariant = true;
  if (!check.holds) check.remark = remark;
  return check;
}

CaseCheck close_to(std::string what, const EngineRun& run, double found, const ExpectedNumber& expected) {
  const double scale = expected.value == 0.0 ? 1.0 : std::abs(expected.value);
  CaseCheck check = within(std::move(what), run, std::abs(found - expected.value) / scale, widened(expected.bound, run));
  if (!check.holds) check.remark = fmt::format("{} in place of {}", found, expected.value);
  return check;
}

void check_invariants(const EngineRun& run, Checks& checks) {
  checks.push_back(invariant("invariants", run, run.faults.size(), run.faults.empty() ? "" : run.faults.front()));
  checks.push_back(invariant("finite", run, run.finite ? 0 : 1, "a position, a velocity or the clock is not finite"));
  checks.push_back(invariant("clock", run, run.monotone ? 0 : 1, "an event or a sample came before an earlier one"));
}

void check_end(const HardCase& hard_case, const Scene& scene, const EngineRun& run, Checks& checks) {
  const Expectations& expect = hard_case.expect;
  const std::string usual = to_string(scene.run.time ? StopReason::time : StopReason::collisions);
  checks.push_back(exactly("stopped", run, to_string(run.result.stopped), expect.stopped.empty() ? usual : expect.stopped));
  if (run.result.stopped == StopReason::time && scene.run.time)
    checks.push_back(exactly("time reached", run, run.report.time, *scene.run.time));
  if (!expect.stopped_disks.empty()) {
    const auto ids = [](const std::vector<std::int32_t>& disks) { return fmt::format("{}", fmt::join(disks, " ")); };
    checks.push_back(exactly("disks that stopped it", run, ids(run.result.stopped_disks), ids(expect.stopped_disks)));
  }
  if (expect.stop_time) checks.push_back(close_to("time of the stop", run, run.report.time, *expect.stop_time));
}

void check_samples(const HardCase& hard_case, const Scene& scene, const EngineRun& run, Checks& checks) {
  const Expectations& expect = hard_case.expect;
  const auto found = static_cast<double>(run.result.samples);
  if (expect.samples) checks.push_back(exactly("samples", run, found, static_cast<double>(*expect.samples)));
  const bool whole_grid =
      scene.run.time && scene.run.is_sampled() && !scene.run.sample_every_collisions && run.result.stopped == StopReason::time;
  if (!expect.samples && whole_grid)
    checks.push_back(exactly("samples", run, found, static_cast<double>(last_sample(scene.run)) + 1.0));
  if (expect.last_sample) checks.push_back(exactly("last sample", run, run.last_sample, *expect.last_sample));
}

void check_counts(const HardCase& hard_case, const EngineRun& run, Checks& checks) {
  const Expectations& expect = hard_case.expect;
  const Totals& totals = run.report.totals;
  const auto count = [&](const char* what, std::uint64_t found, const std::optional<std::uint64_t>& expected) {
    if (expected) checks.push_back(exactly(what, run, static_cast<double>(found), static_cast<double>(*expected)));
  };
  count("pair collisions", totals.pair, expect.pair);
  count("wall collisions", totals.wall, expect.wall);
  count("obstacle collisions", totals.obstacle, expect.obstacle);
  count("well passages", totals.well, expect.well);
  count("collisions", totals.pair + totals.wall, expect.boundaries);
}

/// Times in units of the last place that the engine's numbers have there.
void check_events(const HardCase& hard_case, const EngineRun& run, Checks& checks) {
  const auto& expected = hard_case.expect.events;
  if (expected.empty()) return;
  const int bits = std::min(bits_of_engine(run.engine), std::numeric_limits<double>::digits);
  CaseCheck check = within("events", run, 0.0, hard_case.expect.event_ulps);
  for (std::size_t k = 0; k < expected.size() && check.holds; ++k) {
    const ExpectedEvent& event = expected[k];
    if (k >= run.events.size()) {
      check = within("events", run, std::numeric_limits<double>::infinity(), hard_case.expect.event_ulps);
      check.remark = fmt::format("{} events in place of {}", run.events.size(), expected.size());
      break;
    }
    const Event& found = run.events[k];
    const double ulp = event.time > 0.0 ? std::ldexp(1.0, std::ilogb(event.time) + 1 - bits) : std::ldexp(1.0, -1074);
    const double off = std::abs(found.time - event.time) / ulp;
    const bool same = found.disk == event.disk && found.partner == event.partner;
    if (same && off <= check.value) continue;
    check = within("events", run, same ? off : std::numeric_limits<double>::infinity(), hard_case.expect.event_ulps);
    if (!check.holds)
      check.remark = fmt::format("event {} is {} with {} at {} in place of {} with {} at {}", k, found.disk, found.partner,
                                 found.time, event.disk, event.partner, event.time);
  }
  checks.push_back(std::move(check));
}

void check_conservation(const HardCase& hard_case, const EngineRun& run, Checks& checks) {
  const Expectations& expect = hard_case.expect;
  checks.push_back(within("overlap", run, run.overlap, widened(expect.overlap, run)));
  checks.back().invariant = true;
  if (expect.energy) {
    const double drift = run.report.unaccounted_energy_drift().value_or(run.report.relative_energy_drift());
    checks.push_back(within("energy", run, std::abs(drift), widened(*expect.energy, run)));
  }
  if (expect.momentum) {
    double scale = 0.0;
    for (std::size_t i = 0; i < run.disks.count(); ++i)
      scale += run.disks.mass[i] * run.start.velocities.col(static_cast<Eigen::Index>(i)).norm();
    const double change = (run.report.momentum_final - run.report.momentum_initial).norm();
    checks.push_back(within("momentum", run, scale > 0.0 ? change / scale : change, widened(*expect.momentum, run)));
  }
}

void check_states(const HardCase& hard_case, const Scene& scene, const EngineRun& run, Checks& checks) {
  const Expectations& expect = hard_case.expect;
  if (expect.final_state.cols() > 0) {
    State expected;
    expected.positions = expect.final_state.topRows<2>();
    expected.velocities = expect.final_state.bottomRows<2>();
    const bool fits = expected.positions.cols() == run.end.positions.cols();
    const double off = fits ? difference(scene.box, run.end, expected) : std::numeric_limits<double>::infinity();
    checks.push_back(within("final state", run, off, widened(expect.final_within, run)));
    if (!fits) checks.back().remark = fmt::format("{} disks in place of {}", run.end.positions.cols(), expected.positions.cols());
  }
  if (expect.returns)
    checks.push_back(within("returns", run, difference(scene.box, run.end, run.start), widened(*expect.returns, run)));
}

void check_Z(const HardCase& hard_case, const EngineRun& run, Checks& checks) {
  if (!hard_case.expect.Z) return;
  const auto& [value, bound] = *hard_case.expect.Z;
  const double found = run.report.Z.value_or(std::numeric_limits<double>::quiet_NaN());
  const double error = run.report.Z_error.value_or(std::numeric_limits<double>::quiet_NaN());
  checks.push_back(within("Z", run, std::abs(found / value - 1.0), 5.0 * error / std::abs(value) + bound));
  if (!checks.back().holds) checks.back().remark = fmt::format("{} ± {} in place of {}", found, error, value);
}

}  // namespace

CaseCheck within(std::string what, const EngineRun& run, double value, double bound) {
  return {.what = std::move(what), .engine = run.engine, .value = value, .bound = bound, .holds = value <= bound, .remark = ""};
}

double widened(double bound, const EngineRun& run) {
  constexpr int digits = std::numeric_limits<double>::digits;
  return std::ldexp(bound, std::max(0, digits - bits_of_engine(run.engine)));
}

std::vector<CaseCheck> checks_of_run(const HardCase& hard_case, const Scene& scene, const EngineRun& run) {
  Checks checks;
  check_invariants(run, checks);
  check_end(hard_case, scene, run, checks);
  check_samples(hard_case, scene, run, checks);
  check_counts(hard_case, run, checks);
  check_events(hard_case, run, checks);
  check_conservation(hard_case, run, checks);
  check_states(hard_case, scene, run, checks);
  check_Z(hard_case, run, checks);
  return checks;
}

std::vector<CaseCheck> checks_of_order(const HardCase& hard_case, const std::vector<EngineRun>& runs) {
  Checks checks;
  if (runs.size() < 2 || hard_case.expect.same_events == 0) return checks;
  auto model = std::find_if(runs.begin(), runs.end(), [](const EngineRun& run) { return run.engine == "textbook"; });
  if (model == runs.end()) model = runs.begin();
  for (auto run = runs.begin(); run != runs.end(); ++run) {
    if (run == model) continue;
    const auto& a = run->events;
    const auto& b = model->events;
    const std::size_t limit = hard_case.expect.same_events;
    std::size_t same = 0;
    while (same < std::min({a.size(), b.size(), limit}) && a[same].disk == b[same].disk && a[same].partner == b[same].partner)
      ++same;
    const std::size_t wanted = std::min(std::max(a.size(), b.size()), limit);
    checks.push_back(within("same events", *run, static_cast<double>(wanted - same), 0.0));
    if (same == wanted) continue;
    const auto name = [&](const std::vector<Event>& events) {
      if (same >= events.size()) return std::string("nothing");
      return fmt::format("{} with {} at {}", events[same].disk, events[same].partner, events[same].time);
    };
    checks.back().remark = fmt::format("event {} is {}, and in {} {}", same, name(a), model->engine, name(b));
  }
  return checks;
}

}  // namespace carom
