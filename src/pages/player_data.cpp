// Decides how a run can be shown, and packs it.

#include "pages/player_data.hpp"

#include "io/json_number.hpp"
#include "observe/equilibrium.hpp"
#include "observe/mechanics.hpp"
#include "pages/event_columns.hpp"
#include "pages/exact_run.hpp"
#include "pages/number_columns.hpp"
#include "pages/player_samples.hpp"
#include "pages/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace carom {

namespace {

using Json = nlohmann::ordered_json;
using detail::NumberColumns;

Json obstacles_of(const Effects& effects) {
  Json list = Json::array();
  for (const Obstacle& obstacle : effects.obstacles) {
    if (const auto* disk = std::get_if<DiskObstacle>(&obstacle.shape))
      list.push_back({{"centre", detail::vector(disk->centre)}, {"radius", disk->radius}});
    else if (const auto* segment = std::get_if<SegmentObstacle>(&obstacle.shape))
      list.push_back({{"from", detail::vector(segment->from)}, {"to", detail::vector(segment->to)}});
  }
  return list;
}

Json description_of(const RunReader& run) {
  const Scene& scene = run.scene();
  const Effects& effects = scene.effects;
  Json json{{"title", run.title()}, {"disks", run.disks().count()}};
  json["box"] = {{"lower", detail::vector(scene.box.lower)},
                 {"upper", detail::vector(scene.box.upper)},
                 {"periodic", Json::array({scene.box.periodic(0), scene.box.periodic(1)})}};
  json["species"] = run.species_names();
  json["gravity"] = detail::vector(effects.gravity ? effects.gravity->acceleration : Eigen::Vector2d::Zero());
  json["growth"] = effects.growth ? effects.growth->rate : 0.0;
  json["obstacles"] = obstacles_of(effects);
  json["keepsMomentum"] = Json::array({keeps_momentum(scene.box, effects, 0), keeps_momentum(scene.box, effects, 1)});
  json["whyNoZ"] = why_no_Z(effects);
  json["Z"] = run.Z() ? Json(*run.Z()) : Json(nullptr);
  json["facts"] = Json::array({{"Units", "those of the scene; kB = 1"}});
  for (const auto& [name, value] : run.facts()) json["facts"].push_back({name, value});
  return json;
}

/// The motion of each side that moves: rows of time, position and velocity, from each on with the same acceleration.
struct WallTracks {
  std::array<std::vector<double>, 4> rows;

  void note(const Replay& replay) {
    for (std::size_t side = 0; side < 4; ++side) {
      const Replay::Side& now = replay.sides()[side];
      std::vector<double>& track = rows[side];
      if (track.empty() || track[track.size() - 3] != now.time || track[track.size() - 1] != now.velocity)
        track.insert(track.end(), {now.time, now.position, now.velocity});
    }
  }
  void put(const Replay& replay, NumberColumns& columns, Json& json) const {
    json["accelerations"] = Json::array();
    for (std::size_t side = 0; side < 4; ++side) {
      columns.add(fmt::format("wall{}", side), rows[side]);
      json["accelerations"].push_back(replay.sides()[side].acceleration);
    }
  }
};

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

template <class Id>
void put_events(const RunReader& run, const State& start, const std::vector<Event>& events, VelocityDigits digits,
                NumberColumns& columns, Json& json) {
  const std::size_t disks = run.disks().count();
  detail::EventColumns<Id> packed;
  WallTracks tracks;
  Replay replay(run.scene(), run.disks(), start, digits);
  tracks.note(replay);
  for (const Event& event : events) {
    const auto factor = replay.apply(event);
    packed.add(event, disks);
    if (factor) packed.add_rescaling(event.time, *factor, disks);
    tracks.note(replay);
  }
  digits == VelocityDigits::single ? packed.template put<float>(columns) : packed.template put<double>(columns);
  tracks.put(replay, columns, json);
}

/// The start and every event.
void put_replay(const RunReader& run, const ExactRun& replayed, NumberColumns& columns, Json& json) {
  const Scene& scene = run.scene();
  const State& start = replayed.start;
  const std::vector<Event>& events = replayed.events;
  const double tolerance = player_tolerance * scene.box.lengths().maxCoeff();
  const double rounding = rounding_error(scene, run.disks(), start, events, run.end());
  const VelocityDigits digits = rounding <= tolerance ? VelocityDigits::single : VelocityDigits::twice;
  columns.add("start", detail::start_column(start));
  const bool short_ids = run.disks().count() + 5 + scene.effects.obstacles.size() <= std::numeric_limits<std::uint16_t>::max();
  short_ids ? put_events<std::uint16_t>(run, start, events, digits, columns, json)
            : put_events<std::uint32_t>(run, start, events, digits, columns, json);
  json["duration"] = std::max(run.end(), events.empty() ? 0.0 : events.back().time);
  json["scale"] = start.scale;
  json["distance"] = replayed.distance;
  json["rounding"] = digits == VelocityDigits::single ? rounding : 0.0;
}

}  // namespace

PlayerData player_data(const RunReader& run, const PlayerLimits& limits) {
  NumberColumns columns;
  Json json = description_of(run);
  columns.add("radius", run.disks().radius);
  columns.add("mass", run.disks().mass);
  columns.add("species", std::vector<std::uint16_t>(run.disks().species.begin(), run.disks().species.end()));
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
