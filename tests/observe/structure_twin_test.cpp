// Observables of structure against sums over all pairs and disks of the states that they saw.

#include "observe/observed_system.hpp"

#include "observe/close_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <set>

namespace carom::test {
namespace {

constexpr double rounding_of_pair_sums = 1e-11;  // of sums over 1e5 terms of order one

Eigen::Vector2d nearest(const Box& box, const Eigen::Vector2d& r) {
  return {std::remainder(r.x(), box.lengths().x()), std::remainder(r.y(), box.lengths().y())};
}

const Observed& fluid_with_structure() {
  static const Observed observed = observe(
      parse_scene(small_fluid("radial_distribution = { every = 0.25, range = 3.0, bins = 30 }\nstructure_factor = { every = "
                              "0.25, largest = 9.0 }\nhexatic = { every = 0.25, range = 3.0, bins = 6 }")),
      0.25);
  return observed;
}

TEST(RadialDistribution, SaysThatARangeBelowContactHasNoContactValue) {
  for (const char* range : {"0.9", "1.0"}) {
    const Observed observed =
        observe(parse_scene(small_fluid(std::string("radial_distribution = { every = 0.25, range = ") + range + " }")), 0.25);
    EXPECT_FALSE(observed.scalar("radial_distribution", "contact").value);
    EXPECT_EQ(observed.scalar("radial_distribution", "contact").note,
              "the range ends where disks touch or before; make it longer");
  }
}

/// Lengths and speeds times 2^a: not a bit of what has no unit is another.
TEST(RadialDistribution, HasOneContactValueInAllUnitsOfLength) {
  const auto contact_in = [](int a) {
    Scene scene = parse_scene(small_fluid("radial_distribution = { every = 0.25 }"));
    scene.box.lower *= std::ldexp(1.0, a);
    scene.box.upper *= std::ldexp(1.0, a);
    scene.species.front().radius *= std::ldexp(1.0, a);
    scene.species.front().velocities = MaxwellVelocities{std::ldexp(1.0, 2 * a)};
    const Observed observed = observe(scene, 0.25);
    return std::pair(observed.value("radial_distribution", "contact"), observed.scalar("radial_distribution", "contact").error);
  };
  const auto ordinary = contact_in(0);
  EXPECT_GT(ordinary.first, 1.0);
  for (const int a : {-60, -20, 20, 60}) EXPECT_EQ(contact_in(a), ordinary) << a;
}

TEST(ClosePairs, AreThoseOfAllPairs) {
  std::mt19937_64 engine(5);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  for (const double distance : {0.4, 1.3, 2.4}) {  // many cells, few cells, too few for cells
    Box box{{-1.0, 2.0}, {6.0, 7.0}, {Boundary::periodic, Boundary::periodic}};
    Eigen::Matrix2Xd positions(2, 150);
    for (Eigen::Index i = 0; i < 150; ++i)
      positions.col(i) = box.lower + box.lengths().cwiseProduct(Eigen::Vector2d(uniform(), uniform()));
    std::multiset<std::pair<Eigen::Index, Eigen::Index>> found, expected;
    for_each_close_pair(box, positions, distance, [&](Eigen::Index i, Eigen::Index j, const Eigen::Vector2d& r) {
      found.insert(std::minmax(i, j));
      EXPECT_NEAR((r - nearest(box, positions.col(i) - positions.col(j))).norm(), 0.0, 1e-14);
    });
    for (Eigen::Index i = 0; i < 150; ++i)
      for (Eigen::Index j = i + 1; j < 150; ++j)
        if (nearest(box, positions.col(i) - positions.col(j)).norm() < distance) expected.insert({i, j});
    EXPECT_EQ(found, expected) << distance;
  }
}

TEST(ObservedStructure, RadialDistributionCountsAllPairs) {
  const Observed& o = fluid_with_structure();
  const double width = 0.1, area = o.scene.box.area();
  std::vector<double> counts(30);
  for (const State& state : o.record.states)
    for (Eigen::Index i = 0; i < 40; ++i)
      for (Eigen::Index j = 0; j < i; ++j) {
        const double r = nearest(o.scene.box, state.positions.col(i) - state.positions.col(j)).norm();
        if (r < 3.0) counts[static_cast<std::size_t>(r / width)] += 1.0;
      }
  for (std::size_t b = 0; b < 30; ++b) {
    const double from = width * static_cast<double>(b), ring = std::numbers::pi * (std::pow(from + width, 2) - from * from);
    const double ideal = 40.0 * 39.0 / 2.0 * ring / area * static_cast<double>(o.record.states.size());
    EXPECT_NEAR(o.column("radial_distribution", 0, "g")[b], counts[b] / ideal, rounding_of_pair_sums);
  }
}

TEST(ObservedStructure, StructureFactorIsTheSquareOfTheSumOfWaves) {
  const Observed& o = fluid_with_structure();
  const Eigen::Vector2d unit = 2.0 * std::numbers::pi * o.scene.box.lengths().cwiseInverse();
  // The first shell, below twice the smallest wave number of a square box, holds (1, 0), (0, 1), (1, 1) and (-1, 1).
  ASSERT_EQ(o.column("structure_factor", 0, "vectors")[0], 4.0);
  double sum = 0.0, length = 0.0;
  for (const Eigen::Vector2d& n : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 1), Eigen::Vector2d(-1, 1)}) {
    const Eigen::Vector2d k = n.cwiseProduct(unit);
    length += 0.25 * k.norm();
    for (const State& state : o.record.states) {
      std::complex<double> wave = 0.0;
      for (Eigen::Index i = 0; i < 40; ++i) wave += std::polar(1.0, k.dot(state.positions.col(i)));
      sum += 0.25 * std::norm(wave) / 40.0 / static_cast<double>(o.record.states.size());
    }
  }
  EXPECT_NEAR(o.column("structure_factor", 0, "k")[0], length, rounding_of_pair_sums);
  EXPECT_NEAR(o.column("structure_factor", 0, "S")[0], sum, rounding_of_pair_sums);
}

