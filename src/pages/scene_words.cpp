#include "pages/scene_words.hpp"

#include "pages/effects_words.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace carom {

namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

std::string value_or_range(double same, const std::vector<double>& each) {
  if (each.empty()) return fmt::format("{:.6g}", same);
  const auto [least, most] = std::minmax_element(each.begin(), each.end());
  return *least == *most ? fmt::format("{:.6g}", *least) : fmt::format("{:.6g} to {:.6g}", *least, *most);
}

std::string words(const Positions& positions) {
  return std::visit(Overloaded{[](const RandomPositions&) { return std::string("at random positions"); },
                               [](const SquareLattice&) { return std::string("on a square lattice"); },
                               [](const HexagonalLattice&) { return std::string("on a hexagonal lattice"); },
                               [](const GrownPositions&) { return std::string("at random positions, grown to their size"); },
                               [](const ListedPositions&) { return std::string("at the positions listed"); },
                               [](const FilePositions& file) { return fmt::format("at the positions in {}", file.path); }},
                    positions);
}

std::string words(const Velocities& velocities) {
  return std::visit(
      Overloaded{[](const AtRest&) { return std::string("at rest"); },
                 [](const UniformVelocities& v) { return fmt::format("velocities uniform in [-{0:.6g}, {0:.6g}]", v.maximum); },
                 [](const MaxwellVelocities& v) { return fmt::format("Maxwell velocities at kT = {:.6g}", v.temperature); },
                 [](const FixedSpeed& v) { return fmt::format("all with speed {:.6g}", v.speed); },
                 [](const ListedVelocities&) { return std::string("with the velocities listed"); },
                 [](const FileVelocities&) { return std::string("with the velocities of that file"); }},
      velocities);
}

std::string words(const Box& box, const std::array<WallProperties, 4>& properties) {
  const bool hard = std::none_of(properties.begin(), properties.end(), [](const WallProperties& wall) { return wall.present(); });
  const std::string walls = hard ? "hard walls" : "walls";  // the others are described among the effects

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
  rows.push_back({"run", words(scene.run)});
  if (!scene.observe.empty()) rows.push_back({"observables", words(scene.observe)});
  return rows;
}

}  // namespace carom
