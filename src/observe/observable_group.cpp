#include "observe/observable_group.hpp"

#include "core/archive.hpp"
#include "core/checked_stream.hpp"
#include "observe/drift.hpp"
#include "observe/equilibrium.hpp"
#include "observe/observables.hpp"
#include "scene/changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {

namespace {

/// Every table has a file by its name: one whose name is taken gets that of its observable before it.
void tell_tables_apart(std::vector<Measurement>& measured) {
  std::set<std::string> taken;
  for (Measurement& one : measured)
    for (Table& table : one.tables)
      while (!taken.insert(table.name).second) table.name = one.name + "_" + table.name;
}

std::string described(const std::string& name, double step) {
  return fmt::format("the observable {} ({})", name, step > 0.0 ? fmt::format("sampled every {:.9g}", step) : "without samples");
}

}  // namespace

ObservableGroup::ObservableGroup(const ObservedRun& run)
    : run_(run), acting_(*run.acting), changes_(run.changes_made), meter_(run.scene, run.disks) {
  for (const ObservableRequest& request : run.scene.observe) add(make_observable(request, run_));
}

ObservableGroup::ObservableGroup(const ObservedRun& run, std::istream& saved)
    : run_(run), acting_(*run.acting), meter_(run.scene, run.disks), goes_on_(true) {
  load(saved);
  for (const ObservableRequest& request : run.scene.observe) add(make_observable(request, run_));
}

void ObservableGroup::add(MadeObservable made) {
  Observable& observable = *made.observable;
  const bool follows = observable.follows_collisions();
  if (follows && is_driven(run_.scene.effects))
    throw SceneError({run_.scene.source, 0, 0},
                     fmt::format("{} follows disks from collision to collision, and {} changes their velocities in between; "
                                 "remove one of the two",
                                 observable.name(), what_drives(run_.scene.effects)));
  if (observable.follows_collisions() && run_.own_rule)
    throw SceneError({}, observable.name() +
                             " follows disks from collision to collision, and knows the collision rules of scenes "
                             "only; do without it, or without the rule of the program");
  if (goes_on_) take_up(observable);
  observables_.push_back(std::move(made.observable));
  if (made.changes != nullptr) change_followers_.push_back(made.changes);
  if (!follows) return;
  if (made.fluxes != nullptr)
    meter_.add(*made.fluxes);
  else if (made.records != nullptr)
    record_followers_.push_back(made.records);
  else
    followers_.push_back(&observable);
  if (!run_.has_collision_records || observable.needs_places()) follow_log();
  if (observable.needs_places()) stream_->follow_places();
}

void ObservableGroup::take_up(Observable& observable) {
  const std::string mine = described(observable.name(), observable.step());
  if (observables_.size() == saved_.size())
    throw std::invalid_argument(
        fmt::format("the run was saved without {}; go on with the observables with which it began, in their order", mine));
  Saved& saved = saved_[observables_.size()];
  if (saved.name != observable.name() || saved.step != observable.step())
    throw std::invalid_argument(
        fmt::format("the run was saved with {}, and {} is in its place; go on with the observables with which it began, in their "
                    "order",
                    described(saved.name, saved.step), mine));
  std::istringstream gathered(std::move(saved.gathered));
  observable.load(gathered);
}

void ObservableGroup::require_all_added() const {
  if (observables_.size() >= saved_.size()) return;
  const Saved& missing = saved_[observables_.size()];
  throw std::invalid_argument(fmt::format("the run was saved with {} of a program's own; go on with it in such a program",
                                          described(missing.name, missing.step)));
}

void ObservableGroup::follow_log() {
  run_.has_collision_records = false;
  if (stream_ || !follows_collisions()) return;
  stream_.emplace(run_);
  if (saved_stream_.empty()) return;
  std::istringstream saved(saved_stream_);
  LoadingArchive archive(saved);
  archive(*stream_);
}

bool ObservableGroup::follows_collisions() const {
  return !followers_.empty() || meter_.has_followers() || !record_followers_.empty();
}

std::map<double, std::vector<Observable*>> ObservableGroup::by_step() const {
  std::map<double, std::vector<Observable*>> by_step;
  for (const auto& observable : observables_)
    if (observable->step() > 0.0) by_step[observable->step()].push_back(observable.get());
  return by_step;
}

std::vector<double> ObservableGroup::steps() const {
  std::vector<double> steps;
  for (const ObservableRequest& request : run_.scene.observe) steps.push_back(run_.step(request));
  return steps;
}

