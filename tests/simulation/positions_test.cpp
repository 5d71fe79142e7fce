// Where disks start: no overlaps, inside the box, repeatable, and refused with a sentence where there is no way.

#include "simulation/start.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

Species at_random(std::int64_t count, double radius) { return species_of(count, radius, 1.0, RandomPositions{}, AtRest{}); }

Species listed(double radius, std::vector<Eigen::Vector2d> values) {
  const auto count = static_cast<std::int64_t>(values.size());
  return species_of(count, radius, 1.0, ListedPositions{std::move(values)}, AtRest{});
}

void require_good_start(const Scene& scene) {
  const Start start = draw_start(scene);
  const Eigen::Matrix2Xd& r = start.state.positions;
  RC_ASSERT(r.cols() == scene.disk_count());
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    const double radius = start.disks.radius[static_cast<std::size_t>(i)];
    for (int a = 0; a < 2; ++a) {
      const double margin = scene.box.periodic(a) ? 0.0 : radius;
      RC_ASSERT(r(a, i) >= scene.box.lower[a] + margin);
      RC_ASSERT(r(a, i) <= scene.box.upper[a] - margin);
    }
    for (Eigen::Index j = 0; j < i; ++j) {
      Eigen::Matrix2Xd pair(2, 2);
      pair << r.col(i), r.col(j);
      const double sigma = radius + start.disks.radius[static_cast<std::size_t>(j)];
      const double distance = smallest_distance(scene.box, pair);
      RC_ASSERT(distance >= sigma * (1.0 - 1e-14) || distance == scene.box.lengths().minCoeff());
    }
  }
}

RC_GTEST_PROP(PropertyPositions, RandomDisksDoNotOverlapAndKeepToTheBox, ()) {
  const Box box =
      box_of(*rc::gen::element(1.0, 5.0), *rc::gen::element(1.0, 0.6), *rc::gen::element(Boundary::walls, Boundary::periodic),
             *rc::gen::element(Boundary::walls, Boundary::periodic));
  std::vector<Species> species;
  const int kinds = *rc::gen::inRange(1, 4);
  for (int k = 0; k < kinds; ++k) {
    const auto count = *rc::gen::inRange<std::int64_t>(0, 25);
    const double fraction = *rc::gen::element(0.001, 0.05, 0.12);  // of the box, by this species
    const double radius =
        std::sqrt(fraction * box.area() / (std::numbers::pi * static_cast<double>(std::max<std::int64_t>(count, 4))));
    species.push_back(at_random(count, radius));
  }
  require_good_start(scene_of(box, species, *rc::gen::arbitrary<std::uint64_t>()));
}

TEST(Positions, SameSeedSameBitsAndAnotherSeedAnotherStart) {
  const Box box = box_of(1.0, 1.0, Boundary::periodic);
  const auto positions = [&](std::uint64_t seed) {
    return draw_start(scene_of(box, {at_random(100, 0.02)}, seed)).state.positions;
  };
  EXPECT_TRUE(same_bits(positions(7), positions(7)));
  for (const std::uint64_t other : {0ULL, 8ULL, 7ULL + (1ULL << 32), ~0ULL}) {
    const Eigen::Matrix2Xd difference = positions(7) - positions(other);
    EXPECT_TRUE((difference.array() != 0.0).all()) << other;
  }
}

TEST(Positions, LargerDisksArePlacedFirstWhateverTheOrderOfSpecies) {
  const Box box = box_of(1.0, 1.0, Boundary::walls);
  // Three large disks among many small ones: after the small ones they would find no room.
  const Eigen::Matrix2Xd r = draw_start(scene_of(box, {at_random(400, 0.01), at_random(3, 0.15)})).state.positions;
  EXPECT_EQ(r.cols(), 403);
  // A smaller species that comes later leaves the places of the larger one alone.
  const Eigen::Matrix2Xd alone = draw_start(scene_of(box, {at_random(3, 0.15)})).state.positions;
  const Eigen::Matrix2Xd more = draw_start(scene_of(box, {at_random(3, 0.15), at_random(400, 0.01)})).state.positions;
  EXPECT_TRUE(same_bits(alone, more.leftCols(3)));
}

