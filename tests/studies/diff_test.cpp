// Two runs side by side: distances against their definition over all images, event logs, and runs made in the test.

#include "studies/diff/diff.hpp"
#include "studies/diff/text.hpp"
#include "studies/distance_table.hpp"
#include "support/recorded_run.hpp"
#include "support/systems.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The distance of two positions by definition: over all images, those n boxes higher displaced by n times the shear.
double distance_by_definition(const Box& box, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double shear) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int across = -2; across <= 2; ++across) {
    for (int above = -2; above <= 2; ++above) {
      if ((across != 0 && !box.periodic(0)) || (above != 0 && !box.periodic(1))) continue;
      const Eigen::Vector2d image = b + Eigen::Vector2d(across * box.lengths().x() + above * shear, above * box.lengths().y());
      shortest = std::min(shortest, (a - image).norm());
    }
  }
  return shortest;
}

Box box_with(Boundary x, Boundary y) {
  Box box;
  box.lower = {-1.0, 2.0};
  box.upper = {3.0, 5.0};
  box.boundary = {x, y};
  return box;
}

State drawn_state(const Box& box, Eigen::Index disks, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  State state;
  state.positions.resize(2, disks);
  for (Eigen::Index i = 0; i < disks; ++i)
    state.positions.col(i) = box.lower + Eigen::Vector2d(unit(random), unit(random)).cwiseProduct(box.lengths());
  return state;
}

void expect_distances_by_definition(const Box& box, const State& a, const State& b) {
  double sum = 0.0, largest = 0.0;
  for (Eigen::Index i = 0; i < a.positions.cols(); ++i) {
    const double distance = distance_by_definition(box, a.positions.col(i), b.positions.col(i), a.shear_displacement);
    sum += distance * distance;
    largest = std::max(largest, distance);
  }
  const DistanceAt found = distance_at(box, a, b);
  EXPECT_NEAR(found.rms, std::sqrt(sum / static_cast<double>(a.positions.cols())), 1e-14);
  EXPECT_NEAR(found.largest, largest, 1e-14);
  const Eigen::Index farthest = found.disk;
  EXPECT_NEAR(distance_by_definition(box, a.positions.col(farthest), b.positions.col(farthest), a.shear_displacement), largest,
              1e-14);
}

TEST(StateDistance, IsTheShortestOverAllImages) {
  std::mt19937_64 random(1);
  for (const Boundary x : {Boundary::walls, Boundary::periodic}) {
    for (const Boundary y : {Boundary::walls, Boundary::periodic}) {
      const Box box = box_with(x, y);
      const State a = drawn_state(box, 40, random), b = drawn_state(box, 40, random);
      expect_distances_by_definition(box, a, b);
    }
  }
}

TEST(StateDistance, KnowsTheOffsetOfImagesInAShearedBox) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> step(-0.4, 0.4);
  const Box box = box_with(Boundary::periodic, Boundary::periodic);
  const double width = box.lengths().x();
  for (const double shear : {0.3, 1.7, 3.9}) {
    State a = drawn_state(box, 60, random);
    a.shear_displacement = shear;
    State b = a;
    for (Eigen::Index i = 0; i < 60; ++i) {
      Eigen::Vector2d r = a.positions.col(i) + Eigen::Vector2d(step(random), step(random));
      if (r.y() >= box.upper.y()) r -= Eigen::Vector2d(shear, box.lengths().y());
      if (r.y() < box.lower.y()) r += Eigen::Vector2d(shear, box.lengths().y());
      r.x() -= width * std::floor((r.x() - box.lower.x()) / width);
      b.positions.col(i) = r;
    }
    expect_distances_by_definition(box, a, b);
    EXPECT_LT(distance_at(box, a, b).largest, 0.6);
  }
}

TEST(StateDistance, DepartureIsTheFirstDistanceBeyondAThousandthOfADiameter) {
  const std::vector<DistanceAt> distances = {
      {.time = 0.0, .rms = 0.0}, {.time = 1.0, .rms = 1.9e-3}, {.time = 2.0, .rms = 2.1e-3}, {.time = 3.0, .rms = 1e-3}};
  ASSERT_TRUE(departure(distances, 2.0));
  EXPECT_EQ(departure(distances, 2.0)->time, 2.0);
  EXPECT_EQ(departure(distances, 1.0)->time, 1.0);
  EXPECT_FALSE(departure(distances, 3.0));
}

