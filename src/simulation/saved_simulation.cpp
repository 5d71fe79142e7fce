// A simulation written down and brought back, with what tells whether both are of one kind: the build, and the scene as far as it
// decides how the simulation goes on.

#include <carom/simulation.hpp>

#include "core/checked_stream.hpp"
#include "core/state_archive.hpp"
#include "scene/resolved_effects.hpp"
#include "simulation/parts.hpp"
#include "simulation/saved_simulation.hpp"
#include "simulation/start.hpp"

#include <carom/version.hpp>

#include <fmt/format.h>

#include <istream>
#include <ostream>
#include <sstream>
#include <string_view>
#include <utility>

namespace carom {

namespace {

constexpr std::string_view first_words = "carom simulation ";

std::string build() { return fmt::format("carom {} ({}, {})", build_info().version, build_info().commit, build_info().compiler); }

/// The first line. The number is that of the format of what follows: what one has written, another must not read.
std::string head() { return fmt::format("{}5 of {}", first_words, build()); }

std::runtime_error refusal(const std::string& sentence) {
  return std::runtime_error("the simulation cannot be restored: " + sentence);
}

/// The sizes of the disks of one species, which may have grown.
struct Sizes {
  double radius = 0.0;
  std::vector<double> radii = {};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(radius, radii);
  }
};

/// The changes to a saved simulation since it was made.
struct Changed {
  std::string effects;       ///< as TOML
  Box box;                   ///< its limits
  std::vector<Sizes> sizes;  ///< of each species
  std::uint64_t to_come;     ///< of the scene's own changes

  explicit Changed(const Scene& scene = {})
      : effects(detail::effects_toml(scene.effects)), box(scene.box), to_come(scene.changes.size()) {
    for (const Species& species : scene.species) sizes.push_back({species.radius, species.radii});
  }
  void change(Scene& scene) const {
    const std::optional<Circle> circle = scene.effects.circle;  // it belongs to the box
    scene.effects = detail::parse_effects(effects);
    scene.effects.circle = circle;
    scene.box.lower = box.lower;
    scene.box.upper = box.upper;
    while (scene.changes.size() > to_come) scene.changes.erase(scene.changes.begin());
    for (std::size_t s = 0; s < sizes.size(); ++s) {
      scene.species[s].radius = sizes[s].radius;
      scene.species[s].radii = sizes[s].radii;
    }
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(effects, box.lower, box.upper, sizes, to_come);
  }
};

/// The first line in which two texts differ, in one and in the other.
std::string difference(const std::string& saved, const std::string& given) {
  std::istringstream a(saved), b(given);
  std::string line, other;
  while (std::getline(a, line) && std::getline(b, other) && line == other) {
  }
  return fmt::format("it had \"{}\" in place of \"{}\"", line, other);
}

}  // namespace

void detail::check_saved_head(std::istream& in) {
  std::string line;
  char c = 0;
  while (line.size() < 200 && in.get(c) && c >= ' ' && c <= '~') line += c;
  if (!line.starts_with(first_words)) throw refusal("this was not written by Simulation::save()");
  if (!in || c != '\n') throw refusal("its first line is not whole");
  if (line == head()) return;
  const std::size_t by = line.find(" of ");
  throw refusal(fmt::format("{} has saved it, and only that one can go on to the last bit; this is {}",
                            by == std::string::npos ? "an earlier carom" : line.substr(by + 4), build()));
}

std::string detail::lasting_text(const Scene& scene) {
  Scene lasting = {.box = scene.box, .effects = scene.effects, .run = {.seed = scene.run.seed}, .changes = scene.changes};
  std::uint64_t lists = 0;
  for (const Species& species : scene.species) {
    lasting.species.push_back({.count = species.count, .radius = species.radius, .mass = species.mass});
    for (const std::vector<double>& list : {species.radii, species.masses})
      lists = checksum(lists, list.data(), list.size() * sizeof(double));
  }
  return fmt::format("{}# checksum of radii and masses one by one: {:016x}\n", resolved_toml(lasting), lists);
}

void Simulation::save(std::ostream& out) const {
  const Parts& parts = *parts_;
  const std::string now = detail::lasting_text(parts.scene);
  out << head() << '\n';
  write_checked(out, [&](std::ostream& within) {
    SavingArchive archive(within);
    archive(parts.made_of.value_or(now), now, Changed(parts.scene));
    archive(parts.engine_name, parts.engine_asked, parts.engine_reason, parts.time_step, parts.stiffness, has_collision_rule(),
            parts.clock_began);
    archive(parts.continuation.wall_draws, parts.continuation.thermostat_events, state());
    parts.engine->save(archive);
    archive(parts.standstill.has_value());
    if (parts.standstill) archive(*parts_->standstill);
  });
}

/// An engine is made for the state that was saved, and then told what the state does not show.
Simulation restore_simulation(const Scene& given, std::istream& in) {
  detail::check_saved_head(in);
  try {
    CheckedReading checked(in);
    std::istream within(&checked);
    LoadingArchive archive(within);
    std::string made_of, saved_with;
    Changed changed;
    archive(made_of, saved_with, changed);
    const std::string text = detail::lasting_text(given);
    // The scene of a simulation that was changed was checked then, as it would have begun there.
    if (text != saved_with || made_of == saved_with) check(given);
    Scene scene = given;
    if (text != saved_with) {
      if (text != made_of) throw SceneError({}, "the simulation was saved with another scene: " + difference(saved_with, text));
      changed.change(scene);
    }

    std::string name, asked, reason;
    std::optional<double> time_step, stiffness;
    bool own_rule = false, clock_began = false;
    std::uint64_t wall_draws = 0, thermostat_events = 0;
    Start start{disks_of(scene), {}};
    archive(name, asked, reason, time_step, stiffness, own_rule, clock_began, wall_draws, thermostat_events, start.state);
    Simulation simulation = time_step ? Simulation::begin(scene, std::move(start), FixedStep{name, *time_step, stiffness})
                                      : Simulation::begin(scene, std::move(start), name);
    Simulation::Parts& parts = *simulation.parts_;
    parts.engine_asked = std::move(asked);
    parts.engine_reason = std::move(reason);
    parts.rule_missing = own_rule;
    parts.clock_began = clock_began;
    parts.continuation.wall_draws = wall_draws;
    parts.continuation.thermostat_events = thermostat_events;
    if (made_of != saved_with) parts.made_of = std::move(made_of);
    parts.whole.reset();
    parts.keep_whole(given);
    parts.engine->load(archive);
    bool has_run = false;
    archive(has_run);
    if (has_run)
      archive(parts.standstill.emplace(*parts.engine, parts.disks.count(), parts.smallest_radius, parts.scene.effects,
                                       parts.has_rule()));
    if (!checked.at_end()) throw std::runtime_error("it holds more than a simulation");
    return simulation;
  } catch (const SceneError&) {
    throw;
  } catch (const cereal::Exception&) {
    throw refusal("it holds less than a simulation");
  } catch (const std::runtime_error& error) {
    throw refusal(error.what());
  }
}

}  // namespace carom
