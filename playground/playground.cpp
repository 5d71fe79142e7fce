// The engine's face to the page: functions of C that the Worker calls (worker.js). Texts go in and out as UTF-8, answers as JSON,
// numbers of many disks as arrays in memory. Nothing throws: what is wrong comes back as {"error": "a sentence"}.

#include "live/live_run.hpp"
#include "observe/energy.hpp"
#include "observe/equilibrium.hpp"
#include "observe/mechanics.hpp"
#include "overlaps.hpp"
#include "theory/equation_of_state.hpp"

#include <carom/blocking.hpp>

#include <emscripten.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace carom;

constexpr std::int64_t most_disks = 100'000;
constexpr std::size_t most_snapshot_bytes = 64u << 20;
constexpr std::int64_t most_followed = 5000;  // disks of which the past is kept, and the overlaps are looked for

std::string answer;  // the last one, which the page reads

std::string json_text(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      json += '\\';
      json += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      json += fmt::format("\\u{:04x}", static_cast<int>(c));
    } else {
      json += c;
    }
  }
  return json + "\"";
}
std::string json_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }
std::string json_number(const std::optional<double>& value) { return value ? json_number(*value) : "null"; }
std::string json_pair(const Eigen::Vector2d& pair) {
  return fmt::format("[{},{}]", json_number(pair.x()), json_number(pair.y()));
}

const char* say(std::string json) {
  answer = std::move(json);
  return answer.c_str();
}

template <class Work>
const char* answered(Work&& work) {
  try {
    return say(work());
  } catch (const SceneError& error) {
    return say(fmt::format("{{\"error\":{}}}", json_text(error.what())));
  } catch (const std::bad_alloc&) {
    return say("{\"error\":\"there is not enough memory for this scene; fewer disks need less\"}");
  } catch (const std::exception& error) {
    return say(fmt::format("{{\"error\":{}}}", json_text(error.what())));
  }
}

/// Means over the time since the last change of the run, with errors: taken at multiples of a step.
class Measured {
 public:
  void begin(const LiveRun& run, double step) {
    *this = {};
    step_ = step;
    began_ = run.time();
    totals_ = run.simulation().totals();
    const Disks& disks = run.simulation().disks();
    State state;
    run.state(state);
    const double temperature = kinetic_temperature(run.simulation().scene().box, run.simulation().scene().effects, disks, state);
    const double lightest = disks.mass.empty() ? 1.0 : *std::min_element(disks.mass.begin(), disks.mass.end());
    range_ = temperature > 0.0 ? 3.2 * std::sqrt(2.0 * temperature / lightest) : 1.0;
  }
  [[nodiscard]] double next() const { return began_ + static_cast<double>(samples_ + 1) * step_; }

  void sample(const LiveRun& run, const State& state) {
    const Simulation& simulation = run.simulation();
    const Scene& scene = simulation.scene();
    const Disks& disks = simulation.disks();
    const Totals totals = simulation.totals();
    ++samples_;
    const double count = static_cast<double>(disks.count());
    const double heat = count * kinetic_temperature(scene.box, scene.effects, disks, state);
    const Box box = box_of(scene.box, state);
    const double force = heat + (totals.virial - totals_.virial) / (2.0 * step_);
    pressure_.add(force / box.area());
    factor_.add(force, heat);
    integral_ += force / box.area() * step_;
    for (std::size_t k = 0; k < 4; ++k) {
      const double length = box.lengths()[k < 2 ? 1 : 0];
      walls_[k].add(box.is_circle ? (totals.circle_impulse - totals_.circle_impulse) / (step_ * std::numbers::pi * length)
                                  : (totals.wall_impulse[k] - totals_.wall_impulse[k]) / (step_ * length));
    }
    pairs_ += totals.pair - totals_.pair;
    double speeds = 0.0;
    std::uint64_t beyond = 0;
    for (Eigen::Index i = 0; i < state.velocities.cols(); ++i) {
      const double speed = state.velocities.col(i).norm();
      speeds += speed;
      const auto bin = static_cast<std::size_t>(speed / range_ * static_cast<double>(bins));
      if (bin >= bins) ++beyond;
      ++histogram_[std::min(bin, bins - 1)];
    }
    path_ += speeds * step_;
    if (static_cast<double>(beyond) > 0.02 * count) widen();
    totals_ = totals;
  }

