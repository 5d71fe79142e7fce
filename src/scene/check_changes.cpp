// The list of changes of a scene: times within the run and in order, effects that exist, and after each change a scene that could
// have begun so. Whether disks are in the way is known only when the run has come there.

#include "scene/changes.hpp"
#include "scene/checks.hpp"
#include "scene/contact_scales.hpp"
#include "scene/document.hpp"
#include "scene/effect_traits.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace carom::detail {
namespace {

constexpr const char* advice_on_disks =
    "a run has the same disks from start to end, so give such changes by carom run --changes, or in the playground";

void check_kind(const Change& change, const std::string& path) {
  const auto refuse = [&](const char* key) {
    throw Refusal(path + "." + key, fmt::format("{}.{} changes the disks; {}", path, key, advice_on_disks));
  };
  if (std::holds_alternative<AddDisk>(change.what)) refuse("add_disk");
  if (std::holds_alternative<RemoveDisk>(change.what)) refuse("remove_disk");
  if (std::holds_alternative<MoveDisk>(change.what)) refuse("move_disk");
  if (const auto* scale = std::get_if<ScaleVelocities>(&change.what); scale != nullptr && !std::isfinite(scale->factor))
    throw Refusal(path + ".scale_velocities", fmt::format("{}.scale_velocities is {}; it must be a finite number, such as "
                                                          "scale_velocities = -1.0",
                                                          path, scale->factor));
  if (const auto* set = std::get_if<SetKeys>(&change.what))
    for (const std::string& text : set->overrides)
      if (const std::string_view key = key_of_override(text); key == "disks" || key.starts_with("disks."))
        throw Refusal(path + ".set", fmt::format("{}.set has {}; {}", path, key, advice_on_disks));
}

void check_time(const Scene& scene, std::size_t k, const std::string& path) {
  const double time = scene.changes[k].time;
  if (!(time >= 0.0) || !std::isfinite(time))
    throw Refusal(path + ".time",
                  fmt::format("{}.time is {}; it must be a finite number, zero or more, such as time = 2.5", path, time));
  if (k > 0 && time < scene.changes[k - 1].time)
    throw Refusal(path + ".time", times_out_of_order(k, time, scene.changes[k - 1].time));
  if (scene.run.time && time >= *scene.run.time)
    throw Refusal(path + ".time", fmt::format("{}.time is {}, and the run ends at time {}; make the change earlier, or the run "
                                              "longer",
                                              path, time, *scene.run.time));
}

/// Returns what is the same in all stretches of the run.
Scene first_stage_of(const Scene& scene) {
  Scene stage = scene;
  for (Species& species : stage.species) species.positions = RandomPositions{};
  stage.changes.clear();
  stage.observe.clear();
  return stage;
}

/// Checks a scene with the effects of one stretch of the run, which lasts as long as that.
void check_stage(Scene& stage, const Effects& effects, const Box& box, std::optional<double> lasts) {
  stage.effects = effects;
  stage.box = box;
  stage.run.time = lasts;
  check_numbers(stage);
  check_fixed_shapes(stage);
  check_effects(stage);
  check_scales(stage);
}

/// Moves walls of given velocities. Where pistons get to is not known.
void move_walls(Box& box, const Effects& effects, double time) {
  for (std::size_t w = 0; w < effects.walls.size(); ++w) {
    const auto axis = static_cast<Eigen::Index>(w / 2);
    (w % 2 == 0 ? box.lower : box.upper)[axis] += effects.walls[w].velocity.value_or(0.0) * time;
  }
}

/// Puts a wall that vibrates no more, or otherwise, to where it has come to. One that goes on vibrating is checked from its
/// start. Where that is unknown, it is as far outside as it comes: the run itself looks again.
class VibratingWalls {
 public:
  /// `equilibrated` is how long walls move before the measured run; none where that is known only when it is over.
  explicit VibratingWalls(std::optional<double> equilibrated) {
    since_.fill(equilibrated ? std::optional(-*equilibrated) : std::nullopt);
  }

  /// From `time` on the walls move as `now` says; until then they did as `before` says. Times count from the start of the
  /// measured run.
  void change(Box& box, const Effects& before, const Effects& now, double time) {
    for (std::size_t w = 0; w < since_.size(); ++w) {
      const auto &one = before.walls[w].oscillation, &other = now.walls[w].oscillation;
      if (one == other) continue;
      double inward = 0.0;
      if (one) inward = since_[w] ? inward_after(*one, time - *since_[w]) : inward_reach(*one) - 2.0 * one->amplitude;
      if (w % 2 == 0)
        box.lower[static_cast<Eigen::Index>(w / 2)] += inward;
      else
        box.upper[static_cast<Eigen::Index>(w / 2)] -= inward;
      since_[w] = time;
    }
  }

 private:
  std::array<std::optional<double>, 4> since_;
};

bool contact_distances_differ(const Scene& scene, const Effects& now, const Effects& before) {
  const auto deltas = [&](const Effects& effects) {
    return deltas_of(effects.non_additivity.value_or(NonAdditivity{}), scene.species.size());
  };
  return (now.non_additivity || before.non_additivity) && deltas(now) != deltas(before);
}

/// Observables know one flow and one clock.
void check_observables(const Scene& scene, const Effects& now, const Effects& before, const std::string& path) {
  if (scene.observe.empty()) return;
  if (contact_distances_differ(scene, now, before))
    throw Refusal(
        path, fmt::format("{} changes [non_additivity], and observables know one contact distance of two species only; remove "
                          "[observe], or make a run of each delta",
                          path));
  if (now.shear_rate() == before.shear_rate() && now.drag_rate() == before.drag_rate() &&
      now.growth_rate() == before.growth_rate())
    return;
  throw Refusal(path,
                fmt::format("{} changes shear, growth or drag, and observables know one rate only; remove [observe], or make "
                            "a run of each rate",
                            path));
}

}  // namespace

void check_changes(const Scene& scene) {
  Effects now = scene.effects;
  Box box = scene.box;
  VibratingWalls vibrating(scene.run.equilibrate ? scene.run.equilibrate->time : 0.0);
  const double equilibrated = scene.run.equilibrate ? scene.run.equilibrate->time.value_or(0.0) : 0.0;
  double since = 0.0;
  const auto until = [&](std::size_t k) -> std::optional<double> {
    return k < scene.changes.size() ? std::optional(scene.changes[k].time) : scene.run.time;
  };
  for (std::size_t k = 0; k < scene.changes.size(); ++k) check_time(scene, k, fmt::format("changes.{}", k));
  Scene stage = first_stage_of(scene);
  check_stage(stage, now, box, until(0));
  stage.run.equilibrate.reset();
  for (std::size_t k = 0; k < scene.changes.size(); ++k) {
    const Change& change = scene.changes[k];
    const std::string path = fmt::format("changes.{}", k);
    check_kind(change, path);
    move_walls(box, now, change.time - since + (k == 0 ? equilibrated : 0.0));
    since = change.time;
    const Effects before = now;
    try {
      now = effects_after(before, change);
      vibrating.change(box, before, now, change.time);
      const std::optional<double> end = until(k + 1);
      check_stage(stage, now, box, end ? std::optional(*end - change.time) : std::nullopt);
    } catch (const Refusal& refusal) {
      throw Refusal(path, fmt::format("{}: {}", path, refusal.what()));
    } catch (const SceneError& error) {
      throw Refusal(path, fmt::format("{}: {}", path, error.sentence()));
    }
    check_observables(scene, now, before, path);
  }
}

}  // namespace carom::detail
