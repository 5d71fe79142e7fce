#include "studies/compare/files.hpp"

#include "io/csv_cell.hpp"
#include "io/json.hpp"
#include "studies/compare/answers.hpp"
#include "studies/horizon/json.hpp"

#include <carom/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
double number(const Json& json) { return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>(); }

Json json_of(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

Json json_of(const StepCounts& counts) {
  return {{"steps", counts.steps},         {"time", counts.time},         {"found", counts.found},
          {"missed", counts.missed},       {"repeated", counts.repeated}, {"spurious", counts.spurious},
          {"depth_sum", counts.depth_sum}, {"deepest", counts.deepest}};
}

Json json_of(const MethodRun& run) {
  Json json = {{"method", run.method.name},
               {"dt", run.method.dt},
               {"seed", run.seed},
               {"time", run.time},
               {"setup_seconds", run.setup_seconds},
               {"seconds_early", run.seconds_early},
               {"seconds", run.seconds},
               {"pair", run.pair},
               {"Z", number(run.Z)},
               {"collision_rate", number(run.collision_rate)},
               {"mean_free_path", number(run.mean_free_path)},
               {"energy_drift", number(run.energy_drift)},
               {"worst_overlap", number(run.worst_overlap)},
               {"error", json_of(run.error)}};
  if (run.counts) json["counts"] = json_of(*run.counts);
  if (run.mistakes) json["mistakes"] = {{"steps", run.mistakes->steps}, {"mistaken", run.mistakes->mistaken}};
  return json;
}

MethodRun run_of(const Json& json) {
  MethodRun run;
  run.method = {json.at("method"), json.at("dt")};
  run.seed = json.at("seed");
  run.time = json.at("time");
  run.setup_seconds = json.at("setup_seconds");
  run.seconds_early = json.at("seconds_early");
  run.seconds = json.at("seconds");
  run.pair = json.at("pair");
  run.Z = number(json.at("Z"));
  run.collision_rate = number(json.at("collision_rate"));
  run.mean_free_path = number(json.at("mean_free_path"));
  run.energy_drift = number(json.at("energy_drift"));
  run.worst_overlap = number(json.at("worst_overlap"));
  for (const Json& error : json.at("error")) run.error.push_back(number(error));
  if (json.contains("mistakes"))
    run.mistakes = StepMistakes{.steps = json["mistakes"].at("steps"), .mistaken = json["mistakes"].at("mistaken")};
  if (!json.contains("counts")) return run;
  const Json& counts = json["counts"];
  run.counts = StepCounts{.steps = counts.at("steps"),
                          .time = counts.at("time"),
                          .found = counts.at("found"),
                          .spurious = counts.at("spurious"),
                          .repeated = counts.at("repeated"),
                          .missed = counts.at("missed"),
                          .depth_sum = counts.at("depth_sum"),
                          .deepest = counts.at("deepest")};
  return run;
}

Json json_of(const CostPoint& point) {
  return {{"disks", point.disks},
          {"packing_fraction", point.packing_fraction},
          {"method", point.method},
          {"dt", point.dt},
          {"free_time", point.free_time},
          {"seconds_per_disk_and_free_time", point.seconds},
          {"Z", point.Z},
          {"bias_slope", point.bias_slope}};
}

CostPoint cost_of(const Json& json) {
  return {json.at("disks"), json.at("packing_fraction"), json.at("method"),
          json.at("dt"),    json.at("free_time"),        json.at("seconds_per_disk_and_free_time"),
          json.at("Z"),     json.at("bias_slope")};
}

Json or_null(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json json_of(const ComparePlan& plan) {
  return {{"sigma", plan.sigma},
          {"mean_free_time", plan.mean_free_time},
          {"temperature", plan.temperature},
          {"sample_step", plan.sample_step},
          {"samples", plan.samples},
          {"early_time", plan.early_time()},
          {"until", plan.until()},
          {"dt", plan.dts},
          {"seeds", plan.seeds},
          {"drawn", plan.drawn},
          {"longest", plan.longest},
          {"stiffness", or_null(plan.stiffness)},
          {"conservative", plan.conservative},
          {"machine", plan.machine}};
}

Json json_of(const Price& price) {
  return {{"method", price.method},
          {"target", price.target},
          {"ratio", or_null(price.ratio)},
          {"spread", price.ratio ? Json{number(price.lowest), number(price.highest)} : Json(nullptr)},
          {"extrapolated", price.extrapolated()},
          {"extrapolation", price.extrapolation},
          {"at_most", price.at_most},
          {"dt", or_null(price.dt)},
          {"seconds", or_null(price.seconds)},
          {"remark", price.remark}};
}

Json json_of(const MethodSummary& s) {
  Json json = {{"method", s.method.name},
               {"dt", s.method.dt},
               {"runs", s.runs},
               {"error_early",
                {{"median", number(s.error.median)},
                 {"lower_quartile", number(s.error.lower)},
                 {"upper_quartile", number(s.error.upper)}}},
               {"setup_seconds", number(s.setup_seconds)},
               {"seconds_early", number(s.seconds_early)},
               {"seconds_per_time", number(s.seconds_per_time)}};
  const auto with_error = [](const std::optional<Estimate>& e) {
    return e ? Json{{"value", number(e->value)}, {"error", number(e->error)}} : Json(nullptr);
  };
  json["Z"] = with_error(s.Z);
  json["collision_rate"] = with_error(s.collision_rate);
  json["mean_free_path"] = with_error(s.mean_free_path);
  json["bias"] = {
      {"Z", with_error(s.Z_bias)}, {"collision_rate", with_error(s.rate_bias)}, {"mean_free_path", with_error(s.path_bias)}};
  json["horizon_in_collisions_per_disk"] = or_null(s.horizon);
  json["worst_overlap"] = number(s.worst_overlap);
  json["energy_drift"] = number(s.energy_drift);
  return json;
}

}  // namespace

std::string study_key(const Scene& scene, const CompareOptions& options) {
  const Json key = {{"scene", resolved_toml(scene)},
                    {"dt", options.dts},
                    {"seeds", options.seeds},
                    {"longest", options.longest},
                    {"engine", options.engine},
                    {"costs", options.costs},
                    {"stiffness", or_null(options.stiffness)},
                    {"version", build_info().version},
                    {"commit", build_info().commit}};
  return key.dump(-1, ' ', false, Json::error_handler_t::replace);
}

namespace {

const detail::PartWords words = {"point", "scene"};

std::string line_of(const MethodRun& run) { return Json{{"run", json_of(run)}}.dump(); }
std::string line_of(const CostPoint& point) { return Json{{"cost", json_of(point)}}.dump(); }

std::vector<std::string> lines_of(const Comparison& comparison) {
  std::vector<std::string> lines;
  for (const MethodRun& run : comparison.runs) lines.push_back(line_of(run));
  for (const CostPoint& point : comparison.costs) lines.push_back(line_of(point));
  return lines;
}

}  // namespace

PointsFile::PointsFile(std::filesystem::path path, const std::string& key, const Comparison& before)
    : parts_(std::move(path), words, key, lines_of(before)) {}

void PointsFile::add(const MethodRun& run) { parts_.add(line_of(run)); }
void PointsFile::add(const CostPoint& point) { parts_.add(line_of(point)); }

Comparison load_points(const std::filesystem::path& path, const std::string& key) {
  Comparison comparison;
  detail::read_finished_parts(path, words, key, [&](const Json& point) {
    if (point.contains("run")) comparison.runs.push_back(run_of(point["run"]));
    if (point.contains("cost")) comparison.costs.push_back(cost_of(point["cost"]));
  });
  return comparison;
}

std::string compare_json(const Comparison& comparison, const Scene& scene, const std::string& command_line) {
  const Answers answers = answers_of(comparison);
  Json json;
  json["carom"] = detail::build_json();
  json["scene"] = scene.source;
  json["title"] = scene.title;
  json["disks"] = scene.disk_count();
  json["packing_fraction"] = scene.packing_fraction();
  json["command_line"] = command_line;
  json["complete"] = comparison.complete;
  json["sentences"] = answers.sentences;
  json["answers"] = {
      {"exact", answers.exact},
      {"exact_seconds", number(answers.exact_seconds)},
      {"exact_error", number(answers.exact_error)},
      {"order", answers.order ? Json{{"value", answers.order->value}, {"error", answers.order->error}} : Json(nullptr)},
      {"crossover",
       answers.crossover
           ? Json{{"method", answers.crossover->method}, {"error", answers.crossover->error}, {"dt", answers.crossover->dt}}
           : Json(nullptr)},
      {"break_even", answers.break_even ? Json{{"method", answers.break_even->method},
                                               {"exact_setup_seconds", answers.break_even->exact_setup},
                                               {"method_setup_seconds", answers.break_even->method_setup},
                                               {"collisions_per_disk", answers.break_even->collisions_per_disk}}
                                        : Json(nullptr)},
      {"backtrack_mistakes", answers.mistakes ? Json{{"c", answers.mistakes->c},
                                                     {"error", answers.mistakes->error},
                                                     {"dilute_grazes", or_null(answers.mistakes->grazes)}}
                                              : Json(nullptr)}};
  const Price* best = best_fixed_step(answers.prices, "error 1e-6");
  json["best_fixed_step"] = best != nullptr ? Json(best->method) : Json(nullptr);
  json["prices"] = Json::array();
  for (const Price& price : answers.prices) json["prices"].push_back(json_of(price));
  json["plan"] = json_of(comparison.plan);
  json["horizon"] = horizon_json(comparison.plan.horizon);
  json["summary"] = Json::array();
  for (const MethodSummary& summary : summaries_of(comparison)) json["summary"].push_back(json_of(summary));
  json["time_to_Z"] = Json::array();
  for (const TimeToZ& row : answers.time_to_Z)
    json["time_to_Z"].push_back({{"method", row.method},
                                 {"relative_error", row.accuracy},
                                 {"dt", or_null(row.dt)},
                                 {"seconds", or_null(row.seconds)},
                                 {"remark", row.remark}});
  json["runs"] = Json::array();
  for (const MethodRun& run : comparison.runs) json["runs"].push_back(json_of(run));
  json["left_out"] = Json::array();
  for (const LeftOut& one : comparison.left_out)
    json["left_out"].push_back(
        {{"method", one.method.name}, {"dt", one.method.dt}, {"seconds_predicted", one.seconds}, {"reason", one.reason}});
  json["costs"] = Json::array();
  for (const CostPoint& point : comparison.costs) json["costs"].push_back(json_of(point));
  // A path or a command line need not be UTF-8, and JSON must be.
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

std::string compare_csv(const Comparison& comparison) {
  std::string text =
      "method,dt,seed,time,setup_seconds,seconds_early,error_early,seconds,error_end,horizon,pair,Z,collision_rate,mean_free_"
      "path,"
      "energy_drift,worst_overlap,found,missed,repeated,spurious,mean_depth,deepest,compared_steps,mistaken_steps\n";
  for (const MethodRun& run : comparison.runs) {
    const std::size_t early = comparison.plan.early;
    const auto n = [](double value) { return csv_cell(value); };
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", run.method.name, n(run.method.dt), run.seed, n(run.time),
        n(run.setup_seconds), n(run.seconds_early), n(early >= 1 && run.error.size() >= early ? run.error[early - 1] : NAN),
        n(run.seconds), n(run.error.empty() ? NAN : run.error.back()), n(horizon_of(comparison.plan, run).value_or(NAN)),
        run.pair, n(run.Z), n(run.collision_rate), n(run.mean_free_path), n(run.energy_drift), n(run.worst_overlap));
    if (run.counts) {
      const StepCounts& c = *run.counts;
      text += fmt::format(",{},{},{},{},{},{}", c.found, c.missed, c.repeated, c.spurious, n(c.mean_depth()), n(c.deepest));
    } else {
      text += ",,,,,,";
    }
    text += run.mistakes ? fmt::format(",{},{}\n", run.mistakes->steps, run.mistakes->mistaken) : ",,\n";
  }
  return text;
}

}  // namespace carom
