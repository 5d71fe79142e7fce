// Horizons: their order, their growth by e-foldings, and scenes in which there is nothing to part.

#include "studies/horizon/horizon.hpp"
#include "studies/horizon/difference.hpp"
#include "studies/horizon/report.hpp"
#include "studies/state_distance.hpp"
#include "support/scene_files.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Horizon horizon_of(const Scene& scene, HorizonOptions options = {}) {
  if (options.lyapunov_collisions == 0) options.lyapunov_collisions = 10'000;
  return measure_horizon(scene, make_simulation(scene).state(), options);
}

Scene gas(std::uint64_t seed = 1) {
  Scene scene = gas_scene(36, 0.3, Boundary::periodic, seed);
  scene.run.time = 1.0;
  return scene;
}

/// Disks given one by one, in a scene.
Scene placed_scene(const Box& box, const std::vector<Placed>& placed) {
  Scene scene;
  scene.box = box;
  for (const Placed& disk : placed) {
    Species species;
    species.count = 1;
    species.radius = disk.radius;
    species.mass = disk.mass;
    species.positions = ListedPositions{{disk.r}};
    species.velocities = ListedVelocities{{disk.v}};
    scene.species.push_back(species);
  }
  scene.run.keep_momentum = true;
  return scene;
}

void expect_agreement_to_the_end(const Horizon& horizon, double end) {
  EXPECT_EQ(horizon.ended, HorizonEnd::run);
  EXPECT_EQ(horizon.time, end);
  for (const HorizonRow& row : horizon.rows) {
    EXPECT_FALSE(row.time) << row.engine;
    EXPECT_FALSE(row.first_difference) << row.engine;
  }
  EXPECT_THAT(sentence_of(horizon), HasSubstr("to the end of the run, t = "));
}

TEST(Horizon, GrowsWithThePrecision) {
  const Horizon horizon = horizon_of(gas());
  EXPECT_EQ(horizon.ended, HorizonEnd::parted);
  EXPECT_EQ(horizon.engine, "fast");
  EXPECT_EQ(horizon.sigma, 1.0);
  double longest = 0.0;
  int bits = 0;
  for (const HorizonRow& row : horizon.rows) {
    EXPECT_GE(row.bits, bits) << row.engine;
    bits = row.bits;
    ASSERT_TRUE(row.time && row.collisions_per_disk) << row.engine;
    EXPECT_GT(row.seconds, 0.0) << row.engine;
    EXPECT_EQ(row.estimated, row.against.empty()) << row.engine;
    if (row.engine == "fast") continue;  // as many bits as the textbook engine
    EXPECT_GT(*row.time, longest) << row.engine;
    longest = *row.time;
  }
  EXPECT_EQ(horizon.rows.front().engine, "textbook-float");
  EXPECT_EQ(horizon.rows.back().engine, "textbook-quad");
  EXPECT_EQ(horizon.rows.back().bits, 113);
  ASSERT_NE(horizon.row("textbook"), nullptr);
  EXPECT_EQ(horizon.row("textbook")->price, 1.0);
  EXPECT_THAT(sentence_of(horizon),
              AllOf(StartsWith("In double precision this trajectory is right to 0.001 diameters"),
                    HasSubstr("). With 113 bits it is right until about t = "), HasSubstr("times the cost")));
}

TEST(Horizon, WithoutAnExponentTheBestPrecisionHasALowerBound) {
  Horizon horizon;
  horizon.tolerance = 1e-3;
  horizon.engine = "textbook";
  horizon.time = 10.96;
  horizon.collisions_per_disk = 27.0;
  horizon.ended = HorizonEnd::parted;
  horizon.rows.resize(2);
  horizon.rows[0].engine = "textbook";
  horizon.rows[0].bits = 53;
  horizon.rows[0].time = 10.9;
  horizon.rows[1].engine = "textbook-quad";
  horizon.rows[1].bits = 113;
  EXPECT_THAT(sentence_of(horizon), HasSubstr(" With 113 bits it is right at least until t = 10.96 (27 collisions per disk)"));
}

