// Describes the summary.json of a run, or the compare.json of a comparison.

#include "app/info_parts.hpp"
#include "io/output_error.hpp"
#include "scene/effect_traits.hpp"
#include "text/numbers.hpp"

#include <carom/threads.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <string_view>

namespace carom::detail {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& value) {
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : value.is_null() ? "none" : value.dump();
}

/// Returns a number with its standard error, if it has one.
std::string text_of(const Json& value, const Json& error) {
  return value.is_null() || error.is_null() ? text_of(value) : with_error(value.get<double>(), error.get<double>());
}

/// Returns a packing fraction as the summary of a run has it on the terminal.
std::string packing_fraction(const Json& json) { return fmt::format("{:.4g}", json.at("packing_fraction").get<double>()); }

/// Returns the pressures on all walls that have one: "left 2.5, right 2.5".
std::string wall_pressures(const Json& walls) {
  std::string text;
  for (const auto& [name, wall] : walls.items())
    if (!wall.at("pressure").is_null())
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, text_of(wall.at("pressure")));
  return text;
}

/// Returns all numbers of a section with their keys: "strain 2.5, pressure_xy.flight -0.25".
std::string numbers_of(const Json& section, const std::string& prefix = "") {
  std::string text;
  for (const auto& [key, value] : section.items())
    text += fmt::format(
        "{}{}", text.empty() ? "" : ", ",
        value.is_object() ? numbers_of(value, prefix + key + ".") : fmt::format("{}{} {}", prefix, key, text_of(value)));
  return text;
}

/// Returns one line for each effect that has a result.
std::string lines_of_effects(const Json& json) {
  std::string text;
  if (json.at("energy").contains("supplied"))
    text += info_line("supplied", fmt::format("energy {}, unaccounted {}", text_of(json.at("energy").at("supplied")),
                                              text_of(json.at("energy").at("unaccounted"))));
  if (json.at("temperature").contains("spin_mean"))
    text += info_line("spin", fmt::format("temperature {}", text_of(json.at("temperature").at("spin_mean"))));
  if (json.contains("walls")) {
    const std::string pressures = wall_pressures(json.at("walls"));
    if (!pressures.empty()) text += info_line("pressure on", pressures);
  }
  if (json.contains("dissipated")) text += info_line("dissipated", fmt::format("energy {}", text_of(json.at("dissipated"))));
  for (const EffectTraits& effect : all_effects())
    if (const std::string name(effect.name); json.contains(name)) text += info_line(name, numbers_of(json.at(name)));
  return text;
}

/// Returns the numbers of events by kind, without the engine's own: "1000 pair, 20 wall".
std::string events_line(const Json& events) {
  std::string text = fmt::format("{} pair, {} wall", text_of(events.at("pair")), text_of(events.at("wall")));
  constexpr std::array<std::string_view, 5> told = {"pair", "wall", "other", "stale", "total"};
  for (const auto& [kind, count] : events.items())
    if (std::ranges::find(told, kind) == told.end()) text += fmt::format(", {} {}", text_of(count), kind);
  return text;
}

/// Returns what sharing the run out took: "2, 403 windows of 2 domains, 1 window redone, 0.3 % of the events on one core alone",
/// or "1 in each of 2 processes, ...".
std::string threads_line(const Json& cores) {
  const auto number = [&](const char* key) { return cores.at(key).get<std::uint64_t>(); };
  const std::string processes = number("ranks") > 1 ? fmt::format(" in each of {} processes", number("ranks")) : "";
  const ThreadCounts counts{.events = cores.value("events", std::uint64_t{0}),
                            .events_alone = cores.value("events_alone", std::uint64_t{0})};
  return fmt::format("{}{}, {} of {}, {} redone, {:.1f} % of the events on one core alone", number("threads"), processes,
                     counted(number("windows"), "window"), counted(number("domains"), "domain"),
                     counted(number("windows_redone"), "window"), 100.0 * counts.share_alone());
}

std::string effects_line(const Json& effects) {
  std::string text;
  for (const Json& effect : effects) text += (text.empty() ? "" : ", ") + text_of(effect);
  return text;
}

