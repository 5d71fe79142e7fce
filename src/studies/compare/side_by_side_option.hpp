#pragma once
// The option --play of carom compare, and the page that it makes.

#include "studies/compare/comparison.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <functional>
#include <optional>
#include <string>

namespace carom::cli {

inline constexpr std::string_view side_by_side_file = "side_by_side.html";

/// METHOD[:DT]; "" for the guarded method.
struct PlayChoice {
  std::string method = "guarded";
  std::optional<double> dt;         ///< empty: one of the study's
  std::optional<double> stiffness;  ///< of the springs of soft; empty: a contact takes 30 steps
};

/// Throws UsageError where the text names no method, or no step that can be taken with this scene, its disks are too many, or
/// what acts on them bends their flights.
[[nodiscard]] PlayChoice checked_play(const std::string& text, const Scene& scene, std::optional<double> stiffness = {});

struct SideBySidePage {
  std::string html;
  std::string shorter;  ///< words where less than the scene's run is shown
};

/// Flies both from `start`. Empty where `proceed` said stop.
[[nodiscard]] std::optional<SideBySidePage> make_side_by_side(const PlayChoice& choice, const Scene& scene,
                                                              const std::string& engine, const ComparePlan& plan,
                                                              const State& start, const std::string& command_line,
                                                              const std::function<bool(double fraction)>& proceed);

}  // namespace carom::cli