TEST(Horizon, IsTheSameEveryTime) {
  const Horizon a = horizon_of(gas());
  const Horizon b = horizon_of(gas());
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t k = 0; k < a.rows.size(); ++k) {
    EXPECT_EQ(a.rows[k].time, b.rows[k].time);
    ASSERT_EQ(a.rows[k].first_difference.has_value(), b.rows[k].first_difference.has_value());
    if (a.rows[k].first_difference) {
      EXPECT_EQ(a.rows[k].first_difference->index, b.rows[k].first_difference->index);
    }
  }
}

// What positions are within the tolerance of at a time, a second look at the two engines shows too.
TEST(Horizon, IsWhereTwoEnginesPart) {
  const Scene scene = gas();
  const Horizon horizon = horizon_of(scene);
  for (const HorizonRow& row : horizon.rows) {
    if (row.against.empty()) continue;
    Simulation coarse = make_simulation(scene, row.engine);
    Simulation fine = make_simulation(scene, row.against);
    const auto apart = [&](double time) {
      coarse.run_until(time);
      fine.run_until(time);
      return largest_distance(scene.box, coarse.state(), fine.state());
    };
    EXPECT_LE(apart(*row.time), horizon.tolerance * horizon.sigma) << row.engine;
    EXPECT_GT(apart(*row.time + 1.001 * horizon.resolution), horizon.tolerance * horizon.sigma) << row.engine;
  }
}

TEST(Horizon, TheFirstOtherEventIsWhereTwoLogsPart) {
  const Scene scene = gas();
  const Horizon horizon = horizon_of(scene);
  for (const HorizonRow& row : horizon.rows) {
    if (row.against.empty()) continue;
    ASSERT_TRUE(row.first_difference) << row.engine;
    const auto log_of = [&](const std::string& engine) {
      Simulation simulation = make_simulation(scene, engine);
      simulation.record_events(true);
      simulation.run_until(horizon.time);
      return simulation.take_events();
    };
    const std::vector<Event> coarse = log_of(row.engine);
    const std::vector<Event> fine = log_of(row.against);
    std::size_t k = 0;
    while (coarse[k].disk == fine[k].disk && coarse[k].partner == fine[k].partner) ++k;
    EXPECT_EQ(row.first_difference->index, k) << row.engine;
    EXPECT_EQ(row.first_difference->time, fine[k].time);
    EXPECT_EQ(row.first_difference->disk, fine[k].disk);
    EXPECT_EQ(row.first_difference->other_partner, coarse[k].partner);
  }
}

TEST(Horizon, WaitsForChaosBeyondAShortRunAndSaysSo) {
  Scene scene = gas();
  scene.run.time = 0.5;
  const Horizon horizon = horizon_of(scene);
  EXPECT_EQ(horizon.ended, HorizonEnd::parted);
  EXPECT_GT(horizon.time, 0.5);
  EXPECT_THAT(sentence_of(horizon), HasSubstr("to the end of the run, t = 0.5, and would be until t = "));
}

TEST(Horizon, EndsAtTheLimitOfWork) {
  const Horizon horizon = horizon_of(gas(), {.limit = 2000});
  EXPECT_EQ(horizon.ended, HorizonEnd::limit);
  EXPECT_FALSE(horizon.row("fast")->time);
  EXPECT_FALSE(horizon.rows.back().time);
  EXPECT_THAT(sentence_of(horizon), HasSubstr("at least until t = "));
  EXPECT_THAT(sentence_of(horizon), HasSubstr("the comparison reached its limit of work"));
}

TEST(Horizon, EndsWhenToldTo) {
  for (int after = 0; after < 150; after = 2 * after + 1) {
    HorizonOptions options;
    int asked = 0;
    options.proceed = [&](const HorizonProgress& progress) {
      EXPECT_GE(progress.fraction, 0.0);
      EXPECT_LE(progress.fraction, 1.0);
      return ++asked <= after;
    };
    options.lyapunov_collisions = 1000;
    const Horizon horizon = horizon_of(gas(), options);
    EXPECT_EQ(horizon.ended, HorizonEnd::interrupted) << after;
    EXPECT_EQ(asked, after + 1);
    EXPECT_EQ(horizon.rows.front().engine, "textbook-float");
    EXPECT_THAT(sentence_of(horizon), AnyOf(HasSubstr("nterrupted"), HasSubstr("until t = ")));
  }
}

