#include "theory/kinetic.hpp"

#include "support/systems.hpp"
#include "theory/equation_of_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace carom::test {
namespace {

using theory::Component;

TEST(CollisionRate, OfEqualDisksIsWhatTheEquationOfStateSays) {
  for (const double eta : {0.01, 0.3, 0.6}) {
    const double radius = 0.5, mass = 2.0, kT = 3.0;
    const double density = eta / (std::numbers::pi * radius * radius);
    const std::vector<Component> gas = {{density, radius, mass}};
    // omega = (4 / sqrt(pi)) (Z - 1) v_T / sigma for a disk, half of that for each of a pair.
    const double omega = 4.0 / std::sqrt(std::numbers::pi) * (theory::kolafa_rottner(eta) - 1.0) * std::sqrt(kT / mass);
    EXPECT_NEAR(theory::collision_rate(gas, kT), 0.5 * density * omega, 1e-12 * density * omega) << eta;
  }
}

TEST(CollisionRate, DoesNotKnowHowDisksOfOneKindAreCounted) {
  const std::vector<Component> one = {{0.5, 0.4, 1.0}};
  const std::vector<Component> three = {{0.1, 0.4, 1.0}, {0.25, 0.4, 1.0}, {0.15, 0.4, 1.0}};
  EXPECT_NEAR(theory::collision_rate(three, 1.0), theory::collision_rate(one, 1.0), 1e-12);
}

TEST(CollisionRate, IsZeroWithoutDisks) {
  EXPECT_EQ(theory::collision_rate({}, 1.0), 0.0);
  EXPECT_EQ(theory::collision_rate(std::vector<Component>{{0.0, 0.5, 1.0}}, 1.0), 0.0);
}

TEST(ContactValueOfAMixture, IsThatOfTheFluidForOneSizeAndOfRoomForAPoint) {
  const std::vector<Component> alike = {{0.2, 0.5, 1.0}, {0.25, 0.5, 7.0}};
  const double eta = 0.45 * std::numbers::pi * 0.25;
  EXPECT_NEAR(theory::contact_value(alike, 0.5, 0.5), theory::contact_value(eta), 1e-14 * theory::contact_value(eta));
  // A point finds room in 1 - eta of the area, wherever that is.
  const std::vector<Component> sizes = {{0.2, 0.5, 1.0}, {0.3, 0.25, 1.0}};
  const double filled = std::numbers::pi * (0.2 * 0.25 + 0.3 * 0.0625);
  EXPECT_NEAR(theory::contact_value(sizes, 0.0, 0.5), 1.0 / (1.0 - filled), 1e-14);
  EXPECT_GT(theory::contact_value(sizes, 0.5, 0.5), theory::contact_value(sizes, 0.25, 0.5));
}

TEST(CollisionRate, OfAMixtureIsMetBySimulation) {
  Scene scene = mixture_scene(1000, 0.4, Boundary::periodic);
  std::vector<Component> gas;
  for (const Species& species : scene.species)
    gas.push_back({static_cast<double>(species.count) / scene.box.area(), species.radius, species.mass});
  Simulation simulation = make_simulation(scene);
  simulation.run_until(1e9, {.collisions = 20'000});
  simulation.reset_clock();
  simulation.run_until(1e9, {.collisions = 60'000});
  const double measured = 60'000 / (simulation.time() * scene.box.area());
  // The contact values are good to one or two per cent; five standard errors of 60,000 collisions at random times are two more.
  EXPECT_NEAR(measured / theory::collision_rate(gas, 1.0), 1.0, 0.04);
}

}  // namespace
}  // namespace carom::test