TEST(StateDistance, RowsOfATableHaveTheFirstAndTheLast) {
  EXPECT_THAT(evenly_spaced(3, 12), ElementsAre(0, 1, 2));
  EXPECT_THAT(evenly_spaced(11, 3), ElementsAre(0, 5, 10));
  EXPECT_THAT(evenly_spaced(1, 5), ElementsAre(0));
  EXPECT_TRUE(evenly_spaced(0, 5).empty());
}

// ------------------------------------------------------------------------------------------------------ collisions

Event collision_of(double time, std::int32_t disk, std::int32_t partner) {
  return {.time = time, .disk = disk, .partner = partner};
}

/// The log in parts of `size` events.
NextEvents in_parts(std::vector<Event> log, std::size_t size) {
  return [log, size, next = std::size_t{0}]() mutable {
    const std::size_t from = next;
    next = std::min(log.size(), next + size);
    return std::vector<Event>(log.begin() + static_cast<std::ptrdiff_t>(from), log.begin() + static_cast<std::ptrdiff_t>(next));
  };
}

TEST(CollisionLogs, FindTheFirstDifferenceHoweverTheyArrive) {
  const std::vector<Event> a = {collision_of(1.0, 0, 1), collision_of(2.0, 2, wall_left), collision_of(3.0, 0, 2)};
  const std::vector<Event> b = {collision_of(1.0 + 1e-15, 0, 1), collision_of(2.0, 2, wall_left), collision_of(3.1, 0, 3)};
  for (const std::size_t size : {1U, 2U, 5U}) {
    const LogDifference found = first_different_collision(in_parts(a, size), in_parts(b, size));
    EXPECT_EQ(found.equal, 2U);
    ASSERT_TRUE(found.first);
    EXPECT_EQ((*found.first)[0].number, 3U);
    EXPECT_EQ((*found.first)[0].event.partner, 2);
    EXPECT_EQ((*found.first)[1].number, 3U);
    EXPECT_EQ((*found.first)[1].event.time, 3.1);
    EXPECT_EQ((*found.first)[1].event.partner, 3);
  }
}

TEST(CollisionLogs, MayOrderCollisionsOfOneTimeAsTheyLike) {
  const std::vector<Event> stepped = {collision_of(1.0, 0, 1), collision_of(1.0, 2, 3), collision_of(1.0, 4, 5),
                                      collision_of(2.0, 1, 2)};
  const std::vector<Event> exact = {collision_of(0.91, 4, 5), collision_of(0.92, 0, 1), collision_of(0.95, 2, 3),
                                    collision_of(1.9, 1, 3)};
  for (const std::size_t size : {1U, 2U, 5U}) {
    const LogDifference found = first_different_collision(in_parts(stepped, size), in_parts(exact, size));
    EXPECT_EQ(found.equal, 3U);
    ASSERT_TRUE(found.first);
    EXPECT_EQ((*found.first)[0].number, 4U);
    EXPECT_EQ((*found.first)[1].event.time, 1.9);
    const LogDifference turned = first_different_collision(in_parts(exact, size), in_parts(stepped, size));
    EXPECT_EQ(turned.equal, 3U);
    EXPECT_TRUE(turned.first);
  }
}

TEST(CollisionLogs, ThatEndEarlierDoNotDiffer) {
  const std::vector<Event> a = {collision_of(1.0, 0, 1), collision_of(2.0, 1, 2)};
  const LogDifference found = first_different_collision(in_parts(a, 2), in_parts({a[0]}, 1));
  EXPECT_EQ(found.equal, 1U);
  EXPECT_FALSE(found.first);
  EXPECT_EQ(first_different_collision(in_parts({}, 1), in_parts(a, 1)).equal, 0U);
}

// ------------------------------------------------------------------------------------------------------ runs

class RunsSideBySide : public ::testing::Test {
 protected:
  RunsSideBySide() : scene_(gas_scene(20, 0.3, Boundary::periodic, 1)) {
    scene_.run.time = 1.0;
    scene_.run.sample_every = 0.25;
    scene_.output.events = true;
  }
  DiffRun recorded(const std::string& name, const Scene& scene) {
    record(scene, directory_.file(name));
    return open_diff_run(directory_.file(name));
  }

