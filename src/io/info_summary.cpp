// What a summary.json says, or the compare.json of a comparison.

#include "io/info_parts.hpp"
#include "io/output_error.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace carom::detail {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.is_null() ? "none" : value.dump();
}

std::string described(const Json& json) {
  std::string text = info_line("written by", fmt::format("carom {} ({})", text_of(json.at("carom").at("version")),
                                                         text_of(json.at("carom").at("commit"))));
  text += info_line("scene", text_of(json.at("scene")));
  text += info_line("seed", text_of(json.at("seed")));
  text += info_line("engine", text_of(json.at("engine")));
  text +=
      info_line("disks", fmt::format("{}, packing fraction {}", text_of(json.at("disks")), text_of(json.at("packing_fraction"))));
  text += info_line("time", fmt::format("{}, {} samples, stopped by {}", text_of(json.at("time")), text_of(json.at("samples")),
                                        text_of(json.at("stopped"))));
  const Json& events = json.at("events");
  text += info_line("events", fmt::format("{} pair, {} wall", text_of(events.at("pair")), text_of(events.at("wall"))));
  text += info_line("energy", fmt::format("{}, relative drift {}", text_of(json.at("energy").at("final")),
                                          text_of(json.at("energy").at("relative_drift"))));
  const Json& pressure = json.at("pressure");
  text += info_line("Z", fmt::format("{}, standard error {}", text_of(pressure.at("Z")), text_of(pressure.at("Z_error"))));
  return text +
         info_line("overlap", fmt::format("at most {} of a contact distance", text_of(json.at("overlap").at("max_relative"))));
}

std::string described_comparison(const Json& json) {
  std::string text = info_line("written by", fmt::format("carom {} ({})", text_of(json.at("carom").at("version")),
                                                         text_of(json.at("carom").at("commit"))));
  text += info_line("scene", text_of(json.at("scene")));
  text +=
      info_line("disks", fmt::format("{}, packing fraction {}", text_of(json.at("disks")), text_of(json.at("packing_fraction"))));
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
