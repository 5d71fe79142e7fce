#pragma once
// A small system that is run with observables, and all that they saw, for twins to compute the same from.

#include <carom/observe.hpp>

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace carom::test {

/// What the run showed at the steps of an observable.
struct Record {
  std::vector<State> states;
  std::vector<Totals> totals;
  std::vector<Event> events;  ///< of the whole measured run
};

class Recorder final : public Observable {
 public:
  Recorder(double step, Record& record) : step_(step), record_(record) {}
  [[nodiscard]] std::string name() const override { return "recorder"; }
  [[nodiscard]] double step() const override { return step_; }
  void sample(const State& state, const Totals& totals) override {
    record_.states.push_back(state);
    record_.totals.push_back(totals);
  }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double step_;
  Record& record_;
};

struct Observed {
  Scene scene = {};
  Disks disks = {};
  Record record = {};
  std::vector<Measurement> measurements = {};
  double time = 0.0;
  Totals totals = {};

  [[nodiscard]] const Measurement& of(const std::string& name) const {
    for (const Measurement& measured : measurements)
      if (measured.name == name) return measured;
    throw std::logic_error("nothing is called " + name);
  }
  [[nodiscard]] const Scalar& scalar(const std::string& observable, const std::string& name) const {
    for (const Scalar& scalar : of(observable).scalars)
      if (scalar.name == name) return scalar;
    throw std::logic_error(observable + " has no " + name);
  }
  [[nodiscard]] double value(const std::string& observable, const std::string& name) const {
    return scalar(observable, name).value.value();
  }
  [[nodiscard]] const std::vector<double>& column(const std::string& observable, std::size_t table,
                                                  const std::string& name) const {
    for (const Column& column : of(observable).tables.at(table).columns)
      if (column.name == name) return column.values;
    throw std::logic_error(observable + " has no column " + name);
  }
};

/// Runs a scene to its end; `step` is that of the recorder.
inline Observed observe(const Scene& scene, double step) {
  Observed observed{.scene = scene};
  Simulation simulation = make_simulation(scene);
  observed.disks = simulation.disks();
  Observation observation(simulation);
  observation.add(std::make_unique<Recorder>(step, observed.record));
  RunHooks hooks;
  hooks.events = [&](std::span<const Event> events) {
    observed.record.events.insert(observed.record.events.end(), events.begin(), events.end());
  };
  observation.attach(hooks);
  run_schedule(simulation, hooks);
  observed.measurements = observation.results();
  observed.time = simulation.time();
  observed.totals = simulation.totals();
  return observed;
}

/// Forty disks of diameter 1 at packing fraction 0.4 in a periodic box, followed for about five collisions per disk.
inline std::string small_fluid(const std::string& observe, const std::string& rule = "specular",
                               const std::string& time = "5.0") {
  return "[box]\naspect = 1.0\nboundary = \"periodic\"\n[[disks]]\ncount = 40\nradius = 0.5\nmass = 1.5\npacking_fraction = 0.4\n"
         "positions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"" +
         rule + "\"\n[run]\ntime = " + time + "\n[observe]\n" + observe + "\n";
}

/// Two species between walls.
inline std::string small_mixture(const std::string& observe) {
  return "[box]\nx = [0.0, 9.0]\ny = [0.0, 7.0]\nboundary = \"walls\"\n[[disks]]\nname = \"big\"\ncount = 12\nradius = 0.5\nmass "
         "= "
         "2.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[[disks]]\nname = \"small\"\ncount = 20\nradius = "
         "0.3\nmass = "
         "0.5\npositions = \"random\"\nvelocities = { temperature = 2.0 }\n[collision]\nrule = \"specular\"\n[run]\ntime = 6.0\n"
         "[observe]\n" +
         observe + "\n";
}

}  // namespace carom::test
