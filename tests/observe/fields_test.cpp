// Fields on a grid: shares of a collision in closed form, sums over cells against the whole box, and the fluxes of a steady flow.

#include "observe/long_blocks.hpp"
#include "observe/observed_system.hpp"
#include "support/systems.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace carom::test {
namespace {

const std::vector<double>& field(const Observed& o, const std::string& name) { return o.column("fields", 0, name); }

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Two disks that meet head-on at time 1, with their centres at 3.25 and 4.25.
Observed head_on(const std::string& cells, const std::string& more = "") {
  return observe(
      parse_scene("[box]\nx = [0.0, 10.0]\ny = [0.0, 4.0]\nboundary = \"periodic\"\n[[disks]]\nradius = 0.5\nmass = 1.0\n"
                  "positions = [[2.25, 1.0], [5.25, 1.0]]\nvelocities = [[1.0, 0.0], [-1.0, 0.0]]\n[collision]\nrule = "
                  "\"specular\"\n[run]\ntime = 2.0\n" +
                  more + "[observe]\nfields = { every = 0.25, cells = " + cells + " }\n"),
      0.25);
}

TEST(Fields, ACollisionIsSharedAmongTheCellsThatTheLineOfCentresRunsThrough) {
  // r dp = 2 in all; three quarters of the line lie in the cell from 3 to 4, a quarter in the next.
  const Observed fine = head_on("[10, 1]");
  ASSERT_EQ(fine.totals.pair, 1U);
  std::vector<double> carried(10), disks(10);
  for (std::size_t k = 1; k < fine.record.states.size(); ++k)
    for (int i = 0; i < 2; ++i) disks[static_cast<std::size_t>(fine.record.states[k].positions(0, i))] += 1.0;
  const double steps = 8.0, area = 4.0, time = 2.0;
  for (std::size_t c = 0; c < 10; ++c) {
    EXPECT_NEAR(field(fine, "density")[c], disks[c] / (steps * area), 1e-15) << c;
    if (disks[c] == 0.0) {
      EXPECT_TRUE(std::isnan(field(fine, "stress_xx")[c])) << "no disk, no flow relative to which a stress is one: " << c;
      continue;
    }
    const double u = field(fine, "velocity_x")[c];
    carried[c] = field(fine, "stress_xx")[c] * area * time - disks[c] * (1.0 - u * u) / steps * time;
  }
  EXPECT_NEAR(carried[3], 1.5, 1e-14);
  EXPECT_NEAR(carried[4], 0.5, 1e-14);
  for (const std::size_t c : {2U, 5U}) EXPECT_NEAR(carried[c], 0.0, 1e-14) << c;
}

TEST(Fields, OfOneCellAreThoseOfTheBox) {
  const Observed o = observe(parse_scene(small_fluid("fields = { every = 0.05, cells = [1, 1] }\npressure = true")), 0.05);
  const double area = o.scene.box.area(), mass = 1.5, steps = static_cast<double>(o.record.states.size()) - 1.0;
  // 100 steps are 25 stretches of 4, so nothing is left out. The momentum of all is zero.
  Eigen::Matrix2d flow = Eigen::Matrix2d::Zero();
  for (std::size_t k = 1; k < o.record.states.size(); ++k)
    flow += mass * o.record.states[k].velocities * o.record.states[k].velocities.transpose();
  EXPECT_NEAR(field(o, "density")[0], 40.0 / area, 1e-13);
  EXPECT_NEAR(field(o, "velocity_x")[0], 0.0, 1e-13);
  EXPECT_NEAR(field(o, "temperature")[0], 0.5 * flow.trace() / (40.0 * steps), 1e-12);
  const double virial =
      0.5 * (field(o, "stress_xx")[0] + field(o, "stress_yy")[0]) * 2.0 * area * o.time - flow.trace() / steps * o.time;
  EXPECT_NEAR(virial, o.totals.virial, 1e-10 * o.totals.virial);
  EXPECT_NEAR(field(o, "stress_xy")[0], field(o, "stress_yx")[0], 1e-12) << "smooth disks keep angular momentum";
  EXPECT_NEAR(field(o, "energy_lost")[0], 0.0, 1e-13);
}

TEST(Fields, NoRoundingMakesTheTemperatureOfOneDiskNegative) {
  const Observed o = observe(
      parse_scene("[box]\nx = [0.0, 6.0]\ny = [0.0, 6.0]\nboundary = \"periodic\"\n[[disks]]\nradius = 0.2\nmass = 1.1\n"
                  "positions = [[1.0, 2.0]]\nvelocities = [[0.31, 0.17]]\n[collision]\nrule = \"specular\"\n[run]\ntime = 200.0\n"
                  "[observe]\nfields = { every = 0.1, cells = [4, 4] }\n"),
      0.1);
  for (const char* const name : {"temperature", "stress_xx", "stress_yy"})
    for (const double value : field(o, name)) EXPECT_FALSE(value < 0.0) << name;
}

TEST(Fields, OfManyCellsSumUpToThoseOfTheBox) {
  const auto in_cells = [](const std::string& cells) {
    return observe(parse_scene(small_fluid("fields = { every = 0.05, cells = " + cells + " }")), 5.0);
  };
  const Observed whole = in_cells("[1, 1]"), parts = in_cells("[3, 5]");
  const auto energy = [](const Observed& o) {  // n kT + rho u^2 / 2
    double sum = 0.0;
    for (std::size_t c = 0; c < field(o, "density").size(); ++c)
      sum += field(o, "density")[c] * (field(o, "temperature")[c] +
                                       0.75 * (std::pow(field(o, "velocity_x")[c], 2) + std::pow(field(o, "velocity_y")[c], 2)));
    return sum / static_cast<double>(field(o, "density").size());
  };
  const auto momentum_flux = [](const Observed& o) {  // P_xx + rho u_x u_x
    double sum = 0.0;
    for (std::size_t c = 0; c < field(o, "density").size(); ++c)
      sum += field(o, "stress_xx")[c] + 1.5 * field(o, "density")[c] * std::pow(field(o, "velocity_x")[c], 2);
    return sum / static_cast<double>(field(o, "density").size());
  };
  EXPECT_NEAR(mean_of(field(parts, "density")), field(whole, "density")[0], 1e-14);
  EXPECT_NEAR(energy(parts), energy(whole), 1e-13);
  EXPECT_NEAR(momentum_flux(parts), momentum_flux(whole), 1e-12);
}

TEST(Fields, InTimeAverageToThoseOfTheRun) {
  const Observed o = observe(parse_scene(small_fluid("fields = { every = 0.05, cells = [2, 1] }")), 5.0);
  const std::vector<double>& time = o.column("fields", 1, "time");
  ASSERT_EQ(time.size() % 2, 0U);
  EXPECT_LT(time.size() / 2, 32U);
  EXPECT_GE(time.size() / 2, 16U);
  EXPECT_DOUBLE_EQ(time[2] - time[0], 2.0 * time[0]) << "the middles of stretches of one length";
  double density = 0.0;
  for (std::size_t row = 0; row < time.size(); row += 2) density += o.column("fields", 1, "density")[row];
  EXPECT_NEAR(2.0 * density / static_cast<double>(time.size()), field(o, "density")[0], 1e-13);
}

/// The density is a mean of the stretches, whose jackknife is the standard error of a mean. All cells tell together how far
/// correlations reach into the next stretch.
TEST(Fields, ErrorsAreThoseOfStretchesThatCorrelateAsAllCellsSay) {
  for (const char* time : {"5.0", "4.85", "0.8"}) {  // of 100 steps, of 97 and of 16
    const Observed o = observe(parse_scene(small_fluid("fields = { every = 0.05, cells = [3, 3] }", "specular", time)), 5.0);
    const std::vector<double>& in_time = o.column("fields", 1, "density");
    const std::size_t cells = 9, count = in_time.size() / cells;
    NextBlockCorrelation correlation(count);
    std::vector<double> squared_errors;
    for (std::size_t c = 0; c < cells; ++c) {
      std::vector<double> stretches;
      for (std::size_t s = 0; s < count; ++s) stretches.push_back(in_time[s * cells + c]);
      const double n = static_cast<double>(count), mean = mean_of(stretches);
      double squares = 0.0, products = 0.0;
      for (std::size_t s = 0; s < count; ++s) {
        squares += (stretches[s] - mean) * (stretches[s] - mean);
        if (s > 0) products += (stretches[s] - mean) * (stretches[s - 1] - mean);
      }
      correlation.add(mean, squares, products);
      squared_errors.push_back(squares / (n * (n - 1.0)));
    }
    const double factor = variance_by_correlated_blocks(correlation.value(), count);
    for (std::size_t c = 0; c < cells; ++c)
      EXPECT_NEAR(std::pow(field(o, "density_error")[c], 2), factor * squared_errors[c], 1e-12);
    if (std::string(time) == "0.8") {
      EXPECT_GT(factor, 1.0) << "steps so short that disks hardly move";
    }
  }
}

/// Cells whose disks all came in a few stretches would have errors of next to nothing.
TEST(Fields, OfACellWhoseDisksCameInFewStretchesHaveNoErrors) {
  const Observed o = observe(
      parse_scene(
          "[box]\nx = [0.0, 12.0]\ny = [0.0, 12.0]\nboundary = \"walls\"\n[[disks]]\ncount = 3\nradius = 0.5\nmass = 1.0\n"
          "positions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n"
          "[run]\ntime = 31.0\n[observe]\nfields = { every = 0.1, cells = [3, 3] }\n"),
      31.0);
  const std::vector<double>& in_time = o.column("fields", 1, "density");
  std::size_t known = 0;
  for (std::size_t c = 0; c < 9; ++c) {
    double sum = 0.0, squares = 0.0;
    for (std::size_t row = c; row < in_time.size(); row += 9) sum += in_time[row], squares += in_time[row] * in_time[row];
    const bool is_known = sum * sum >= 8.0 * squares;
    known += is_known ? 1 : 0;
    for (const char* name : {"density_error", "velocity_x_error", "temperature_error"})
      EXPECT_EQ(!std::isnan(field(o, name)[c]), is_known) << name << " of cell " << c;
  }
  EXPECT_GT(known, 0U);
  EXPECT_LT(known, 9U);
}

TEST(Fields, SayWhereStretchesAreTooShortForTheirCorrelations) {
  const auto note = [](const char* every, const char* time) {
    const std::string asked = fmt::format("fields = {{ every = {}, cells = [2, 2] }}", every);
    return observe(parse_scene(small_fluid(asked, "specular", time)), 5.0).of("fields").note;
  };
  EXPECT_EQ(note("0.5", "200.0"), "");
  EXPECT_EQ(note("0.05", "0.8"), "the run is too short for some correlations: errors there are lower bounds")
      << "disks hardly move";
}

TEST(Fields, OfDisksThatDissipateTellTheEnergyThatCollisionsTake) {
  const Observed o =
      observe(parse_scene("[box]\naspect = 1.0\nboundary = \"periodic\"\n[[disks]]\ncount = 64\nradius = 0.5\nmass = "
                          "1.0\npacking_fraction = 0.3\npositions = \"random\"\nvelocities = { temperature = 1.0 "
                          "}\n[collision]\nrule = \"specular\"\nrestitution = 0.9\n[run]\ntime = 3.2\n[observe]\n"
                          "fields = { every = 0.1, cells = [4, 4] }\n"),
              3.2);
  EXPECT_NEAR(mean_of(field(o, "energy_lost")) * o.scene.box.area() * o.time, o.totals.dissipated, 1e-10 * o.totals.dissipated);
}

TEST(Fields, OfRoughDisksCarryTheEnergyOfSpin) {
  const Observed o =
      observe(parse_scene("[box]\nx = [0.0, 10.0]\ny = [0.0, 10.0]\nboundary = \"periodic\"\n[[disks]]\nradius = "
                          "0.5\nmass = 2.0\npositions = [[2.0, 1.3], [5.0, 1.0]]\nvelocities = [[1.0, 0.0], [-1.5, "
                          "0.0]]\n[collision]\nrule = \"specular\"\nroughness = 1.0\n[run]\ntime = "
                          "2.0\n[observe]\nfields = { every = 0.25, cells = [1, 1] }\n"),
              0.25);
  ASSERT_EQ(o.totals.pair, 1U);
  EXPECT_NEAR(field(o, "energy_lost")[0], 0.0, 1e-15) << "perfectly rough disks lose nothing";
  const auto energy = [](const State& state, int i) {
    return state.velocities.col(i).squaredNorm() + 0.25 * 2.0 * 0.25 * state.spins[i] * state.spins[i];
  };
  const State &first = o.record.states.front(), &last = o.record.states.back();
  EXPECT_GT(std::abs(last.spins[0]), 0.1);
  EXPECT_NEAR(energy(first, 0) + energy(first, 1), energy(last, 0) + energy(last, 1), 1e-14);
  const double area = 100.0, steps = 8.0, time = 2.0;
  Eigen::Vector2d flow(0.0, 0.0), momentum(0.0, 0.0);
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();
  double held = 0.0;
  for (std::size_t k = 1; k < o.record.states.size(); ++k)
    for (int i = 0; i < 2; ++i) {
      const State& state = o.record.states[k];
      flow += energy(state, i) * state.velocities.col(i) / steps;
      held += energy(state, i) / steps;
      momentum += 2.0 * state.velocities.col(i) / steps;
      stress += 2.0 * state.velocities.col(i) * state.velocities.col(i).transpose() / steps;
    }
  const double met = o.record.events.at(0).time;
  const Eigen::Vector2d r =
      (first.positions.col(0) + met * first.velocities.col(0)) - (first.positions.col(1) + met * first.velocities.col(1));
  EXPECT_NEAR(r.norm(), 1.0, 1e-14);
  const Eigen::Vector2d passed = (energy(last, 0) - energy(first, 0)) * r;
  const Eigen::Vector2d impulse = 2.0 * (last.velocities.col(0) - first.velocities.col(0));
  const Eigen::Vector2d u = momentum / 4.0;
  stress += -4.0 * u * u.transpose() + r * impulse.transpose() / time;
  const Eigen::Vector2d expected = (flow + passed / time - held * u - stress * u) / area;
  EXPECT_NEAR(field(o, "heat_flux_x")[0], expected.x(), 1e-15);
  EXPECT_NEAR(field(o, "heat_flux_y")[0], expected.y(), 1e-15);
}

TEST(Fields, OfDisksInWellsCarryTheEnergyOfPairs) {
  const Observed o = observe(
      parse_scene("[box]\nx = [0.0, 8.0]\ny = [0.0, 8.0]\nboundary = { x = \"periodic\", y = \"walls\" }\n[[disks]]\ncount = "
                  "30\nradius = 0.5\nmass = 2.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = "
                  "\"specular\"\n[square_well]\nwidth = 1.8\ndepth = 1.5\n[run]\ntime = 2.0\n[observe]\nfields = { every = "
                  "0.125, cells = [1, 1] }\n"),
      0.125);
  ASSERT_GT(o.record.states.back().bonds, 10U);
  // Sums over all disks and pairs of each state, and over the events of the log.
  const auto flux = [&](bool with_pairs) {
    Eigen::Vector2d flow(0.0, 0.0), momentum(0.0, 0.0);
    double held = 0.0;
    std::size_t bonds = 0;
    for (std::size_t k = 1; k < o.record.states.size(); ++k) {
      const State& state = o.record.states[k];
      for (Eigen::Index i = 0; i < 30; ++i) {
        double energy = state.velocities.col(i).squaredNorm();
        for (Eigen::Index j = 0; j < 30 && with_pairs; ++j) {
          Eigen::Vector2d r = state.positions.col(i) - state.positions.col(j);
          r.x() = std::remainder(r.x(), 8.0);
          if (i == j || r.norm() > 1.8) continue;
          energy -= 0.75;
          ++bonds;
        }
        flow += energy * state.velocities.col(i);
        held += energy;
        momentum += 2.0 * state.velocities.col(i);
      }
      EXPECT_EQ(bonds, with_pairs ? 2 * state.bonds : 0);
      bonds = 0;
    }
    return Eigen::Vector2d((flow - held * momentum / (60.0 * 16.0)) / (16.0 * 64.0));
  };
  // What is left beside the flights is P u and what collisions pass on.
  Eigen::Vector2d rest = flux(true);
  const Eigen::Vector2d of_motion = flux(false);
  EXPECT_GT((rest - of_motion).norm(), 1e-3);
  std::vector<Eigen::Vector2d> v(30);
  Eigen::Vector2d momentum(0.0, 0.0), passed(0.0, 0.0);
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();
  const State& start = o.record.states.front();
  std::vector<Eigen::Vector2d> x(30);
  std::vector<double> since(30, 0.0);
  for (Eigen::Index i = 0; i < 30; ++i)
    v[static_cast<std::size_t>(i)] = start.velocities.col(i), x[static_cast<std::size_t>(i)] = start.positions.col(i);
  for (const Event& event : o.record.events) {
    const auto i = static_cast<std::size_t>(event.disk);
    x[i] += v[i] * (event.time - since[i]), since[i] = event.time;
    if (event.partner >= 0) {
      const auto j = static_cast<std::size_t>(event.partner);
      x[j] += v[j] * (event.time - since[j]), since[j] = event.time;
      Eigen::Vector2d r = x[i] - x[j];
      r.x() = std::remainder(r.x(), 8.0);
      stress += r * (2.0 * (event.velocity - v[i])).transpose() / 2.0;
      const double gained = event.velocity.squaredNorm() - v[i].squaredNorm();
      const double partner = event.partner_velocity.squaredNorm() - v[j].squaredNorm();
      passed += 0.5 * (gained - partner) * r / 2.0;
      v[j] = event.partner_velocity;
    }
    v[i] = event.velocity;
  }
  for (std::size_t k = 1; k < o.record.states.size(); ++k) {
    momentum += 2.0 * o.record.states[k].velocities.rowwise().sum() / 16.0;
    stress += 2.0 * o.record.states[k].velocities * o.record.states[k].velocities.transpose() / 16.0;
  }
  const Eigen::Vector2d u = momentum / 60.0;
  stress -= 60.0 * u * u.transpose();
  rest += (passed - stress * u) / 64.0;
  EXPECT_NEAR(field(o, "heat_flux_x")[0], rest.x(), 1e-12);
  EXPECT_NEAR(field(o, "heat_flux_y")[0], rest.y(), 1e-12);
}

/// What follows disks from collision to collision has to make the changes of the scene, too: elastic disks lose no energy, which
/// any velocity, place or edge of a potential that is out of date would show.
TEST(Fields, OfElasticDisksLoseNothingWhereTheSceneChanges) {
  struct Case {
    const char* scene;
    const char* changes;
  };
  const char* const scaled =
      "[[changes]]\ntime = 1.0\nscale_velocities = 2.0\n[[changes]]\ntime = 1.5\nscale_velocities = -0.5\n";
  for (const auto& [tables, changes] :
       {Case{"", scaled}, Case{"roughness = 1.0\n", scaled}, Case{"[gravity]\nacceleration = [0.0, -0.5]\n", scaled},
        Case{"[gravity]\nacceleration = [0.0, -1.0]\n", "[[changes]]\ntime = 1.0\nset = [\"gravity.acceleration=[0.0,-3.0]\"]\n"},
        Case{"", "[[changes]]\ntime = 1.0\nset = [\"gravity.acceleration=[0.0,-1.0]\"]\n"},
        Case{"", "[[changes]]\ntime = 1.0\nset = [\"collision.rule='reversal'\"]\n"},
        Case{"[square_well]\nwidth = 1.8\ndepth = 0.5\n", "[[changes]]\ntime = 1.0\nset = [\"square_well.width=1.2\"]\n"}}) {
    const Observed o = observe(
        parse_scene("[box]\nx = [0.0, 12.0]\ny = [0.0, 12.0]\nboundary = { x = \"periodic\", y = \"walls\" }\n[[disks]]\ncount = "
                    "50\nradius = 0.5\nmass = 1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule "
                    "= \"specular\"\n" +
                    std::string(tables) + changes + "[run]\ntime = 4.0\n[observe]\nfields = { every = 0.125, cells = [2, 2] }\n"),
        4.0);
    ASSERT_GT(o.totals.pair, 200U);
    for (const double lost : o.column("fields", 1, "energy_lost")) EXPECT_NEAR(lost, 0.0, 1e-12) << tables << changes;
  }
}

/// One disk at x = 7 that follows the right wall of a box of 8 at velocity 1, from effects and a run.
Observed behind_a_wall(const std::string& wall, const std::string& more, const std::string& run = "time = 2.0") {
  return observe(parse_scene("[box]\nx = [0.0, 8.0]\ny = [0.0, 8.0]\nboundary = \"walls\"\n[[disks]]\ncount = 1\n"
                             "radius = 0.5\nmass = 1.0\npositions = [[7.0, 4.0]]\nvelocities = [[1.0, 0.0]]\n"
                             "[collision]\nrule = \"specular\"\n[walls]\nright = { " +
                             wall + " }\n[run]\n" + run +
                             "\n[observe]\nfields = { every = 0.25, cells = [2, 1] }\n"
                             "density_profile = { axis = \"x\", bins = 4, every = 0.25 }\n" +
                             more),
                 0.25);
}

TEST(Fields, CoverAllThatWallsReach) {
  // Bins from 0 to `reach`, and no disk beyond.
  const auto expect_reach = [](const Observed& o, double reach) {
    for (const char* name : {"fields", "density_profile"}) {
      EXPECT_EQ(o.of(name).note, "") << name;
      const std::vector<double>& x = o.of(name).tables.at(0).columns.at(0).values;
      EXPECT_NEAR(x.front() + x.back(), reach, 1e-12) << name;
    }
  };
  expect_reach(behind_a_wall("velocity = 0.0", ""), 8.0);
  expect_reach(behind_a_wall("velocity = -0.25", ""), 8.0);
  expect_reach(behind_a_wall("velocity = 2.0", ""), 12.0);
  const auto change = [](double time, const char* what) {
    return fmt::format("[[changes]]\ntime = {}\nset = [\"walls.right.{}\"]\n", time, what);
  };
  // Out by 2, back by 0.75, out by 1.25.
  expect_reach(behind_a_wall("velocity = 2.0", change(1.0, "velocity=-1.5") + change(1.5, "velocity=2.5")), 10.5);
  // In by 0.5, out by 3.
  expect_reach(behind_a_wall("velocity = -0.5", change(1.0, "velocity=3")), 10.5);
  // A sine begins in the middle. At phase 1/4 it is at its innermost, at 3/4 at its outermost.
  const auto sine = [](const char* phase) {
    return std::string("vibration = { form = \"sine\", amplitude = 0.4, frequency = 0.3, phase = ") + phase + " }";
  };
  expect_reach(behind_a_wall(sine("0.0"), ""), 8.4);
  expect_reach(behind_a_wall(sine("0.25"), ""), 8.8);
  expect_reach(behind_a_wall(sine("0.75"), ""), 8.0);
  // A change of anything else lets it vibrate on.
  expect_reach(behind_a_wall(sine("0.25"), change(1.0, "restitution=0.5")), 8.8);
  // Where it is after equilibrating, the outermost position is the same.
  expect_reach(behind_a_wall(sine("0.25"), "", "time = 2.0\nequilibrate = { time = 1.0 }"), 8.8);
  // A wall that goes 1.5 outward before the measured run, and 1 in it.
  expect_reach(behind_a_wall("velocity = 0.5", "", "time = 2.0\nequilibrate = { time = 3.0 }"), 10.5);
}

TEST(Fields, SayHowManyDisksWereBeyondAWallWhoseWayIsNotKnown) {
  // At 0.5 the disk hits a piston of an eighth of its mass and follows it at 7/9. Its centre is at 7.89 at 1 and beyond 8
  // from 1.25 to 2: at 4 of the 8 ends of steps, and of 9 samples with the start.
  const Observed o = behind_a_wall("mass = 0.125, load = 0.0", "");
  const std::string where =
      " % of the disks were beyond the bins, behind walls that had moved further outward than was known when the run began";
  EXPECT_EQ(o.of("fields").note, "50" + where);
  EXPECT_EQ(o.of("density_profile").note, "44.4" + where);
}

/// Heat goes from the hot wall to the cold one: as much through every line across, and as much as through the walls.
/// Sixty disks, whose collisions cannot be followed for what `effect` does.
Observed driven(const std::string& effect, const std::string& cells) {
  return observe(
      parse_scene("[box]\nx = [0.0, 12.0]\ny = [0.0, 8.0]\nboundary = \"periodic\"\n[[disks]]\ncount = 60\nradius = 0.5\n"
                  "mass = 1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n" +
                  effect + "[run]\ntime = 400.0\n[observe]\nfields = { every = 0.5, cells = " + cells + " }\n"),
      10.0);
}

TEST(Fields, OfACrystalSayThatErrorsOfTheFlowAreTooLarge) {
  for (const double fraction : {0.71, 0.73}) {
    Scene scene = gas_scene(64, fraction, Boundary::periodic);
    scene.run.time = 1.0;
    scene.observe = {{.name = "fields", .every = 0.1, .cells = {{2, 2}}}};
    EXPECT_EQ(observe(scene, 0.1).of("fields").note.find("errors are up to 3 times too large") != std::string::npos,
              fraction > 0.72);
  }
}

TEST(Fields, OfABathHaveItsTemperatureAndNoFluxesOfCollisions) {
  const Observed o = driven("[thermostat]\ntemperature = 2.0\nrate = 1.0\n", "[2, 2]");
  for (std::size_t cell = 0; cell < 4; ++cell) {
    // A cell has velocities relative to its own mean, which takes a part 1/n of the temperature, n = 15 disks x 800 samples.
    EXPECT_NEAR(field(o, "temperature")[cell], 2.0, 4.0 * field(o, "temperature_error")[cell] + 2.0 / 12000.0);
    EXPECT_LT(field(o, "temperature_error")[cell], 0.1);
  }
  EXPECT_NEAR(mean_of(field(o, "density")), 60.0 / 96.0, 1e-12);
  for (const Table& table : o.of("fields").tables)
    EXPECT_EQ(table.columns.back().name.rfind("temperature", 0), 0U) << "the last of those that need no collisions";
  EXPECT_THAT(o.of("fields").note, testing::HasSubstr("without stress and heat flux: [thermostat] changes velocities between "
                                                      "collisions"));
}

TEST(Fields, OfAShearedFluidHaveItsFlow) {
  const Observed o = driven("[shear]\nrate = 0.5\n[thermostat]\ntemperature = 1.0\nrate = 1.0\n", "[2, 8]");
  for (std::size_t cell = 0; cell < 16; ++cell) {
    const double y = o.column("fields", 0, "y")[cell];
    EXPECT_NEAR(field(o, "velocity_x")[cell], 0.5 * (y - 4.0), 4.0 * field(o, "velocity_x_error")[cell]) << y;
    EXPECT_NEAR(field(o, "velocity_y")[cell], 0.0, 4.0 * field(o, "velocity_y_error")[cell]) << y;
    EXPECT_LT(field(o, "velocity_x_error")[cell], 0.1);
  }
}

TEST(Fields, AreThereWhateverChangesVelocitiesBetweenCollisions) {
  for (const char* effect :
       {"[brownian]\ntemperature = 1.0\nrate = 10.0\n", "[drag]\nrate = 0.001\n", "[tumbling]\nrate = 1.0\n"})
    EXPECT_NEAR(mean_of(field(driven(effect, "[2, 1]"), "density")), 60.0 / 96.0, 1e-12) << effect;
}

TEST(SlowFields, HeatFluxIsTheSameThroughEveryLineBetweenWallsOfTwoTemperatures) {
  const Observed o = observe(
      parse_scene(
          "[box]\nx = [0.0, 20.0]\ny = [0.0, 12.0]\nboundary = { x = \"walls\", y = \"periodic\" }\n[[disks]]\ncount = "
          "80\nradius = 0.5\n"
          "mass = 1.0\npositions = \"random\"\nvelocities = { temperature = 1.5 }\n[walls.left]\ntemperature = 1.0\n"
          "[walls.right]\ntemperature = 2.0\n[collision]\nrule = \"specular\"\n[run]\ntime = 4000.0\nequilibrate = { time = "
          "200.0 }\n[observe]\nwall_fluxes = true\nfields = { cells = [10, 1] }\n"),
      4000.0);
  const double through_wall = o.value("wall_fluxes", "energy_left");
  const double its_error = o.scalar("wall_fluxes", "energy_left").error.value();
  EXPECT_GT(through_wall, 5.0 * its_error) << "heat flows to the cold wall";
  for (std::size_t c = 1; c < 9; ++c) {  // the outer ones hold lines between walls and centres
    EXPECT_NEAR(field(o, "heat_flux_x")[c], -through_wall, 5.0 * std::hypot(its_error, field(o, "heat_flux_x_error")[c])) << c;
    EXPECT_NEAR(field(o, "stress_xx")[c], o.value("wall_fluxes", "momentum_right"),
                5.0 * std::hypot(o.scalar("wall_fluxes", "momentum_right").error.value(), field(o, "stress_xx_error")[c]))
        << c;
    EXPECT_GT(field(o, "temperature")[c + 1], field(o, "temperature")[c - 1]);
  }
}

}  // namespace
}  // namespace carom::test