TEST(Positions, RandomDisksCoverTheBoxEvenly) {
  // 1e4 points: the mean of a uniform coordinate has the standard error 1/sqrt(12e4), its square 1/sqrt(11.25e4).
  const Scene scene = scene_of(box_of(1.0, 1.0, Boundary::periodic), {at_random(10000, 1e-6)});
  const Eigen::Matrix2Xd r = draw_start(scene).state.positions;
  for (int a = 0; a < 2; ++a) {
    EXPECT_NEAR(r.row(a).mean(), 0.5, 5.0 / std::sqrt(12e4));
    EXPECT_NEAR(r.row(a).array().square().mean(), 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / 1e4));
  }
  EXPECT_NEAR((r.row(0).array() - 0.5).cwiseProduct(r.row(1).array() - 0.5).mean(), 0.0, 5.0 / 12.0 / 100.0);
}

TEST(Positions, RandomDisksGoAroundListedAndLatticeOnes) {
  const Box box = box_of(1.0, 1.0, Boundary::periodic);
  const Species lattice = species_of(9, 0.05, 1.0, SquareLattice{}, AtRest{});
  const Scene scene = scene_of(box, {at_random(50, 0.03), listed(0.1, {{0.0, 0.0}}), lattice});
  const Start start = draw_start(scene);
  EXPECT_EQ(start.state.positions.col(50), Eigen::Vector2d(0.0, 0.0));
  for (Eigen::Index i = 0; i < 60; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      Eigen::Matrix2Xd pair(2, 2);
      pair << start.state.positions.col(i), start.state.positions.col(j);
      const double sigma = start.disks.radius[static_cast<std::size_t>(i)] + start.disks.radius[static_cast<std::size_t>(j)];
      EXPECT_GE(smallest_distance(box, pair), sigma * (1.0 - 1e-14)) << i << " " << j;
    }
  }
}

TEST(Positions, SpeciesOnOneLatticeAreMixed) {
  const Box box = box_of(10.0, 10.0, Boundary::periodic);
  const auto mixture = [&](std::uint64_t seed) {
    return draw_start(scene_of(box,
                               {species_of(50, 0.4, 1.0, SquareLattice{}, AtRest{}),
                                species_of(50, 0.3, 1.0, SquareLattice{}, AtRest{})},
                               seed))
        .state.positions;
  };
  const Eigen::Matrix2Xd r = mixture(1);
  EXPECT_NEAR(smallest_distance(box, r), 1.0, 1e-12);
  // Unmixed, the first species would have all rows below 5. Of 50 drawn from 100 sites, 25 +- 2.5 lie there.
  EXPECT_NEAR(static_cast<double>((r.leftCols(50).row(1).array() < 5.0).count()), 25.0, 12.5);
  EXPECT_FALSE(same_bits(r, mixture(2)));
}

TEST(Positions, TouchingWithinOnePartInABillionIsAcceptedAndNotMore) {
  const Box box = box_of(4.0, 4.0, Boundary::walls);
  const auto pair = [&](double distance) {
    return [&, distance] { (void)draw_start(scene_of(box, {listed(0.5, {{1.0, 1.0}, {1.0 + distance, 1.0}})})); };
  };
  EXPECT_EQ(refusal<SceneError>(pair(1.0)), "");
  EXPECT_EQ(refusal<SceneError>(pair(1.0 - 0.9e-9)), "");
  EXPECT_THAT(refusal<SceneError>(pair(1.0 - 1.1e-9)), HasSubstr("disks 0 and 1 overlap by 1.1e-09"));
  EXPECT_THAT(refusal<SceneError>(pair(0.75)),
              HasSubstr("disks 0 and 1 overlap by 0.25; their centres must be at least 1 apart"));
}

TEST(Positions, OverlapAcrossAPeriodicEdgeIsNamedWithItsIds) {
  Box box = box_of(4.0, 4.0, Boundary::walls);
  const std::vector<Species> species = {at_random(2, 0.01), listed(0.5, {{0.5, 2.0}, {3.75, 2.0}})};
  EXPECT_NE(refusal<SceneError>([&] { (void)draw_start(scene_of(box, species)); }), "");  // sticks out at 3.75
  box.boundary[0] = Boundary::periodic;
  const std::string sentence = refusal<SceneError>([&] { (void)draw_start(scene_of(box, species)); });
  EXPECT_THAT(sentence, HasSubstr("disks 2 and 3 overlap by 0.25"));
}