  TemporaryDirectory directory_;
  Scene scene_;
};

TEST_F(RunsSideBySide, OfOneSceneAreTheSame) {
  const RunDifference found = difference_of(recorded("a", scene_), recorded("b", scene_));
  EXPECT_TRUE(found.same());
  EXPECT_EQ(found.equal_samples, 5U);
  ASSERT_EQ(found.distances.size(), 5U);
  for (const DistanceAt& at : found.distances) EXPECT_EQ(at.largest, 0.0);
  ASSERT_TRUE(found.log);
  EXPECT_FALSE(found.log->first);
  EXPECT_THAT(diff_text(found), HasSubstr("are the same run: state hash " + found.state_hash[0]));
}

TEST_F(RunsSideBySide, WithOtherDirectionsPartAtOnce) {
  const DiffRun a = recorded("a", scene_);
  scene_.run.seed = 2;
  const DiffRun b = recorded("b", scene_);
  const RunDifference found = difference_of(a, b);
  EXPECT_FALSE(found.same());
  EXPECT_EQ(found.equal_samples, 0U);
  for (std::size_t k = 0; k < found.distances.size(); ++k) {
    const State in_a = a.reader.sample(k), in_b = b.reader.sample(k);
    EXPECT_EQ(found.distances[k].time, 0.25 * static_cast<double>(k));
    EXPECT_EQ(found.distances[k].rms, rms_distance(scene_.box, in_a, in_b));
  }
  const auto printed = nlohmann::json::parse(diff_json(found));
  EXPECT_EQ(printed["same"], false);
  EXPECT_EQ(printed["distances"].size(), 5U);
  EXPECT_EQ(printed["distances"][1]["rms"].get<double>(), found.distances[1].rms / found.diameter);
}

TEST_F(RunsSideBySide, AreComparedAtTheTimesThatBothHave) {
  const DiffRun a = recorded("a", scene_);
  scene_.run.sample_every = 0.5;
  const RunDifference found = difference_of(a, recorded("b", scene_));
  ASSERT_EQ(found.distances.size(), 3U);
  EXPECT_EQ(found.distances[1].time, 0.5);
  EXPECT_FALSE(found.same()) << "they have other numbers of samples";
  EXPECT_EQ(found.distances[2].largest, 0.0);
}

TEST_F(RunsSideBySide, OfATrajectoryAloneHaveNoHash) {
  const DiffRun a = recorded("a", scene_);
  std::filesystem::copy_file(directory_.file("a") + "/trajectory.h5md", directory_.file("alone.h5md"));
  const RunDifference found = difference_of(a, open_diff_run(directory_.file("alone.h5md")));
  EXPECT_TRUE(found.same());
  EXPECT_EQ(found.state_hash[1], "");
  EXPECT_THAT(diff_text(found), HasSubstr("are the same run: all 5 samples are equal"));
}

TEST(DifferentSystems, AreNamedByTheirFirstDifference) {
  const Box box = box_with(Boundary::walls, Boundary::periodic);
  const Disks disks{.radius = {0.5, 0.25}, .mass = {1.0, 2.0}, .species = {0, 0}};
  EXPECT_EQ(different_system(box, disks, box, disks), "");
  Disks fewer = disks;
  fewer.radius.pop_back();
  EXPECT_EQ(different_system(box, disks, box, fewer), "the first has 2 disks and the second 1");
  Disks larger = disks;
  larger.radius[1] = 0.75;
  EXPECT_EQ(different_system(box, disks, box, larger), "disk 1 has radius 0.25 in the first and 0.75 in the second");
  Disks heavier = disks;
  heavier.mass[0] = 4.0;
  EXPECT_EQ(different_system(box, disks, box, heavier), "disk 0 has mass 1 in the first and 4 in the second");
  Box wider = box;
  wider.upper.x() = 4.0;
  EXPECT_THAT(different_system(box, disks, wider, disks), StartsWith("the box is [-1, 3] along x"));
  EXPECT_EQ(different_system(box, disks, box_with(Boundary::walls, Boundary::walls), disks),
            "along y the first has periodic edges and the second walls");
}

}  // namespace
}  // namespace carom::test