  static constexpr std::size_t bins = 60;
  [[nodiscard]] const std::array<double, bins>& histogram() const { return histogram_; }
  [[nodiscard]] double range() const { return range_; }
  [[nodiscard]] double integral() const { return integral_; }
  [[nodiscard]] double covered() const { return static_cast<double>(samples_) * step_; }
  [[nodiscard]] double step() const { return step_; }
  /// Mean free path: the way of all disks over twice the collisions.
  [[nodiscard]] double free_path() const {
    return pairs_ > 0 ? path_ / (2.0 * static_cast<double>(pairs_)) : std::numeric_limits<double>::quiet_NaN();
  }

  [[nodiscard]] std::string json() const {
    const auto estimate = [](const Blocking& blocking, const char* name) {
      const auto result = blocking.estimate();
      return fmt::format("\"{}\":{},\"{}_error\":{}", name, result ? json_number(result->mean) : "null", name,
                         result ? json_number(result->error) : "null");
    };
    std::string text = fmt::format("{},{},\"walls\":[", estimate(pressure_, "pressure"), estimate(factor_, "Z"));
    for (std::size_t k = 0; k < 4; ++k) text += fmt::format("{}{{{}}}", k > 0 ? "," : "", estimate(walls_[k], "pressure"));
    return text + "]";
  }

 private:
  /// Doubles the range of speeds.
  void widen() {
    for (std::size_t b = 0; b < bins; ++b) histogram_[b] = 2 * b + 1 < bins ? histogram_[2 * b] + histogram_[2 * b + 1] : 0.0;
    range_ *= 2.0;
  }

  double step_ = 1.0, began_ = 0.0, range_ = 1.0, integral_ = 0.0, path_ = 0.0;
  std::uint64_t samples_ = 0, pairs_ = 0;
  Totals totals_;
  Blocking pressure_, factor_;
  std::array<Blocking, 4> walls_;
  std::array<double, bins> histogram_{};
};

/// The past of a run, and how near to it a reversed run comes: moments that are compared when the run passes them again.
class Return {
 public:
  void begin(const LiveRun& run, double step) {
    past_.clear();
    mirror_.reset();
    distances_.clear();
    step_ = step;
    began_ = run.time();
    count_ = 0;
    keep(run);
  }
  /// The time at which the run is to be looked at next.
  [[nodiscard]] double next() const {
    if (!mirror_) return began_ + static_cast<double>(count_) * step_;
    return past_.empty() ? std::numeric_limits<double>::infinity() : *mirror_ + (*mirror_ - past_.back().time);
  }
  void look(const LiveRun& run) { mirror_ ? compare(run) : keep(run); }
  /// Velocities have been reversed now.
  void reverse(const LiveRun& run) {
    if (mirror_) {
      begin(run, step_);
      return;
    }
    mirror_ = run.time();
    distances_.clear();
    while (!past_.empty() && past_.back().time >= *mirror_) past_.pop_back();
  }
  [[nodiscard]] std::string json() const {
    std::string text = fmt::format("\"reversed_at\":{},\"return_at\":{},\"way_back\":[", json_number(mirror_),
                                   mirror_ ? json_number(*mirror_ + (*mirror_ - began_)) : "null");
    for (std::size_t k = 0; k < distances_.size(); ++k)
      text += fmt::format("{}[{},{}]", k > 0 ? "," : "", json_number(distances_[k][0]), json_number(distances_[k][1]));
    return text + "]";
  }