/// One line per observable: its numbers with their errors, then its tables.
std::string lines_of_observables(const Json& observables) {
  std::string text;
  for (const auto& [name, measured] : observables.items()) {
    std::string line;
    for (const auto& [key, entry] : measured.items()) {
      if (!entry.is_object() || !entry.contains("value") || entry.at("value").is_null()) continue;
      line += fmt::format("{}{} {}", line.empty() ? "" : ", ", key, text_of(entry.at("value"), entry.at("error")));
    }
    if (measured.contains("tables"))
      for (const auto& [key, table] : measured.at("tables").items())
        line += fmt::format("{}{}", line.empty() ? "" : ", ", text_of(table.at("file")));
    text += info_line("observed", fmt::format("{}: {}", name, line));
  }
  return text;
}

std::string described(const Json& json) {
  std::string text = info_line("written by", fmt::format("carom {} ({})", text_of(json.at("carom").at("version")),
                                                         text_of(json.at("carom").at("commit"))));
  text += info_line("scene", text_of(json.at("scene")));
  text += info_line("seed", text_of(json.at("seed")));
  const auto number = [&](const char* key) {
    return json.contains(key) ? std::optional(json.at(key).get<double>()) : std::nullopt;
  };
  text += engine_line(text_of(json.at("engine")), number("dt"), number("stiffness"));
  if (json.contains("cores")) text += info_line("threads", threads_line(json.at("cores")));
  text += info_line("effects", effects_line(json.at("effects")));
  text += info_line("disks", fmt::format("{}, packing fraction {}", text_of(json.at("disks")), packing_fraction(json)));
  text += info_line("time", fmt::format("{}, {} samples, stopped by {}", text_of(json.at("time")), text_of(json.at("samples")),
                                        text_of(json.at("stopped"))));
  if (json.contains("state_hash")) text += info_line("state hash", text_of(json.at("state_hash")));
  text += info_line("events", events_line(json.at("events")));
  text += info_line("energy", fmt::format("{}, relative drift {}", text_of(json.at("energy").at("final")),
                                          text_of(json.at("energy").at("relative_drift"))));
  text += lines_of_effects(json);
  if (json.contains("observables")) text += lines_of_observables(json.at("observables"));
  const Json& pressure = json.at("pressure");
  text += info_line("Z", text_of(pressure.at("Z"), pressure.at("Z_error")));
  return text +
         info_line("overlap", fmt::format("at most {} of a contact distance", text_of(json.at("overlap").at("max_relative"))));
}

std::string described_comparison(const Json& json) {
  std::string text = info_line("written by", fmt::format("carom {} ({})", text_of(json.at("carom").at("version")),
                                                         text_of(json.at("carom").at("commit"))));
  text += info_line("scene", text_of(json.at("scene")));
  text += info_line("disks", fmt::format("{}, packing fraction {}", text_of(json.at("disks")), packing_fraction(json)));
  text += info_line("runs", fmt::format("{}, {} starts, {} time steps", json.at("runs").size(),
                                        json.at("plan").at("seeds").size(), json.at("plan").at("dt").size()));
  for (const Json& sentence : json.at("sentences")) text += info_line("answer", text_of(sentence));
  return text;
}

}  // namespace

std::string describe_summary(const std::filesystem::path& path) {
  std::ifstream file(path);
  Json json;
  try {
    json = Json::parse(file);
  } catch (const Json::parse_error& error) {
    throw OutputError(
        fmt::format("{}: this is not whole JSON (it breaks at byte {}); it is damaged or cut short", path.string(), error.byte));
  } catch (const Json::out_of_range&) {
    throw OutputError(fmt::format("{}: this JSON holds a number beyond the range of doubles; it is damaged", path.string()));
  }
  try {
    if (json.contains("sentences"))
      return fmt::format("{}: comparison of methods\n{}", path.string(), described_comparison(json));
    return fmt::format("{}: summary of a run\n{}", path.string(), described(json));
  } catch (const Json::exception&) {
    throw OutputError(fmt::format("{}: this JSON is not the summary of a run: keys that every summary of Carom has are missing",
                                  path.string()));
  }
}

}  // namespace carom::detail
