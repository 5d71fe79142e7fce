// Packs what players are made of.

#include "pages/player_parts.hpp"

#include "io/json.hpp"
#include "observe/equilibrium.hpp"
#include "observe/mechanics.hpp"
#include "pages/wall_vibrations.hpp"
#include "scene/changes.hpp"
#include "scene/fixed_shapes.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <variant>

namespace carom::detail {

namespace {

Json shapes_of(const Effects& effects) {
  Json list = Json::array();
  for (const Obstacle& shape : fixed_shapes(effects)) {
    if (const auto* disk = std::get_if<DiskObstacle>(&shape))
      list.push_back({{"centre", vector(disk->centre)}, {"radius", disk->radius}});
    else if (const auto* segment = std::get_if<SegmentObstacle>(&shape))
      list.push_back({{"from", vector(segment->from)}, {"to", vector(segment->to)}});
    else if (const auto* arc = std::get_if<ArcObstacle>(&shape))
      list.push_back({{"centre", vector(arc->centre)}, {"radius", arc->radius}, {"angles", Json::array({arc->from, arc->to})}});
  }
  return list;
}

/// The shapes after each change, with its time.
Json later_shapes(const Scene& scene) {
  Json list = Json::array();
  Effects effects = scene.effects;
  for (const Change& change : scene.changes) {
    effects = effects_after(effects, change);
    list.push_back({{"time", change.time}, {"shapes", shapes_of(effects)}});
  }
  return list;
}

/// Events as columns; `Id` holds every number that a disk or another partner can have.
template <class Id>
struct EventColumns {
  std::size_t disks;
  std::vector<double> time;
  std::vector<Id> disk, partner;
  std::vector<std::array<double, 4>> velocity;

  void add(const Event& event) {
    const auto count = static_cast<std::int32_t>(disks);
    const std::int32_t code = event.partner >= 0               ? event.partner
                              : event.partner > first_obstacle ? count - 1 - event.partner
                                                               : count + 5 + first_obstacle - event.partner;
    push(event.time, static_cast<Id>(event.disk), static_cast<Id>(code),
         {event.velocity.x(), event.velocity.y(), event.partner_velocity.x(), event.partner_velocity.y()});
  }
  void add_rescaling(double when, double factor) { push(when, Id{0}, static_cast<Id>(disks + 4), {factor, 0.0, 0.0, 0.0}); }

  template <class Real>
  void put(NumberColumns& columns) const {
    columns.add("time", time);
    columns.add("disk", disk);
    columns.add("partner", partner);
    std::vector<Real> flat;
    for (const auto& four : velocity)
      for (const double v : four) flat.push_back(static_cast<Real>(v));
    columns.add("velocity", flat);
  }

 private:
  void push(double when, Id first, Id second, const std::array<double, 4>& velocities) {
    time.push_back(when);
    disk.push_back(first);
    partner.push_back(second);
    velocity.push_back(velocities);
  }
};

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

template <class Id>
void put_events_with(Replay replay, std::size_t disks, const std::vector<Event>& events, VelocityDigits digits,
                     NumberColumns& columns, Json& json) {
  EventColumns<Id> packed{disks, {}, {}, {}, {}};
  WallTracks tracks;
  tracks.note(replay);
  for (const Event& event : events) {
    const auto factor = replay.apply(event);
    packed.add(event);
    if (factor) packed.add_rescaling(event.time, *factor);
    tracks.note(replay);
  }
  digits == VelocityDigits::single ? packed.template put<float>(columns) : packed.template put<double>(columns);
  tracks.put(replay, columns, json);
}

/// Returns position and velocity of every disk, x and y of each.
std::vector<double> start_column(const State& start) {
  std::vector<double> numbers;
  for (Eigen::Index i = 0; i < start.positions.cols(); ++i)
    numbers.insert(numbers.end(), {start.positions(0, i), start.positions(1, i), start.velocities(0, i), start.velocities(1, i)});
  return numbers;
}

}  // namespace

Json player_description(const Scene& scene, const std::string& title, const std::vector<std::string>& species_names,
                        std::size_t disks) {
  const Effects& effects = scene.effects;
  const Box& box = scene.box;
  Json json{{"title", title}, {"disks", disks}};
  json["box"] = {
      {"lower", vector(box.lower)}, {"upper", vector(box.upper)}, {"periodic", Json::array({box.periodic(0), box.periodic(1)})}};
  if (box.is_circle) json["box"]["isCircle"] = true;
  json["species"] = species_names;
  json["acceleration"] = vector(effects.acceleration());
  json["growth"] = effects.growth_rate();
  json["shapes"] = shapes_of(effects);
  if (!scene.changes.empty()) json["laterShapes"] = later_shapes(scene);
  for (const WallVibration& wall : wall_vibrations(scene))
    json["vibrations"].push_back({{"side", wall.side}, {"low", wall.low}, {"high", wall.high}});
  json["centreOfMassIsThermal"] =
      Json::array({centre_of_mass_is_thermal(box, effects, 0), centre_of_mass_is_thermal(box, effects, 1)});
  json["whyNoZ"] = why_no_Z(scene);
  return json;
}

void put_disks(const Disks& disks, NumberColumns& columns) {
  columns.add("radius", disks.radius);
  columns.add("mass", disks.mass);
  columns.add("species", std::vector<std::uint16_t>(disks.species.begin(), disks.species.end()));
}

void put_events(const Scene& scene, const Disks& disks, const State& start, const std::vector<Event>& events,
                VelocityDigits digits, NumberColumns& columns, Json& json) {
  json["scale"] = start.scale;
  columns.add("start", start_column(start));
  const Replay replay(scene, disks, start, digits);
  const bool short_ids = disks.count() + 5 + fixed_shapes(scene.effects).size() <= std::numeric_limits<std::uint16_t>::max();
  short_ids ? put_events_with<std::uint16_t>(replay, disks.count(), events, digits, columns, json)
            : put_events_with<std::uint32_t>(replay, disks.count(), events, digits, columns, json);
}

}  // namespace carom::detail
