#pragma once
// Steps with a mistake, of a method that finds contacts within a step: how often it misses a pair or takes two collisions of one
// disk in the wrong order.

#include "studies/horizon/method.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>

namespace carom {

/// Counts over the steps that were compared.
struct StepMistakes {
  std::uint64_t steps = 0;
  std::uint64_t mistaken = 0;  ///< after them a disk is not where exact events from the step's beginning bring it

  [[nodiscard]] double fraction() const { return steps == 0 ? 0.0 : static_cast<double>(mistaken) / static_cast<double>(steps); }
};

/// Runs a fixed-step method from `start` until `time`, for `most_steps` steps at most, and compares each of its steps with exact
/// events from where the step began, so that chaos does not matter. A step has a mistake if a disk ends more than 1e-9 mean
/// diameters away from where exact events bring it, or if exact events cannot begin where it began because disks overlap there.
/// `proceed` is called before every step; false ends the run.
[[nodiscard]] StepMistakes mistakes_of(const Scene& scene, const State& start, const Method& method, double time,
                                       std::uint64_t most_steps, const std::function<bool()>& proceed = {});

}  // namespace carom