 private:
  struct Past {
    double time;
    Eigen::Matrix2Xd positions;
  };
  void keep(const LiveRun& run) {
    State state;
    run.state(state);
    past_.push_back({run.time(), state.positions});
    ++count_;
    constexpr std::size_t most = 128;
    if (past_.size() <= most) return;
    std::vector<Past> half;
    for (std::size_t k = 0; k < past_.size(); k += 2) half.push_back(std::move(past_[k]));
    past_ = std::move(half);
    count_ = (count_ + 1) / 2;
    step_ *= 2.0;
  }
  /// The largest distance of a disk from where it was.
  void compare(const LiveRun& run) {
    State state;
    run.state(state);
    const Box& box = run.simulation().scene().box;
    double largest = 0.0;
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
      Eigen::Vector2d r = state.positions.col(i) - past_.back().positions.col(i);
      for (int axis = 0; axis < 2; ++axis)
        if (box.periodic(axis)) r[axis] -= std::round(r[axis] / box.lengths()[axis]) * box.lengths()[axis];
      largest = std::max(largest, r.norm());
    }
    distances_.push_back({run.time() - *mirror_, largest});
    past_.pop_back();
  }

  std::vector<Past> past_;
  std::optional<double> mirror_;
  std::vector<std::array<double, 2>> distances_;
  double step_ = 1.0, began_ = 0.0;
  std::uint64_t count_ = 0;
};

/// A scene that runs in the page.
class Session {
 public:
  explicit Session(const Scene& scene) : run_(scene) {
    const Disks& disks = run_.simulation().disks();
    State state;
    run_.state(state);
    const double speed = usual_speed(state);
    const double length = scene.box.lengths().minCoeff();
    const double fall = scene.effects.acceleration().norm();
    crossing_ = length / std::max({speed, std::sqrt(fall * length), 1e-300});
    for (const WallProperties& wall : scene.effects.walls)
      if (wall.temperature)
        crossing_ = std::min(crossing_, length / std::sqrt(2.0 * *wall.temperature / std::max(1e-300, largest(disks.mass))));
    if (!std::isfinite(crossing_) || crossing_ > 1e100) crossing_ = 1.0;
    grid_ = grid_of(crossing_);
    const double spacing = std::sqrt(scene.box.area() / std::max<double>(1.0, static_cast<double>(disks.count())));
    step_ = nice(std::clamp(0.5 * spacing / length, 2e-3, 0.1) * crossing_);
    begin_measuring();
    keep_moment();
  }

  [[nodiscard]] double nice(double time) const { return std::ceil(time / grid_) * grid_; }
  /// The time of a change that is made now: the next of the grid, or of a finer one where disks have become faster.
  [[nodiscard]] double time_of_change() {
    run_.state(state_);
    const double grid = std::min(grid_, grid_of(run_.simulation().scene().box.lengths().minCoeff() / usual_speed(state_)));
    return std::ceil(run_.time() / grid) * grid;
  }
  LiveRun& run() { return run_; }
  [[nodiscard]] double crossing() const { return crossing_; }
  [[nodiscard]] const Measured& measured() const { return measured_; }
  [[nodiscard]] StopReason stopped() const { return stopped_; }
  [[nodiscard]] const std::string& fault() const { return fault_; }

  void begin_measuring() {
    measured_.begin(run_, step_);
    return_.begin(run_, 0.25 * step_);
  }

  void replay(std::vector<Change> changes) { pending_.assign(changes.begin(), changes.end()); }
  [[nodiscard]] std::size_t pending() const { return pending_.size(); }

  /// Runs to `until` for at most `budget` milliseconds. Returns 0 there, 1 where time is up, 2 where the run cannot go on.
  int advance(double until, double budget) {
    const double end = emscripten_get_now() + budget;
    while (run_.time() < until) {
      const bool follows = static_cast<std::int64_t>(run_.simulation().disks().count()) <= most_followed;
      double target = std::min(until, measured_.next());
      if (follows) target = std::min(target, std::max(return_.next(), run_.time()));
      if (!pending_.empty()) target = std::min(target, std::max(pending_.front().time, run_.time()));
      constexpr std::uint64_t events_at_once = 2000;
      stopped_ = run_.run_until(target, events_at_once);
      const bool arrived = stopped_ == StopReason::time;
      if (!arrived && stopped_ != StopReason::events) return 2;
      if (arrived) {
        if (!pending_.empty() && pending_.front().time <= target) apply_pending();
        if (measured_.next() <= target) {
          run_.state(state_);
          measured_.sample(run_, state_);
        }
        if (follows && return_.next() <= target) return_.look(run_);
      }
      if (emscripten_get_now() > end) return run_.time() < until ? 1 : 0;
    }
    return 0;
  }

