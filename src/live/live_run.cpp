#include "live/live_run.hpp"

#include "core/running_totals.hpp"
#include "scene/listed_disks.hpp"
#include "simulation/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace carom {
namespace {

/// The scene of a run that ends when somebody stops it: its walls may move, and its disks grow, as long as they are let. LiveRun
/// makes its changes.
Scene without_end(Scene scene) {
  scene.run.time.reset();
  scene.run.collisions.reset();
  scene.run.equilibrate.reset();
  scene.changes.clear();
  return scene;
}

/// The equilibration of Simulation's schedule, without its hooks.
void equilibrate(Simulation& simulation, const std::optional<Run::Equilibrate>& asked) {
  if (!asked) return;
  RunLimits limits;
  limits.collisions = asked->pair_collisions(simulation.scene().disk_count()).value_or(RunLimits::none);
  const StopReason stopped = simulation.run_until(asked->time.value_or(std::numeric_limits<double>::max()), limits);
  if (stopped != StopReason::time && stopped != StopReason::collisions)
    throw std::runtime_error(
        fmt::format("the run ended while it was equilibrating ({}); leave out run.equilibrate", to_string(stopped)));
  simulation.reset_clock();
}

/// Returns the species of a disk and its place there.
std::pair<std::size_t, std::int64_t> place_of(const Scene& scene, std::int64_t disk) {
  std::int64_t rest = disk;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    if (rest >= 0 && rest < scene.species[s].count) return {s, rest};
    rest -= scene.species[s].count;
  }
  throw SceneError({}, fmt::format("there is no disk {}; ids go from 0 to {}", disk, scene.disk_count() - 1));
}

template <class Matrix>
Matrix without_column(const Matrix& matrix, Eigen::Index column) {
  if (matrix.cols() == 0) return matrix;
  Matrix result(matrix.rows(), matrix.cols() - 1);
  result.leftCols(column) = matrix.leftCols(column);
  result.rightCols(result.cols() - column) = matrix.rightCols(result.cols() - column);
  return result;
}

template <class Matrix, class Column>
Matrix with_column(const Matrix& matrix, Eigen::Index column, const Column& values) {
  Matrix result(2, matrix.cols() + 1);
  result.leftCols(column) = matrix.leftCols(column);
  result.col(column) = values;
  result.rightCols(matrix.cols() - column) = matrix.rightCols(matrix.cols() - column);
  return result;
}

/// Removes entry `at` of a vector of one number per disk, or puts a zero there; leaves one without entries alone.
Eigen::VectorXd without_entry(const Eigen::VectorXd& numbers, Eigen::Index at) {
  if (numbers.size() == 0) return numbers;
  Eigen::VectorXd result(numbers.size() - 1);
  result << numbers.head(at), numbers.tail(result.size() - at);
  return result;
}
Eigen::VectorXd with_entry(const Eigen::VectorXd& numbers, Eigen::Index at) {
  if (numbers.size() == 0) return numbers;
  Eigen::VectorXd result(numbers.size() + 1);
  result << numbers.head(at), 0.0, numbers.tail(numbers.size() - at);
  return result;
}

void remove_disk(Scene& scene, State& state, std::int64_t disk) {
  const auto [s, k] = place_of(scene, disk);
  Species& species = scene.species[s];
  --species.count;
  if (!species.radii.empty()) species.radii.erase(species.radii.begin() + k);
  if (!species.masses.empty()) species.masses.erase(species.masses.begin() + k);
  const auto column = static_cast<Eigen::Index>(disk);
  state.positions = without_column(state.positions, column);
  state.velocities = without_column(state.velocities, column);
  state.images = without_column(state.images, column);
  state.spins = without_entry(state.spins, column);
}

void add_disk(Scene& scene, State& state, const AddDisk& add) {
  const auto s = static_cast<std::size_t>(add.species);
  if (s >= scene.species.size())
    throw SceneError({}, fmt::format("there is no species {}; they go from 0 to {}", add.species, scene.species.size() - 1));
  Eigen::Index column = 0;
  for (std::size_t k = 0; k <= s; ++k) column += static_cast<Eigen::Index>(scene.species[k].count);
  Species& species = scene.species[s];
  ++species.count;
  if (!species.radii.empty()) species.radii.push_back(species.radii.back());
  if (!species.masses.empty()) species.masses.push_back(species.masses.back());
  state.positions = with_column(state.positions, column, add.position);
  state.velocities = with_column(state.velocities, column, add.velocity);
  state.images = with_column(state.images, column, Eigen::Matrix<std::int64_t, 2, 1>::Zero());
  state.spins = with_entry(state.spins, column);
}

}  // namespace

LiveRun::LiveRun(const Scene& scene) : first_(scene), simulation_(make_simulation(without_end(scene))) {
  equilibrate(simulation_, scene.run.equilibrate);
}

StopReason LiveRun::run_until(double time, std::uint64_t most_events) {
  RunLimits limits;
  const std::uint64_t now = events();
  const std::uint64_t most = most_events < RunLimits::none - now ? now + most_events : RunLimits::none;
  const auto run = [&](double until) {
    if (most < RunLimits::none) limits.events = most - counts_before_.events();
    return simulation_.run_until(until - before_, limits);
  };
  while (has_change_before(time)) {
    if (const StopReason stopped = run(first_.changes[own_changes_].time); stopped != StopReason::time) return stopped;
    make_own_change();
  }
  return run(time);
}