TEST(ObservedStructure, WaveVectorsReachToTheLargestAndNoFurther) {
  const auto& k = fluid_with_structure().column("structure_factor", 0, "k");
  EXPECT_TRUE(std::is_sorted(k.begin(), k.end()));
  EXPECT_LE(k.back(), 9.0);
  EXPECT_GT(k.back(), 8.0);
}

std::vector<std::complex<double>> sixfold_order(const Box& box, const Eigen::Matrix2Xd& positions) {
  std::vector<std::complex<double>> psi;
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    std::vector<Eigen::Vector2d> others;
    for (Eigen::Index j = 0; j < positions.cols(); ++j)
      if (j != i) others.push_back(nearest(box, positions.col(j) - positions.col(i)));
    std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.norm() < b.norm(); });
    std::complex<double> sum = 0.0;
    for (std::size_t k = 0; k < 6; ++k) sum += std::polar(1.0 / 6.0, 6.0 * std::atan2(others[k].y(), others[k].x()));
    psi.push_back(sum);
  }
  return psi;
}

TEST(ObservedStructure, HexaticOrderIsThatOfSixSortedNeighbours) {
  const Observed& o = fluid_with_structure();
  double local = 0.0, global = 0.0, square = 0.0;
  std::vector<double> sums(6), pairs(6);
  for (const State& state : o.record.states) {
    const auto psi = sixfold_order(o.scene.box, state.positions);
    std::complex<double> all = 0.0;
    for (const auto& one : psi) {
      local += std::abs(one) / 40.0;
      all += one / 40.0;
    }
    global += std::abs(all);
    square += std::norm(all);
    for (Eigen::Index i = 0; i < 40; ++i)
      for (Eigen::Index j = 0; j < i; ++j) {
        const double r = nearest(o.scene.box, state.positions.col(i) - state.positions.col(j)).norm();
        if (r >= 3.0) continue;
        sums[static_cast<std::size_t>(2.0 * r)] +=
            (std::conj(psi[static_cast<std::size_t>(i)]) * psi[static_cast<std::size_t>(j)]).real();
        pairs[static_cast<std::size_t>(2.0 * r)] += 1.0;
      }
  }
  const double states = static_cast<double>(o.record.states.size());
  EXPECT_NEAR(o.value("hexatic", "local"), local / states, rounding_of_pair_sums);
  EXPECT_NEAR(o.value("hexatic", "global"), global / states, rounding_of_pair_sums);
  EXPECT_NEAR(o.value("hexatic", "global_square"), square / states, rounding_of_pair_sums);
  for (std::size_t b = 2; b < 6; ++b) EXPECT_NEAR(o.column("hexatic", 0, "g6")[b], sums[b] / pairs[b], rounding_of_pair_sums);
  EXPECT_TRUE(std::isnan(o.column("hexatic", 0, "g6")[0])) << "no pair is that near";
}

/// In a box narrower than the way to the sixth neighbour, images count.
TEST(ObservedStructure, HexaticOrderOfANarrowBoxLooksAtImages) {
  const Observed o = observe(
      parse_scene(
          "[box]\nx = [0.0, 30.0]\ny = [0.0, 2.0]\nboundary = \"periodic\"\n[[disks]]\ncount = 20\nradius = 0.5\nmass = 1.0\n"
          "positions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n[run]\ntime = 5.0\n"
          "[observe]\nhexatic = { every = 0.5, range = 1.0 }"),
      0.5);
  double local = 0.0;
  for (const State& state : o.record.states) {
    for (Eigen::Index i = 0; i < 20; ++i) {
      std::vector<Eigen::Vector2d> others;
      for (Eigen::Index j = 0; j < 20; ++j)
        for (int nx = -1; nx <= 1; ++nx)
          for (int ny = -9; ny <= 9; ++ny)
            if (i != j || nx != 0 || ny != 0)
              others.push_back(state.positions.col(j) - state.positions.col(i) + Eigen::Vector2d(30.0 * nx, 2.0 * ny));
      std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.norm() < b.norm(); });
      std::complex<double> sum = 0.0;
      for (std::size_t k = 0; k < 6; ++k) sum += std::polar(1.0 / 6.0, 6.0 * std::atan2(others[k].y(), others[k].x()));
      local += std::abs(sum) / 20.0;
    }
  }
  // Images at equal distances to either side: which of the two is the sixth may depend on rounding, and psi does not, since they
  // are opposite.
  EXPECT_NEAR(o.value("hexatic", "local"), local / static_cast<double>(o.record.states.size()), rounding_of_pair_sums);
}

TEST(ObservedStructure, PerfectTriangularLatticeHasFullHexaticOrder) {
  const Scene scene = parse_scene(
      "[box]\nx = [0.0, 6.0]\ny = [0.0, 6.92820323027551]\nboundary = \"periodic\"\n[[disks]]\ncount = 48\nradius = 0.3\nmass = "
      "1.0\n"
      "positions = \"hexagonal\"\nvelocities = \"rest\"\n[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n[observe]\nhexatic "
      "= { "
      "every = 0.5 }");
  const Observed o = observe(scene, 0.5);
  // 6 x 8 sites, rows sqrt(3) / 2 apart to 15 digits: angles are off by less than 1e-14.
  EXPECT_NEAR(o.value("hexatic", "local"), 1.0, 1e-12);
  EXPECT_NEAR(o.value("hexatic", "global"), 1.0, 1e-12);
}

}  // namespace
}  // namespace carom::test