TEST(Horizon, OfTheEngineAskedForIsWhatTheSentenceSays) {
  const Horizon horizon = horizon_of(gas(), {.engine = "textbook-float"});
  EXPECT_EQ(horizon.engine, "textbook-float");
  EXPECT_THAT(sentence_of(horizon), StartsWith("In single precision this trajectory is right"));
  EXPECT_THAT(sentence_of(horizon_of(gas(), {.engine = "textbook-quad"})),
              AllOf(StartsWith("With 113 bits"), HasSubstr("until about t = "), Not(HasSubstr("cost"))));
}

TEST(Horizon, OfASceneThatTheGeneralEngineRunsIsThatOfThisEngine) {
  Scene scene = gas();
  scene.effects.gravity = Gravity{{0.0, -0.1}};
  scene.box.boundary = {Boundary::walls, Boundary::walls};
  const Horizon horizon = horizon_of(scene);
  EXPECT_EQ(horizon.engine, "general");
  const HorizonRow* own = horizon.row("general");
  ASSERT_TRUE(own != nullptr && own->time);
  EXPECT_EQ(own->bits, std::numeric_limits<double>::digits);
  EXPECT_EQ(own->against, "textbook-long-double");
  EXPECT_THAT(sentence_of(horizon), AllOf(StartsWith("In double precision this trajectory is right"),
                                          HasSubstr("times the cost of the general engine.")));
  EXPECT_EQ(horizon_of(gas(), {.engine = "textbook"}).row("general"), nullptr);
  EXPECT_NE(horizon_of(gas(), {.engine = "general"}).row("general"), nullptr);
}

// ------------------------------------------------------------------------------------------- nothing that could part

TEST(Horizon, WithoutDisksIsTheEndOfTheRun) {
  Scene scene = gas_scene(4, 0.3, Boundary::periodic);
  scene.species.clear();
  scene.box = square_box(4.0, Boundary::periodic);
  scene.run.time = 3.0;
  expect_agreement_to_the_end(horizon_of(scene), 3.0);
}

TEST(Horizon, OfASceneAtRestIsTheEndOfTheRun) {
  Scene scene = gas();
  scene.species.front().velocities = AtRest{};
  expect_agreement_to_the_end(horizon_of(scene), 1.0);
  scene.run.time.reset();
  scene.run.collisions = 100;
  expect_agreement_to_the_end(horizon_of(scene), 0.0);
}

TEST(Horizon, OfOneDiskOnDyadicDataIsTheEndOfTheRun) {
  Scene scene = placed_scene(square_box(4.0, Boundary::walls), {{{1.0, 2.0}, {1.0, 0.25}}});
  scene.run.time = 100.0;
  const Horizon horizon = horizon_of(scene);
  expect_agreement_to_the_end(horizon, 100.0);
  EXPECT_FALSE(horizon.lyapunov);
}

// Two disks on a line in a periodic box, every number exact in binary: integrable, and no engine ever rounds.
TEST(Horizon, OfTwoDisksOnALineIsTheEndOfTheRun) {
  Scene scene = placed_scene(square_box(8.0, Boundary::periodic), {{{1.0, 4.0}, {1.0, 0.0}}, {{5.0, 4.0}, {-1.0, 0.0}}});
  scene.run.time = 500.0;
  const Horizon horizon = horizon_of(scene);
  expect_agreement_to_the_end(horizon, 500.0);
  EXPECT_GT(horizon.collisions_per_disk, 50.0);
}

TEST(Horizon, OfARunThatCountsCollisionsEndsWithThem) {
  Scene scene = placed_scene(square_box(8.0, Boundary::periodic), {{{1.0, 4.0}, {1.0, 0.0}}, {{5.0, 4.0}, {-1.0, 0.0}}});
  scene.run.collisions = 1000;
  const Horizon horizon = horizon_of(scene);
  EXPECT_EQ(horizon.ended, HorizonEnd::run);
  EXPECT_GE(horizon.collisions, 1000U);
  EXPECT_LT(horizon.collisions, 1100U);
}

TEST(Horizon, OfDisksThatNeverMeetEnds) {
  Scene scene = placed_scene(square_box(8.0, Boundary::periodic), {{{1.0, 2.0}, {1.0, 0.0}}, {{5.0, 6.0}, {1.0, 0.0}}});
  scene.run.collisions = 10;
  const Horizon horizon = horizon_of(scene);
  EXPECT_EQ(horizon.ended, HorizonEnd::run);
  EXPECT_EQ(horizon.collisions, 0U);
  for (const HorizonRow& row : horizon.rows) EXPECT_FALSE(row.time);
}

