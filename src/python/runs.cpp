// Runs of a scene's whole schedule, with files and without.

#include "io/run_directory.hpp"
#include "io/summary.hpp"
#include "python/buffers.hpp"
#include "python/observables.hpp"
#include "python/parts.hpp"
#include "python/sampled_states.hpp"
#include "runner/expected_memory.hpp"
#include "runner/resumed_run.hpp"
#include "runner/run_threads.hpp"
#include "runner/runner.hpp"
#include "simulation/start.hpp"
#include "terminal/run_estimate.hpp"
#include "text/numbers.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <chrono>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carom::python {

namespace {

using Objects = nb::typed<nb::list, nb::any>;

/// What a run is asked for besides its scene.
struct RunWishes {
  Objects observables;                          ///< carom.Observable
  std::optional<std::string> checkpoint_every;  ///< as saving_plan() reads it
  std::optional<double> walltime;               ///< seconds
  std::optional<int> threads;
  bool report = false;
  bool frames = false;
  std::uint64_t verify_every = 0;  ///< events from one check of the invariants to the next; 0: no checks
  nb::object progress;             ///< told the fraction done; False from it stops the run; None
};

/// Tells `report` which fraction of a run is done; returns whether it did not answer False. Requires the interpreter's lock.
bool may_go_on(const nb::object& report, double fraction) {
  return report.is_none() || !report(fraction).is(nb::handle(Py_False));
}

[[noreturn]] void throw_interrupt() {
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw nb::python_error();
}

class PythonRun {
 public:
  /// `scene` has the end that the run is to reach.
  PythonRun(Simulation& simulation, const Scene& scene, const RunDirectory* directory, Provenance provenance,
            const RunWishes& wishes, const Checkpoint* from = nullptr)
      : simulation_(simulation),
        scene_(scene),
        wishes_(wishes),
        runner_(simulation, directory, std::move(provenance),
                {.checkpoint_every = wishes.checkpoint_every,
                 .verify_every = wishes.verify_every,
                 .threads = wishes.threads,
                 .report = wishes.report,
                 .observe = wishes.observables.begin() == wishes.observables.end()
                                ? std::function<void(Observation&)>()
                                : [&](Observation& observation) { observe(observation); },
                 .began = began_},
                from) {}

  AnyTuple operator()() {
    RunnerHooks hooks;
    hooks.proceed = [this](const Progress& progress) { return may_go_on(progress); };
    hooks.warn = [this](const std::string& sentence) { warnings_.push_back(sentence); };
    if (wishes_.frames) hooks.sample = [this](const State& state, const Totals& totals) { sampled_.add(state, totals); };
    RunnerOutcome outcome = [&] {
      const nb::gil_scoped_release released;
      try {
        return runner_.run(hooks);
      } catch (const std::exception& error) {
        if (!raised_) throw;
        raise_kept(error.what());
      }
    }();
    if (raised_) raise_kept(warnings_.empty() ? "" : warnings_.back());
    if (outcome.report_failed) warnings_.push_back(*outcome.report_failed);
    const std::size_t disks = simulation_.disks().count();
    const nb::object frames = wishes_.frames ? nb::object(std::move(sampled_).arrays(disks)) : nb::none();
    return nb::borrow<AnyTuple>(nb::make_tuple(summary_json(outcome.report, runner_.provenance()),
                                               tuples_of(outcome.report.observables), outcome.report.stopped_disks, outcome.files,
                                               frames, runner_.state(), interrupted_, runner_.saved_now(), warnings_,
                                               arrays_of(disks_of(simulation_.whole_scene()))));
  }

 private:
  void observe(Observation& observation) {
    const nb::gil_scoped_acquire locked;
    for (const nb::handle object : wishes_.observables)
      observation.add(
          observable_of(nb::borrow<nb::object>(object), [this](std::exception_ptr error) { keep(std::move(error)); }));
  }

  /// Keeps the first exception of Python until the files of the run are complete.
  void keep(std::exception_ptr error) {
    if (!raised_) raised_ = std::move(error);
  }

  /// Raises that exception, with a note on what failed besides.
  [[noreturn]] void raise_kept(const std::string& besides) const {
    const nb::gil_scoped_acquire locked;
    try {
      std::rethrow_exception(raised_);
    } catch (const nb::python_error& error) {
      const nb::handle value = error.value();
      if (!besides.empty() && nb::hasattr(value, "add_note")) value.attr("add_note")("besides: " + besides);
      throw;
    }
  }

  /// Ctrl-C stops the run, and so does `progress` that returns False. So does what else a signal or `progress` raises.
  bool may_go_on(const Progress& progress) {
    const nb::gil_scoped_acquire locked;
    try {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      const double done = progress.equilibrating ? 0.0 : cli::fraction_done(scene_, progress);
      if (!python::may_go_on(wishes_.progress, done)) interrupted_ = true;
    } catch (nb::python_error& error) {
      if (!error.matches(PyExc_KeyboardInterrupt)) keep(std::current_exception());
      interrupted_ = true;
    }
    interrupted_ = interrupted_ || raised_;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - began_;
    return !interrupted_ && (!wishes_.walltime || passed.count() < *wishes_.walltime);
  }

