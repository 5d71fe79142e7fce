#include "studies/sweep/state.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <system_error>

namespace carom {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// Returns the text as JSON stores it: a path need not be UTF-8.
std::string kept(const std::string& text) { return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Network file systems remember for a while that a file was not there; to list its directory makes them ask again.
void look_again(const fs::path& directory) {
  std::error_code ignored;
  for (fs::directory_iterator entry(directory, ignored); entry != fs::directory_iterator(); entry.increment(ignored)) continue;
}

FoundRun run_of(const Json& summary, const std::string& resolved) {
  const std::string stopped = summary.at("stopped");
  if (stopped == "interrupted") return {};
  if (kept(summary.at("resolved_scene")) != kept(resolved)) return {.state = RunState::other};
  if (!summary.value("measured", true))
    return {.state = RunState::failed, .failure = fmt::format("the run ended while it was still equilibrating ({})", stopped)};
  const Json& build = summary.at("carom");
  return {.state = RunState::finished,
          .stopped = stopped,
          .version = fmt::format("{} (commit {})", build.value("version", "?"), build.value("commit", "?")),
          .numbers = numbers_of(summary)};
}

}  // namespace

std::string_view to_string(RunState state) {
  switch (state) {
    case RunState::missing:
      return "missing";
    case RunState::finished:
      return "finished";
    case RunState::failed:
      return "failed";
    case RunState::other:
      return "other";
  }
  return "";
}

FoundRun find_run(const fs::path& directory, const std::function<std::string()>& resolved) {
  look_again(directory);
  if (std::ifstream file(directory / failure_file); file) {
    FoundRun run{.state = RunState::failed};
    std::getline(file, run.failure);
    return run;
  }
  std::error_code error;
  if (!fs::is_regular_file(directory / "summary.json", error)) return {};
  try {
    return run_of(Json::parse(std::ifstream(directory / "summary.json")), resolved());
  } catch (const Json::exception&) {  // cut short, or nobody's summary
    return {};
  }
}

}  // namespace carom