void ObservableGroup::start(const State& state) {
  started_ = true;
  if (stream_) stream_->start(state);
  meter_.start(common_velocity(run_, state));
  for (const auto& observable : observables_) observable->start(state);
}

/// Passes events on in pieces that stay in the nearest cache while all observables read them.
void ObservableGroup::follow(std::span<const Event> events) {
  while (!events.empty()) {
    const auto later = [&](const Event& event) {
      return changes_ < run_.scene.changes.size() && run_.scene.changes[changes_].time < event.time;
    };
    while (later(events.front())) pass_change();
    const std::span<const Event> some = events.first(std::min(CollisionContacts::most, events.size()));
    const auto count = static_cast<std::size_t>(std::ranges::find_if(some, later) - some.begin());
    follow(stream_->follow(some.first(count)));
    events = events.subspan(count);
  }
}

void ObservableGroup::changed(std::size_t changes) {
  while (changes_ < changes) pass_change();
}

/// Passes on the next change of the scene.
void ObservableGroup::pass_change() {
  const Change& change = run_.scene.changes[changes_++];
  acting_ = effects_after(acting_, change);
  if (stream_) stream_->change(change, acting_);
  for (ChangeFollower* follower : change_followers_) follower->pass(change, acting_);
}

void ObservableGroup::follow(const CollisionRecords& collisions) {
  if (collisions.records.empty()) return;
  if (meter_.has_followers()) meter_.follow(collisions);
  if (!record_followers_.empty()) {
    const CollisionRecords met = touching(collisions);
    for (RecordFollower* follower : record_followers_) follower->follow(met);
  }
  if (followers_.empty()) return;
  collisions.read(collisions_);
  for (Observable* observable : followers_) observable->collisions(collisions_);
}

void ObservableGroup::change(bool made, const Effects& effects, const State& state, const Totals& totals) {
  if (made) pass_change();
  for (ChangeFollower* follower : change_followers_) follower->change(made, effects, state, totals);
}

void ObservableGroup::end(const State& state, const Totals& totals) {
  if (!started_) return;
  for (ChangeFollower* follower : change_followers_) follower->end(state, totals);
}

/// Returns the collisions that are not at the edge of a well.
CollisionRecords ObservableGroup::touching(const CollisionRecords& collisions) {
  if (std::ranges::all_of(collisions.contacts, &PairContact::touching)) return collisions;
  touching_.clear();
  for (std::size_t n = 0; n < collisions.records.size(); ++n)
    if (collisions.contacts[n].touching) touching_.push_back(collisions.records[n]);
  return {collisions.disks, collisions.epoch, collisions.epoch_remainder, touching_, {}};
}

std::vector<Measurement> ObservableGroup::results(double time, const Totals& totals) {
  std::vector<Measurement> measured;
  if (!started_) return measured;
  const std::string on_errors =
      note_on_errors(run_.scene, 2.0 * static_cast<double>(totals.pair) / static_cast<double>(run_.disks.count()));
  for (const auto& observable : observables_) {
    std::string& note = measured.emplace_back(observable->finish(time, totals)).note;
    if (!on_errors.empty()) note += (note.empty() ? "" : "; ") + on_errors;
  }
  note_drifts(measured, run_.scene);
  tell_tables_apart(measured);
  return measured;
}

void ObservableGroup::save(std::ostream& out) const {
  write_checked(out, [this](std::ostream& within) {
    SavingArchive archive(within);
    archive(run_.time, run_.temperature, run_.mean_free_time, started_, meter_, static_cast<std::uint64_t>(changes_));
    std::ostringstream stream;
    if (stream_) {
      SavingArchive of_stream(stream);
      of_stream(*stream_);
    }
    archive(stream.str(), static_cast<std::uint64_t>(observables_.size()));
    for (const auto& observable : observables_) {
      std::ostringstream gathered;
      observable->save(gathered);
      archive(observable->name(), observable->step(), gathered.str());
    }
  });
}

void ObservableGroup::load(std::istream& saved) {
  try {
    read_checked(saved, [this](std::istream& within) {
      LoadingArchive archive(within);
      std::uint64_t changes = 0, observables = 0;
      archive(run_.time, run_.temperature, run_.mean_free_time, started_, meter_, changes, saved_stream_, observables);
      changes_ = changes;
      saved_.resize(observables);
      for (Saved& one : saved_) archive(one.name, one.step, one.gathered);
    });
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("the observables cannot be continued: {}", error.what()));
  }
}

}  // namespace carom
