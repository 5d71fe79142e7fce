// A running simulation, as Python sees it. Calls that take long leave the interpreter's lock to others, and look at signals some
// twenty times a second.

#include "python/buffers.hpp"
#include "python/given_state.hpp"
#include "python/parts.hpp"
#include "scene/listed_disks.hpp"
#include "scene/resolved_effects.hpp"
#include "scene/walls.hpp"
#include "simulation/sampling_times.hpp"
#include "simulation/saved_simulation.hpp"

#include <carom/simulation.hpp>

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::python {

namespace {

template <class Value, class... Shape>
using Room = nb::ndarray<Value, nb::c_contig, nb::device::cpu, Shape...>;

/// time, remainder, disk, partner, velocity, velocity of the partner
using EventTuple = std::tuple<double, double, std::int32_t, std::int32_t, std::tuple<double, double>, std::tuple<double, double>>;

EventTuple tuple_of(const Event& event) {
  return {event.time,
          event.time_remainder,
          event.disk,
          event.partner,
          {event.velocity.x(), event.velocity.y()},
          {event.partner_velocity.x(), event.partner_velocity.y()}};
}

/// Where the samples of a run go: memory of numpy's, one entry or row per frame. What is absent is not written.
struct FrameRoom {
  Room<double, nb::ndim<1>> time;
  std::optional<Room<double, nb::shape<-1, -1, 2>>> positions, velocities;
  std::optional<Room<std::int64_t, nb::shape<-1, -1, 2>>> images;
  std::optional<Room<double, nb::shape<-1, -1>>> spins;
  Room<double, nb::shape<-1, 4, 2>> walls;  ///< positions and velocities; not a number where none moves
  Room<double, nb::ndim<1>> scale, shear_displacement, virial;
  Room<std::uint64_t, nb::ndim<1>> collisions;
  Room<std::int64_t, nb::ndim<1>> written;  ///< one number: frames so far

  /// Writes a frame. `grown` is the factor by which changes have made the radii larger since those that the scale is of;
  /// `settled` are walls where changes have stopped the last one that moved, else empty.
  void write(const State& state, const Totals& totals, double grown, const std::vector<WallState>& settled) const {
    const auto frame = static_cast<std::size_t>(written.data()[0]);
    const auto copy = [&](const auto& matrix, const auto& room) {
      if (room) std::copy_n(matrix.data(), matrix.size(), room->data() + frame * static_cast<std::size_t>(matrix.size()));
    };
    time.data()[frame] = state.time;
    scale.data()[frame] = state.scale * grown;
    shear_displacement.data()[frame] = state.shear_displacement;
    write_walls(settled.empty() ? state.walls : settled, walls.data() + frame * numbers_of_walls);
    virial.data()[frame] = totals.virial;
    collisions.data()[frame] = totals.pair;
    copy(state.positions, positions);
    copy(state.velocities, velocities);
    copy(state.images, images);
    if (spins && state.spins.size() == 0)  // a change has made the disks smooth, or will make them rough
      std::fill_n(spins->data() + frame * spins->shape(1), spins->shape(1), 0.0);
    else
      copy(state.spins, spins);
    ++written.data()[0];
  }
};

/// A simulation that belongs to one caller at a time: a second one is refused in place of a race.
class Running {
 public:
  Running(const Scene& scene, const std::string& engine, const std::optional<FixedStep>& step, const State* start)
      : simulation_(made(scene, engine, step, start)) {}
  explicit Running(Simulation simulation) : simulation_(std::move(simulation)) {}

  /// Calls `action` with the simulation, while nobody else has it.
  template <class Action>
  auto use(Action&& action) {
    if (busy_.exchange(true))
      throw std::runtime_error(
          "this simulation is running: ask it when the call that runs it has returned, or make one of its own for each thread");
    struct Release {
      std::atomic<bool>& busy;
      ~Release() { busy = false; }
    } release{busy_};
    return action(simulation_);
  }

  /// Does so without the interpreter's lock.
  template <class Action>
  auto use_alone(Action&& action) {
    return use([&](Simulation& simulation) {
      const nb::gil_scoped_release released;
      return action(simulation);
    });
  }

 private:
  static Simulation made(const Scene& scene, const std::string& engine, const std::optional<FixedStep>& step,
                         const State* start) {
    const nb::gil_scoped_release released;
    if (start != nullptr) require_apart(scene, *start);
    const auto placing = [](double) { look_at_python(); };
    if (step) return start != nullptr ? make_simulation(scene, *start, *step) : make_simulation(scene, *step, placing);
    return start != nullptr ? make_simulation(scene, *start, engine) : make_simulation(scene, engine, placing);
  }

  Simulation simulation_;
  std::atomic<bool> busy_ = false;
};

/// Limits that look at signals, and tell `report` the time.
RunLimits limits_of(std::optional<std::uint64_t> collisions, const nb::object& report, const Simulation& simulation) {
  RunLimits limits;
  limits.collisions = collisions.value_or(RunLimits::none);
  limits.proceed = [&report, &simulation] {
    look_at_python([&] {
      if (!report.is_none()) report(simulation.time());
    });
    return true;
  };
  return limits;
}

/// Appends all collisions to `events` as long as it lives.
class EventRecorder {
 public:
  EventRecorder(Simulation& simulation, std::vector<Event>& events) : simulation_(simulation), events_(events) {
    simulation_.record_events(true);
  }
  EventRecorder(const EventRecorder&) = delete;
  EventRecorder& operator=(const EventRecorder&) = delete;
  ~EventRecorder() {
    simulation_.take_events(events_);
    simulation_.record_events(false);
  }

 private:
  Simulation& simulation_;
  std::vector<Event>& events_;
};

/// What a player needs of a run: states now and then, and all collisions where they are known and not too many.
struct PlayerRecording {
  std::vector<State> samples;
  std::vector<Event> events;
  bool has_log = false;

  StopReason record(Simulation& simulation, double until, double step, std::uint64_t most_events, RunLimits limits) {
    const SamplingGrid grid{.step = step, .sample = [this](std::uint64_t, const State& state, const Totals&) { keep(state); }};
    keep(simulation.state());
    StopReason stopped = StopReason::events;
    if (!simulation.time_step()) {
      limits.events = simulation.counts().events() + most_events;
      const EventRecorder recorder(simulation, events);
      stopped = simulation.run_sampled(until, grid, limits);
    }
    has_log = stopped != StopReason::events;
    if (!has_log) {
      events = {};
      limits.events = RunLimits::none;
      stopped = simulation.run_sampled(until, grid, limits);
    }
    keep(simulation.state());
    return stopped;
  }

 private:
  void keep(const State& state) {
    if (!samples.empty() && !(state.time > samples.back().time)) return;
    State& kept = samples.emplace_back(state);
    kept.images.resize(2, 0);  // a player does not look at these
    kept.remainders.resize(2, 0);
  }
};

/// The scene as it is now: its text is not that which was read. Where disks have grown, or walls have come nearer, so far that
/// the scene's start has no room for them, it lists the disks as they are now; where walls would close the box before its end,
/// the end is the start.
Scene scene_now(const Simulation& simulation) {
  Scene scene = simulation.scene();
  try {
    check(scene);
  } catch (const SceneError&) {
    list_disks(scene, simulation.state());
    try {
      check(scene);
    } catch (const SceneError&) {
      if (scene.run.time) scene.run.time = 0.0;
    }
  }
  scene.text = resolved_toml(scene);
  scene.overrides.clear();
  return scene;
}

nb::typed<nb::dict, nb::str, nb::any> dict_of(const Totals& totals) {
  const auto pair = [](const Eigen::Vector2d& v) { return std::tuple(v.x(), v.y()); };
  nb::typed<nb::dict, nb::str, nb::any> d;
  d["pair"] = totals.pair;
  d["wall"] = totals.wall;
  d["obstacle"] = totals.obstacle;
  d["well"] = totals.well;
  d["thermostat"] = totals.thermostat;
  d["other"] = totals.other;
  d["stale"] = totals.stale;
  d["virial"] = totals.virial;
  d["virial_yx"] = totals.virial_yx;
  d["wall_impulse"] = std::vector<double>(totals.wall_impulse.begin(), totals.wall_impulse.end());
  d["wall_shear"] = std::vector<double>(totals.wall_shear.begin(), totals.wall_shear.end());
  d["wall_energy"] = std::vector<double>(totals.wall_energy.begin(), totals.wall_energy.end());
  d["wall_work"] = std::vector<double>(totals.wall_work.begin(), totals.wall_work.end());
  d["obstacle_impulse"] = pair(totals.obstacle_impulse);
  d["circle_impulse"] = totals.circle_impulse;
  d["dissipated"] = totals.dissipated;
  d["thermostat_energy"] = totals.thermostat_energy;
  d["growth_energy"] = totals.growth_energy;
  d["shear_energy"] = totals.shear_energy;
  return d;
}

nb::typed<nb::dict, nb::str, int> dict_of(const ThreadCounts& counts) {
  nb::typed<nb::dict, nb::str, int> d;
  d["threads"] = counts.threads;
  d["ranks"] = counts.ranks;
  d["domains"] = counts.domains;
  d["windows"] = counts.windows;
  d["windows_redone"] = counts.windows_redone;
  d["shared_out"] = counts.shared_out;
  d["events"] = counts.events;
  d["events_alone"] = counts.events_alone;
  d["copied_events"] = counts.copied_events;
  d["copies"] = counts.copies;
  d["copies_wrong"] = counts.copies_wrong;
  return d;
}

/// The two disks of a collision, for a rule in Python, which changes the velocities.
void add_colliding_pair(nb::module_& module) {
  const auto get = [](Eigen::Vector2d CollidingPair::*member) {
    return [member](const CollidingPair& pair) { return std::tuple((pair.*member).x(), (pair.*member).y()); };
  };
  const auto set = [](Eigen::Vector2d CollidingPair::*member) {
    return [member](CollidingPair& pair, const nb::object& value) {
      std::tuple<double, double> v;
      if (!nb::try_cast(value, v)) {
        const nb::str shown = nb::repr(value);
        const char* const text = shown.c_str();  // null where it is no Unicode
        if (text == nullptr) PyErr_Clear();
        const std::string sentence =
            std::string("a velocity is ") + (text == nullptr ? "no pair of numbers" : text) + "; give two numbers, (vx, vy)";
        throw nb::type_error(sentence.c_str());
      }
      pair.*member = {std::get<0>(v), std::get<1>(v)};
    };
  };
  nb::class_<CollidingPair>(module, "CollidingPair",
                            "Two disks in contact, as a collision rule of one's own gets them. The rule sets velocity and "
                            "partner_velocity, with which they part; all else is read only.")
      .def_ro("disk", &CollidingPair::disk, "The number of the one disk.")
      .def_ro("partner", &CollidingPair::partner, "The number of the other disk.")
      .def_ro("mass", &CollidingPair::mass)
      .def_ro("partner_mass", &CollidingPair::partner_mass)
      .def_ro("radius", &CollidingPair::radius, "Length, now: disks may grow.")
      .def_ro("partner_radius", &CollidingPair::partner_radius, "Length, now.")
      .def_prop_ro("normal", get(&CollidingPair::normal), "The unit vector (x, y) from the partner to the disk.")
      .def_prop_rw("velocity", get(&CollidingPair::velocity), set(&CollidingPair::velocity),
                   nb::for_setter(nb::arg("value").none()), "The velocity (vx, vy) of the disk, length / time.")
      .def_prop_rw("partner_velocity", get(&CollidingPair::partner_velocity), set(&CollidingPair::partner_velocity),
                   nb::for_setter(nb::arg("value").none()), "The velocity (vx, vy) of the partner, length / time.");
}

/// A collision rule that calls a function of Python, which the caller keeps alive: the rule itself would hide it from the
/// collector of garbage. The function gets a copy of the pair, which it may keep.
CollisionFunction rule_of(const nb::object& function) {
  if (function.is_none()) return {};
  // The reference is copied and destroyed by threads that need not hold the lock.
  const std::shared_ptr<nb::weakref> held(new nb::weakref(function), [](nb::weakref* reference) {
    const nb::gil_scoped_acquire locked;
    delete reference;
  });
  return [held](CollidingPair& pair) {
    const nb::gil_scoped_acquire locked;
    const nb::object copy = nb::cast(pair, nb::rv_policy::copy);
    (*held)()(copy);
    const auto& changed = nb::cast<const CollidingPair&>(copy);
    pair.velocity = changed.velocity;
    pair.partner_velocity = changed.partner_velocity;
  };
}

/// Adds how a simulation is made, saved and restored.
void add_making_and_saving(nb::class_<Running>& simulation) {
  simulation
      .def(
          "__init__",
          [](Running* self, const Scene& scene, const std::string& engine, const std::optional<std::string>& method, double dt,
             std::optional<double> stiffness, const State* state) {
            std::optional<FixedStep> step;
            if (method) step = FixedStep{*method, dt, stiffness};
            new (self) Running(scene, engine, step, state);
          },
          nb::arg("scene"), nb::arg("engine"), nb::arg("method").none(), nb::arg("dt"), nb::arg("stiffness").none(),
          nb::arg("state").none())
      .def_static(
          "restore",
          [](const Scene& scene, const nb::bytes& saved) {
            std::istringstream in(std::string(saved.c_str(), saved.size()));
            const nb::gil_scoped_release released;
            return new Running(restore_simulation(scene, in));
          },
          nb::arg("scene"), nb::arg("saved"), nb::rv_policy::take_ownership)
      .def_static(
          "check_saved",
          [](const nb::bytes& saved) {
            std::istringstream in(std::string(saved.c_str(), saved.size()));
            detail::check_saved_head(in);
          },
          nb::arg("saved"), "Raises RuntimeError where it was not saved by this build.")
      .def("save", [](Running& self) {
        std::ostringstream out;
        self.use_alone([&](Simulation& s) { s.save(out); });
        const std::string bytes = out.str();
        return nb::bytes(bytes.data(), bytes.size());
      });
}

/// Adds what a simulation knows of itself.
void add_facts(nb::class_<Running>& simulation) {
  simulation.def_prop_ro("time", [](Running& self) { return self.use([](Simulation& s) { return s.time(); }); })
      .def_prop_ro("collisions", [](Running& self) { return self.use([](Simulation& s) { return s.counts().pair; }); })
      .def_prop_ro("engine", [](Running& self) { return self.use([](Simulation& s) { return s.engine(); }); })
      .def_prop_ro("changes_to_come",
                   [](Running& self) { return self.use([](Simulation& s) { return s.scene().changes.size(); }); })
      .def_prop_ro("engine_reason", [](Running& self) { return self.use([](Simulation& s) { return s.engine_reason(); }); })
      .def_prop_ro("time_step", [](Running& self) { return self.use([](Simulation& s) { return s.time_step(); }); })
      .def_prop_ro("stiffness", [](Running& self) { return self.use([](Simulation& s) { return s.stiffness(); }); })
      .def_prop_ro("bytes", [](Running& self) { return self.use([](Simulation& s) { return s.bytes(); }); })
      .def_prop_ro("scene", [](Running& self) { return self.use([](Simulation& s) { return scene_now(s); }); })
      .def_prop_ro("totals", [](Running& self) { return self.use([](Simulation& s) { return dict_of(s.totals()); }); })
      .def("disks", [](Running& self) { return arrays_of(self.use([](Simulation& s) { return s.disks(); })); })
      .def("state", [](Running& self) { return self.use_alone([](Simulation& s) { return s.state(); }); })
      .def_prop_ro("has_collision_rule",
                   [](Running& self) { return self.use([](Simulation& s) { return s.has_collision_rule(); }); })
      .def_prop_ro("threads", [](Running& self) { return self.use([](Simulation& s) { return s.threads(); }); })
      .def_prop_ro("thread_counts",
                   [](Running& self) { return dict_of(self.use([](Simulation& s) { return s.thread_counts(); })); })
      .def("check_invariants", [](Running& self) { return self.use_alone([](Simulation& s) { return s.check_invariants(); }); });
}

/// Adds how it goes on, and what it hands out on the way.
void add_running(nb::class_<Running>& simulation) {
  simulation
      .def(
          "run_until",
          [](Running& self, double time, std::optional<std::uint64_t> collisions, const nb::object& report) {
            return to_string(self.use_alone([&](Simulation& s) { return s.run_until(time, limits_of(collisions, report, s)); }));
          },
          nb::arg("time"), nb::arg("collisions").none() = nb::none(), nb::arg("report").none() = nb::none())
      .def(
          "sample_range",
          [](Running& self, double until, double step, std::uint64_t first, std::uint64_t stride) {
            const detail::SamplingTimes times(step);
            const double now = self.use([](Simulation& s) { return s.time(); });
            if (until < 0.0) return std::tuple(first, std::uint64_t{0});
            const std::uint64_t begin = times.next({now, 0.0}, {.first = first, .stride = stride}), last = times.last(until);
            return std::tuple(begin, last < begin ? std::uint64_t{0} : (last - begin) / stride + 1);
          },
          nb::arg("until"), nb::arg("step"), nb::arg("first"), nb::arg("stride"),
          "Returns the number of the next sample, and how many there are until then.")
      .def(
          "run_sampled",
          [](Running& self, double until, double step, std::uint64_t first, std::uint64_t stride, std::uint64_t most,
             const Room<double, nb::ndim<1>>& time, const std::optional<Room<double, nb::shape<-1, -1, 2>>>& positions,
             const std::optional<Room<double, nb::shape<-1, -1, 2>>>& velocities,
             const std::optional<Room<std::int64_t, nb::shape<-1, -1, 2>>>& images,
             const std::optional<Room<double, nb::shape<-1, -1>>>& spins, const Room<double, nb::shape<-1, 4, 2>>& walls,
             const Room<double, nb::ndim<1>>& scale, const Room<double, nb::ndim<1>>& shear_displacement,
             const Room<double, nb::ndim<1>>& virial, const Room<std::uint64_t, nb::ndim<1>>& collisions,
             const Room<std::int64_t, nb::ndim<1>>& written, std::optional<double> first_radius,
             const std::array<double, 4>& first_box, const nb::object& report) {
            const FrameRoom room{time,  positions,          velocities, images,     spins,  walls,
                                 scale, shear_displacement, virial,     collisions, written};
            const bool whole = positions || images || spins;
            return to_string(self.use_alone([&](Simulation& s) {
              const auto write = [&](std::uint64_t, const State& state, const Totals& totals) {
                const Box& now = s.scene().box;
                const Box before{{first_box[0], first_box[2]}, {first_box[1], first_box[3]}, now.boundary};
                room.write(state, totals, first_radius ? s.disks().radius.front() / *first_radius : 1.0,
                           have_settled(state, before, now) ? walls_at_rest(now) : std::vector<WallState>());
              };
              const SamplingGrid grid{.step = step, .sample = write, .velocities_alone = !whole};
              return s.run_sampled(until, grid, limits_of({}, report, s), {.first = first, .stride = stride, .most = most});
            }));
          },
          nb::arg("until"), nb::arg("step"), nb::arg("first"), nb::arg("stride"), nb::arg("most"), nb::arg("time"),
          nb::arg("positions").none(), nb::arg("velocities").none(), nb::arg("images").none(), nb::arg("spins").none(),
          nb::arg("walls"), nb::arg("scale"), nb::arg("shear_displacement"), nb::arg("virial"), nb::arg("collisions"),
          nb::arg("written"), nb::arg("first_radius").none(), nb::arg("first_box"), nb::arg("report").none())
      .def(
          "step",
          [](Running& self, double until) -> std::optional<EventTuple> {
            const std::optional<Event> event = self.use([&](Simulation& s) { return s.step(until); });
            return event ? std::optional(tuple_of(*event)) : std::nullopt;
          },
          nb::arg("until") = std::numeric_limits<double>::infinity())
      .def(
          "record",
          [](Running& self, double until, const nb::object& report) {
            std::vector<Event> events;
            StopReason reason = StopReason::interrupted;
            nb::object raised = nb::none();
            try {
              reason = self.use_alone([&](Simulation& s) {
                const EventRecorder recorder(s, events);
                return s.run_until(until, limits_of({}, report, s));
              });
            } catch (const nb::python_error& error) {
              raised = nb::borrow(error.value());
            }
            // So that bytes of equal logs are equal. No member lies there: src/python/state.cpp.
            for (Event& event : events) std::memset(reinterpret_cast<char*>(&event) + 24, 0, 8);
            const std::size_t bytes = events.size() * sizeof(Event);
            return std::tuple(array_that_owns<std::uint8_t>(std::move(events), {bytes}), to_string(reason), raised);
          },
          nb::arg("until"), nb::arg("report").none() = nb::none(),
          "Returns all collisions until then, the reason, and what Python has raised meanwhile, or None.")
      .def(
          "record_for_player",
          [](Running& self, double until, double step, std::uint64_t most_events, const nb::object& report) {
            PlayerRecording recording;
            const StopReason reason = self.use_alone(
                [&](Simulation& s) { return recording.record(s, until, step, most_events, limits_of({}, report, s)); });
            std::optional<Array<std::uint8_t>> log;
            const std::size_t bytes = recording.events.size() * sizeof(Event);
            if (recording.has_log) log = array_that_owns<std::uint8_t>(std::move(recording.events), {bytes});
            return std::tuple(std::move(recording.samples), std::move(log), to_string(reason));
          },
          nb::arg("until"), nb::arg("step"), nb::arg("most_events"), nb::arg("report").none() = nb::none(),
          "Returns states from now to until, all collisions, or None where they are more than that or not known, and the "
          "reason.");
}

/// Adds what a program changes in it.
void add_changing(nb::class_<Running>& simulation) {
  simulation
      .def(
          "set_effects",
          [](Running& self, const std::string& toml) {
            const Effects effects = detail::parse_effects(toml);
            self.use_alone([&](Simulation& s) { s.set_effects(effects); });
          },
          nb::arg("toml"))
      .def(
          "set_velocities",
          [](Running& self, const Pairs& velocities, const std::optional<Numbers>& spins) {
            const auto columns = static_cast<Eigen::Index>(velocities.shape(0));
            const Eigen::Matrix2Xd matrix = Eigen::Map<const Eigen::Matrix2Xd>(velocities.data(), 2, columns);
            Eigen::VectorXd turning;
            if (spins) turning = Eigen::Map<const Eigen::VectorXd>(spins->data(), static_cast<Eigen::Index>(spins->shape(0)));
            self.use_alone([&](Simulation& s) { s.set_velocities(matrix, turning); });
          },
          nb::arg("velocities"), nb::arg("spins").none() = nb::none())
      .def(
          "set_collision_rule",
          [](Running& self, const nb::object& rule) {
            CollisionFunction function = rule_of(rule);
            self.use_alone([&](Simulation& s) { s.set_collision_rule(std::move(function)); });
          },
          nb::arg("rule").none())
      .def(
          "set_threads",
          [](Running& self, std::size_t threads) { self.use_alone([&](Simulation& s) { s.set_threads({.threads = threads}); }); },
          nb::arg("threads"))
      .def("reset_clock", [](Running& self) { self.use([](Simulation& s) { s.reset_clock(); }); });
}

}  // namespace

void add_simulation(nb::module_& module) {
  add_colliding_pair(module);
  nb::class_<Running> simulation(module, "Simulation");
  add_making_and_saving(simulation);
  add_facts(simulation);
  add_running(simulation);
  add_changing(simulation);
}

}  // namespace carom::python