  /// Runs to the next event; the changes of the list on the way are made.
  std::optional<Event> step() {
    const double end = run_.time() + 1e4 * crossing_;
    const auto until = [&] { return pending_.empty() ? end : std::min(std::max(pending_.front().time, run_.time()), end); };
    std::optional<Event> event = run_.step(until());
    while (!event && run_.time() < end && !pending_.empty()) {
      apply_pending();
      event = run_.step(until());
    }
    begin_measuring();
    return event;
  }

  void apply(Change change) {
    constexpr std::uint64_t most_events = 1'000'000;
    if (run_.run_until(change.time, most_events) == StopReason::events && run_.time() < change.time)
      throw std::runtime_error("the disks have become too fast to be changed; begin again");
    const auto* scale = std::get_if<ScaleVelocities>(&change.what);
    const bool reverses = scale != nullptr && scale->factor == -1.0;
    keep_moment();
    run_.apply(change);
    pending_.clear();  // somebody does otherwise than the list
    measured_.begin(run_, step_);
    if (reverses)
      return_.reverse(run_);
    else
      return_.begin(run_, 0.25 * step_);
    keep_moment();
  }

  /// Goes back by a number of events, as far as is known. Returns whether it could.
  /// The changes on the way are made again; those after it are to come, until somebody makes another.
  bool back(std::uint64_t events) {
    const std::uint64_t now = run_.events();
    const std::uint64_t wanted = now > events ? now - events : 0;
    while (moments_.size() > 1 && moments_.back().events > wanted) drop_last();
    if (moments_.empty() || moments_.back().events > wanted) return false;
    const std::vector<Change> made = run_.changes();
    run_.back_to(moments_.back());
    pending_.insert(pending_.begin(), made.begin() + static_cast<std::ptrdiff_t>(run_.changes().size()), made.end());
    while (run_.events() < wanted) {
      const double until = pending_.empty() ? run_.time() + 1e4 * crossing_ : pending_.front().time;
      const StopReason stopped = run_.run_until(until, wanted - run_.events());
      if (stopped == StopReason::time && !pending_.empty())
        apply_pending();
      else if (stopped != StopReason::events)
        break;
    }
    begin_measuring();
    return true;
  }

  void keep_moment() {
    if (!moments_.empty() && moments_.back().time == run_.time() &&
        moments_.back().changes + moments_.back().own_changes == run_.changes_made())
      return;
    moments_.push_back(run_.moment());
    bytes_ += moments_.back().bytes.size();
    while (bytes_ > most_snapshot_bytes && moments_.size() > 3) {
      // Every other one of the older half goes; the start stays.
      std::deque<LiveRun::Moment> kept;
      bytes_ = 0;
      for (std::size_t k = 0; k < moments_.size(); ++k) {
        if (k % 2 == 1 && k < moments_.size() / 2) continue;
        if (k > 0 && moments_.size() > 512 && k < moments_.size() / 4) continue;
        bytes_ += moments_[k].bytes.size();
        kept.push_back(std::move(moments_[k]));
      }
      if (kept.size() == moments_.size()) kept.erase(kept.begin() + 1);
      moments_ = std::move(kept);
    }
  }

  std::string twin(const std::string& method, double dt) {
    twin_.reset();
    if (method.empty()) return "";
    run_.state(state_);
    Scene scene = run_.simulation().scene();
    twin_.emplace(make_simulation(scene, state_, FixedStep{method, dt}));
    twin_before_ = run_.time();
    deepest_ = 0.0;
    return "";
  }
  void advance_twin(double budget) {
    if (!twin_) return;
    const double end = emscripten_get_now() + budget;
    while (twin_->time() < run_.time() - twin_before_ && emscripten_get_now() < end)
      twin_->run_until(std::min(run_.time() - twin_before_, twin_->time() + 20.0 * twin_->time_step().value_or(1.0)));
  }
  /// The time that the twin has come to, on the clock of the run.
  [[nodiscard]] double time_of_twin() const { return twin_before_ + twin_->time(); }
  Simulation* twin() { return twin_ ? &*twin_ : nullptr; }
  double& deepest() { return deepest_; }

