#include "simulation/catalogue.hpp"

#include "core/real.hpp"
#include "simulation/driven_engine.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace carom::detail {

extern template std::unique_ptr<AnyEngine> make_textbook<float>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_textbook<double>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_textbook<long double>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_textbook<Quad>(const Scene&, const Disks&, State);

namespace {

bool always(const Scene& /*scene*/, const Disks& /*disks*/) { return true; }

}  // namespace

const std::vector<EngineEntry>& catalogue() {
  static const std::vector<EngineEntry> entries = {
      {"fast", &fast_covers, &make_fast},
      {"general", &general_covers, &make_general},
      {"textbook", &always, &make_textbook<double>},
      {"textbook-float", &always, &make_textbook<float>},
      {"textbook-long-double", &always, &make_textbook<long double>},
      {"textbook-quad", &always, &make_textbook<Quad>},
  };
  return entries;
}

const EngineEntry& choose_engine(const Scene& scene, const Disks& disks, const std::string& engine) {
  const auto& entries = catalogue();
  const auto named = [&](const auto& entry) { return entry.name == engine; };
  if (engine != "auto" && std::none_of(entries.begin(), entries.end(), named))
    throw std::invalid_argument(
        fmt::format("there is no engine \"{}\"; choose one of auto, {}", engine, fmt::join(engine_names(), ", ")));
  const auto covering = [&](const auto& entry) { return (engine == "auto" || named(entry)) && entry.covers(scene, disks); };
  const auto entry = std::find_if(entries.begin(), entries.end(), covering);
  if (entry == entries.end())
    throw std::invalid_argument(
        fmt::format("the engine \"{}\" does not cover this scene: {}; leave the choice to carom, or take \"textbook\"", engine,
                    "its periodic box is too small, or its disks are, compared with the box"));
  return *entry;
}

std::unique_ptr<AnyEngine> make_engine(const EngineEntry& entry, const Scene& scene, const Disks& disks, State start) {
  std::unique_ptr<AnyEngine> engine = entry.make(scene, disks, std::move(start));
  if (!DrivenEngine::needed_by(scene.effects)) return engine;
  return std::make_unique<DrivenEngine>(std::move(engine), scene, disks);
}

}  // namespace carom::detail
