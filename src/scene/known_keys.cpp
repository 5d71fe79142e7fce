#include "scene/known_keys.hpp"

#include "scene/effect_traits.hpp"
#include "scene/excerpt.hpp"
#include "scene/number_keys.hpp"
#include "scene/observables_known.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

namespace carom::detail {

namespace {

struct Meaning {
  std::string_view clause;
  std::string_view words;  ///< between blanks, in small letters without _ and -, but for those of one letter
};

constexpr std::array<Meaning, 14> meanings = {{
    {"events need no time step; the time between samples is sample_every in [run]",
     " dt deltat timestep step stepsize h saveevery saveinterval sampleinterval outputevery outputinterval "
     "dumpevery "},
    {"events need no steps; a run is as long as time or collisions in [run] says",
     " steps nsteps numsteps maxsteps timesteps iterations niter "},
    {"a run is as long as time or collisions in [run] says", " t tmax tend tfinal endtime totaltime runtime duration "},
    {"disks are described in [[disks]], where their number is count",
     " N n num number nparticles numparticles ndisks numdisks nballs natoms particles particle balls atoms "},
    {"the temperature is that of velocities = { temperature = 1.0 } in [[disks]], or of a [thermostat]", " T temp kt kbt "},
    {"the size of the box is given by x = [0.0, 10.0] and y = [0.0, 10.0] in [box]",
     " L l lx ly boxsize boxlength sidelength size length width height domain "},
    {"the size of a disk is radius in [[disks]], half its diameter", " r R d sigma diameter radii "},
    {"the mass of a disk is mass in [[disks]]", " m masses "},
    {"where disks start is positions in [[disks]]", " pos r0 x0 coords coordinates "},
    {"how disks start to move is velocities in [[disks]]", " v vel v0 "},
    {"the share of the box that disks cover is packing_fraction in [[disks]]",
     " phi eta density rho areafraction volumefraction packing "},
    {"the coefficient of restitution is restitution in [collision]", " e cor coefficientofrestitution "},
    {"gravity is acceleration = [0.0, -9.81] in [gravity]", " g "},
    {"walls or periodic edges are boundary in [box]", " pbc bc bcs boundaryconditions periodic "},
}};

}  // namespace

std::string_view meant_by(std::string_view word) {
  std::string plain;
  for (const char c : word) {
    if (c == '_' || c == '-') continue;
    plain += word.size() == 1 ? c : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  plain = " " + plain + " ";
  for (const Meaning& meaning : meanings) {
    if (meaning.words.find(plain) != std::string_view::npos) return meaning.clause;
  }
  return {};
}

namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Returns the table to which a key belongs, for keys that are in the wrong table rather than misspelt; empty for others.
std::string home_of(std::string_view key) {
  using Home = std::pair<std::string_view, std::string_view>;
  static constexpr Home homes[] = {{"grid", "a sweep, which carom sweep runs"},
                                   {"points", "a sweep, which carom sweep runs"},
                                   {"seeds", "a sweep, which carom sweep runs"},
                                   {"x", "[box]"},
                                   {"y", "[box]"},
                                   {"aspect", "[box]"},
                                   {"boundary", "[box]"},
                                   {"name", "[[disks]]"},
                                   {"count", "[[disks]]"},
                                   {"circle", "[box]; an obstacle is a disk, a segment or an arc"},
                                   {"radius", "[[disks]]"},
                                   {"mass", "[[disks]]"},
                                   {"species", "an entry of pairs in [non_additivity], or add_disk in [[changes]]"},
                                   {"packing_fraction", "[[disks]]"},
                                   {"positions", "[[disks]]"},
                                   {"velocities", "[[disks]]"},
                                   {"rule", "[collision]"},
                                   {"restitution", "[collision] or a wall in [walls]"},
                                   {"roughness", "[collision]"},
                                   {"elastic_below", "[collision]"},
                                   {"left", "[walls]"},
                                   {"right", "[walls]"},
                                   {"bottom", "[walls]"},
                                   {"top", "[walls]"},
                                   {"tangential_velocity", "a wall in [walls]"},
                                   {"vibration", "a wall in [walls]"},
                                   {"form", "vibration of a wall in [walls]"},
                                   {"amplitude", "vibration of a wall in [walls]"},
                                   {"frequency", "vibration of a wall in [walls]"},
                                   {"phase", "vibration of a wall in [walls]"},
                                   {"load", "a wall in [walls]"},
                                   {"centre", "a disk or an arc in [[obstacles]], or box.circle"},
                                   {"from", "a segment or an arc in [[obstacles]]"},
                                   {"to", "a segment or an arc in [[obstacles]]"},
                                   {"time", "[run]"},
                                   {"collisions", "[run]"},
                                   {"sample_every", "[run]"},
                                   {"sample_log", "[run]"},
                                   {"equilibrate", "[run]"},
                                   {"seed", "[run]"},
                                   {"keep_momentum", "[run]"},
                                   {"accept_overlap", "[run]"},
                                   {"trajectory", "[output]"},
                                   {"xyz", "[output]"},
                                   {"csv", "[output]"},
                                   {"events", "[output]"},
                                   {"unwrapped", "[output]"},
                                   {"uniform", "velocities = { ... }"},
                                   {"speed", "velocities = { ... }"},
                                   {"lognormal", "radius = { ... }"},
                                   {"per_area", "mass = { ... }"}};
  const auto* home = std::ranges::find(homes, key, &Home::first);
  if (home != std::end(homes)) return std::string(home->second);
  const std::string tables = tables_with_key(key);
  if (key == "temperature") return "velocities = { ... }, a wall in [walls] or " + tables;
  if (!tables.empty()) return tables;
  return find_observable(key) != nullptr ? "[observe]" : "";
}

/// Returns an example of an obstacle in which there is a key, which is not one of [[obstacles]] itself; empty for other words.
std::string shape_with_key(std::string_view key) {
  if (key == "centre" || key == "radius") return fmt::format("disk = {}", keys::disk_example);
  return key == "from" || key == "to" ? fmt::format("segment = {}", keys::segment_example) : "";
}

/// Returns the path of a table's title, "disks.0" for "[[disks]]"; empty for words that are no title.
std::string path_of_title(std::string_view title) {
  for (const std::string_view name : {"box", "collision", "run", "output"})
    if (title == fmt::format("[{}]", name)) return std::string(name);
  return title == "[[disks]]" ? "disks.0" : "";
}

/// Returns whether a user of another program might look here for all that its input file had. A radius in [[obstacles]] is
/// another one.
bool takes_foreign_words(std::string_view path) {
  static constexpr std::array<std::string_view, 6> tables = {"the scene",   "[box]", "[[disks]]",
                                                             "[collision]", "[run]", "[output]"};
  return std::find(tables.begin(), tables.end(), table_title(path)) != tables.end();
}

}  // namespace

std::string dotted_key_for(std::string_view word) {
  std::string key(word);
  std::replace(key.begin(), key.end(), '-', '_');
  if (key == "temperature") return "disks.0.velocities.temperature";
  if (key == "gravity") return "gravity.acceleration";
  if (key == "restitution") return "collision.restitution";
  const std::string path = path_of_title(home_of(key));
  return path.empty() ? "" : fmt::format("{}.{}", path, key);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + (same ? 0U : 1U)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  if (word.size() > 100) return best;  // no key of the format is near a word of that length
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    const bool something_in_common = distance < std::max(word.size(), candidate.size());
    if (something_in_common && distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string table_title(std::string_view path) {
  if (path.empty()) return "the scene";
  if (path.find('.') == std::string_view::npos) return fmt::format("[{}]", path);
  for (const std::string_view list : {"disks", "obstacles", "changes"}) {
    const bool entry = path.starts_with(list) && path.find('.', list.size() + 1) == std::string_view::npos;
    if (entry) return fmt::format("[[{}]]", list);
  }
  return std::string(path);
}

std::string unknown_key_sentence(std::string_view key, std::string_view path, std::span<const std::string_view> known) {
  const std::string problem = fmt::format("{} has no key \"{}\"", table_title(path), excerpt(key, 60));
  // One edit away from a key of this table is a slip of the finger, whatever the word means elsewhere: [[disk]] for [[disks]].
  const std::string_view near = nearest_word(key, known);
  if (takes_foreign_words(path) && !meant_by(key).empty()) return fmt::format("{}; {}", problem, meant_by(key));
  if (const std::string shape = shape_with_key(key); table_title(path) == "[[obstacles]]" && !shape.empty())
    return fmt::format("{}; it belongs to a shape in it, such as {}", problem, shape);
  const std::string home = !near.empty() && edit_distance(key, near) == 1 ? std::string() : home_of(key);
  if (!home.empty()) return fmt::format("{}; it belongs to {}", problem, home);
  if (key == "title") return problem + "; it belongs to the top of the file, before the first [table]";
  if (!near.empty()) return fmt::format("{}; did you mean \"{}\"?", problem, near);
  return fmt::format("{}; its keys are {}", problem, fmt::join(known, ", "));
}

}  // namespace carom::detail
