#include "io/horizon_json.hpp"

#include "io/json_number.hpp"

#include <optional>

namespace carom {

using detail::Json;
using detail::number;

namespace {

Json json_of(const std::optional<FirstDifference>& found) {
  if (!found) return nullptr;
  return {{"index", found->index},     {"time", number(found->time)},     {"disk", found->disk},
          {"partner", found->partner}, {"other_disk", found->other_disk}, {"other_partner", found->other_partner}};
}

Json json_of(const std::optional<Lyapunov>& exponent) {
  if (!exponent) return nullptr;
  return {{"per_time", number(exponent->per_time)},
          {"per_time_error", number(exponent->per_time_error)},
          {"per_collision", number(exponent->per_collision)},
          {"per_collision_error", number(exponent->per_collision_error)},
          {"collision_rate", number(exponent->collision_rate)},
          {"collisions", exponent->collisions}};
}

Json json_of(const HorizonRow& row) {
  const bool timed = row.seconds > 0.0;
  return {{"engine", row.engine},
          {"bits", row.bits},
          {"against", row.against.empty() ? Json(nullptr) : Json(row.against)},
          {"time", number(row.time)},
          {"collisions_per_disk", number(row.collisions_per_disk)},
          {"estimated", row.estimated},
          {"first_difference", json_of(row.first_difference)},
          {"seconds", timed ? number(row.seconds) : Json(nullptr)},
          {"price", timed && row.price > 0.0 ? number(row.price) : Json(nullptr)}};
}

}  // namespace

Json horizon_json(const Horizon& horizon) {
  Json json = {{"tolerance", number(horizon.tolerance)},
               {"sigma", number(horizon.sigma)},
               {"resolution", number(horizon.resolution)},
               {"engine", horizon.engine},
               {"rows", Json::array()},
               {"lyapunov", json_of(horizon.lyapunov)},
               {"time", number(horizon.time)},
               {"collisions_per_disk", number(horizon.collisions_per_disk)},
               {"collisions", horizon.collisions},
               {"timed_until", number(horizon.timed_until)},
               {"ended", to_string(horizon.ended)}};
  for (const HorizonRow& row : horizon.rows) json["rows"].push_back(json_of(row));
  return json;
}

}  // namespace carom
