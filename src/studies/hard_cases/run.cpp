#include "studies/hard_cases/run.hpp"

#include "core/all_events.hpp"
#include "core/nearest_image.hpp"
#include "observe/geometry.hpp"
#include "observe/run_measurements.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace carom {

namespace {

/// Ends of blocks at which overlap is computed, before it becomes rarer: states are copied for it.
constexpr std::uint64_t most_contacts = 256;

/// Looks on while the schedule runs.
class Witness {
 public:
  Witness(Simulation& simulation, EngineRun& run, const Watch& watch)
      : simulation_(simulation), run_(run), measurements_(simulation), watch_(watch) {}

  void look_on() {
    RunHooks hooks;
    hooks.start = [this](const State& state) {
      run_.start = state;
      measurements_.start(state);
      look_at(state);
      look_for_faults();
    };
    hooks.sample = [this](std::uint64_t k, const State& state) {
      measurements_.sample(state);
      look_at(state);
      run_.monotone = run_.monotone && (k == 0 || state.time > run_.last_sample);
      run_.last_sample = state.time;
      now_and_then(samples_);
    };
    if (watch_.events > 0) hooks.events = [this](std::span<const Event> events) { keep(events); };
    hooks.block = [this](const Progress& progress) {
      measurements_.block(progress);
      now_and_then(blocks_);
      if (blocks_ <= most_contacts || std::has_single_bit(blocks_)) look_at_contact();
    };
    hooks.proceed = [this](const Progress& progress) {
      return detail::all_events(progress.totals) <= watch_.most_events && (!watch_.proceed || watch_.proceed());
    };
    run_.result = run_schedule(simulation_, hooks);
    run_.end = simulation_.state();
    look_at(run_.end);
    look_for_faults();
    run_.report = measurements_.report(run_.result, 0.0);
    run_.overlap = std::max(run_.overlap, run_.report.max_relative_overlap);
  }

 private:
  void keep(std::span<const Event> events) {
    for (const Event& event : events) {
      run_.monotone = run_.monotone && (event.time > last_ || (event.time == last_ && event.time_remainder >= last_remainder_));
      last_ = event.time;
      last_remainder_ = event.time_remainder;
      if (run_.events.size() < watch_.events) run_.events.push_back(event);
    }
  }

  void look_at(const State& state) {
    run_.finite = run_.finite && state.positions.allFinite() && state.velocities.allFinite() && std::isfinite(state.time);
  }

  /// A block ends at a collision: the pair is in contact, and overlaps if any does.
  void look_at_contact() {
    const Scene& scene = simulation_.scene();
    const DeepestOverlap deepest = deepest_overlap(scene.box, scene.effects, run_.disks, simulation_.state());
    run_.overlap = std::max(run_.overlap, deepest.relative);
  }

  /// At the first, fourth, sixteenth, ... of its kind: comparing all pairs takes longer than the run.
  void now_and_then(std::uint64_t& count) {
    if (std::has_single_bit(++count) && std::countr_zero(count) % 2 == 0) look_for_faults();
  }

  void look_for_faults() {
    if (!watch_.look_for_faults) return;
    for (std::string& fault : simulation_.check_invariants(std::numeric_limits<double>::infinity()))
      run_.faults.push_back(std::move(fault));
  }

  Simulation& simulation_;
  EngineRun& run_;
  RunMeasurements measurements_;
  const Watch& watch_;
  std::uint64_t samples_ = 0;
  std::uint64_t blocks_ = 0;
  double last_ = 0.0;
  double last_remainder_ = 0.0;
};

}  // namespace

int bits_of_engine(const std::string& engine) {
  if (engine == "textbook-float") return std::numeric_limits<float>::digits;
  if (engine == "textbook-long-double") return std::numeric_limits<long double>::digits;
  return engine == "textbook-quad" ? 113 : std::numeric_limits<double>::digits;
}

EngineRun run_in_engine(const Scene& scene, const std::string& engine, const Watch& watch) {
  Simulation simulation = make_simulation(scene, engine);
  EngineRun run;
  run.engine = simulation.engine();
  run.disks = simulation.disks();
  Witness(simulation, run, watch).look_on();
  return run;
}

double difference(const Box& box, const State& a, const State& b) {
  double largest = 0.0;
  const auto speed = [](const State& state) {
    return state.velocities.size() > 0 ? state.velocities.cwiseAbs().maxCoeff() : 0.0;
  };
  const double fastest = std::max(speed(a), speed(b));
  const double longest = box.lengths().maxCoeff();
  for (Eigen::Index i = 0; i < a.positions.cols(); ++i) {
    const Eigen::Vector2d apart = nearest_image(box, a.positions.col(i) - b.positions.col(i)) / longest;
    const Eigen::Vector2d faster = a.velocities.col(i) - b.velocities.col(i);
    largest = std::max({largest, apart.cwiseAbs().maxCoeff(), fastest > 0.0 ? faster.cwiseAbs().maxCoeff() / fastest : 0.0});
    if (!apart.allFinite() || !faster.allFinite()) return std::numeric_limits<double>::infinity();
  }
  return largest;
}

}  // namespace carom
