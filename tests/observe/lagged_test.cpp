// Observables of pairs of states: each against the sum over all pairs of states that it looks at, and what is known of free
// flight.

#include "observe/lagged_states.hpp"
#include "observe/observed_system.hpp"
#include "support/same_measurements.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double rounding_of_lags = 1e-11;

std::string periodic_mixture(const std::string& observables) {
  return "[box]\nx = [0.0, 9.0]\ny = [0.0, 7.0]\nboundary = \"periodic\"\n[[disks]]\nname = \"big\"\ncount = 12\nradius = 0.5\n"
         "mass = 2.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[[disks]]\nname = \"small\"\ncount = "
         "20\nradius = "
         "0.3\nmass = 0.5\npositions = \"random\"\nvelocities = { temperature = 2.0 }\n[collision]\nrule = \"specular\"\n[run]\n"
         "time = 20.0\n[observe]\n" +
         observables + "\n";
}

/// All that follow disks, at steps of 1/4 of mean diameter 0.75.
const Observed& mixture_in_motion() {
  static const Observed observed =
      observe(parse_scene(periodic_mixture(
                  "intermediate_scattering = { every = 0.25, k = 4.0 }\noverlap = { every = 0.25, range = 1.0 }\n"
                  "non_gaussian = { every = 0.25 }\nvan_hove = { every = 0.25, range = 80.0, bins = 40 }")),
              0.25);
  return observed;
}
constexpr double its_mean_diameter = (12 * 1.0 + 20 * 0.6) / 32.0;

/// The mean of f(later, earlier) over all pairs of states this far apart whose later one is an eighth state of the lag's level:
/// lags below 16 are of level 0, below 32 of level 1, ...
double mean_over_pairs(const Observed& o, std::size_t lag, const std::function<double(std::size_t, std::size_t)>& f) {
  std::size_t spacing = 8, pairs = 0;
  for (std::size_t least = 16; lag >= least; least *= 2) spacing *= 2;
  double sum = 0.0;
  for (std::size_t later = 0; later < o.record.states.size(); later += spacing) {
    if (later < lag) continue;
    sum += f(later, later - lag);
    ++pairs;
  }
  return sum / static_cast<double>(pairs);
}

