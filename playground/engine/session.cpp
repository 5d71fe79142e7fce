#include "session.hpp"

#include <emscripten.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <variant>

namespace carom::playground {

namespace {

/// Disks of which the past is kept.
constexpr std::size_t most_followed = 5000;

/// Root mean square.
double usual_speed(const State& state) {
  return std::sqrt(state.velocities.squaredNorm() / std::max<double>(1.0, static_cast<double>(state.velocities.cols())));
}

/// Returns the time in which a disk crosses the box: at its usual speed, falling, or as hot as a wall; 1 where nothing moves.
double crossing_time(const Scene& scene, const Disks& disks, const State& state) {
  const double length = scene.box.lengths().minCoeff();
  const double fall = scene.effects.acceleration().norm();
  double time = length / std::max({usual_speed(state), std::sqrt(fall * length), 1e-300});
  const double heaviest = disks.mass.empty() ? 1.0 : *std::max_element(disks.mass.begin(), disks.mass.end());
  for (const WallProperties& wall : scene.effects.walls)
    if (wall.temperature) time = std::min(time, length / std::sqrt(2.0 * *wall.temperature / std::max(1e-300, heaviest)));
  return std::isfinite(time) && time <= 1e100 ? time : 1.0;
}

/// Returns a power of two, so that times have few digits: at most a millionth of the time in which a disk crosses the box.
double grid_of(double crossing) { return std::exp2(std::floor(std::log2(crossing * 1e-6))); }

/// Returns the first time of the grid that is not before this one.
double on_grid(double time, double grid) { return std::ceil(time / grid) * grid; }

}  // namespace

Session::Session(const Scene& scene) : run_(scene) {
  const Disks& disks = run_.simulation().disks();
  crossing_ = crossing_time(scene, disks, state());
  grid_ = grid_of(crossing_);
  const double spacing = std::sqrt(scene.box.area() / std::max<double>(1.0, static_cast<double>(disks.count())));
  const double length = scene.box.lengths().minCoeff();
  step_ = on_grid(std::clamp(0.5 * spacing / length, 2e-3, 0.1) * crossing_, grid_);
  begin_measuring();
  keep_moment();
}

State Session::state() const {
  State state;
  run_.state(state);
  return state;
}

std::string Session::check() const {
  const std::vector<std::string> faults = run_.simulation().check_invariants(1e-9);
  return faults.empty() ? "" : faults.front();
}

double Session::time_of_change() const {
  const double length = run_.simulation().scene().box.lengths().minCoeff();
  return on_grid(run_.time(), std::min(grid_, grid_of(length / usual_speed(state()))));
}

void Session::apply(const Change& change) {
  constexpr std::uint64_t most_events = 1'000'000;
  if (run_.run_until(change.time, most_events) == StopReason::events && run_.time() < change.time)
    throw std::runtime_error("the disks have become too fast to be changed; begin again");
  const auto* scale = std::get_if<ScaleVelocities>(&change.what);
  const bool reverses = scale != nullptr && scale->factor == -1.0;
  keep_moment();
  run_.apply(change);
  pending_.clear();  // the visitor does otherwise than the list
  measured_.begin(run_, step_);
  if (reverses)
    way_back_.reverse(run_);
  else
    way_back_.begin(run_, 0.25 * step_);
  keep_moment();
}

void Session::make_pending() {
  const Change change = pending_.front();
  pending_.pop_front();
  try {
    run_.apply(change);
    keep_moment();
  } catch (const std::exception& error) {
    fault_ = error.what();
    pending_.clear();
  }
  begin_measuring();
}

void Session::begin_measuring() {
  measured_.begin(run_, step_);
  way_back_.begin(run_, 0.25 * step_);
}

double Session::next_change(double otherwise) const {
  return pending_.empty() ? otherwise : std::max(pending_.front().time, run_.time());
}

Session::Advance Session::advance(double until, double budget) {
  const double end = emscripten_get_now() + budget;
  while (run_.time() < until) {
    const bool follows = run_.simulation().disks().count() <= most_followed;
    double target = std::min({until, measured_.next(), next_change(until)});
    if (follows) target = std::min(target, std::max(way_back_.next(), run_.time()));
    constexpr std::uint64_t events_at_once = 2000;
    stopped_ = run_.run_until(target, events_at_once);
    const bool arrived = stopped_ == StopReason::time;
    if (!arrived && stopped_ != StopReason::events) return Advance::ended;
    if (arrived) {
      if (!pending_.empty() && pending_.front().time <= target) make_pending();
      if (measured_.next() <= target) measured_.sample(run_, state());
      if (follows && way_back_.next() <= target) way_back_.look(run_);
    }
    if (emscripten_get_now() > end) return run_.time() < until ? Advance::out_of_budget : Advance::arrived;
  }
  return Advance::arrived;
}

std::optional<Event> Session::step() {
  const double end = run_.time() + 1e4 * crossing_;
  std::optional<Event> event = run_.step(std::min(next_change(end), end));
  while (!event && run_.time() < end && !pending_.empty()) {
    make_pending();
    event = run_.step(std::min(next_change(end), end));
  }
  begin_measuring();
  return event;
}

bool Session::back(std::uint64_t events) {
  const std::uint64_t now = run_.events();
  const std::uint64_t wanted = now > events ? now - events : 0;
  const LiveRun::Moment* moment = moments_.last_before(wanted);
  if (moment == nullptr) return false;
  const std::vector<Change> made = run_.changes();
  run_.back_to(*moment);
  pending_.insert(pending_.begin(), made.begin() + static_cast<std::ptrdiff_t>(run_.changes().size()), made.end());
  while (run_.events() < wanted) {
    const double until = pending_.empty() ? run_.time() + 1e4 * crossing_ : pending_.front().time;
    const StopReason stopped = run_.run_until(until, wanted - run_.events());
    if (stopped == StopReason::time && !pending_.empty())
      make_pending();
    else if (stopped != StopReason::events)
      break;
  }
  begin_measuring();
  return true;
}

void Session::begin_twin(const std::string& method, double dt) {
  twin_.reset();  // the one before ends, also where this one is refused
  twin_.emplace(run_, method, dt);
}

}  // namespace carom::playground