  std::string check() {
    const std::vector<std::string> faults = run_.simulation().check_invariants(1e-9);
    return faults.empty() ? "" : faults.front();
  }
  [[nodiscard]] std::string way_back() const { return return_.json(); }

 private:
  /// Root mean square.
  static double usual_speed(const State& state) {
    return std::sqrt(state.velocities.squaredNorm() / std::max<double>(1.0, static_cast<double>(state.velocities.cols())));
  }
  /// A power of two, so that times have few digits: at most a millionth of the time in which a disk crosses the box.
  static double grid_of(double crossing) { return std::exp2(std::floor(std::log2(crossing * 1e-6))); }
  static double largest(const std::vector<double>& numbers) {
    return numbers.empty() ? 1.0 : *std::max_element(numbers.begin(), numbers.end());
  }
  void drop_last() {
    bytes_ -= moments_.back().bytes.size();
    moments_.pop_back();
  }
  void apply_pending() {
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

  LiveRun run_;
  double crossing_ = 1.0, grid_ = 1.0, step_ = 1.0;
  Measured measured_;
  Return return_;
  std::deque<LiveRun::Moment> moments_;
  std::size_t bytes_ = 0;
  std::deque<Change> pending_;
  std::optional<Simulation> twin_;
  double twin_before_ = 0.0, deepest_ = 0.0;
  StopReason stopped_ = StopReason::time;
  std::string fault_;
  State state_;
};

std::unique_ptr<Session> session;
State shown;
std::vector<double> disks_of_page;  // x, y, vx, vy of all disks, one list after the other
std::array<double, 40> numbers{};
std::vector<std::uint8_t> overlapping;

Session& here() {
  if (!session) throw std::runtime_error("no scene is loaded; load one first");
  return *session;
}

std::string wall_json(const WallProperties& wall) {
  return fmt::format(
      "{{\"restitution\":{},\"temperature\":{},\"velocity\":{},\"slides\":{},\"mass\":{},\"load\":{},\"vibration\":{},"
      "\"amplitude\":{},\"frequency\":{}}}",
      json_number(wall.restitution), json_number(wall.temperature), json_number(wall.velocity),
      json_number(wall.tangential_velocity), json_number(wall.mass), json_number(wall.load), json_number(wall.vibration),
      wall.oscillation ? json_number(wall.oscillation->amplitude) : "null",
      wall.oscillation ? json_number(wall.oscillation->frequency) : "null");
}

std::string steps_json(const Effects& effects) {
  std::string text;
  if (!effects.stepped_potential) return "[]";
  for (const PotentialStep& step : effects.stepped_potential->steps)
    text += fmt::format("{}{{\"width\":{},\"energy\":{}}}", text.empty() ? "" : ",", json_number(step.width),
                        json_number(step.energy));
  return "[" + text + "]";
}

std::string obstacles_json(const Effects& effects) {
  std::string text;
  for (const Obstacle& obstacle : effects.obstacles) {
    if (!text.empty()) text += ",";
    if (const auto* disk = std::get_if<DiskObstacle>(&obstacle))
      text += fmt::format("{{\"centre\":{},\"radius\":{}}}", json_pair(disk->centre), json_number(disk->radius));
    else if (const auto* segment = std::get_if<SegmentObstacle>(&obstacle))
      text += fmt::format("{{\"from\":{},\"to\":{}}}", json_pair(segment->from), json_pair(segment->to));
    else if (const auto* arc = std::get_if<ArcObstacle>(&obstacle))
      text += fmt::format("{{\"centre\":{},\"radius\":{},\"angles\":[{},{}]}}", json_pair(arc->centre), json_number(arc->radius),
                          json_number(arc->from), json_number(arc->to));
  }
  return "[" + text + "]";
}

/// Z of the equation of state, where the disks are of one size and fluid, and nothing but collisions acts.
std::optional<double> theory_Z(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const Disks& disks = simulation.disks();
  const double eta = scene.packing_fraction();
  if (disks.count() < 2 || !why_no_Z(scene.effects).empty() || !scene.effects.potential_steps().empty() || !(eta <= 0.69))
    return std::nullopt;
  if (std::adjacent_find(disks.radius.begin(), disks.radius.end(), std::not_equal_to<>()) != disks.radius.end())
    return std::nullopt;
  const bool periodic = scene.box.periodic(0) && scene.box.periodic(1);
  return periodic && eta < 0.63 ? theory::kolafa_rottner_finite(eta, scene.disk_count()) : theory::kolafa_rottner(eta);
}

std::string description(Session& session) {
  const Simulation& simulation = session.run().simulation();
  const Scene& scene = simulation.scene();
  const Disks& disks = simulation.disks();
  const Effects& effects = scene.effects;
  std::string species;
  for (const Species& kind : scene.species) {
    const bool one = kind.radii.empty() && kind.masses.empty();
    species += fmt::format("{}{{\"name\":{},\"count\":{},\"radius\":{},\"mass\":{},\"uniform\":{}}}", species.empty() ? "" : ",",
                           json_text(kind.name), kind.count, json_number(kind.radius), json_number(kind.mass), one);
  }
  std::string walls;
  for (const WallProperties& wall : effects.walls) walls += (walls.empty() ? "" : ",") + wall_json(wall);
  const bool reversal = effects.collision.rule == CollisionRule::reversal;
  std::string json = fmt::format(
      "{{\"title\":{},\"disks\":{},\"lower\":{},\"upper\":{},\"periodic\":[{},{}],\"species\":[{}],\"walls\":[{}],\"obstacles\":{"
      "},",
      json_text(scene.title), disks.count(), json_pair(scene.box.lower), json_pair(scene.box.upper), scene.box.periodic(0),
      scene.box.periodic(1), species, walls, obstacles_json(effects));
  json += fmt::format(
      "\"gravity\":{},\"rule\":\"{}\",\"restitution\":{},\"roughness\":{},\"thermostat\":{},\"thermostatRate\":{},\"shear\":{},"
      "\"drag\":{},\"tumbling\":{},\"growth\":{},",
      json_pair(effects.acceleration()), reversal ? "reversal" : "specular", json_number(effects.collision.restitution),
      json_number(effects.collision.roughness), effects.thermostat ? json_number(effects.thermostat->temperature) : "null",
      effects.thermostat ? json_number(effects.thermostat->rate) : "null",
      effects.shear ? json_number(effects.shear->rate) : "null", effects.drag ? json_number(effects.drag->rate) : "null",
      effects.tumbling ? json_number(effects.tumbling->rate) : "null",
      effects.growth ? json_number(effects.growth->rate) : "null");
  json += fmt::format(
      "\"wellDepth\":{},\"wellWidth\":{},\"engine\":{},\"whyNoZ\":{},\"theoryZ\":{},\"packing\":{},"
      "\"crossing\":{},",
      effects.square_well ? json_number(effects.square_well->depth) : "null",
      effects.square_well ? json_number(effects.square_well->width) : "null", json_text(simulation.engine()),
      json_text(why_no_Z(effects)), json_number(theory_Z(simulation)), json_number(scene.packing_fraction()),
      json_number(session.crossing()));
  json +=
      fmt::format("\"isCircle\":{},\"steps\":{},\"delta\":{},\"brownian\":{},", scene.box.is_circle, steps_json(effects),
                  effects.non_additivity ? json_number(effects.non_additivity->delta) : "null",
                  effects.brownian ? fmt::format("{{\"temperature\":{},\"rate\":{}}}", json_number(effects.brownian->temperature),
                                                 json_number(effects.brownian->rate))
                                   : "null");
  json += fmt::format("\"thermal\":[{},{}],\"seed\":{},\"changes\":{}}}", centre_of_mass_is_thermal(scene.box, effects, 0),
                      centre_of_mass_is_thermal(scene.box, effects, 1), session.run().first_scene().run.seed,
                      session.run().changes_made());
  return json;
}

}  // namespace

