#include "runner/runner.hpp"

#include "core/seconds.hpp"
#include "core/state_archive.hpp"
#include "io/partial_file.hpp"
#include "simulation/start.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

namespace carom {

Runner::Runner(Simulation& simulation, const RunDirectory* directory, Provenance provenance, RunnerOptions options,
               const Checkpoint* from)
    : simulation_(simulation),
      scene_(simulation.whole_scene()),
      directory_(directory),
      provenance_(std::move(provenance)),
      options_(std::move(options)),
      from_(from),
      measurements_(simulation),
      saved_collisions_(simulation.totals().pair) {
  if (options_.checkpoint_every) plan_ = saving_plan(*options_.checkpoint_every);
  if (from != nullptr) {
    read(*from);
    extended_ = from->facts().finished;
  } else {
    observation_.emplace(simulation_);
    if (options_.observe) options_.observe(*observation_);
    if (directory_ != nullptr) writer_.emplace(*directory_, scene_, disks_of(scene_), provenance_);
  }
}

RunnerOutcome Runner::run(const RunnerHooks& hooks) {
  const RunResult result = simulate(hooks);
  RunnerOutcome outcome{.report = measurements_.report(result, wall_seconds()), .files = {}, .report_failed = {}};
  outcome.report.observables = observation_->results();
  if (options_.verify_every > 0) outcome.report.verification = {options_.verify_every, result.verified, result.faults};
  if (start_ && hooks.complete && result.stopped != StopReason::interrupted) hooks.complete(outcome.report, *start_);
  if (writer_) outcome.files = writer_->finish(outcome.report);
  if (end_unsaved_) remove_checkpoints();
  if (saved_) outcome.files.emplace_back(checkpoint_name);
  if (options_.report && directory_ != nullptr) write_report(outcome);
  return outcome;
}

RunResult Runner::simulate(const RunnerHooks& hooks) {
  if (writer_) writer_->set_effects(simulation_.scene().effects);
  RunHooks schedule;
  schedule.verify_every = options_.verify_every;
  schedule.start = [&](const State& start) {
    measurements_.start(start);
    if (writer_) writer_->start(start, observation_->reference_temperature());
    if (options_.keep_start) start_ = start;
  };
  schedule.sample = [&](std::uint64_t k, const State& state) {
    measurements_.sample(state);
    const Totals totals = simulation_.totals();
    const State& kept = in_first_terms_(state);
    if (writer_) writer_->sample(k, kept, totals);
    if (hooks.sample) hooks.sample(kept, totals);
  };
  if (writer_ && scene_.output.events) schedule.events = [&](std::span<const Event> events) { writer_->events(events); };
  schedule.block = [&](const Progress& progress) { measurements_.block(progress); };
  schedule.change = [&](bool made) {
    measurements_.change(made);
    if (made && writer_) writer_->set_effects(simulation_.scene().effects);
  };
  schedule.proceed = [&](const Progress& progress) {
    stopped_ = hooks.proceed && !hooks.proceed(progress);
    return !stopped_;
  };
  schedule.checkpoint = [&](const SavingMoment& moment) {
    if (is_due(moment)) save(moment, hooks);
  };
  const bool beside = options_.observe   ? false
                      : options_.threads ? *options_.threads > 1
                                         : std::thread::hardware_concurrency() > 1;
  beside ? observation_->attach_on_thread(schedule) : observation_->attach(schedule);
  schedule.grids.insert(schedule.grids.end(), hooks.grids.begin(), hooks.grids.end());
  std::istringstream saved_schedule(schedule_);
  if (from_ != nullptr) schedule.resume = &saved_schedule;
  const RunResult result = run_schedule(simulation_, schedule);
  if (hooks.ended) hooks.ended({simulation_.time(), simulation_.totals(), result.loop_seconds, !result.measured});
  return result;
}

/// Returns the wall time of the whole run, all its parts together.
double Runner::wall_seconds() const {
  return (from_ != nullptr ? from_->facts().wall_seconds : 0.0) + seconds_since(options_.began);
}

/// A run that is stopped is always saved; others as the plan says, and then at their end too. One that went on from a checkpoint
/// leaves none in its directory that is older than its end.
bool Runner::is_due(const SavingMoment& moment) const {
  if (directory_ == nullptr) return false;
  if (moment.ended) return stopped_ || plan_ || from_ != nullptr;
  if (extended_ && !saved_) return true;  // another end is known from now on
  if (!plan_) return false;
  if (plan_->seconds) return seconds_since(last_saved_) >= *plan_->seconds;
  const std::uint64_t collisions = moment.progress.totals.pair;
  return collisions < saved_collisions_ || collisions - saved_collisions_ >= *plan_->collisions;
}

void Runner::save(const SavingMoment& moment, const RunnerHooks& hooks) {
  const CheckpointFacts facts{.provenance = provenance_,
                              .scene_source = scene_.source,
                              .scene_text = scene_.text,
                              .overrides = scene_.overrides,
                              .time = moment.progress.time,
                              .collisions = moment.progress.totals.pair,
                              .finished = moment.ended && !stopped_,
                              .wall_seconds = wall_seconds(),
                              .verify = options_.verify_every,
                              .checkpoint_every = options_.checkpoint_every.value_or(""),
                              .report = options_.report};
  // First, while no checkpoint takes the room: without all of its results no run is to go on.
  std::ostringstream files;
  writer_->save(files);
  std::vector<CheckpointPart> parts = {{"simulation", [&](std::ostream& out) { simulation_.save(out); }},
                                       {"schedule", moment.save},
                                       {"measurements",
                                        [&](std::ostream& out) {
                                          SavingArchive archive(out);
                                          archive(measurements_);
                                        }},
                                       {"observables", [&](std::ostream& out) { observation_->save(out); }},
                                       {"files", [&](std::ostream& out) { out << files.view(); }}};
  if (start_)
    parts.push_back({"start", [&](std::ostream& out) {
                       SavingArchive archive(out);
                       archive(*start_);
                     }});
  last_saved_ = Clock::now();
  saved_collisions_ = moment.progress.totals.pair;
  try {
    write_checkpoint(*directory_, facts, simulation_.state(), parts);
    saved_ = saved_last_ = true;
    told_unsaved_ = false;
  } catch (const OutputError& error) {  // the run may still come to its end
    saved_last_ = false;
    end_unsaved_ = moment.ended && !stopped_;
    const char* const what_follows = !moment.ended ? "the run goes on unsaved"
                                     : !stopped_   ? "the run is complete, and cannot be extended from here"
                                     : saved()     ? "the run can go on from where it was saved before, and not from here"
                                                   : "the run cannot go on later";
    if (hooks.warn && (moment.ended || !std::exchange(told_unsaved_, true)))
      hooks.warn(fmt::format("{}; {}", error.what(), what_follows));
  }
}

/// An older checkpoint would lead to the complete results once more, and replace them.
void Runner::remove_checkpoints() {
  std::error_code ignored;
  for (const std::string_view name : {checkpoint_name, previous_checkpoint_name})
    std::filesystem::remove(directory_->final_name(name), ignored);
  saved_ = false;
}

/// The files come last: what is wrong with anything else is found before they are cut back.
void Runner::read(const Checkpoint& from) {
  from.read("measurements", [&](std::istream& in) {
    LoadingArchive archive(in);
    archive(measurements_);
  });
  from.read("observables", [&](std::istream& in) { observation_.emplace(simulation_, in); });
  if (options_.observe) options_.observe(*observation_);
  observation_->require_all_added();
  if (provenance_.resolved_scene != from.facts().provenance.resolved_scene) provenance_.resolved_scene = scene_with_steps();
  from.read("schedule", [&](std::istream& in) { schedule_.assign(std::istreambuf_iterator<char>(in), {}); });
  if (from.has("start"))
    from.read("start", [&](std::istream& in) {
      LoadingArchive archive(in);
      archive(start_.emplace());
    });
  from.read("files", [&](std::istream& in) { writer_.emplace(*directory_, scene_, disks_of(scene_), provenance_, in); });
}

/// Observables keep the steps that followed from the end which the run began with; from another end others would follow.
std::string Runner::scene_with_steps() const {
  Scene scene = parse_scene(provenance_.resolved_scene, scene_.source);  // before its changes
  const std::vector<double> steps = observation_->steps();
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (steps[k] > 0.0) scene.observe[k].every = steps[k];
  return resolved_toml(scene);
}

/// Makes the page from the files of the finished run. A failure leaves them as they are.
void Runner::write_report(RunnerOutcome& outcome) const {
  constexpr const char* name = "report.html";
  try {
    PartialFile file(directory_->final_name(name));
    file.write(report_of(directory_->path(), options_.more_on_accuracy).html);
    file.publish();
    outcome.files.emplace_back(name);
  } catch (const std::exception& error) {
    outcome.report_failed = error.what();
  }
}

}  // namespace carom
