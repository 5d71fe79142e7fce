#pragma once
// What steps that know the moment of contact are held against: the search of all pairs, and the exact engine.

#include "stepper/backtrack.hpp"
#include "stepper/stepper.hpp"
#include "support/exact_run.hpp"
#include "support/same_events.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace carom::test {

/// A fluid of 256 disks after 50 collisions per disk, followed with that step.
struct Fluid {
  double packing_fraction, end, dt;
};

/// Holds a method against exact events in a fluid under both rules. Returns the smaller number of pair collisions.
inline std::uint64_t expect_right_to_rounding(const std::string& method, const Fluid& fluid) {
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max();
  for (const CollisionRule rule : both_rules) {
    Scene scene = gas_scene(256, fluid.packing_fraction, Boundary::periodic, 3);
    scene.effects.collision.rule = rule;
    Simulation run_up = make_simulation(scene);
    run_up.run_until(1e300, {.collisions = 25 * 256});
    run_up.run_until(run_up.time() + 1e-6);
    const State start = run_up.state();
    Simulation exact = make_simulation(scene, start, "textbook-long-double");
    exact.run_until(fluid.end);
    Simulation s = make_simulation(scene, start, FixedStep{method, fluid.dt});
    s.run_until(fluid.end);
    EXPECT_EQ(s.totals().pair, exact.totals().pair) << fluid.packing_fraction;
    EXPECT_LT(rms_difference(scene, s.state(), exact.state()), 1e-13) << fluid.packing_fraction;
    fewest = std::min(fewest, s.totals().pair);
  }
  return fewest;
}

/// All pairs, one by one, in the place of the list.
class EveryPair {
 public:
  EveryPair(const Bodies& bodies, double /*dt*/, double /*least_margin*/) : radius_(bodies.radius) {}

  [[nodiscard]] static double work(double disks) { return disks * disks / 2; }
  void moved(const Bodies& /*bodies*/, double /*time*/) {}
  void about_to_move(const Bodies& /*bodies*/, double /*time*/, double /*fastest*/) {}
  [[nodiscard]] static bool strayed(const Bodies& /*bodies*/, std::size_t /*i*/) { return false; }
  [[nodiscard]] static std::size_t bytes() { return 0; }
  template <class Look>
  void for_pairs(Look look) const {
    for (std::uint32_t i = 0; i < radius_.size(); ++i)
      for (std::uint32_t j = i + 1; j < radius_.size(); ++j) look(i, j, (radius_[i] + radius_[j]) * (radius_[i] + radius_[j]));
  }
  template <class Look>
  void for_near(std::uint32_t i, Look look) const {
    for (std::uint32_t j = 0; j < radius_.size(); ++j)
      if (j != i) look(j, (radius_[i] + radius_[j]) * (radius_[i] + radius_[j]));
  }
  template <class Archive>
  void serialize(Archive& /*archive*/) {}

 private:
  std::vector<double> radius_;
};

/// Holds a step with its list against one that looks at every pair.
template <class Rule, class Search = OverlapAtTheEnd>
void expect_the_twin(const System& system, double dt, int steps, const std::string& what) {
  Stepper<ContactStep<Rule, Search, ClosePairs>> listed(system.box, system.disks, system.state, dt);
  Stepper<ContactStep<Rule, Search, EveryPair>> twin(system.box, system.disks, system.state, dt);
  listed.record_events(true);
  twin.record_events(true);
  run_to(listed, steps * dt);
  run_to(twin, steps * dt);
  EXPECT_TRUE(same_bits(listed.state(), twin.state())) << what;
  std::vector<Event> a, b;
  listed.take_events(a);
  twin.take_events(b);
  EXPECT_TRUE(same_events(a, b)) << what;
}

}  // namespace carom::test