extern "C" {

/// Loads a scene; the changes of the last text are made at their times. Keeps the session that is there where either is refused.
EMSCRIPTEN_KEEPALIVE const char* carom_load(const char* toml, const char* source, const char* overrides, const char* changes) {
  return answered([&] {
    std::vector<std::string> list;
    std::string line;
    for (const char* c = overrides; *c != '\0'; ++c) {
      if (*c == '\n') {
        if (!line.empty()) list.push_back(line);
        line.clear();
      } else {
        line += *c;
      }
    }
    if (!line.empty()) list.push_back(line);
    const Scene scene = parse_scene(toml, source, list);
    if (scene.disk_count() > most_disks)
      throw std::runtime_error(fmt::format("{}: {} disks are more than this page holds; at most {}, or take carom run", source,
                                           scene.disk_count(), most_disks));
    auto another = std::make_unique<Session>(scene);
    if (*changes != '\0') another->replay(parse_changes(changes, "changes"));
    session = std::move(another);
    return description(*session);
  });
}

EMSCRIPTEN_KEEPALIVE const char* carom_describe() {
  return answered([] { return description(here()); });
}

/// The scene of the start as TOML, with its overrides applied.
EMSCRIPTEN_KEEPALIVE const char* carom_scene_text() {
  return answered([] { return fmt::format("{{\"toml\":{}}}", json_text(resolved_toml(here().run().first_scene()))); });
}

EMSCRIPTEN_KEEPALIVE int carom_advance(double until, double budget) {
  try {
    return here().advance(until, budget);
  } catch (const std::exception& error) {
    answer = error.what();
    return 3;
  }
}
EMSCRIPTEN_KEEPALIVE const char* carom_why_stopped() { return say(to_string(here().stopped())); }
EMSCRIPTEN_KEEPALIVE const char* carom_answer() { return answer.c_str(); }
EMSCRIPTEN_KEEPALIVE const char* carom_fault() { return say(here().fault()); }

/// Goes to the next event; returns it.
EMSCRIPTEN_KEEPALIVE const char* carom_step() {
  return answered([] {
    const std::optional<Event> event = here().step();
    if (!event) return std::string("{\"event\":null}");
    return fmt::format("{{\"event\":{{\"time\":{},\"disk\":{},\"partner\":{}}}}}", json_number(here().run().time()), event->disk,
                       event->partner);
  });
}

EMSCRIPTEN_KEEPALIVE int carom_back(double events) {
  try {
    return here().back(static_cast<std::uint64_t>(events)) ? 1 : 0;
  } catch (const std::exception& error) {
    answer = error.what();
    return 0;
  }
}
EMSCRIPTEN_KEEPALIVE void carom_keep_moment() {
  try {
    here().keep_moment();
  } catch (const std::exception&) {  // without it one cannot step back to here
  }
}

/// Applies what the body of a [[changes]] table says, now. Returns the description after it.
EMSCRIPTEN_KEEPALIVE const char* carom_apply(const char* body) {
  return answered([&] {
    Session& now = here();
    const std::string text = fmt::format("[[changes]]\ntime = {}\n{}", now.time_of_change(), body);
    now.apply(parse_changes(text, "change").front());
    return description(now);
  });
}

EMSCRIPTEN_KEEPALIVE const char* carom_changes() {
  return answered([] {
    std::string text;
    for (const Change& change : here().run().changes()) text += changes_text(change);
    return fmt::format("{{\"toml\":{}}}", json_text(text));
  });
}

EMSCRIPTEN_KEEPALIVE const char* carom_hash() {
  return answered([] { return fmt::format("{{\"hash\":{}}}", json_text(here().run().hash())); });
}

EMSCRIPTEN_KEEPALIVE const char* carom_check() {
  return answered([] { return fmt::format("{{\"fault\":{}}}", json_text(here().check())); });
}

EMSCRIPTEN_KEEPALIVE const char* carom_measured() {
  return answered([] { return fmt::format("{{{},{}}}", here().measured().json(), here().way_back()); });
}
EMSCRIPTEN_KEEPALIVE void carom_measure_anew() {
  if (session) session->begin_measuring();
}
EMSCRIPTEN_KEEPALIVE const double* carom_histogram() { return here().measured().histogram().data(); }

/// Writes x, y, vx, vy of all disks, one list after the other, and the numbers of the moment.
EMSCRIPTEN_KEEPALIVE const double* carom_state() {
  Session& now = here();
  const LiveRun& run = now.run();
  run.state(shown);
  const auto count = static_cast<std::size_t>(shown.positions.cols());
  disks_of_page.resize(4 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    disks_of_page[i] = shown.positions(0, column);
    disks_of_page[count + i] = shown.positions(1, column);
    disks_of_page[2 * count + i] = shown.velocities(0, column);
    disks_of_page[3 * count + i] = shown.velocities(1, column);
  }
  const Simulation& simulation = run.simulation();
  const Scene& scene = simulation.scene();
  const Energies energies = energies_of(scene.box, scene.effects, simulation.disks(), shown);
  const Box box = box_of(scene.box, shown);
  const Totals totals = simulation.totals();
  numbers = {shown.time,
             static_cast<double>(count),
             static_cast<double>(run.pairs()),
             static_cast<double>(run.walls() + run.obstacles()),
             static_cast<double>(run.events()),
             shown.scale,
             shown.shear_displacement,
             box.lower.x(),
             box.upper.x(),
             box.lower.y(),
             box.upper.y(),
             energies.kinetic,
             energies.spin,
             energies.potential,
             energies.pistons,
             kinetic_temperature(scene.box, scene.effects, simulation.disks(), shown),
             static_cast<double>(totals.numerics.overlapping),
             totals.numerics.deepest_overlap,
             now.measured().integral(),
             now.measured().covered(),
             now.measured().range(),
             static_cast<double>(shown.bonds),
             static_cast<double>(run.changes_made()),
             now.measured().free_path(),
             totals.dissipated,
             static_cast<double>(now.pending())};
  return disks_of_page.data();
}
EMSCRIPTEN_KEEPALIVE const double* carom_numbers() { return numbers.data(); }

/// Radii, masses and species of all disks.
EMSCRIPTEN_KEEPALIVE const double* carom_disks() {
  static std::vector<double> list;
  const Disks& disks = here().run().simulation().disks();
  list.assign(disks.radius.begin(), disks.radius.end());
  list.insert(list.end(), disks.mass.begin(), disks.mass.end());
  list.insert(list.end(), disks.species.begin(), disks.species.end());
  return list.data();
}

/// Runs the scene of now from its state of now by fixed steps beside the exact run; an empty name ends that.
EMSCRIPTEN_KEEPALIVE const char* carom_twin(const char* method, double dt) {
  return answered([&] {
    here().twin(method, dt);
    return std::string("{}");
  });
}
EMSCRIPTEN_KEEPALIVE void carom_advance_twin(double budget) { here().advance_twin(budget); }
/// Writes the twin's x, y, vx, vy; null where there is none.
EMSCRIPTEN_KEEPALIVE const double* carom_twin_state() {
  static std::vector<double> list;
  Simulation* twin = here().twin();
  if (twin == nullptr) return nullptr;
  const State state = twin->state();
  const auto count = static_cast<std::size_t>(state.positions.cols());
  list.resize(4 * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      list[k * count + i] = k < 2 ? state.positions(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i))
                                  : state.velocities(static_cast<Eigen::Index>(k - 2), static_cast<Eigen::Index>(i));
  return list.data();
}
/// What went wrong in the twin so far, as JSON.
EMSCRIPTEN_KEEPALIVE const char* carom_twin_numbers() {
  return answered([] {
    Simulation* twin = here().twin();
    if (twin == nullptr) return std::string("{}");
    const State state = twin->state();
    const playground::Overlaps found = playground::overlaps_of(twin->scene().box, twin->disks(), state, overlapping);
    here().deepest() = std::max(here().deepest(), found.deepest);
    const Energies energies = energies_of(twin->scene().box, twin->scene().effects, twin->disks(), state);
    return fmt::format("{{\"time\":{},\"overlapping\":{},\"deepest\":{},\"collisions\":{},\"energy\":{}}}",
                       json_number(here().time_of_twin()), found.pairs, json_number(here().deepest()), twin->counts().pair,
                       json_number(energies.total()));
  });
}
EMSCRIPTEN_KEEPALIVE const std::uint8_t* carom_twin_overlapping() { return overlapping.data(); }
}
