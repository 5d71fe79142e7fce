#include "studies/compare/side_by_side_option.hpp"

#include "studies/compare/side_by_side.hpp"
#include "studies/compare/side_by_side_page.hpp"
#include "terminal/command.hpp"
#include "text/number_in.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace carom::cli {

namespace {

double step_in(const std::string& text, const std::string& number) {
  const std::optional<double> dt = number_in<double>(number);
  if (!dt || !(*dt > 0.0 && std::isfinite(*dt)))
    throw UsageError(fmt::format("--play {}: after the colon stands a time step, positive and finite, as in guarded:0.01", text));
  return *dt;
}

}  // namespace

PlayChoice checked_play(const std::string& text, const Scene& scene, std::optional<double> stiffness) {
  if (!scene.effects.neutral())
    throw UsageError(
        fmt::format("{}: --play shows disks on which nothing acts but the collision rule, and this scene asks for {}; leave one "
                    "of the two out",
                    scene.source, words_beyond_the_rule(scene.effects)));
  PlayChoice choice;
  const std::size_t colon = text.find(':');
  if (!text.empty()) choice.method = text.substr(0, colon);
  if (colon != std::string::npos) choice.dt = step_in(text, text.substr(colon + 1));
  const std::vector<std::string> names = fixed_step_names();
  if (std::find(names.begin(), names.end(), choice.method) == names.end())
    throw UsageError(fmt::format("--play {}: there is no fixed-step method \"{}\"; choose one of {}", text, choice.method,
                                 fmt::join(names, ", ")));
  if (choice.method == "soft") choice.stiffness = stiffness;
  if (scene.disk_count() > most_disks_side_by_side)
    throw UsageError(
        fmt::format("--play: {} disks are too many to be told apart side by side; {} can be shown, so take fewer, or "
                    "leave --play out",
                    scene.disk_count(), most_disks_side_by_side));
  if (choice.dt) {
    if (scene.run.time && *choice.dt > *scene.run.time)
      throw UsageError(fmt::format("--play {}: the scene's run ends at time {:g}, within the first step", text, *scene.run.time));
    try {
      (void)make_simulation(scene, FixedStep{choice.method, *choice.dt, choice.stiffness});
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("--play {}: {}", text, error.what()));
    }
  }
  return choice;
}

std::optional<SideBySidePage> make_side_by_side(const PlayChoice& choice, const Scene& scene, const std::string& engine,
                                                const ComparePlan& plan, const State& start, const std::string& command_line,
                                                const std::function<bool(double fraction)>& proceed) {
  SideBySideOptions options;
  options.step = {choice.method, choice.dt.value_or(visible_step(plan, start)), choice.stiffness};
  options.engine = engine;
  options.until = scene.run.time && *scene.run.time > 0.0 ? *scene.run.time : plan.until();
  options.free_time = plan.mean_free_time;
  options.sigma = plan.sigma;
  options.proceed = proceed;
  const SideBySide shown = fly_side_by_side(scene, start, options);
  if (shown.because == ShownUntil::stopped) return {};
  return SideBySidePage{side_by_side_page(shown, scene, plan.horizon.lyapunov, command_line), why_no_longer(shown, scene)};
}

}  // namespace carom::cli
