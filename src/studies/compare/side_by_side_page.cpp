// Packs both sides for src/pages/side_by_side/*.js, and says in words what is seen there.

#include "studies/compare/side_by_side_page.hpp"

#include <carom/pages/page.hpp>
#include "pages/player_page.hpp"
#include "pages/player_parts.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace carom {

namespace {

using Json = nlohmann::ordered_json;
using detail::NumberColumns;

constexpr std::array<std::string_view, 4> panel_scripts = {"side_by_side/distances.js", "side_by_side/overlaps.js",
                                                           "side_by_side/curves.js", "side_by_side/panel.js"};

std::vector<std::string> species_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Species& species : scene.species) names.push_back(species.name);
  return names;
}

void put_steps(const SideBySide& shown, NumberColumns& columns) {
  std::vector<std::uint32_t> step;
  std::vector<std::uint16_t> disk, first, second;
  std::vector<double> velocity, begin, end;
  std::vector<float> depth;
  for (const Turn& turn : shown.turns) {
    step.push_back(turn.step);
    disk.push_back(static_cast<std::uint16_t>(turn.disk));
    velocity.insert(velocity.end(), {turn.velocity.x(), turn.velocity.y()});
  }
  for (const Overlap& overlap : shown.overlaps) {
    first.push_back(static_cast<std::uint16_t>(overlap.first));
    second.push_back(static_cast<std::uint16_t>(overlap.second));
    begin.push_back(overlap.begin);
    end.push_back(overlap.end);
    depth.push_back(static_cast<float>(overlap.depth));
  }
  columns.add("turnStep", step);
  columns.add("turnDisk", disk);
  columns.add("turnVelocity", velocity);
  columns.add("overlapFirst", first);
  columns.add("overlapSecond", second);
  columns.add("overlapBegin", begin);
  columns.add("overlapEnd", end);
  columns.add("overlapDepth", depth);
  columns.add("distanceTime", shown.times);
  columns.add("distance", shown.distance);
}

std::string growth_words(const SideBySide& shown, const std::optional<Lyapunov>& lyapunov) {
  const std::string what = "Disks are convex mirrors: every collision turns a small distance into a larger one";
  if (!lyapunov || !lyapunov->is_chaotic()) return what + ".";
  const double time = 1.0 / lyapunov->per_time;
  return fmt::format(
             "{}, on average by a factor e in every Lyapunov time, here {:.3g} or {:.2g} collisions of a disk. So the curve "
             "rises as a straight line until disks have lost each other{}.",
             what, time, time * lyapunov->collision_rate,
             finds_contacts(shown.step.method)
                 ? std::string()  // it is right until a step is wrong
                 : fmt::format(", and a step ten times shorter gains {:.3g} of time and no more", std::log(10.0) * time)) +
         (shown.parted_at() ? "" : " Here the two are still near each other at the end.");
}

std::string energy_words(const SideBySide& shown) {
  const std::string changes = fmt::format("{:.1g} of it on the exact side and {:.1g} on the other", shown.energy_change_exact,
                                          shown.energy_change_stepped);
  if (shown.energy_change_stepped < 1e-9)
    return "Energy is conserved: the largest change is " + changes + ". It does not show overlaps and distances.";
  return "Energy changes, by up to " + changes + ".";
}

Json words_of(const SideBySide& shown, const Scene& scene, const std::optional<Lyapunov>& lyapunov) {
  const std::string no_longer = why_no_longer(shown, scene);
  const std::string step = shown.free_time > 0.0 ? fmt::format(" ({:.2g} mean free times)", shown.step.dt / shown.free_time) : "";
  return {{"what",
           fmt::format("{} from one start: left from collision to collision, each at its instant; right in steps of {:.3g}{}, "
                       "{} ({}).",
                       counted(shown.disks.count(), "disk"), shown.step.dt, step,
                       shown.step.method == "swept" ? "with a search for the contacts within each"
                                                    : "with a look for overlaps after each",
                       shown.step.method)},
          {"growth", growth_words(shown, lyapunov)},
          {"window", no_longer.empty() ? "" : "S" + no_longer.substr(1) + "."},
          {"energy", energy_words(shown)}};
}

}  // namespace

std::string why_no_longer(const SideBySide& shown, const Scene& scene) {
  if (shown.because == ShownUntil::end) return {};
  const std::string until = scene.run.time ? fmt::format("shown until time {:.4g} of {:.4g}", shown.until, *scene.run.time)
                                           : fmt::format("shown until time {:.4g}", shown.until);
  switch (shown.because) {
    case ShownUntil::end:
      break;
    case ShownUntil::parted:
      return fmt::format("{}: the two are half a diameter apart at {:.3g}, and go their own ways from there", until,
                         shown.parted_at().value_or(0.0));
    case ShownUntil::numbers:
      return until + ": a page holds no more collisions and turns";
    case ShownUntil::work:
      return until + ": more steps of this length would take too long";
    case ShownUntil::stuck:
      return until + ": time stands still in the exact run, where disks have no room to move";
    case ShownUntil::stopped:
      return until + ": it was interrupted";
  }
  return until;
}

std::string side_by_side_page(const SideBySide& shown, const Scene& scene, const std::optional<Lyapunov>& lyapunov,
                              const std::string& command_line) {
  NumberColumns columns;
  Json json = detail::player_description(scene, scene.title, species_names(scene), shown.disks.count());
  json["exact"] = true;
  json["duration"] = shown.until;
  detail::put_disks(shown.disks, columns);
  detail::put_events(scene, shown.disks, shown.start, shown.events, VelocityDigits::twice, columns, json);
  put_steps(shown, columns);
  json["sigma"] = shown.sigma;
  json["steps"] = {{"method", shown.step.method},
                   {"dt", shown.step.dt},
                   {"count", static_cast<std::uint64_t>(shown.until / shown.step.dt * (1.0 + 1e-12))}};
  json["lyapunov"] = nullptr;
  if (lyapunov && lyapunov->is_chaotic()) json["lyapunov"] = {{"perTime", lyapunov->per_time}};
  json["words"] = words_of(shown, scene, lyapunov);
  Facts facts = {{"Units", "those of the scene; distances in mean diameters"},
                 {"Scene", scene.source},
                 {"Seed", std::to_string(scene.run.seed)},
                 {"Exact side", shown.engine + " engine"},
                 {"Command", command_line}};
  add_build(facts);
  json["facts"] = facts;
  json["columns"] = columns.list();
  return player_page({.description = json.dump(-1, ' ', false, Json::error_handler_t::replace), .columns = columns.take_bytes()},
                     {side_by_side_mark, "Exact events and fixed steps", "side_by_side/side_by_side.html",
                      "side_by_side/sides.js", panel_scripts});
}

}  // namespace carom
