#include "simulation/catalogue.hpp"

#include "core/real.hpp"
#include "scene/checks.hpp"
#include "simulation/drag_engine.hpp"
#include "simulation/driven_engine.hpp"
#include "simulation/engine_reason.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace carom::detail {

extern template std::unique_ptr<AnyEngine> make_textbook<float>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_textbook<double>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_textbook<long double>(const Scene&, const Disks&, State);
extern template std::unique_ptr<AnyEngine> make_textbook<Quad>(const Scene&, const Disks&, State);

namespace {

std::string never(const Scene& /*scene*/, const Disks& /*disks*/) { return ""; }

/// Squares of lengths and of products of speed and length, and masses, must be numbers of all digits in single precision, from
/// 1.2e-38 to 3.4e38, with room for sums.
std::string why_not_single(const Scene& scene, const Disks& disks) {
  constexpr double shortest = 1e-17, longest = 1e18, lightest = 1e-36, heaviest = 1e36;
  const double side = std::max(scene.box.lower.cwiseAbs().maxCoeff(), scene.box.upper.cwiseAbs().maxCoeff());
  if (side > longest)
    return fmt::format("coordinates reach to {:.6g}, and their squares are too large for single precision", side);
  for (const double radius : disks.radius)
    if (radius < shortest) return fmt::format("a radius is {:.6g}, and its square is too small for single precision", radius);
  for (const double mass : disks.mass)
    if (mass < lightest || mass > heaviest) return fmt::format("a mass is {:.6g}, beyond the range of single precision", mass);
  const double fastest = fastest_speed(scene);
  if (disks.count() == 0 || fastest == 0.0) return "";
  if (fastest * side > longest)
    return fmt::format(
        "speeds are {:.3g}, and the square of their product with {:.6g}, the farthest coordinate, is too large for "
        "single precision",
        fastest, side);
  if (const double smallest = radii_of(scene).smallest; fastest * smallest < shortest)
    return fmt::format(
        "speeds are {:.3g}, and the square of their product with {:.6g}, the smallest radius, is too small for "
        "single precision",
        fastest, smallest);
  return "";
}

}  // namespace

const std::vector<EngineEntry>& catalogue() {
  static const std::vector<EngineEntry> entries = {
      {.name = "fast",
       .why_not = &why_not_fast,
       .make = &make_fast,
       .takes_rules = false,
       .shares_out = true,
       .keeps_spins = false},
      {.name = "general", .why_not = &why_not_general, .make = &make_general, .shares_out = true},
      {.name = "textbook", .why_not = &never, .make = &make_textbook<double>},
      {.name = "textbook-float", .why_not = &why_not_single, .make = &make_textbook<float>},
      {.name = "textbook-long-double", .why_not = &never, .make = &make_textbook<long double>},
      {.name = "textbook-quad", .why_not = &never, .make = &make_textbook<Quad>},
  };
  return entries;
}

bool has_spins(const Scene& scene, const State& state) {
  return scene.effects.collision.roughness && state.spins.size() > 0 && !state.spins.isZero(0.0);
}

const EngineEntry& choose_engine(const Scene& scene, const Disks& disks, const std::string& engine, const EngineNeeds& needs) {
  const auto& entries = catalogue();
  const auto covering = [&](const auto& entry) {
    return (entry.takes_rules || !needs.own_rule) && (entry.keeps_spins || !needs.spins) && entry.covers(scene, disks);
  };
  const auto chosen = [&] {
    return std::find_if(entries.begin(), entries.end(), covering);  // there is one: the textbook engine covers everything
  };
  if (engine == "auto") return *chosen();
  const auto named = [&](const auto& entry) { return entry.name == engine; };
  const auto entry = std::find_if(entries.begin(), entries.end(), named);
  if (entry == entries.end())
    throw std::invalid_argument(
        fmt::format("there is no engine \"{}\"; choose one of auto, {}", engine, fmt::join(engine_names(), ", ")));
  if (const std::string reason = entry->why_not(scene, disks); !reason.empty()) {
    throw std::invalid_argument(
        fmt::format("the engine \"{}\" does not cover this scene: {}; leave the choice to carom, or take \"{}\"", engine, reason,
                    chosen()->name));
  }
  if (needs.spins && !entry->keeps_spins)
    throw std::invalid_argument(fmt::format(
        "the engine \"{}\" does not keep the spins that disks have; leave the choice to carom, or take \"general\"", engine));
  if (needs.own_rule && !entry->takes_rules)
    throw std::invalid_argument(fmt::format(
        "the engine \"{}\" does not call a collision rule of the program; leave the choice to carom, or take \"general\"",
        engine));
  return *entry;
}

std::string why_chosen(const EngineEntry& entry, const Scene& scene, const Disks& disks, const std::string& engine,
                       const EngineNeeds& needs) {
  if (engine != "auto") return engine_was_asked_for;
  const auto& entries = catalogue();
  const auto same = [&](const auto& other) { return other.name == entry.name; };
  const auto position = std::find_if(entries.begin(), entries.end(), same);
  if (position != entries.begin()) {
    const std::string why = std::prev(position)->why_not(scene, disks);
    if (!why.empty()) return why;
    return needs.own_rule ? "a collision rule of the program acts" : "disks have spins";
  }
  return scene.box.periodic(0) && scene.box.periodic(1) ? "nothing but the collision rule acts"
                                                        : "nothing but the collision rule and hard walls acts";
}

std::unique_ptr<AnyEngine> make_engine(const EngineEntry& entry, const Scene& scene, const Disks& disks, State start) {
  std::unique_ptr<AnyEngine> engine = entry.make(scene, disks, std::move(start));
  if (DrivenEngine::needed_by(scene.effects)) return std::make_unique<DrivenEngine>(std::move(engine), scene, disks);
  if (const double rate = scene.effects.drag_rate(); rate > 0.0) return std::make_unique<DragEngine>(std::move(engine), rate);
  return engine;
}

}  // namespace carom::detail
