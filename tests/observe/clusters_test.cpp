// Clusters: states made by hand, all pairs and all images by a flood, and the percolation of overlapping discs.

#include "observe/observed_system.hpp"

#include "observe/disk_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <random>

namespace carom::test {
namespace {

Box cluster_box(double x, double y, Boundary along_x = Boundary::periodic, Boundary along_y = Boundary::periodic) {
  return {{0.0, 0.0}, {x, y}, {along_x, along_y}};
}

Eigen::Matrix2Xd places(const std::vector<Eigen::Vector2d>& centres) {
  Eigen::Matrix2Xd positions(2, static_cast<Eigen::Index>(centres.size()));
  for (std::size_t i = 0; i < centres.size(); ++i) positions.col(static_cast<Eigen::Index>(i)) = centres[i];
  return positions;
}

std::array<bool, 2> percolation(const DiskClusters& clusters, std::size_t disk) {
  return {clusters.percolates(clusters.cluster(disk), 0), clusters.percolates(clusters.cluster(disk), 1)};
}
using Both = std::array<bool, 2>;

TEST(DiskClusters, ARowAcrossAPeriodicBoxPercolatesAndOneWithAGapDoesNot) {
  const std::vector<double> radii(5, 0.5);
  const Eigen::Matrix2Xd row = places({{0.5, 1.0}, {1.6, 1.0}, {2.7, 1.0}, {3.8, 1.0}, {2.0, 3.0}});
  const DiskClusters whole(cluster_box(4.4, 6.0), row, radii, 0.11);
  EXPECT_EQ(whole.size(whole.cluster(0)), 4U);
  EXPECT_EQ(whole.size(whole.cluster(4)), 1U);
  EXPECT_EQ(whole.pairs(), 4U) << "the last and the first through the edge";
  EXPECT_EQ(percolation(whole, 2), (Both{true, false}));
  EXPECT_EQ(percolation(whole, 4), (Both{false, false}));
  EXPECT_EQ(percolation(DiskClusters(cluster_box(4.6, 6.0), row, radii, 0.11), 2), (Both{false, false})) << "a gap at the edge";
  EXPECT_EQ(DiskClusters(cluster_box(4.4, 6.0), row, radii, 0.09).pairs(), 0U);
}

/// The ends of a chain around a corner of the box have no neighbour but that of the chain; a chain along the diagonal percolates
/// along both axes.
TEST(DiskClusters, AChainAlongTheDiagonalPercolatesAlongBothAxes) {
  std::vector<Eigen::Vector2d> chain;
  for (int i = 0; i < 8; ++i) chain.emplace_back(0.3 + 0.75 * i, 0.2 + 0.75 * i);
  const std::vector<double> radii(8, 0.5);
  EXPECT_EQ(percolation(DiskClusters(cluster_box(6.0, 6.0), places(chain), radii, 0.1), 3), (Both{true, true}));
  EXPECT_EQ(percolation(DiskClusters(cluster_box(6.0, 7.0), places(chain), radii, 0.1), 3), (Both{false, false}));
  chain.erase(chain.begin() + 4);
  EXPECT_EQ(percolation(DiskClusters(cluster_box(6.0, 6.0), places(chain), std::vector<double>(7, 0.5), 0.1), 3),
            (Both{false, false}));
}

TEST(DiskClusters, OneDiskThatTouchesItsImagePercolates) {
  const std::vector<double> radius = {0.5};
  const DiskClusters alone(cluster_box(1.05, 3.0), places({{0.2, 1.0}}), radius, 0.1);
  EXPECT_EQ(percolation(alone, 0), (Both{true, false}));
  EXPECT_EQ(alone.pairs(), 1U);
}

TEST(DiskClusters, BetweenWallsAChainFromOneToTheOtherPercolates) {
  const std::vector<double> radii = {0.5, 0.3, 0.5};
  const Eigen::Matrix2Xd chain = places({{0.55, 1.0}, {1.4, 1.0}, {2.25, 1.0}});
  const Box box = cluster_box(2.8, 9.0, Boundary::walls, Boundary::walls);
  EXPECT_EQ(percolation(DiskClusters(box, chain, radii, 0.06), 1), (Both{true, false}));
  EXPECT_EQ(percolation(DiskClusters(box, chain, radii, 0.045), 1), (Both{false, false})) << "nearer than the gap to no wall";
  EXPECT_EQ(percolation(DiskClusters(cluster_box(2.8, 2.0, Boundary::periodic, Boundary::walls), chain, radii, 0.2), 1),
            (Both{true, false}));
}

/// Clusters of disks by a flood over copies of the box: two copies of a disk in one piece tell that it percolates.
struct Flooded {
  std::vector<std::size_t> cluster;
  std::vector<Both> percolates;
};
Flooded flood(const Box& box, const Eigen::Matrix2Xd& positions, const std::vector<double>& radii, double gap) {
  Flooded found{std::vector<std::size_t>(radii.size(), radii.size()), std::vector<Both>(radii.size())};
  for (std::size_t start = 0; start < radii.size(); ++start) {
    if (found.cluster[start] != radii.size()) continue;
    std::map<std::size_t, Eigen::Vector2d> at;  // where each was first met
    std::deque<std::size_t> next = {start};
    at[start] = positions.col(static_cast<Eigen::Index>(start));
    Both percolates = {};
    std::array<bool, 4> touches = {};
    while (!next.empty()) {
      const std::size_t i = next.front();
      next.pop_front();
      found.cluster[i] = start;
      for (int axis = 0; axis < 2; ++axis) {
        if (box.periodic(axis)) continue;
        const auto a = static_cast<std::size_t>(axis);
        touches[2 * a] = touches[2 * a] || at[i][axis] - radii[i] - box.lower[axis] < gap;
        touches[2 * a + 1] = touches[2 * a + 1] || box.upper[axis] - radii[i] - at[i][axis] < gap;
      }
      for (std::size_t j = 0; j < radii.size(); ++j)
        for (int x = -9; x <= 9; ++x)
          for (int y = -9; y <= 9; ++y) {
            if ((x != 0 && !box.periodic(0)) || (y != 0 && !box.periodic(1))) continue;
            const Eigen::Vector2d image =
                positions.col(static_cast<Eigen::Index>(j)) + Eigen::Vector2d(x * box.lengths().x(), y * box.lengths().y());
            if (j == i && (image - at[i]).norm() < 1e-9) continue;
            if ((image - at[i]).norm() - radii[i] - radii[j] >= gap) continue;
            if (at.count(j) == 0) {
              at[j] = image;
              next.push_back(j);
            } else {
              for (int axis = 0; axis < 2; ++axis)
                if (std::abs(image[axis] - at[j][axis]) > 0.5 * box.lengths()[axis])
                  percolates[static_cast<std::size_t>(axis)] = true;
            }
          }
    }
    for (std::size_t axis = 0; axis < 2; ++axis)
      percolates[axis] = percolates[axis] || (touches[2 * axis] && touches[2 * axis + 1]);
    for (std::size_t i = 0; i < radii.size(); ++i)
      if (found.cluster[i] == start) found.percolates[i] = percolates;
  }
  return found;
}

void expect_clusters_by_flood(const Box& box, const Eigen::Matrix2Xd& positions, const std::vector<double>& radii, double gap) {
  const DiskClusters clusters(box, positions, radii, gap);
  const Flooded twin = flood(box, positions, radii, gap);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    EXPECT_EQ(clusters.size(clusters.cluster(i)),
              static_cast<std::size_t>(std::count(twin.cluster.begin(), twin.cluster.end(), twin.cluster[i])));
    EXPECT_EQ(percolation(clusters, i), twin.percolates[i]);
    for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(clusters.cluster(i) == clusters.cluster(j), twin.cluster[i] == twin.cluster[j]);
  }
}

TEST(DiskClusters, AreThoseOfAFloodOverAllImages) {
  std::mt19937_64 engine(11);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  for (const Boundary x : {Boundary::periodic, Boundary::walls})
    for (const Boundary y : {Boundary::periodic, Boundary::walls})
      for (const int count : {1, 3, 20, 60, 90}) {
        const Box box = cluster_box(9.0, 6.0, x, y);
        Eigen::Matrix2Xd positions(2, count);
        std::vector<double> radii;
        for (int i = 0; i < count; ++i) {
          positions.col(i) = Eigen::Vector2d(9.0 * uniform(), 6.0 * uniform());
          radii.push_back(0.1 + 0.3 * uniform());
        }
        expect_clusters_by_flood(box, positions, radii, 0.2);
        if (count < 20) expect_clusters_by_flood(box, positions, radii, 4.0);
      }
}

/// Discs at random places, which overlap, percolate at the filling factor 1.128087 (Mertens & Moore, Phys. Rev. E 86, 061109
/// (2012)). There a cluster wraps around a torus of equal sides along one of the axes or both with the probability 0.690473725,
/// and along x with 0.521058290, as any critical percolation in two dimensions does (Pinson, J. Stat. Phys. 75, 1167 (1994);
/// Newman & Ziff, Phys. Rev. E 64, 016706 (2001)). Below and above the threshold that is rare and nearly sure.
TEST(SlowDiskClusters, OfOverlappingDiscsPercolateAtTheKnownThreshold) {
  std::mt19937_64 engine(12);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  constexpr int count = 4000, trials = 1000;
  const std::vector<double> radii(count, 0.5);
  const auto share = [&](double filling) {
    const double side = std::sqrt(count * 0.25 * std::numbers::pi / filling);
    std::array<double, 2> found = {};  // along either axis, along x
    Eigen::Matrix2Xd positions(2, count);
    for (int trial = 0; trial < trials; ++trial) {
      for (int i = 0; i < count; ++i) positions(0, i) = side * uniform(), positions(1, i) = side * uniform();
      const DiskClusters clusters(cluster_box(side, side), positions, radii, 0.0);
      Both any = {};
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t axis = 0; axis < 2; ++axis) any[axis] = any[axis] || percolation(clusters, i)[axis];
      found[0] += any[0] || any[1] ? 1.0 / trials : 0.0;
      found[1] += any[0] ? 1.0 / trials : 0.0;
    }
    return found;
  };
  const auto critical = share(1.128087);
  EXPECT_NEAR(critical[0], 0.690473725, 4.0 * std::sqrt(0.6905 * 0.3095 / trials));
  EXPECT_NEAR(critical[1], 0.521058290, 4.0 * std::sqrt(0.25 / trials));
  EXPECT_LT(share(1.00)[0], 0.1);
  EXPECT_GT(share(1.25)[0], 0.9);
}