  Simulation& simulation_;
  const Scene& scene_;
  const RunWishes& wishes_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  Runner runner_;
  SampledStates sampled_;
  bool interrupted_ = false;
  std::exception_ptr raised_;
  std::vector<std::string> warnings_;
};

/// Has a run go on several cores. Throws std::invalid_argument with the name of the argument.
void take_threads(Simulation& simulation, const std::optional<int>& threads) {
  try {
    set_threads_of_run(simulation, threads);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("threads=" + std::to_string(threads.value_or(1)) + ": " + error.what());
  }
}

/// Throws std::invalid_argument with the name of the argument where it is no such plan.
void require_saving_plan(const std::optional<std::string>& text) {
  try {
    if (text) (void)saving_plan(*text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("checkpoint_every=\"" + *text + "\": " + error.what());
  }
}

AnyTuple run(const Scene& scene, const std::string& engine, const std::optional<std::string>& method, double dt,
             std::optional<double> stiffness, const std::optional<std::string>& path, bool overwrite, const RunWishes& wishes) {
  if (path) RunDirectory::require_free(*path, overwrite);  // to place disks may take minutes
  require_saving_plan(wishes.checkpoint_every);
  if (const auto refusal = too_little_memory(scene)) {  // the system would end Python
    PyErr_SetString(PyExc_MemoryError, refusal->c_str());
    throw nb::python_error();
  }
  Simulation simulation = [&] {
    const nb::gil_scoped_release released;
    const auto placing = [&](double) {
      look_at_python([&] {
        if (!may_go_on(wishes.progress, 0.0)) throw_interrupt();
      });
    };
    Simulation made =
        method ? make_simulation(scene, FixedStep{*method, dt, stiffness}, placing) : make_simulation(scene, engine, placing);
    take_threads(made, wishes.threads);
    return made;
  }();
  std::optional<RunDirectory> directory;
  if (path) directory.emplace(*path, overwrite);
  const Provenance provenance{.resolved_scene = resolved_toml(scene),
                              .command_line = {},
                              .engine = simulation.engine(),
                              .time_step = simulation.time_step(),
                              .stiffness = simulation.stiffness()};
  try {
    return PythonRun(simulation, scene, directory ? &*directory : nullptr, provenance, wishes)();
  } catch (...) {
    if (directory) directory->discard_if_empty();
    throw;
  }
}

AnyTuple resume(const std::string& path, std::optional<double> time, std::optional<std::uint64_t> collisions,
                const RunWishes& wishes) {
  require_saving_plan(wishes.checkpoint_every);
  const LaterEnd end{time, collisions};
  const ResumedRun resumed(path, end);
  if (resumed.complete() && !end.given())
    throw std::invalid_argument(path + ": this run has come to its end; give a later one, time=... or collisions=...");
  resumed.check_end(end);
  Simulation simulation = [&] {
    const nb::gil_scoped_release released;
    Simulation saved = resumed.simulation();
    take_threads(saved, wishes.threads);
    return saved;
  }();
  RunWishes with_its_own = wishes;
  const CheckpointFacts& facts = resumed.from.facts();
  with_its_own.report = wishes.report || facts.report;
  with_its_own.verify_every = facts.verify;
  if (!wishes.checkpoint_every && !facts.checkpoint_every.empty()) with_its_own.checkpoint_every = facts.checkpoint_every;
  return PythonRun(simulation, resumed.scene, &resumed.directory, resumed.provenance(), with_its_own, &resumed.from)();
}

}  // namespace

void add_runs(nb::module_& module) {
  module.def(
      "run",
      [](const Scene& scene, const std::string& engine, const std::optional<std::string>& method, double dt,
         std::optional<double> stiffness, const std::optional<std::string>& directory, bool overwrite, const Objects& observables,
         const std::optional<std::string>& checkpoint_every, std::optional<double> walltime, std::optional<int> threads,
         bool report, bool frames, const nb::object& progress) {
        return run(scene, engine, method, dt, stiffness, directory, overwrite,
                   {observables, checkpoint_every, walltime, threads, report, frames, 0, progress});
      },
      nb::arg("scene"), nb::arg("engine"), nb::arg("method").none(), nb::arg("dt"), nb::arg("stiffness").none(),
      nb::arg("directory").none(), nb::arg("overwrite"), nb::arg("observables"), nb::arg("checkpoint_every").none(),
      nb::arg("walltime").none(), nb::arg("threads").none(), nb::arg("report"), nb::arg("frames"), nb::arg("progress").none());
  module.def(
      "resume",
      [](const std::string& directory, std::optional<double> time, std::optional<std::uint64_t> collisions,
         const Objects& observables, const std::optional<std::string>& checkpoint_every, std::optional<double> walltime,
         std::optional<int> threads, bool report, const nb::object& progress) {
        return resume(directory, time, collisions,
                      {observables, checkpoint_every, walltime, threads, report, false, 0, progress});
      },
      nb::arg("directory"), nb::arg("time").none(), nb::arg("collisions").none(), nb::arg("observables"),
      nb::arg("checkpoint_every").none(), nb::arg("walltime").none(), nb::arg("threads").none(), nb::arg("report"),
      nb::arg("progress").none());
}

}  // namespace carom::python