/// Displacements of the disks of one species, without the common motion, which is none in this scene.
std::vector<Eigen::Vector2d> moved(const Observed& o, std::size_t later, std::size_t earlier, std::int32_t species) {
  const State &a = o.record.states[later], &b = o.record.states[earlier];
  std::vector<Eigen::Vector2d> found;
  for (std::size_t i = 0; i < o.disks.count(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (o.disks.species[i] != species) continue;
    const Eigen::Vector2d images = (a.images.col(k) - b.images.col(k)).cast<double>();
    found.push_back(a.positions.col(k) - b.positions.col(k) + images.cwiseProduct(o.scene.box.lengths()));
  }
  return found;
}

std::vector<std::size_t> lags_of(const Observed& o, const std::string& name) {
  std::vector<std::size_t> lags;
  for (const double lag : o.column(name, 0, "lag")) lags.push_back(static_cast<std::size_t>(std::lround(lag / 0.25)));
  return lags;
}

TEST(ObservedLags, GrowWithTheLogarithmOfTheRun) {
  EXPECT_EQ(lags_of(mixture_in_motion(), "non_gaussian"),
            (std::vector<std::size_t>{1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16,
                                      18, 20, 22, 24, 26, 28, 30, 32, 36, 40, 44, 48, 52, 56, 60, 64}));
}

/// Four wave vectors near 4 / 0.75 = 5.33 in a box of 9 by 7.
TEST(ObservedLags, ScatteringIsThatOfAllPairsOfStates) {
  const Observed& o = mixture_in_motion();
  std::vector<Eigen::Vector2d> vectors;
  double mean = 0.0;
  for (int d = 0; d < 4; ++d) {
    const double angle = std::numbers::pi * (0.25 + d) / 4.0, k = 4.0 / its_mean_diameter;
    const double x = std::round(k * std::cos(angle) * 9.0 / 2.0 / std::numbers::pi);
    const double y = std::round(k * std::sin(angle) * 7.0 / 2.0 / std::numbers::pi);
    vectors.emplace_back(2.0 * std::numbers::pi * x / 9.0, 2.0 * std::numbers::pi * y / 7.0);
    mean += vectors.back().norm() / 4.0;
  }
  EXPECT_NEAR(o.value("intermediate_scattering", "k"), mean, rounding_of_lags);
  const auto mode = [&](std::size_t state, const Eigen::Vector2d& k) {
    std::complex<double> sum = 0.0;
    for (Eigen::Index i = 0; i < 32; ++i) sum += std::polar(1.0, k.dot(o.record.states[state].positions.col(i)));
    return sum;
  };
  const std::vector<std::size_t> lags = lags_of(o, "intermediate_scattering");
  ASSERT_EQ(lags.front(), 0U);
  for (std::size_t row = 0; row < lags.size(); ++row) {
    const double all = mean_over_pairs(o, lags[row], [&](std::size_t later, std::size_t earlier) {
      double sum = 0.0;
      for (const Eigen::Vector2d& k : vectors) sum += 0.25 * (mode(later, k) * std::conj(mode(earlier, k))).real() / 32.0;
      return sum;
    });
    EXPECT_NEAR(o.column("intermediate_scattering", 0, "F")[row], all, rounding_of_lags) << lags[row];
    for (const int species : {0, 1}) {
      const double self = mean_over_pairs(o, lags[row], [&](std::size_t later, std::size_t earlier) {
        double sum = 0.0;
        const auto displacements = moved(o, later, earlier, species);
        for (const Eigen::Vector2d& way : displacements)
          for (const Eigen::Vector2d& k : vectors) sum += 0.25 * std::cos(k.dot(way));
        return sum / static_cast<double>(displacements.size());
      });
      EXPECT_NEAR(o.column("intermediate_scattering", 0, species == 0 ? "F_self_big" : "F_self_small")[row], self,
                  rounding_of_lags);
    }
  }
  EXPECT_NEAR(o.column("intermediate_scattering", 0, "F_self_big")[0], 1.0, rounding_of_lags);
}

/// With the number behind their names, in the order of the list, after the other names of the table.
TEST(ObservedLags, ScatteringOfAListIsThatOfARunForEachWaveNumberToTheLastBit) {
  const std::vector<std::pair<std::string, std::string>> numbers = {{"4.0", "_4"}, {"0.75", "_0.75"}, {"12.5625", "_12.5625"}};
  const auto scattering = [](const std::string& k) {
    return observe(parse_scene(periodic_mixture("intermediate_scattering = { every = 0.25, k = " + k + " }")), 0.25)
        .of("intermediate_scattering");
  };
  const Measurement list = scattering("[4.0, 0.75, 12.5625]");
  Measurement expected{.name = "intermediate_scattering", .tables = {{.name = "intermediate_scattering"}}};
  for (const auto& [k, suffix] : numbers) {
    const Measurement alone = scattering(k);
    for (Scalar scalar : alone.scalars) {
      scalar.name += suffix;
      expected.scalars.push_back(scalar);
    }
    for (Column column : alone.tables.at(0).columns) {
      if (column.name == "lag" && !expected.tables[0].columns.empty()) continue;
      if (const std::size_t error = column.name.find("_error"); error != std::string::npos)
        column.name.insert(error, suffix);
      else if (column.name != "lag")
        column.name += suffix;
      expected.tables[0].columns.push_back(column);
    }
  }
  ASSERT_EQ(list.scalars.size(), 9U) << "k and two relaxation times for each";
  ASSERT_EQ(list.tables.at(0).columns.size(), expected.tables[0].columns.size());
  for (std::size_t s = 0; s < list.scalars.size(); ++s) EXPECT_EQ(list.scalars[s].name, expected.scalars[s].name);
  for (std::size_t c = 0; c < list.tables[0].columns.size(); ++c)
    EXPECT_EQ(list.tables[0].columns[c].name, expected.tables[0].columns[c].name);
  EXPECT_EQ(list.tables[0].columns[3].name, "F_self_big_4");
  expect_same_measurements({list}, {expected});
}

TEST(ObservedLags, ScatteringOfAListOfOneHasTheNumberInItsNames) {
  const Observed o = observe(parse_scene(small_fluid("intermediate_scattering = { every = 0.25, k = [6.25] }")), 0.25);
  EXPECT_EQ(o.column("intermediate_scattering", 0, "F_self_6.25").size(), o.column("intermediate_scattering", 0, "lag").size());
  EXPECT_GT(o.value("intermediate_scattering", "k_6.25"), 0.0);
}

TEST(ObservedLags, OverlapAndItsFluctuationsAreThoseOfAllPairsOfStates) {
  const Observed& o = mixture_in_motion();
  const std::vector<std::size_t> lags = lags_of(o, "overlap");
  for (std::size_t row = 0; row < lags.size(); ++row) {
    const auto moment = [&](double power) {
      return mean_over_pairs(o, lags[row], [&](std::size_t later, std::size_t earlier) {
        double near = 0.0;
        for (const Eigen::Vector2d& way : moved(o, later, earlier, 0)) near += way.norm() < its_mean_diameter ? 1.0 : 0.0;
        return std::pow(near / 12.0, power);
      });
    };
    const double q = moment(1.0), square = moment(2.0);
    EXPECT_NEAR(o.column("overlap", 0, "overlap_big")[row], q, rounding_of_lags);
    if (q > 0.0) {
      EXPECT_NEAR(o.column("overlap", 0, "chi_4_big")[row], 12.0 * (square - q * q), 1e-10) << lags[row];
    }
  }
}

TEST(ObservedLags, MomentsOfDisplacementsAreThoseOfAllPairsOfStates) {
  const Observed& o = mixture_in_motion();
  const std::vector<std::size_t> lags = lags_of(o, "non_gaussian");
  for (std::size_t row = 0; row < lags.size(); ++row) {
    const auto moment = [&](int power) {
      return mean_over_pairs(o, lags[row], [&](std::size_t later, std::size_t earlier) {
        double sum = 0.0;
        for (const Eigen::Vector2d& way : moved(o, later, earlier, 1)) sum += std::pow(way.norm(), power) / 20.0;
        return sum;
      });
    };
    EXPECT_NEAR(o.column("non_gaussian", 0, "alpha_2_small")[row], moment(4) / (2.0 * std::pow(moment(2), 2)) - 1.0, 1e-10);
  }
}

TEST(ObservedLags, VanHoveCountsAllDisplacementsAndIntegratesToOne) {
  const Observed& o = mixture_in_motion();
  const double width = 80.0 * its_mean_diameter / 40.0;
  for (const std::size_t lag : {1U, 2U, 4U, 8U, 16U, 32U, 64U}) {
    const std::vector<double>& density =
        o.column("van_hove", 0, fmt::format("density_small_{:.6g}", 0.25 * static_cast<double>(lag)));
    double integral = 0.0;
    for (std::size_t b = 0; b < 40; ++b) {
      const double share = mean_over_pairs(o, lag, [&](std::size_t later, std::size_t earlier) {
        double count = 0.0;
        for (const Eigen::Vector2d& way : moved(o, later, earlier, 1))
          count += std::floor(way.norm() / width) == static_cast<double>(b) ? 1.0 : 0.0;
        return count / 20.0;
      });
      EXPECT_NEAR(density[b] * width, share, rounding_of_lags);
      integral += density[b] * width;
    }
    EXPECT_NEAR(integral, 1.0, 1e-12);
  }
}

/// N disks of momentum 0 and given energy have velocities on a sphere in 2 (N - 1) dimensions. A part of 2 of them has
/// <v^4> / 2 <v^2>^2 = (N - 1) / N, and <cos kvt> is Gamma(N-1) (2/z)^(N-2) J_(N-2)(z), z^2 = 2 (N - 1) (k t v_T)^2 (N - 1) / N.
TEST(SlowObservedLags, OfFreeFlightAreThoseOfTheMicrocanonicalGas) {
  for (const int count : {4, 12}) {
    const double step = 0.05;
    const Observed o = observe(
        parse_scene(fmt::format(
            "[box]\nx = [0.0, 24.0]\ny = [0.0, 24.0]\nboundary = \"periodic\"\n[[disks]]\ncount = {}\nradius = "
            "0.2\nmass = 1.0\npositions = \"random\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\nrule = "
            "\"specular\"\n[run]\ntime = 100000.0\nequilibrate = {{ collisions_per_disk = 100 }}\n[observe]\n"
            "temperature = {{ every = 100.0 }}\nnon_gaussian = {{ every = {} }}\nintermediate_scattering = {{ every = {}, k "
            "= 4.8 }}\n",
            count, step, step)),
        1000.0);
    const double n = count, expected = -1.0 / n, error = o.column("non_gaussian", 0, "alpha_2_error")[0];
    EXPECT_NEAR(o.column("non_gaussian", 0, "alpha_2")[0], expected, 5.0 * error);
    EXPECT_LT(error, 0.25 / n) << "the law is distinguished from that of independent disks";
    const double speed = std::sqrt(o.value("temperature", "kT")), k = o.value("intermediate_scattering", "k");
    for (const std::size_t row : {1U, 2U, 3U}) {
      const double z = k * step * static_cast<double>(row) * speed * std::sqrt(2.0 * (n - 1.0) * (n - 1.0) / n);
      const double law = std::tgamma(n - 1.0) * std::pow(2.0 / z, n - 2.0) * std::cyl_bessel_j(n - 2.0, z);
      EXPECT_NEAR(o.column("intermediate_scattering", 0, "F_self")[row], law,
                  5.0 * o.column("intermediate_scattering", 0, "F_self_error")[row])
          << row;
    }
  }
}

/// F(k,0) is S(k): of the same states as the whole shell of a structure factor.
/// All states are then at few moments between two redraws, which come at equal steps, and pairs at the same lag no mean over
/// time.
TEST(ObservedLags, AreNotedWhereTheyKeepStepWithBrownianRedraws) {
  const std::vector<std::string> all = {"mean_square_displacement", "intermediate_scattering", "overlap", "non_gaussian",
                                        "van_hove"};
  const auto note_at = [&](double every, const std::string& name, double rate = 0.5) {
    std::string lines = fmt::format("[brownian]\ntemperature = 1.0\nrate = {}\n[observe]\n", rate);
    for (const std::string& one : all) lines += fmt::format("{} = {{ every = {} }}\n", one, every);
    std::string scene = periodic_mixture("");
    scene.replace(scene.find("[observe]"), 9, lines);
    return observe(parse_scene(scene), every).of(name).note;
  };
  for (const std::string& name : all) {
    EXPECT_THAT(note_at(0.25, name), HasSubstr("states lie at one moment between two of them; take every = 0.2325")) << name;
    EXPECT_THAT(note_at(0.3125, name), HasSubstr("states lie at 4 moments")) << name;
    EXPECT_THAT(note_at(0.2325, name), Not(HasSubstr("moment"))) << name;
    EXPECT_THAT(note_at(1.0, name, 5.0), HasSubstr("take every = 0.9207")) << name << ": 0.93 has 5 moments";
    EXPECT_THAT(note_at(1.0, name, 50.0), Not(HasSubstr("moment"))) << name << ": no lag is of few redraws";
  }
}

TEST(ObservedLags, ScatteringBeginsWithTheStructureFactor) {
  // In a square box of side L the four vectors near 2 pi / L are (1, 0), (1, 1), (0, 1) and (-1, 1), the first shell of S(k).
  const std::string scene = small_fluid("", "specular", "40.0");
  const double side = parse_scene(scene).box.lengths().x();
  const Observed o =
      observe(parse_scene(small_fluid(fmt::format("structure_factor = {{ every = 0.8, largest = {0:.17g} }}\n"
                                                  "intermediate_scattering = {{ every = 0.1, k = {1:.17g} }}",
                                                  2.0 * 2.0 * std::numbers::pi / side, 1.3 * 2.0 * std::numbers::pi / side),
                                      "specular", "40.0")),
              0.8);
  ASSERT_EQ(o.column("structure_factor", 0, "vectors")[0], 4.0);
  EXPECT_NEAR(o.value("intermediate_scattering", "k"), o.column("structure_factor", 0, "k")[0], 1e-12);
  EXPECT_NEAR(o.column("intermediate_scattering", 0, "F")[0], o.column("structure_factor", 0, "S")[0], 1e-12);
}

}  // namespace
}  // namespace carom::test