std::optional<Event> LiveRun::step(double until) {
  while (has_change_before(until)) {
    const double change = first_.changes[own_changes_].time;
    if (std::optional<Event> event = simulation_.step(change - before_)) return event;
    make_own_change();
  }
  return simulation_.step(until - before_);
}

void LiveRun::make_own_change() {
  make(first_.changes[own_changes_]);
  ++own_changes_;
}

void LiveRun::state(State& state) const {
  simulation_.state(state);
  state.time += before_;
}

std::string LiveRun::hash() const {
  State state;
  this->state(state);
  return state_hash(state);
}

void LiveRun::apply(const Change& change) {
  if (change.time < time())
    throw SceneError({}, fmt::format("a change at time {} comes too late at time {}", change.time, time()));
  run_until(change.time);
  while (own_changes_ < first_.changes.size() && first_.changes[own_changes_].time == change.time) make_own_change();
  make(change);
  changes_.push_back(change);
}

void LiveRun::make(const Change& change) {
  State state = simulation_.state();
  Scene scene = simulation_.scene();
  if (const auto* set = std::get_if<SetKeys>(&change.what)) {
    set_keys(*set);
  } else if (const auto* scale = std::get_if<ScaleVelocities>(&change.what)) {
    simulation_.set_velocities(scale->factor * state.velocities, scale->factor * state.spins);
  } else if (const auto* add = std::get_if<AddDisk>(&change.what)) {
    add_disk(scene, state, *add);
    begin_again(scene, state);
  } else if (const auto* remove = std::get_if<RemoveDisk>(&change.what)) {
    remove_disk(scene, state, remove->disk);
    begin_again(scene, state);
  } else if (const auto* move = std::get_if<MoveDisk>(&change.what)) {
    (void)place_of(scene, move->disk);
    const auto column = static_cast<Eigen::Index>(move->disk);
    state.positions.col(column) = move->position;
    state.velocities.col(column) = move->velocity;
    begin_again(scene, state);
  } else {
    simulation_.set_effects(effects_after(scene.effects, change));
  }
}

/// Keys of effects are set in the effects of now, which may be those of the scene's own changes. Radii and masses are read in the
/// scene of the start with all that were set so far, which completes short forms.
void LiveRun::set_keys(const SetKeys& set) {
  SetKeys of_effects;
  std::vector<std::string> all = overrides_;
  std::vector<std::string> of_disks;
  for (const std::string& text : set.overrides) {
    require_changeable(text);
    if (!text.starts_with("disks.")) {
      of_effects.overrides.push_back(text);
      continue;
    }
    of_disks.push_back(text);
    const std::string key = text.substr(0, text.find('='));
    std::erase_if(all, [&](const std::string& other) { return other.substr(0, other.find('=')) == key; });
    all.push_back(text);
  }
  Scene scene = simulation_.scene();
  scene.effects = effects_after(scene.effects, {.what = of_effects});
  if (of_disks.empty()) {
    simulation_.set_effects(scene.effects);
    return;
  }
  std::vector<std::string> from_start = first_.overrides;
  from_start.insert(from_start.end(), all.begin(), all.end());
  from_start.emplace_back("changes=[]");
  if (first_.run.time) from_start.emplace_back("run.time=1e-30");  // what is set need not last until the end of the run
  const Scene asked = parse_scene(first_.text, first_.source, from_start);
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const std::string path = fmt::format("disks.{}.", s);
    for (const std::string& text : of_disks) {
      if (!text.starts_with(path)) continue;
      Species& species = scene.species[s];
      (text.starts_with(path + "radius") ? species.radius : species.mass) =
          text.starts_with(path + "radius") ? asked.species[s].radius : asked.species[s].mass;
      (text.starts_with(path + "radius") ? species.radii : species.masses).clear();
    }
  }
  begin_again(scene, simulation_.state());
  overrides_ = std::move(all);
}

/// Another simulation goes on from the state. Its random numbers are others than those of the one before.
void LiveRun::begin_again(const Scene& with, const State& state) {
  Scene scene = with;
  ++scene.run.seed;
  scene.box = box_of(scene.box, state);
  list_disks(scene, state);
  Simulation another = make_simulation(scene, state);
  const State begun = another.state();
  require_apart_in_shear(scene, begun, begun.scale);
  before_ += simulation_.time();
  add_counts(counts_before_, simulation_.counts());
  simulation_ = std::move(another);
}

LiveRun::Moment LiveRun::moment() const {
  std::ostringstream bytes;
  simulation_.save(bytes);
  return {time(),         events(),        std::move(bytes).str(), simulation_.scene(), before_,
          counts_before_, changes_.size(), own_changes_,           overrides_};
}

void LiveRun::back_to(const Moment& moment) {
  std::istringstream bytes(moment.bytes);
  simulation_ = restore_simulation(moment.scene, bytes);
  before_ = moment.before;
  counts_before_ = moment.counts_before;
  changes_.resize(moment.changes);
  own_changes_ = moment.own_changes;
  overrides_ = moment.overrides;
}

}  // namespace carom
