#include "pages/scene_words.hpp"

#include "scene/changes.hpp"
#include "scene/effect_traits.hpp"
#include "scene/walls.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/hana/functional/overload.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

std::string words(const Collision& collision) {
  std::string text = collision.rule == CollisionRule::reversal
                         ? "reversal: a collision reverses the whole relative velocity"
                         : "specular: a collision reverses the relative velocity along the line of centres";
  if (collision.restitution) text += fmt::format("; restitution {:.6g}", *collision.restitution);
  if (collision.roughness) text += fmt::format("; roughness {:.6g}: disks spin", *collision.roughness);
  if (collision.elastic_below) {
    text += fmt::format("; elastic within time {:.6g} of the last collision of either disk", *collision.elastic_below);
  }
  return text;
}

std::string words(const WallProperties& wall, int axis) {
  std::vector<std::string> parts;
  if (wall.mass) parts.push_back(fmt::format("a free piston of mass {:.6g} under load {:.6g}", *wall.mass, *wall.load));
  if (wall.temperature) parts.push_back(fmt::format("thermal, kT = {:.6g}", *wall.temperature));
  if (wall.tangential_velocity)
    parts.push_back(fmt::format("slides at {:.6g} in {}", *wall.tangential_velocity, axis == 0 ? "y" : "x"));
  if (wall.vibration) parts.push_back(fmt::format("vibrates at speed {:.6g}, without amplitude", *wall.vibration));
  if (const auto& motion = wall.oscillation)
    parts.push_back(fmt::format("vibrates as a {} of amplitude {:.6g} and frequency {:.6g}{}",
                                motion->form == WaveForm::sine ? "sine" : "sawtooth", motion->amplitude, motion->frequency,
                                motion->phase != 0.0 ? fmt::format(", from phase {:.6g}", motion->phase) : std::string()));
  if (wall.restitution) parts.push_back(fmt::format("restitution {:.6g}", *wall.restitution));
  if (wall.velocity) parts.push_back(fmt::format("moves at {:.6g} in {}", *wall.velocity, axis == 0 ? "x" : "y"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

SummaryRows words_of(const Effects& effects) {
  SummaryRows rows;
  const auto put = [&](const char* subject, std::string text) { rows.push_back({subject, std::move(text)}); };
  put("collisions", words(effects.collision));
  for (std::size_t w = 0; w < effects.walls.size(); ++w) {
    if (!effects.walls[w].present()) continue;
    put("wall", fmt::format("{}: {}", wall_names[w], words(effects.walls[w], axis_of_wall(w))));
  }
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    if (effect.words == nullptr || !effect.is_present(effects)) continue;
    std::string subject(effect.name);
    std::replace(subject.begin(), subject.end(), '_', ' ');
    rows.push_back({std::move(subject), effect.words(effects)});
  }
  return rows;
}

std::string absent(const Effects& effects) {
  std::vector<std::string_view> names;
  for (const detail::EffectTraits& effect : detail::all_effects()) {
    const auto is_there = [&](const detail::EffectTraits& other) {
      return other.absence == effect.absence && other.is_present(effects);
    };
    if (effect.absence.empty() || std::ranges::find(names, effect.absence) != names.end()) continue;
    if (std::ranges::none_of(detail::all_effects(), is_there)) names.push_back(effect.absence);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string conserved(const Box& box, const Effects& effects) {
  const bool x = conserves_momentum(box, effects, 0), y = conserves_momentum(box, effects, 1);
  std::vector<std::string_view> names;
  if (detail::conserve_energy(effects)) names.emplace_back("energy");
  if (x || y) names.emplace_back(x && y ? "momentum" : x ? "momentum along x" : "momentum along y");
  if (effects.collision.rule == CollisionRule::specular &&
      detail::all_acting(effects, &detail::EffectTraits::conserves_angular_momentum))
    names.emplace_back(box.is_circle ? "angular momentum about the centre" : "angular momentum in collisions of disks");
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

namespace {

std::string value_or_range(double same, const std::vector<double>& each) {
  if (each.empty()) return fmt::format("{:.6g}", same);
  const auto [least, most] = std::minmax_element(each.begin(), each.end());
  return *least == *most ? fmt::format("{:.6g}", *least) : fmt::format("{:.6g} to {:.6g}", *least, *most);
}

std::string words(const Positions& positions) {
  return std::visit(boost::hana::overload(
                        [](const RandomPositions& random) {
                          return std::string(random.region ? "at random positions in a part of the box" : "at random positions");
                        },
                        [](const SquareLattice&) { return std::string("on a square lattice"); },
                        [](const HexagonalLattice&) { return std::string("on a hexagonal lattice"); },
                        [](const GrownPositions&) { return std::string("at random positions, grown to their size"); },
                        [](const ListedPositions&) { return std::string("at the positions listed"); },
                        [](const FilePositions& file) { return fmt::format("at the positions in {}", file.path); }),
                    positions);
}

std::string words(const Velocities& velocities) {
  return std::visit(
      boost::hana::overload(
          [](const AtRest&) { return std::string("at rest"); },
          [](const UniformVelocities& v) { return fmt::format("velocities uniform in [-{0:.6g}, {0:.6g}]", v.maximum); },
          [](const MaxwellVelocities& v) { return fmt::format("Maxwell velocities at kT = {:.6g}", v.temperature); },
          [](const FixedSpeed& v) { return fmt::format("all with speed {:.6g}", v.speed); },
          [](const ListedVelocities&) { return std::string("with the velocities listed"); },
          [](const FileVelocities&) { return std::string("with the velocities of that file"); }),
      velocities);
}

std::string words(const Box& box, const std::array<WallProperties, 4>& properties) {
  const bool hard = std::none_of(properties.begin(), properties.end(), [](const WallProperties& wall) { return wall.present(); });
  const std::string walls = hard ? "hard walls" : "walls";  // the others are described among the effects

  if (box.is_circle)
    return fmt::format("circle of radius {:.6g} round ({:.6g}, {:.6g})", 0.5 * box.lengths().x(),
                       0.5 * (box.lower.x() + box.upper.x()), 0.5 * (box.lower.y() + box.upper.y()));
  const std::string limits =
      fmt::format("[{:.6g}, {:.6g}] x [{:.6g}, {:.6g}]", box.lower.x(), box.upper.x(), box.lower.y(), box.upper.y());
  if (box.periodic(0) && box.periodic(1)) return limits + ", periodic";
  if (!box.periodic(0) && !box.periodic(1)) return fmt::format("{}, {} on all sides", limits, walls);
  return fmt::format("{}, periodic in {}, {} in {}", limits, box.periodic(0) ? "x" : "y", walls, box.periodic(0) ? "y" : "x");
}

std::string words(const Run& run) {
  std::string text;
  if (run.equilibrate) {
    text = run.equilibrate->time
               ? fmt::format("equilibrate for time {:.6g}, then measure ", *run.equilibrate->time)
               : fmt::format("equilibrate for {:.6g} collisions per disk, then measure ", *run.equilibrate->collisions_per_disk);
  }
  text += "until ";
  if (run.time) text += fmt::format("time {:.6g}", *run.time);
  if (run.time && run.collisions) text += " or ";
  if (run.collisions) text += counted(*run.collisions, "pair collision");
  if (run.is_sampled()) text += ", samples " + sampling_words(run);
  return text + fmt::format("; seed {}", run.seed);
}

/// Returns text such as "temperature, radial_distribution every 0.5"
std::string words(const std::vector<ObservableRequest>& requests) {
  std::string text;
  for (const ObservableRequest& request : requests) {
    text += (text.empty() ? "" : ", ") + request.name;
    if (request.every) text += fmt::format(" every {:.6g}", *request.every);
  }
  return text;
}

/// One row for each of a few changes; many are counted.
SummaryRows words_of_changes(const std::vector<Change>& changes) {
  constexpr std::size_t most = 8;
  if (changes.size() > most)
    return {
        {"changes", fmt::format("{}, from time {:.6g} to {:.6g}", changes.size(), changes.front().time, changes.back().time)}};
  SummaryRows rows;
  for (const Change& change : changes) {
    const std::string text = changes_text(change);  // its second line has what it changes
    const std::size_t begin = text.find('\n', text.find("time")) + 1;
    rows.push_back({"change", fmt::format("at time {:.6g}, {}", change.time, text.substr(begin, text.size() - begin - 1))});
  }
  return rows;
}

}  // namespace

std::string sampling_words(const Run& run) {
  if (run.sample_every) return fmt::format("every {:.6g}", *run.sample_every);
  if (run.sample_every_collisions) return "every " + counted(*run.sample_every_collisions, "collision");
  const SampleLog& log = *run.sample_log;
  return fmt::format("{} in each block of {:.6g}, spaced by powers of {:.6g}", log.per_block, log.block, log.base);
}

SummaryRows words_of(const Scene& scene) {
  SummaryRows rows;
  for (const Species& species : scene.species)
    rows.push_back(
        {"disks",
         fmt::format("{} ({}), radius {}, mass {}, {}, {}", grouped(static_cast<std::uint64_t>(species.count)), species.name,
                     value_or_range(species.radius, species.radii), value_or_range(species.mass, species.masses),
                     words(species.positions), words(species.velocities))});
  rows.push_back(
      {"box", fmt::format("{}; packing fraction {:.4g}", words(scene.box, scene.effects.walls), scene.packing_fraction())});
  for (const SummaryRow& row : words_of(scene.effects)) rows.push_back(row);
  for (const SummaryRow& row : words_of_changes(scene.changes)) rows.push_back(row);
  rows.push_back({"run", words(scene.run)});
  if (!scene.observe.empty()) rows.push_back({"observables", words(scene.observe)});
  return rows;
}

}  // namespace carom
