#pragma once
// Classification of a fixed-step method's collisions: found, missed, repeated, spurious. It is made along the method's own
// trajectory, step by step, so that chaos does not matter: wherever the trajectory is, the next step is right or wrong.

#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <utility>

namespace carom {

/// Counts over the steps that were looked at. An encounter is the time from a pair's first reversal until it is apart and was not
/// reversed in the last step.
struct StepCounts {
  std::uint64_t steps = 0;
  double time = 0.0;           ///< simulated time of these steps
  std::uint64_t found = 0;     ///< encounters that begin with the reversal of an approaching pair: collisions
  std::uint64_t spurious = 0;  ///< encounters that begin with the reversal of a pair that was parting
  std::uint64_t repeated = 0;  ///< further reversals within an encounter
  std::uint64_t missed = 0;    ///< pairs that were in contact, between two steps or at some, and left it without a reversal
  double depth_sum = 0.0;      ///< of (sigma - |r|) / sigma over `found`, at the reversal
  double deepest = 0.0;        ///< the largest overlap of any pair in contact, in units of its sigma

  [[nodiscard]] std::uint64_t collisions() const { return found + missed; }
  [[nodiscard]] std::uint64_t reversals() const { return found + spurious + repeated; }
  /// Returns missed over all collisions that should happen.
  [[nodiscard]] double missed_fraction() const { return fraction(missed, collisions()); }
  /// Returns repeated over all reversals.
  [[nodiscard]] double repeated_fraction() const { return fraction(repeated, found + spurious + repeated); }
  [[nodiscard]] double spurious_fraction() const { return fraction(spurious, found + spurious + repeated); }
  [[nodiscard]] double mean_depth() const { return found == 0 ? 0.0 : depth_sum / static_cast<double>(found); }

 private:
  [[nodiscard]] static double fraction(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
  }
};

/// Looks on, step after step.
class StepAudit {
 public:
  StepAudit(const Box& box, const Disks& disks, double dt) : box_(box), disks_(disks), dt_(dt) {}

  /// The state at a step, after its check, and the reversals of that check in their order. O(N^2).
  void step(const State& state, std::span<const Event> reversals);

  [[nodiscard]] const StepCounts& counts() const { return counts_; }

 private:
  using Pair = std::pair<std::int32_t, std::int32_t>;

  [[nodiscard]] Eigen::Vector2d separation(const State& state, const Pair& pair) const;
  [[nodiscard]] double sigma(const Pair& pair) const;
  void look_at_reversals(const State& state, std::span<const Event> reversals);
  void look_at_flights(const State& state);

  const Box& box_;
  const Disks& disks_;
  double dt_;
  std::set<Pair> encounters_;  ///< encounters that have not ended
  std::set<Pair> reversed_last_step_;
  std::set<Pair> passed_;     ///< pairs counted as missed whose flights from the last step touch: a method may yet find them
  std::set<Pair> unnoticed_;  ///< pairs in contact at the last step that were not reversed since they touched
  StepCounts counts_;
};

/// Runs the method from `start` for `time`, or for as many steps (one at least) as examine `pair_limit` pairs. `proceed` is
/// called now and then; false ends the run. Requires a fixed-step method.
[[nodiscard]] StepCounts audit(const Scene& scene, const State& start, const FixedStep& method, double time, double pair_limit,
                               const std::function<bool()>& proceed = {});

}  // namespace carom
