#include "studies/horizon/json.hpp"

#include "io/json.hpp"
#include "io/output_error.hpp"
#include "studies/horizon/report.hpp"

#include <fmt/format.h>

#include <optional>

namespace carom {

using detail::Json;
using detail::number;
using detail::number_in;

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

std::optional<FirstDifference> difference_in(const Json& json) {
  if (json.is_null()) return {};
  return FirstDifference{.index = json.at("index").get<std::uint64_t>(),
                         .time = number_in(json.at("time")).value_or(0.0),
                         .disk = json.at("disk").get<std::int32_t>(),
                         .partner = json.at("partner").get<std::int32_t>(),
                         .other_disk = json.at("other_disk").get<std::int32_t>(),
                         .other_partner = json.at("other_partner").get<std::int32_t>()};
}

std::optional<Lyapunov> lyapunov_in(const Json& json) {
  if (json.is_null()) return {};
  return Lyapunov{.per_time = number_in(json.at("per_time")).value_or(0.0),
                  .per_time_error = number_in(json.at("per_time_error")),
                  .per_collision = number_in(json.at("per_collision")).value_or(0.0),
                  .per_collision_error = number_in(json.at("per_collision_error")),
                  .collision_rate = number_in(json.at("collision_rate")).value_or(0.0),
                  .collisions = json.at("collisions").get<std::uint64_t>()};
}

HorizonRow row_in(const Json& json) {
  return {.engine = json.at("engine").get<std::string>(),
          .bits = json.at("bits").get<int>(),
          .against = json.at("against").is_null() ? "" : json.at("against").get<std::string>(),
          .time = number_in(json.at("time")),
          .collisions_per_disk = number_in(json.at("collisions_per_disk")),
          .estimated = json.at("estimated").get<bool>(),
          .first_difference = difference_in(json.at("first_difference")),
          .seconds = number_in(json.at("seconds")).value_or(0.0),
          .price = number_in(json.at("price")).value_or(0.0)};
}

HorizonEnd end_in(const std::string& word) {
  for (const HorizonEnd end :
       {HorizonEnd::parted, HorizonEnd::run, HorizonEnd::limit, HorizonEnd::interrupted, HorizonEnd::stuck})
    if (to_string(end) == word) return end;
  throw Json::other_error::create(501, "no comparison of precisions ends by \"" + word + "\"", nullptr);
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

Horizon horizon_of(const Json& json) {
  Horizon horizon;
  horizon.tolerance = number_in(json.at("tolerance")).value_or(0.0);
  horizon.sigma = number_in(json.at("sigma")).value_or(0.0);
  horizon.resolution = number_in(json.at("resolution")).value_or(0.0);
  horizon.engine = json.at("engine").get<std::string>();
  for (const Json& row : json.at("rows")) horizon.rows.push_back(row_in(row));
  horizon.lyapunov = lyapunov_in(json.at("lyapunov"));
  horizon.time = number_in(json.at("time")).value_or(0.0);
  horizon.collisions_per_disk = number_in(json.at("collisions_per_disk")).value_or(0.0);
  horizon.collisions = json.at("collisions").get<std::uint64_t>();
  horizon.timed_until = number_in(json.at("timed_until")).value_or(0.0);
  horizon.ended = end_in(json.at("ended").get<std::string>());
  return horizon;
}

std::string horizon_study_json(const Horizon& horizon, const Scene& scene) {
  Json json;
  json["carom"] = detail::build_json();
  json["scene"] = scene.source;
  json["seed"] = scene.run.seed;
  json["disks"] = scene.disk_count();
  json["packing_fraction"] = scene.packing_fraction();
  json["horizon"] = horizon_json(horizon);
  json["sentence"] = sentence_of(horizon);
  // A path need not be UTF-8, and JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

void append(RunReport& report, const Horizon& horizon) { report.appended["horizon"] = horizon_json(horizon).dump(); }

std::optional<Horizon> horizon_in(const RunReport& report) {
  const auto found = report.appended.find("horizon");
  if (found == report.appended.end()) return {};
  try {
    return horizon_of(Json::parse(found->second));
  } catch (const Json::exception&) {
    throw OutputError(fmt::format("{}: \"horizon\" in the summary of this run is damaged; run the scene again", report.scene));
  }
}

}  // namespace carom
