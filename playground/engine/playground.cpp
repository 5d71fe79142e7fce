// The engine's face to the page: functions of C that the Worker calls (worker.js). Texts go in and out as UTF-8, answers as JSON,
// numbers of many disks as arrays in memory. Nothing throws: what is wrong comes back as {"error": "a sentence"}.

#include "description.hpp"
#include "json.hpp"
#include "observe/energy.hpp"
#include "observe/mechanics.hpp"
#include "session.hpp"

#include <emscripten.h>
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace carom;
using namespace carom::playground;

constexpr std::int64_t most_disks = 100'000;

std::unique_ptr<Session> session;
std::string answer;  // the last one, which the page reads
State shown;
std::vector<double> disks_of_page;
std::array<double, 40> numbers{};

Session& here() {
  if (!session) throw std::runtime_error("no scene is loaded; load one first");
  return *session;
}

const char* say(std::string json) {
  answer = std::move(json);
  return answer.c_str();
}

template <class Work>
const char* answered(Work&& work) {
  try {
    return say(work());
  } catch (const std::bad_alloc&) {
    return say("{\"error\":\"there is not enough memory for this scene; fewer disks need less\"}");
  } catch (const std::exception& error) {
    return say(fmt::format("{{\"error\":{}}}", json_text(error.what())));
  }
}

/// Returns the lines of a text that are not empty.
std::vector<std::string> lines_of(const char* text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

/// Lists x, y, vx and vy of all disks, one after the other.
void list_places_and_velocities(const State& state, std::vector<double>& list) {
  list.clear();
  for (const Eigen::Matrix2Xd* of : {&state.positions, &state.velocities})
    for (int axis = 0; axis < 2; ++axis)
      for (Eigen::Index i = 0; i < of->cols(); ++i) list.push_back((*of)(axis, i));
}

}  // namespace

extern "C" {

/// Loads a scene; the changes of the last text are made at their times. Keeps the session that is there where either is refused.
EMSCRIPTEN_KEEPALIVE const char* carom_load(const char* toml, const char* source, const char* overrides, const char* changes) {
  return answered([&] {
    const Scene scene = parse_scene(toml, source, lines_of(overrides));
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

/// Runs to `until` for at most `budget` milliseconds. Returns Session::Advance, or 3 where carom_answer() says what is wrong.
EMSCRIPTEN_KEEPALIVE int carom_advance(double until, double budget) {
  try {
    return static_cast<int>(here().advance(until, budget));
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
  list_places_and_velocities(shown, disks_of_page);
  const Simulation& simulation = run.simulation();
  const Scene& scene = simulation.scene();
  const Energies energies = energies_of(scene.box, scene.effects, simulation.disks(), shown, run.first_scene().box);
  const Box box = box_of(scene.box, shown);
  const Totals totals = simulation.totals();
  numbers = {shown.time,
             static_cast<double>(shown.positions.cols()),
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
    if (*method == '\0')
      here().end_twin();
    else
      here().begin_twin(method, dt);
    return std::string("{}");
  });
}
EMSCRIPTEN_KEEPALIVE void carom_advance_twin(double budget) {
  if (auto& twin = here().twin()) twin->follow(here().run(), budget);
}
/// Writes the twin's x, y, vx, vy; null where there is none.
EMSCRIPTEN_KEEPALIVE const double* carom_twin_state() {
  static std::vector<double> list;
  const auto& twin = here().twin();
  if (!twin) return nullptr;
  list_places_and_velocities(twin->state(), list);
  return list.data();
}
/// What went wrong in the twin so far, as JSON.
EMSCRIPTEN_KEEPALIVE const char* carom_twin_numbers() {
  return answered([] {
    auto& twin = here().twin();
    return twin ? twin->json() : std::string("{}");
  });
}
EMSCRIPTEN_KEEPALIVE const std::uint8_t* carom_twin_overlapping() {
  const auto& twin = here().twin();
  return twin ? twin->overlapping().data() : nullptr;
}
}
