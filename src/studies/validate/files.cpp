#include "studies/validate/files.hpp"

#include "io/json.hpp"

#include <carom/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

using detail::Json;
using detail::number;

/// Reads null as NaN: only measured numbers can be null.
double number_in(const Json& json) { return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>(); }

Json json_of(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

std::vector<double> list_of(const Json& json) {
  std::vector<double> values;
  for (const Json& value : json) values.push_back(number_in(value));
  return values;
}

constexpr std::array<std::pair<Judged, const char*>, 3> judgements = {
    {{Judged::agrees, "agrees"}, {Judged::disagrees, "must not agree"}, {Judged::shown, "shown"}}};

Json json_of(const Check& check) {
  const auto judged =
      std::find_if(judgements.begin(), judgements.end(), [&](const auto& one) { return one.first == check.judged; });
  Json json = {{"name", check.name},
               {"theory", check.theory},
               {"source", check.source},
               {"expected", number(check.expected)},
               {"measured", number(check.measured.value)},
               {"error", number(check.measured.error)},
               {"reference_error", check.reference_error},
               {"error_is_bound", check.error_is_bound},
               {"z", number(check.z())},
               {"calibrates", check.calibrates()},
               {"allowance", check.allowance},
               {"allowance_for", check.allowance_for},
               {"deviation", number(check.deviation())},
               {"judged", judged->second},
               {"fits", check.fits()},
               {"holds", check.holds()}};
  if (check.equivalent) json["equivalent"] = number(*check.equivalent);
  if (std::isfinite(check.measured.freedom)) json["freedom"] = check.measured.freedom;
  if (check.largest_error > 0.0) json["largest_error"] = check.largest_error;
  return json;
}

Check check_of(const Json& json) {
  Check check{.name = json.at("name"),
              .theory = json.at("theory"),
              .source = json.at("source"),
              .expected = number_in(json.at("expected")),
              .measured = {number_in(json.at("measured")), number_in(json.at("error"))},
              .reference_error = json.at("reference_error"),
              .allowance = json.at("allowance"),
              .allowance_for = json.at("allowance_for"),
              .error_is_bound = json.at("error_is_bound")};
  if (json.contains("equivalent"))
    check.equivalent = json["equivalent"].is_null() ? std::numeric_limits<double>::infinity() : json["equivalent"].get<double>();
  check.measured.freedom = json.value("freedom", check.measured.freedom);
  check.largest_error = json.value("largest_error", 0.0);
  const std::string judged = json.at("judged");
  for (const auto& [value, word] : judgements)
    if (judged == word) check.judged = value;
  return check;
}

Json json_of(const TrialResult& result) {
  Json json = {{"trial", result.trial}, {"seconds", result.seconds}, {"scenes", result.scenes}};
  json["checks"] = Json::array();
  for (const Check& check : result.checks) json["checks"].push_back(json_of(check));
  json["curves"] = Json::array();
  for (const Curve& curve : result.curves)
    json["curves"].push_back({{"plot", curve.plot},
                              {"name", curve.name},
                              {"theory", curve.theory},
                              {"x", json_of(curve.x)},
                              {"y", json_of(curve.y)},
                              {"error", json_of(curve.error)}});
  return json;
}

TrialResult result_of(const Json& json) {
  TrialResult result{.trial = json.at("trial"), .scenes = json.at("scenes"), .seconds = json.at("seconds")};
  for (const Json& check : json.at("checks")) result.checks.push_back(check_of(check));
  for (const Json& curve : json.at("curves"))
    result.curves.push_back({.plot = curve.at("plot"),
                             .name = curve.at("name"),
                             .theory = curve.at("theory"),
                             .x = list_of(curve.at("x")),
                             .y = list_of(curve.at("y")),
                             .error = list_of(curve.at("error"))});
  return result;
}

}  // namespace

std::string validation_key(const ValidateOptions& options) {
  const BuildInfo& build = build_info();
  return fmt::format("{} {}, seed {}, {}", build.version, build.commit, options.seed, options.full ? "full" : "quick");
}

namespace {

const detail::PartWords words = {"trial", "seed"};

std::vector<std::string> lines_of(const Validation& validation) {
  std::vector<std::string> lines;
  for (const TrialResult& result : validation.results) lines.push_back(json_of(result).dump());
  return lines;
}

}  // namespace

TrialsFile::TrialsFile(std::filesystem::path path, const std::string& key, const Validation& before)
    : parts_(std::move(path), words, key, lines_of(before)) {}

void TrialsFile::add(const TrialResult& result) { parts_.add(json_of(result).dump()); }

Validation load_trials(const std::filesystem::path& path, const std::string& key) {
  Validation validation;
  detail::read_finished_parts(path, words, key, [&](const Json& trial) { validation.results.push_back(result_of(trial)); });
  return validation;
}

std::string validation_json(const Validation& validation, const std::string& command_line) {
  Json json;
  json["carom"] = detail::build_json();
  json["command_line"] = command_line;
  json["mode"] = validation.options.full ? "full" : "quick";
  json["seed"] = validation.options.seed;
  json["checks"] = validation.checks();
  json["failed"] = validation.failed();
  json["groups"] = Json::array();
  for (const GroupFit& fit : group_fits(validation))
    json["groups"].push_back({{"name", fit.group},
                              {"trials", fit.trials},
                              {"chi_squared_per_trial", number(fit.mean_square)},
                              {"between", {fit.least, fit.most}}});
  json["trials"] = Json::array();
  for (const TrialResult& result : validation.results) json["trials"].push_back(json_of(result));
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace carom
