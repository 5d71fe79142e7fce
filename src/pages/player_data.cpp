// Decides how a run can be shown, and packs it.

#include "pages/player_data.hpp"

#include "pages/player_parts.hpp"
#include "pages/replay.hpp"

#include <algorithm>

namespace carom {

namespace {

using Json = nlohmann::ordered_json;
using detail::NumberColumns;

Json description_of(const Recording& run) {
  Json json = detail::player_description(run.scene, run.title, run.species_names, run.disks.count());
  json["Z"] = run.Z ? Json(*run.Z) : Json(nullptr);
  json["facts"] = Json::array({{"Units", "those of the scene; kB = 1"}});
  for (const auto& [name, value] : run.facts) json["facts"].push_back({name, value});
  return json;
}

/// Returns the largest displacement of any disk by rounding the velocities, at any time up to `end`.
double rounding_error(const Scene& scene, const Disks& disks, const State& start, const std::vector<Event>& events, double end) {
  Replay exact(scene, disks, start), rounded(scene, disks, start, VelocityDigits::single);
  double largest = 0.0;
  const auto compare = [&](std::size_t i, double time) {
    largest = std::max(largest, (exact.position(i, time) - rounded.position(i, time)).norm());
  };
  for (const Event& event : events) {
    compare(static_cast<std::size_t>(event.disk), event.time);
    if (event.partner >= 0) compare(static_cast<std::size_t>(event.partner), event.time);
    const bool rescaled = exact.apply(event).has_value();
    rounded.apply(event);
    if (rescaled)
      for (std::size_t i = 0; i < disks.count(); ++i) compare(i, event.time);
  }
  for (std::size_t i = 0; i < disks.count(); ++i) compare(i, end);
  return largest;
}

/// The start and every event.
void put_replay(const Recording& run, const ExactRun& replayed, NumberColumns& columns, Json& json) {
  const Scene& scene = run.scene;
  const State& start = replayed.start;
  const std::vector<Event>& events = replayed.events;
  const double tolerance = player_tolerance * scene.box.lengths().maxCoeff();
  const double rounding = rounding_error(scene, run.disks, start, events, run.end);
  const VelocityDigits digits = rounding <= tolerance ? VelocityDigits::single : VelocityDigits::twice;
  detail::put_events(scene, run.disks, start, events, digits, columns, json);
  json["duration"] = std::max(run.end, events.empty() ? 0.0 : events.back().time);
  json["distance"] = replayed.distance;
  json["rounding"] = digits == VelocityDigits::single ? rounding : 0.0;
}

}  // namespace

PlayerData player_data(const Recording& run, const PlayerLimits& limits) {
  NumberColumns columns;
  Json json = description_of(run);
  detail::put_disks(run.disks, columns);
  PlayerData data;
  const ExactRun replayed = read_exactly(run, limits.events, "a page can hold");
  data.why_not = replayed.why_not;
  data.exact = replayed.exact();
  data.exact ? put_replay(run, replayed, columns, json) : detail::put_samples(run, limits.sample_bytes, columns, json);
  json["exact"] = data.exact;
  json["whyNot"] = data.why_not;
  json["columns"] = columns.list();
  data.description = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  data.columns = columns.take_bytes();
  return data;
}

}  // namespace carom
