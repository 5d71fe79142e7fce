// Observables of velocities and places against the obvious computation on the states that they saw.

#include "observe/observed_system.hpp"

#include <cmath>
#include <numbers>
#include <set>

namespace carom::test {
namespace {

/// Of sums over some thousand terms of order one.
constexpr double rounding_of_means = 1e-12;

const Observed& mixture() {
  static const Observed observed =
      observe(parse_scene(small_mixture(
                  "temperature = { every = 0.05 }\nspeeds = { every = 0.05, bins = 20 }\nvelocity_moments = { every = "
                  "0.05 }\ndensity_profile = { every = 0.05, axis = \"x\", bins = 9 }\nh_function = { every = 0.05 }")),
              0.05);
  return observed;
}

/// Mean over states and the disks of one species (or of all, -1) of f(mass, position, velocity).
template <class F>
double mean_of(const Observed& o, int species, F f) {
  double sum = 0.0, count = 0.0;
  for (const State& state : o.record.states) {
    for (std::size_t i = 0; i < o.disks.count(); ++i) {
      if (species >= 0 && o.disks.species[i] != species) continue;
      const auto c = static_cast<Eigen::Index>(i);
      sum += f(o.disks.mass[i], Eigen::Vector2d(state.positions.col(c)), Eigen::Vector2d(state.velocities.col(c)));
      count += 1.0;
    }
  }
  return sum / count;
}

TEST(ObservedVelocities, TemperatureOfAllAxesAndSpeciesIsThatOfTheStates) {
  const Observed& o = mixture();
  using V = Eigen::Vector2d;
  EXPECT_NEAR(o.value("temperature", "kT"), mean_of(o, -1, [](double m, V, V v) { return 0.5 * m * v.squaredNorm(); }),
              rounding_of_means);
  EXPECT_NEAR(o.value("temperature", "kT_x"), mean_of(o, -1, [](double m, V, V v) { return m * v.x() * v.x(); }),
              rounding_of_means);
  EXPECT_NEAR(o.value("temperature", "kT_y"), mean_of(o, -1, [](double m, V, V v) { return m * v.y() * v.y(); }),
              rounding_of_means);
  EXPECT_NEAR(o.value("temperature", "kT_big"), mean_of(o, 0, [](double m, V, V v) { return 0.5 * m * v.squaredNorm(); }),
              rounding_of_means);
  EXPECT_NEAR(o.value("temperature", "kT_small"), mean_of(o, 1, [](double m, V, V v) { return 0.5 * m * v.squaredNorm(); }),
              rounding_of_means);
}

TEST(ObservedVelocities, TemperatureInAPeriodicBoxLeavesTheCommonMotionOut) {
  std::string scene = small_fluid("temperature = { every = 0.1 }");
  scene.replace(scene.find("time = 5.0"), 10, "time = 1.0\nkeep_momentum = true");
  const Observed o = observe(parse_scene(scene), 0.1);
  const State& state = o.record.states.front();
  const Eigen::Vector2d common = state.velocities.rowwise().mean();
  ASSERT_GT(common.norm(), 0.01) << "the system should drift for this test to say anything";
  const double K = 0.5 * 1.5 * (state.velocities.colwise() - common).squaredNorm();
  EXPECT_NEAR(o.value("temperature", "kT"), K / 39.0, rounding_of_means);  // equal masses: energy and momentum stay
}

TEST(ObservedVelocities, HHasNoErrorWhereNoTwoDisksShareABin) {
  const Observed o =
      observe(parse_scene("[box]\nx = [0.0, 9.0]\ny = [0.0, 9.0]\nboundary = \"periodic\"\n[[disks]]\nradius = 0.5\nmass = 1.0\n"
                          "positions = [[1.0, 1.0], [4.0, 1.0], [7.0, 1.0]]\nvelocities = [[0.0, 1.0], [0.0, -1.0], [0.0, 3.0]]\n"
                          "[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n[observe]\nh_function = { every = 0.5 }\n"),
              0.5);
  for (const double error : o.column("h_function", 0, "H_error")) EXPECT_TRUE(std::isnan(error));
}

/// Until the bath acts, N disks share the energy of 2 (N - 1) degrees of freedom; from then on of 2 N.
TEST(ObservedVelocities, TemperatureIsThatOfTheEffectsThatActAtTheTime) {
  std::string scene = small_fluid("temperature = { every = 0.1 }");
  scene.insert(scene.find("[observe]"), "[[changes]]\ntime = 2.55\nset = [\"thermostat={ temperature = 1.0, rate = 1.0 }\"]\n");
  const Observed o = observe(parse_scene(scene), 0.1);
  double squares = 0.0, freedom = 0.0;
  for (const State& state : o.record.states) {
    squares += 1.5 * state.velocities.squaredNorm();
    freedom += state.time < 2.55 ? 78.0 : 80.0;
  }
  EXPECT_NEAR(o.value("temperature", "kT"), squares / freedom, rounding_of_means);
}

TEST(ObservedVelocities, MomentsAreThoseOfTheStates) {
  const Observed& o = mixture();
  using V = Eigen::Vector2d;
  for (const auto& [species, suffix] : {std::pair{0, "_big"}, std::pair{1, "_small"}}) {
    const double v2 = mean_of(o, species, [](double, V, V v) { return v.squaredNorm(); });
    const double v4 = mean_of(o, species, [](double, V, V v) { return std::pow(v.squaredNorm(), 2); });
    const double x2 = mean_of(o, species, [](double, V, V v) { return v.x() * v.x(); });
    const double x4 = mean_of(o, species, [](double, V, V v) { return std::pow(v.x(), 4); });
    EXPECT_NEAR(o.value("velocity_moments", std::string("v2") + suffix), v2, v2 * rounding_of_means);
    EXPECT_NEAR(o.value("velocity_moments", std::string("v4") + suffix), v4, v4 * rounding_of_means);
    EXPECT_NEAR(o.value("velocity_moments", std::string("kurtosis") + suffix), v4 / (v2 * v2), rounding_of_means);
    EXPECT_NEAR(o.value("velocity_moments", std::string("kurtosis_x") + suffix), x4 / (x2 * x2), rounding_of_means);
    EXPECT_NEAR(o.value("velocity_moments", std::string("speed") + suffix),
                mean_of(o, species, [](double, V, V v) { return v.norm(); }), rounding_of_means);
    EXPECT_NEAR(o.value("velocity_moments", std::string("vx3") + suffix),
                mean_of(o, species, [](double, V, V v) { return std::pow(v.x(), 3); }), 10.0 * rounding_of_means);
  }
}

TEST(ObservedVelocities, HistogramsCountTheDisksOfTheStates) {
  const Observed& o = mixture();
  for (const auto& [species, suffix] : {std::pair{-1, ""}, std::pair{0, "_big"}, std::pair{1, "_small"}}) {
    const auto& middles = o.column("speeds", 0, "middle");
    const auto& energies = o.column("speeds", 1, "middle");
    const double width = 2.0 * middles[0], energy_width = 2.0 * energies[0];
    for (std::size_t b = 0; b < middles.size(); ++b) {
      const double share = mean_of(o, species, [&](double, const Eigen::Vector2d&, const Eigen::Vector2d& v) {
        return std::floor(v.norm() / width) == static_cast<double>(b) ? 1.0 : 0.0;
      });
      EXPECT_NEAR(o.column("speeds", 0, std::string("density") + suffix)[b], share / width, rounding_of_means);
      const double of_energy = mean_of(o, species, [&](double m, const Eigen::Vector2d&, const Eigen::Vector2d& v) {
        return std::floor(0.5 * m * v.squaredNorm() / energy_width) == static_cast<double>(b) ? 1.0 : 0.0;
      });
      EXPECT_NEAR(o.column("speeds", 1, std::string("density") + suffix)[b], of_energy / energy_width, rounding_of_means);
    }
  }
}

TEST(ObservedVelocities, DensityProfileCountsTheDisksOfEachStrip) {
  const Observed& o = mixture();
  const auto& places = o.column("density_profile", 0, "x");
  ASSERT_EQ(places.size(), 9U);
  double all = 0.0;
  for (std::size_t b = 0; b < places.size(); ++b) {
    EXPECT_NEAR(places[b], static_cast<double>(b) + 0.5, rounding_of_means);  // strips of width 1 and height 7
    const auto inside = [&](double, const Eigen::Vector2d& r, const Eigen::Vector2d&) {
      return r.x() >= static_cast<double>(b) && r.x() < static_cast<double>(b) + 1.0 ? 1.0 : 0.0;
    };
    EXPECT_NEAR(o.column("density_profile", 0, "density")[b], 32.0 / 7.0 * mean_of(o, -1, inside), rounding_of_means);
    EXPECT_NEAR(o.column("density_profile", 0, "density_small")[b], 20.0 / 7.0 * mean_of(o, 1, inside), rounding_of_means);
    all += 7.0 * o.column("density_profile", 0, "density")[b];
  }
  EXPECT_NEAR(all, 32.0, rounding_of_means);
}

using Bins = std::multiset<std::pair<int, int>>;

/// H of disks in these bins of that width, less Miller's bias.
double h_of(const Bins& bins, double width) {
  const auto count = static_cast<double>(bins.size());
  const std::set<std::pair<int, int>> distinct(bins.begin(), bins.end());
  double h = -(static_cast<double>(distinct.size()) - 1.0) / (2.0 * count);
  for (const auto& bin : distinct) {
    const double share = static_cast<double>(bins.count(bin)) / count;
    h += share * std::log(share / (width * width));
  }
  return h;
}

/// From a sorted list of bins in place of a grid of counts. The error is that of H without each disk in turn, and unknown where a
/// species has no two disks in one bin.
TEST(ObservedVelocities, HIsThatOfTheBinsThatVelocitiesFallInto) {
  const Observed& o = mixture();
  double kT = 0.0;
  for (std::size_t i = 0; i < o.disks.count(); ++i)
    kT += 0.5 * o.disks.mass[i] * o.record.states.front().velocities.col(static_cast<Eigen::Index>(i)).squaredNorm() / 32.0;
  int known = 0;
  for (std::size_t row = 0; row < o.record.states.size(); ++row) {
    double h = 0.0, variance = 0.0;
    bool is_known = true;
    for (int s = 0; s < 2; ++s) {
      const double width = 0.5 * std::sqrt(kT / (s == 0 ? 2.0 : 0.5)), count = s == 0 ? 12.0 : 20.0;
      Bins bins;
      for (std::size_t i = 0; i < o.disks.count(); ++i) {
        if (o.disks.species[i] != s) continue;
        const Eigen::Vector2d v = o.record.states[row].velocities.col(static_cast<Eigen::Index>(i)) / width;
        bins.insert({static_cast<int>(std::floor(v.x())), static_cast<int>(std::floor(v.y()))});
      }
      h += count / 32.0 * h_of(bins, width);
      std::vector<double> without;
      double mean = 0.0;
      for (const auto& bin : bins) {
        Bins others = bins;
        others.erase(others.find(bin));
        without.push_back(h_of(others, width));
        mean += without.back() / count;
      }
      for (const double one : without) variance += std::pow(count / 32.0 * (one - mean), 2) * (count - 1.0) / count;
      is_known = is_known && std::set<std::pair<int, int>>(bins.begin(), bins.end()).size() < bins.size();
    }
    EXPECT_NEAR(o.column("h_function", 0, "H")[row], h, rounding_of_means);
    const double error = o.column("h_function", 0, "H_error")[row];
    EXPECT_EQ(!std::isnan(error), is_known) << row;
    if (!is_known) continue;
    EXPECT_NEAR(error, std::sqrt(variance), rounding_of_means);
    ++known;
  }
  EXPECT_GT(known, 10);
  EXPECT_EQ(o.column("h_function", 0, "time")[0], 0.0);
  EXPECT_NEAR(o.column("h_function", 0, "time")[7], 0.35, rounding_of_means);
}

TEST(ObservedSpeeds, BeyondTheHistogramsAreSaid) {
  const auto heated = [](double kT) {
    return observe(
        parse_scene("[box]\nx = [0.0, 6.0]\ny = [0.0, 6.0]\nboundary = \"walls\"\n[[disks]]\ncount = 12\nradius = 0.3\nmass = "
                    "1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n"
                    "[walls]\ntop = { temperature = " +
                    std::to_string(kT) + " }\n[run]\ntime = 40.0\n[observe]\nspeeds = true\nh_function = true"),
        40.0);
  };
  const Observed hot = heated(1000.0), mild = heated(1.0);
  for (const char* name : {"speeds", "h_function"}) {
    EXPECT_NE(hot.of(name).note.find("beyond the histogram"), std::string::npos) << name;
    EXPECT_EQ(mild.of(name).note, "") << name;
  }
}

TEST(ObservedPlaces, AreasAreThoseThatMovingWallsLeave) {
  const Observed o = observe(
      parse_scene(
          "[box]\nx = [0.0, 10.0]\ny = [0.0, 6.0]\nboundary = \"walls\"\n[[disks]]\ncount = 12\nradius = 0.3\nmass = 1.0\n"
          "positions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n[walls]\nright = { "
          "velocity = -1.0 }\n[run]\ntime = 4.0\n[observe]\ndensity_profile = { every = 0.25, axis = \"y\", bins = 3 }"),
      0.25);
  double density = 0.0, expected = 0.0;
  for (const double one : o.column("density_profile", 0, "density")) density += 2.0 * one;
  for (const State& state : o.record.states) expected += 12.0 / state.walls[1].position;
  EXPECT_NEAR(density, expected / static_cast<double>(o.record.states.size()), rounding_of_means);
}

}  // namespace
}  // namespace carom::test
