#include "studies/analysis/analysis.hpp"

#include "observe/observable_group.hpp"
#include "observe/observables.hpp"
#include "scene/changes.hpp"
#include "simulation/sampling_times.hpp"

#include <carom/io/run_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

namespace carom {

namespace {

using detail::SamplingTimes;

/// Returns the scene of the run with another [observe] table.
Scene scene_with(const RunReader& run, const std::vector<std::string>& observables) {
  if (observables.empty()) return run.scene(std::vector<std::string>{});
  std::vector<std::string> overrides = {"observe={}"};
  for (const std::string& observable : observables) {
    const bool has_settings = observable.find('=') != std::string::npos;
    overrides.push_back("observe." + observable + (has_settings ? "" : "=true"));
  }
  return run.scene(overrides);
}

[[noreturn]] void refuse(const ObservableRequest& request, const std::string& why) {
  throw std::invalid_argument(fmt::format("{} {}", request.name, why));
}

/// Says at which of the run's samples an observable is to look, where it looks at states, and that the run has kept what it
/// needs.
void choose_step(ObservableRequest& request, const ObservedRun& run, std::uint64_t samples) {
  const std::unique_ptr<Observable> wished = make_observable(request, run).observable;
  if (wished->follows_collisions() && !run.collisions_known)
    refuse(request, "follows collisions, and the run kept none; run the scene with --events");
  if (!(wished->step() > 0.0)) return;
  if (samples == 0) refuse(request, "needs states, and the run kept no samples; run the scene with run.sample_every");
  const std::optional<SamplingTimes> times = SamplingTimes::of(run.scene.run);
  if (!times)
    refuse(request,
           "is an average over time, and the run's samples are so many collisions apart; run the scene with run.sample_every = "
           "TIME");
  const double step = times->block();
  if (!request.every) request.every = step * std::max(1.0, std::nearbyint(wished->step() / step));
  if (!times->stride(*request.every))
    refuse(request,
           fmt::format("asks for states every {}, and the run has them every {}; take a multiple of that", *request.every, step));
}

/// The event log, in pieces.
class Log {
 public:
  explicit Log(const RunReader& run) : run_(run), left_(run.events()) {}

  /// Hands on the events up to number `pairs` of those of two disks, and others up to `time`.
  void follow_to(std::uint64_t pairs, double time, ObservableGroup& group) {
    for (;;) {
      std::size_t end = next_;
      while (end < piece_.size() && (piece_[end].partner < 0 ? piece_[end].time <= time : pairs_ < pairs))
        if (piece_[end++].partner >= 0) ++pairs_;
      group.follow(std::span(piece_).subspan(next_, end - next_));
      next_ = end;
      if (end < piece_.size() || left_ == 0) return;
      read();
    }
  }

 private:
  void read() {
    constexpr std::uint64_t most = 1 << 16;
    const std::uint64_t count = std::min(left_, most);
    const double before = piece_.empty() ? 0.0 : piece_.back().time;
    piece_ = run_.event_log(run_.events() - left_, count, before);
    left_ -= count;
    next_ = 0;
  }

  const RunReader& run_;
  std::uint64_t left_;  ///< in the file
  std::vector<Event> piece_;
  std::size_t next_ = 0;  ///< of the piece
  std::uint64_t pairs_ = 0;
};

/// Returns how many of the scene's changes come before a sample. One of its own time, to rounding, comes after it.
std::size_t changes_before(const Scene& scene, const Instant& sample) {
  return static_cast<std::size_t>(std::ranges::count_if(scene.changes, [&](const Change& change) {
    const Instant time{change.time, 0.0};
    return time < before_change(time, sample);
  }));
}

void feed(const RunReader& run, const Scene& scene, ObservableGroup& group, const std::function<void(double)>& progress) {
  const bool follows = group.follows_collisions();
  const std::optional<SamplingTimes> times = SamplingTimes::of(scene.run);
  std::vector<std::pair<std::uint64_t, std::vector<Observable*>>> by_stride;
  for (auto& [step, observables] : group.by_step()) by_stride.emplace_back(times->stride(step).value(), observables);
  Log log(run);
  State start = follows ? run.start() : run.sample(0);
  if (follows && run.samples() > 0) start.walls = run.sample(0).walls;  // the start of the log has disks alone
  group.start(start);
  for (std::uint64_t k = 0; k < run.samples(); ++k) {
    const auto wants = [&](const auto& of) { return k % of.first == 0; };
    if (std::none_of(by_stride.begin(), by_stride.end(), wants)) continue;
    if (progress) progress(static_cast<double>(k) / static_cast<double>(run.samples()));
    const Totals totals = run.totals(k);
    const State state = run.sample(k);
    if (follows) log.follow_to(totals.pair + totals.well, state.time, group);
    group.changed(changes_before(scene, times->at(k)));
    for (const auto& of : by_stride)
      if (wants(of))
        for (Observable* observable : of.second) observable->sample(state, totals);
  }
  if (follows) log.follow_to(run.events(), std::numeric_limits<double>::infinity(), group);
}

}  // namespace

Analysis analyse(const std::filesystem::path& run_directory, const std::vector<std::string>& observables,
                 const std::function<void(double)>& progress) {
  const RunReader run(run_directory);
  Analysis analysis{.scene = scene_with(run, observables), .observables = {}, .samples = run.samples(), .events = run.events()};
  Scene& scene = analysis.scene;
  if (scene.observe.empty())
    throw std::invalid_argument(observables.empty()
                                    ? "the run's scene has no [observe] table; name what to measure, such as pressure"
                                    : "there is nothing to measure; name an observable, such as pressure");
  const auto is_work = [](const ObservableRequest& request) { return request.name == "work"; };
  if (observables.empty() && !std::ranges::all_of(scene.observe, is_work)) std::erase_if(scene.observe, is_work);
  for (const ObservableRequest& request : scene.observe)
    if (is_work(request))
      throw std::invalid_argument(
          "work and heat are measured while the scene runs, and its files do not hold what baths and collisions gave; name other "
          "observables");
  const Effects at_start = scene.effects;
  scene.effects = detail::effects_of_whole_run(scene);
  ObservedRun observed = observed_run(scene, run.disks(), run.reference_temperature());
  observed.acting = &at_start;
  observed.collisions_known = run.has_event_log();
  for (ObservableRequest& request : scene.observe) choose_step(request, observed, run.samples());
  ObservableGroup group(observed);
  feed(run, scene, group, progress);
  Totals at_end = run.samples() > 0 ? run.totals(run.samples() - 1) : Totals{};
  at_end.pair = run.pair_collisions();  // as far as notes on errors ask for them
  analysis.observables = group.results(run.end(), at_end);
  return analysis;
}

}  // namespace carom