TEST(Positions, DisksOutsideTheBoxAreRefused) {
  const Box box = box_of(1.0, 1.0, Boundary::walls);
  const auto at = [&](double x, double y) {
    return refusal<SceneError>([&] { (void)draw_start(scene_of(box, {listed(0.1, {{x, y}})})); });
  };
  EXPECT_EQ(at(0.1, 0.9), "");
  EXPECT_EQ(at(0.1 - 1e-10, 0.5), "");
  EXPECT_THAT(at(0.0999, 0.5), HasSubstr("disk 0 is outside the box: its x = 0.0999 must lie from 0.1 to 0.9"));
  EXPECT_THAT(at(0.5, 1.5), HasSubstr("its y = 1.5"));
  EXPECT_THAT(at(std::nan(""), 0.5), HasSubstr("disks.0.positions.0.0 is a floating-point number (nan)"));
  EXPECT_NE(refusal<SceneError>([&] { (void)draw_start(scene_of(box, {at_random(1, 0.6)})); }), "");
  EXPECT_NE(refusal<SceneError>([&] { (void)draw_start(scene_of(box, {species_of(1, 0.6, 1.0, SquareLattice{}, AtRest{})})); }),
            "");
}

TEST(Positions, ImpossibleRequestsSayWhatWouldBePossible) {
  const Box box = box_of(10.0, 10.0, Boundary::periodic);
  const auto start = [&](const Species& species) {
    return refusal<SceneError>([&] { (void)draw_start(scene_of(box, {species})); });
  };
  const std::string square = start(species_of(101, 0.5, 1.0, SquareLattice{}, AtRest{}));
  EXPECT_THAT(square, HasSubstr("a square lattice of 101 disks in this box has a spacing of 0.909091, less than the diameter 1"));
  EXPECT_THAT(square, HasSubstr("\"hexagonal\""));
  EXPECT_THAT(start(species_of(200, 0.5, 1.0, HexagonalLattice{}, AtRest{})), HasSubstr("take fewer or smaller disks"));
  const std::string random = start(at_random(90, 0.5));
  EXPECT_THAT(random, HasSubstr("the packing fraction is 0.706858, but random sequential addition of equal disks"));
  EXPECT_THAT(random, HasSubstr("\"hexagonal\""));
}

TEST(Positions, ALatticeUponListedDisksIsRefused) {
  const Scene scene = scene_of(box_of(10.0, 10.0, Boundary::periodic),
                               {listed(0.5, {{0.5, 0.5}}), species_of(9, 0.5, 1.0, SquareLattice{}, AtRest{})});
  EXPECT_EQ(refusal<SceneError>([&] { (void)draw_start(scene); }), "");  // sites 1.67, 5, 8.33
  const Scene clash = scene_of(box_of(10.0, 10.0, Boundary::periodic),
                               {listed(0.5, {{5.0, 5.0}}), species_of(9, 0.5, 1.0, SquareLattice{}, AtRest{})});
  EXPECT_THAT(refusal<SceneError>([&] { (void)draw_start(clash); }), HasSubstr("the square lattice puts disk 5 upon disk 0"));
}

TEST(Positions, IncompleteSpeciesAreRefused) {
  const Box box = box_of(1.0, 1.0, Boundary::walls);
  const auto start = [&](const Species& species) {
    return refusal<SceneError>([&] { (void)draw_start(scene_of(box, {species})); });
  };
  Species few = listed(0.1, {{0.5, 0.5}});
  few.count = 2;
  EXPECT_THAT(start(few), HasSubstr("disks.0.count is 2, but positions has 1"));
  EXPECT_THAT(start(species_of(1, 0.0, 1.0, RandomPositions{}, AtRest{})),
              HasSubstr("disks.0.radius is a floating-point number (0.0)"));
  EXPECT_THAT(start(species_of(1, 0.1, -1.0, RandomPositions{}, AtRest{})),
              HasSubstr("disks.0.mass is a floating-point number (-1.0)"));
  EXPECT_THAT(start(species_of(2, 0.1, 1.0, RandomPositions{}, ListedVelocities{{{1.0, 1.0}}})),
              HasSubstr("disks.0.velocities has length 1, but there are 2 disks"));
}

TEST(Positions, NoDisksAreAStartToo) {
  EXPECT_EQ(draw_start(scene_of(box_of(1.0, 1.0, Boundary::walls), std::vector<Species>{})).state.positions.cols(), 0);
  EXPECT_EQ(draw_start(scene_of(box_of(1.0, 1.0, Boundary::periodic), {at_random(0, 0.1)})).state.velocities.cols(), 0);
}

}  // namespace
}  // namespace carom::test
