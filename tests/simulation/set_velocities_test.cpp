// Velocities that a program sets while a simulation runs. The twin is a simulation that begins with them in the same state.

#include "simulation/twin_event.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>

namespace carom::test {
namespace {

TEST(SetVelocities, FindsTheBitsOfASceneThatBeginsSo) {
  for (const char* engine : {"auto", "general", "textbook"}) {
    Simulation simulation = make_simulation(gas_scene(24, 0.4, Boundary::walls), engine);
    simulation.run_until(1.0);
    const std::uint64_t before = simulation.counts().pair;
    State state = simulation.state();
    state.velocities *= -0.5;
    simulation.set_velocities(state.velocities);
    Simulation twin = make_simulation(simulation.scene(), state, engine);
    for (int step = 0; step < 200; ++step) {
      const std::optional<Event> event = simulation.step();
      ASSERT_NO_FATAL_FAILURE(expect_twin_event(event, twin.step(), 1.0, step));
    }
    EXPECT_EQ(simulation.counts().pair, before + twin.counts().pair);
  }
}

TEST(SetVelocities, TakesADiskBackTheWayThatItCame) {
  Simulation simulation = make_simulation(gas_scene(24, 0.2, Boundary::walls));
  const State start = simulation.state();
  simulation.run_until(2.0);
  simulation.set_velocities(-simulation.state().velocities);
  simulation.run_until(4.0);
  EXPECT_LT((simulation.state().positions - start.positions).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SetVelocities, SetsSpinsToo) {
  Scene scene = gas_scene(8, 0.1, Boundary::walls);
  scene.effects.collision.roughness = 1.0;
  Simulation simulation = make_simulation(scene);
  const Eigen::VectorXd spins = Eigen::VectorXd::LinSpaced(8, -1.0, 1.0);
  simulation.set_velocities(simulation.state().velocities, spins);
  EXPECT_EQ(simulation.state().spins, spins);
  simulation.set_velocities(simulation.state().velocities);
  EXPECT_EQ(simulation.state().spins, spins) << "left alone where none are given";
  EXPECT_THROW(simulation.set_velocities(simulation.state().velocities, spins.head(3)), std::invalid_argument);
}

TEST(SetVelocities, RefusesWhatIsNotOneFiniteVelocityPerDisk) {
  Simulation simulation = make_simulation(gas_scene(24, 0.2, Boundary::walls));
  Eigen::Matrix2Xd velocities = simulation.state().velocities;
  EXPECT_THROW(simulation.set_velocities(velocities.leftCols(3)), std::invalid_argument);
  EXPECT_THROW(simulation.set_velocities(velocities, Eigen::VectorXd::Zero(24)), std::invalid_argument) << "disks are smooth";
  velocities(1, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(simulation.set_velocities(velocities), std::invalid_argument);
  velocities(1, 3) = 1e200;
  EXPECT_THROW(simulation.set_velocities(velocities), SceneError);
  EXPECT_EQ(simulation.run_until(1.0), StopReason::time);
}

TEST(SetVelocities, WakesWhatHasCooled) {
  Scene scene = gas_scene(16, 0.2, Boundary::periodic);
  scene.effects.collision.restitution = 0.5;
  Simulation simulation = make_simulation(scene);
  simulation.run_until(5.0);
  simulation.set_velocities(Eigen::Matrix2Xd::Zero(2, 16));
  EXPECT_FALSE(simulation.step(6.0)) << "all is at rest";
  simulation.set_velocities(make_simulation(scene).state().velocities);
  EXPECT_TRUE(simulation.step());
}

}  // namespace
}  // namespace carom::test
