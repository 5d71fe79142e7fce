// Simulations that begin with a state given in place of the scene's own start.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace carom::test {
namespace {

TEST(GivenState, TheScenesOwnStartGivenBackLeavesTheSameBits) {
  const Scene scene = mixture_scene(20, 0.4, Boundary::periodic);
  for (const char* engine : {"fast", "textbook"}) {
    Simulation drawn = make_simulation(scene, engine);
    Simulation given = make_simulation(scene, drawn.state(), engine);
    EXPECT_EQ(given.engine(), engine);
    drawn.run_until(3.0);
    given.run_until(3.0);
    EXPECT_TRUE(same_bits(drawn.state(), given.state())) << engine;
  }
}

TEST(GivenState, ItsTimeIsZeroAndItsImagesGoOn) {
  const Scene scene = gas_scene(9, 0.2, Boundary::periodic);
  Simulation first = make_simulation(scene);
  first.run_until(20.0);
  const State middle = first.state();
  ASSERT_FALSE((middle.images.array() == 0).all());
  const Simulation second = make_simulation(scene, middle);
  EXPECT_EQ(second.time(), 0.0);
  EXPECT_EQ(second.totals().pair, 0U);
  EXPECT_EQ(second.state().images, middle.images);
}

TEST(GivenState, OneThatDoesNotFitTheSceneIsRefused) {
  const Scene scene = gas_scene(9, 0.2, Boundary::periodic);
  const State good = make_simulation(scene).state();
  const auto refused = [&](auto spoil) {
    State state = good;
    spoil(state);
    EXPECT_THROW(make_simulation(scene, state), std::invalid_argument);
  };
  refused([](State& state) { state.positions.conservativeResize(2, 8); });
  refused([](State& state) { state.velocities.conservativeResize(2, 10); });
  refused([](State& state) { state.positions(0, 3) = std::numeric_limits<double>::quiet_NaN(); });
  refused([](State& state) { state.velocities(1, 3) = std::numeric_limits<double>::infinity(); });
  refused([&](State& state) { state.positions(0, 3) = scene.box.upper[0]; });
  refused([&](State& state) { state.positions(1, 3) = std::nextafter(scene.box.lower[1], -1e9); });
}

TEST(GivenState, EnginesWiderThanDoubleSayWhatDoublesCannotHold) {
  const Scene scene = gas_scene(16, 0.4, Boundary::periodic);
  Simulation wide = make_simulation(scene, "textbook-quad");
  wide.run_until(1.0);
  const State state = wide.state();
  ASSERT_EQ(state.remainders.cols(), 16);
  const double half_an_ulp = std::ldexp(scene.box.lengths().maxCoeff(), -53);
  EXPECT_LE(state.remainders.cwiseAbs().maxCoeff(), half_an_ulp);
  EXPECT_GT(state.remainders.cwiseAbs().minCoeff(), 0.0);
  EXPECT_EQ(make_simulation(scene, "textbook").state().remainders.cols(), 0);
}

}  // namespace
}  // namespace carom::test