void expect_means_over_floods(const Observed& o, double gap) {
  double sizes = 0.0, largest = 0.0, number = 0.0, either = 0.0;
  const auto count = static_cast<double>(o.disks.count());
  for (const State& state : o.record.states) {
    std::vector<double> radii = o.disks.radius;
    for (double& radius : radii) radius *= state.scale;
    const Flooded twin = flood(o.scene.box, state.positions, radii, gap);
    std::map<std::size_t, double> members;
    for (const std::size_t cluster : twin.cluster) members[cluster] += 1.0;
    double most = 0.0;
    for (const auto& [cluster, size] : members) sizes += size * size / count, most = std::max(most, size);
    largest += most / count, number += static_cast<double>(members.size()) / count;
    either +=
        std::any_of(twin.percolates.begin(), twin.percolates.end(), [](const Both& one) { return one[0] || one[1]; }) ? 1.0 : 0.0;
  }
  const auto states = static_cast<double>(o.record.states.size());
  EXPECT_NEAR(o.value("clusters", "mean_size"), sizes / states, 1e-12 * count);
  EXPECT_NEAR(o.value("clusters", "largest"), largest / states, 1e-12);
  EXPECT_NEAR(o.value("clusters", "clusters_per_disk"), number / states, 1e-12);
  EXPECT_NEAR(o.value("clusters", "percolating"), either / states, 1e-12);
  double disks = 0.0;
  for (const double in_octave : o.column("clusters", 0, "clusters_per_disk")) disks += in_octave;
  EXPECT_NEAR(disks, number / states, 1e-12);
}

TEST(ObservedClusters, AreMeansOverFloodsOfItsStates) {
  expect_means_over_floods(observe(parse_scene(small_fluid("clusters = { every = 0.5, gap = 0.15 }")), 0.5), 0.15);
  expect_means_over_floods(observe(parse_scene(small_mixture("clusters = { every = 0.5, gap = 0.2 }")), 0.5), 0.2 * 0.75);
}

}  // namespace
}  // namespace carom::test
