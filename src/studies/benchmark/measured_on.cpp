#include "studies/benchmark/measured_on.hpp"

#include "core/instructions.hpp"
#include "io/json.hpp"
#include "studies/machine.hpp"

#include <fmt/format.h>
#include <carom/version.hpp>
#include <nlohmann/json.hpp>

#include <optional>

namespace carom::cli {

std::string measured_on() {
  const BuildInfo& build = build_info();
  const std::optional<std::size_t> cache = second_level_cache();
  return fmt::format("{}{}; carom {} (commit {}; {}; {}), {} instructions.", processor(),
                     cache ? fmt::format(", {} KiB of second-level cache", *cache / 1024) : "", build.version, build.commit,
                     build.compiler, build.flags, name_of(chosen_instructions()));
}

nlohmann::ordered_json measured_on_json() {
  using Json = nlohmann::ordered_json;
  const std::optional<std::size_t> cache = second_level_cache();
  return {{"carom", detail::build_json()},
          {"machine", {{"processor", processor()}, {"second_level_cache", cache ? Json(*cache) : Json(nullptr)}}},
          {"instructions", name_of(chosen_instructions())}};
}

}  // namespace carom::cli
