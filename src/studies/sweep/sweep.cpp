#include "studies/sweep/sweep.hpp"

#include <fmt/format.h>

namespace carom {

std::filesystem::path Sweep::directory_of(std::size_t run) const {
  return std::filesystem::path(point_of(run).name) / fmt::format("seed={}", seed_of(run));
}

std::vector<std::string> Sweep::changes_of(const SweepPoint& point) const {
  std::vector<std::string> changes = shared;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (!point.values[k].empty()) changes.push_back(fmt::format("{}={}", keys[k], point.values[k]));
  return changes;
}

std::vector<std::string> Sweep::overrides_of(std::size_t run) const {
  std::vector<std::string> overrides = changes_of(point_of(run));
  overrides.push_back(fmt::format("run.seed={}", seed_of(run)));
  return overrides;
}

Scene Sweep::scene_of(std::size_t run) const {
  return parse_scene(scene_text, scene_path, overrides_of(run), std::filesystem::path(scene_path).parent_path().string());
}

}  // namespace carom