TEST(Horizon, OfMassesAMillionApartIsFound) {
  Scene scene = mixture_scene(36, 0.3, Boundary::walls);
  scene.species.front().mass = 1e6;
  scene.run.time = 1.0;
  const Horizon horizon = horizon_of(scene);
  EXPECT_EQ(horizon.ended, HorizonEnd::parted);
  EXPECT_LT(*horizon.row("textbook-float")->time, *horizon.row("textbook")->time);
  EXPECT_NEAR(horizon.sigma, 0.8, 36 * std::numeric_limits<double>::epsilon()) << "the mean of 18 diameters of 1 and 18 of 0.6";
}

TEST(Horizon, OfAnUnknownEngineIsRefused) { EXPECT_THROW(horizon_of(gas(), {.engine = "steam"}), std::invalid_argument); }

// Between the walls there is room for two diameters and no more: two disks that touch both walls and each other collide for ever.
TEST(SlowHorizon, OfDisksWithoutRoomEnds) {
  const Box box = {{0.0, 0.0}, {2.0, 4.0}, {Boundary::walls, Boundary::walls}};
  Scene scene = placed_scene(box, {{{0.5, 2.0}, {1.0, 0.0}}, {{1.5, 2.0}, {-1.0, 0.0}}});
  scene.run.time = 1.0;
  const Horizon horizon = horizon_of(scene);
  EXPECT_EQ(horizon.ended, HorizonEnd::stuck);
  EXPECT_EQ(horizon.time, 0.0);
  EXPECT_THAT(sentence_of(horizon), HasSubstr("jammed disks collided without end"));
}

// ---------------------------------------------------------------------------------------------- how states and logs differ

TEST(LargestDistance, IsToTheNearestImageAndCountsRemainders) {
  const Box box = {{0.0, 0.0}, {4.0, 4.0}, {Boundary::periodic, Boundary::walls}};
  State a;
  a.positions = Eigen::Vector2d(0.0, 1.0);
  State b = a;
  b.positions = Eigen::Vector2d(4.0 - 0x1p-40, 1.0);
  b.remainders = Eigen::Vector2d(0.0, 0x1p-80);
  EXPECT_EQ(largest_distance(box, a, a), 0.0);
  EXPECT_EQ(largest_distance(box, a, b), 0x1p-40);
  b.positions = a.positions;
  EXPECT_EQ(largest_distance(box, a, b), 0x1p-80);
  b.positions(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(largest_distance(box, a, b), std::numeric_limits<double>::infinity());
}

Event event(double time, std::int32_t disk, std::int32_t partner) {
  Event event;
  event.time = time;
  event.disk = disk;
  event.partner = partner;
  return event;
}

TEST(LogComparison, FindsTheFirstDifferenceAcrossParts) {
  LogComparison logs;
  const std::vector<Event> better = {event(1.0, 0, 1), event(2.0, 2, wall_left), event(3.0, 0, 2)};
  const std::vector<Event> other = {event(1.0, 0, 1), event(2.0, 2, wall_left), event(3.0, 0, 3)};
  logs.add({}, {better.data(), 2});
  logs.add({other.data(), 3}, {});
  EXPECT_FALSE(logs.found());
  logs.add({}, {better.data() + 2, 1});
  ASSERT_TRUE(logs.found());
  EXPECT_EQ(logs.found()->index, 2U);
  EXPECT_EQ(logs.found()->time, 3.0);
  EXPECT_EQ(logs.found()->partner, 2);
  EXPECT_EQ(logs.found()->other_partner, 3);
}

TEST(LogComparison, EventsAtOneInstantMayComeInAnyOrder) {
  LogComparison logs;
  logs.add(std::vector{event(1.0, 2, 3), event(1.0, 0, 1), event(2.0, 1, 2)},
           std::vector{event(1.0, 0, 1), event(1.0, 2, 3), event(2.0, 1, 2)});
  EXPECT_FALSE(logs.found());
}

TEST(LogComparison, TimesThatDifferInTheirRemaindersAreNotOneInstant) {
  const auto later = [](Event event) {
    event.time_remainder = 0x1p-60;
    return event;
  };
  LogComparison logs;
  logs.add(std::vector{later(event(1.0, 2, 3)), event(1.0, 0, 1)}, std::vector{event(1.0, 0, 1), later(event(1.0, 2, 3))});
  ASSERT_TRUE(logs.found());
  EXPECT_EQ(logs.found()->index, 0U);
  EXPECT_EQ(logs.found()->disk, 0);
  EXPECT_EQ(logs.found()->other_disk, 2);
}

// ------------------------------------------------------------------------------------------------------ e-foldings

/// The mean of the values, within 4 standard errors and `beyond_chance`.
void expect_mean(const std::vector<double>& values, double expected, double beyond_chance) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0;
  double variance = 0.0;
  for (const double value : values) mean += value / n;
  for (const double value : values) variance += (value - mean) * (value - mean) / (n - 1.0);
  EXPECT_NEAR(mean, expected, 4.0 * std::sqrt(variance / n) + beyond_chance) << "standard error " << std::sqrt(variance / n);
}

// An error of 2^-53 needs 29 ln 2 / lambda longer than one of 2^-24 to grow to the same size, and one of 2^-64 needs 11 ln 2 /
// lambda longer still. Over 24 starts, within 4 standard errors of the mean; and one and a half e-folding, by which the
// rounding of the start itself, which float alone does, is ahead of the rounding of the first collision.
TEST(PhysicsHorizon, GrowsByTheExpectedNumberOfEFoldings) {
  constexpr int runs = 24;
  std::vector<double> to_double;
  std::vector<double> to_long_double;
  for (int seed = 1; seed <= runs; ++seed) {
    Scene scene = gas_scene(64, 0.4 * std::numbers::pi / 4.0, Boundary::periodic, static_cast<std::uint64_t>(seed));
    scene.run.time = 1.0;
    Simulation simulation = make_simulation(scene);
    simulation.run_until(20.0);  // away from the lattice: some 50 collisions per disk
    HorizonOptions options;
    options.lyapunov_collisions = 50'000;
    const Horizon horizon = measure_horizon(scene, simulation.state(), options);
    ASSERT_EQ(horizon.ended, HorizonEnd::parted);
    const double lambda = horizon.lyapunov->per_time;
    to_double.push_back(lambda * (*horizon.row("textbook")->time - *horizon.row("textbook-float")->time));
    if (horizon.row("textbook-long-double") != nullptr)
      to_long_double.push_back(lambda * (*horizon.row("textbook-long-double")->time - *horizon.row("textbook")->time));
  }
  expect_mean(to_double, 29.0 * std::numbers::ln2, 1.5);
  if (std::numeric_limits<long double>::digits == 64) expect_mean(to_long_double, 11.0 * std::numbers::ln2, 0.0);
}

struct Held {
  double density;
  double collisions_per_disk;
};

class PhysicsDoubleHorizon : public ::testing::TestWithParam<Held> {};

// The reference is the number of collisions of a disk after which trajectories are a diameter apart, "about": half a unit of 11
// is one in twenty. From the tolerance to a diameter an error grows for another ln 1000 / lambda. The mean of 16 starts, within 4
// standard errors.
TEST_P(PhysicsDoubleHorizon, IsTheKnownNumberOfCollisionsPerDisk) {
  constexpr int runs = 16;
  std::vector<double> values;
  for (int seed = 1; seed <= runs; ++seed) {
    Scene scene =
        gas_scene(64, GetParam().density * std::numbers::pi / 4.0, Boundary::periodic, static_cast<std::uint64_t>(seed));
    scene.run.time = 1.0;
    Simulation simulation = make_simulation(scene);
    simulation.run_until(1e9, {.collisions = 64 * 25});
    HorizonOptions options;
    options.lyapunov_collisions = 50'000;
    const Horizon horizon = measure_horizon(scene, simulation.state(), options);
    values.push_back(*horizon.row("textbook")->collisions_per_disk +
                     std::log(1.0 / horizon.tolerance) / horizon.lyapunov->per_collision);
  }
  expect_mean(values, GetParam().collisions_per_disk, 0.05 * GetParam().collisions_per_disk);
}

INSTANTIATE_TEST_SUITE_P(Each, PhysicsDoubleHorizon, ::testing::Values(Held{0.1, 11.0}, Held{0.4, 32.0}, Held{0.7, 64.0}));

}  // namespace
}  // namespace carom::test
