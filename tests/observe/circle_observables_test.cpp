// What is observed in a circular box: areas of cells, the momentum through the rim, profiles and fields, against the states and
// totals of the run and against what is known of a gas.

#include "observe/area_in_circle.hpp"
#include "observe/effects_report.hpp"
#include "observe/observed_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace carom::test {
namespace {

constexpr double pi_of_circles = std::numbers::pi;
const Eigen::Vector2d centre_of_gas(1.5, -0.25);
constexpr double radius_of_box = 4.0;

/// Equal disks, and half as many of another species where `mixed`, round (1.5, -0.25).
Scene gas_in_a_circle(const std::string& observe, const std::string& more = "", bool mixed = false) {
  const std::string other =
      "[[disks]]\nname = \"small\"\ncount = 14\nradius = 0.2\nmass = 0.5\npositions = \"random\"\n"
      "velocities = { temperature = 2.0 }\n";
  return parse_scene(
      "[box]\ncircle = { centre = [1.5, -0.25], radius = 4.0 }\n[[disks]]\nname = \"big\"\ncount = 28\nradius = 0.4\nmass = 1.5\n"
      "positions = \"random\"\nvelocities = { temperature = 1.0 }\n" +
      (mixed ? other : std::string()) + "[collision]\nrule = \"specular\"\n" + more + "[run]\ntime = 6.4\nseed = 3\n[observe]\n" +
      observe + "\n");
}

/// The area by strips along x: within a strip the height varies by at most that of the rectangle up and down again.
double area_by_strips(const Rectangle& rectangle, const Eigen::Vector2d& centre, double radius, int strips) {
  const double width = (rectangle.upper.x() - rectangle.lower.x()) / strips;
  double sum = 0.0;
  for (int k = 0; k < strips; ++k) {
    const double x = rectangle.lower.x() + (k + 0.5) * width - centre.x();
    if (std::abs(x) >= radius) continue;
    const double half = std::sqrt(radius * radius - x * x);
    const double low = std::max(rectangle.lower.y(), centre.y() - half), high = std::min(rectangle.upper.y(), centre.y() + half);
    sum += width * std::max(0.0, high - low);
  }
  return sum;
}

TEST(GasInACircle, EveryObservableSaysThatItKeepsTurning) {
  const std::string all =
      "mean_square_displacement = { every = 0.1 }\nvelocity_autocorrelation = { every = 0.1 }\n"
      "fields = { cells = [2, 2], every = 0.1 }\noverlap = { every = 0.1 }\npressure = { every = 0.1 }";
  for (const char* more : {"", "[thermostat]\ntemperature = 1.0\nrate = 0.5\n"}) {
    const Observed o = observe(gas_in_a_circle(all, more), 0.1);
    const bool keeps_turning = std::string(more).find("thermostat") == std::string::npos;
    for (const char* name : {"mean_square_displacement", "velocity_autocorrelation", "fields", "overlap", "pressure"})
      EXPECT_EQ(o.of(name).note.find("all disks together keep turning") != std::string::npos, keeps_turning) << name << more;
    EXPECT_EQ(o.of("mean_square_displacement").note.find("too large") != std::string::npos, !keeps_turning) << more;
    EXPECT_EQ(o.scalar("pressure", "Z_rate").value.has_value(), !keeps_turning) << more;
  }
}

TEST(AreaInCircle, IsWhatStripsAddUpTo) {
  std::mt19937_64 engine(11);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  constexpr int strips = 20'000;
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector2d centre(uniform() - 0.5, uniform() - 0.5), lower(3.0 * uniform() - 1.5, 3.0 * uniform() - 1.5);
    const Rectangle rectangle{lower, lower + Eigen::Vector2d(0.01 + 2.0 * uniform(), 0.01 + 2.0 * uniform())};
    const Eigen::Vector2d sides = rectangle.upper - rectangle.lower;
    EXPECT_NEAR(area_in_circle(rectangle, centre, 1.0), area_by_strips(rectangle, centre, 1.0, strips),
                2.0 * sides.prod() / strips)
        << k;
  }
}

TEST(AreaInCircle, OfKnownPartsIsExact) {
  const Eigen::Vector2d centre(2.0, -1.0);
  const auto area = [&](double left, double right, double bottom, double top) {
    return area_in_circle({centre + Eigen::Vector2d(left, bottom), centre + Eigen::Vector2d(right, top)}, centre, 2.0);
  };
  EXPECT_NEAR(area(-2.0, 2.0, -2.0, 2.0), 4.0 * pi_of_circles, 1e-14);
  EXPECT_NEAR(area(-5.0, 9.0, -3.0, 2.5), 4.0 * pi_of_circles, 1e-14);
  EXPECT_NEAR(area(0.0, 2.0, 0.0, 2.0), pi_of_circles, 1e-14);
  EXPECT_NEAR(area(1.0, 2.0, -2.0, 2.0), 4.0 * pi_of_circles / 3.0 - std::sqrt(3.0), 1e-14) << "a segment of 120 degrees";
  EXPECT_EQ(area(-1.0, 1.0, -1.0, 1.0), 4.0);
  EXPECT_EQ(area(1.5, 2.5, 1.5, 2.5), 0.0) << "a corner that the circle does not reach";
  EXPECT_EQ(area(2.0, 3.0, -1.0, 1.0), 0.0) << "it touches the circle in a point";
}

TEST(AreaInCircle, OfAllCellsIsThatOfTheCircle) {
  const Box box{{-1.0, 3.0}, {1.0, 5.0}, {Boundary::walls, Boundary::walls}, true};
  for (const int across : {1, 2, 3, 17, 100}) {
    double sum = 0.0;
    const double side = 2.0 / across;
    for (int x = 0; x < across; ++x)
      for (int y = 0; y < across; ++y) {
        const Eigen::Vector2d lower = box.lower + side * Eigen::Vector2d(x, y);
        sum += area_in_circle({lower, lower + Eigen::Vector2d(side, side)}, box);
      }
    EXPECT_NEAR(sum, pi_of_circles, 1e-15 * across * across + 1e-14) << across;
  }
}

/// Of equal disks that keep their energy: the virial theorem of the centres, which the rim holds at R - a. To rounding.
TEST(RimFluxes, AreTheImpulsePerPerimeterAndObeyTheVirialTheorem) {
  const Observed o = observe(gas_in_a_circle("wall_fluxes = { every = 0.1 }"), 6.4);
  ASSERT_EQ(o.of("wall_fluxes").scalars.size(), 1U);
  const double pressure = o.value("wall_fluxes", "momentum_rim");
  const double impulse = pressure * 2.0 * pi_of_circles * radius_of_box * o.time;
  EXPECT_NEAR(impulse, o.totals.circle_impulse, 1e-12 * impulse);
  const EffectsReport report = effects_report(o.scene, o.disks, o.totals, o.record.states.back());
  EXPECT_NEAR(pressure, *report.circle->pressure, 1e-12 * pressure) << "that of the summary";
  const auto action = [&](const State& state) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
      sum += 1.5 * (state.positions.col(i) - centre_of_gas).dot(state.velocities.col(i));
    return sum;
  };
  const State &first = o.record.states.front(), &last = o.record.states.back();
  ASSERT_DOUBLE_EQ(last.time, o.time);
  const double twice_kinetic = 1.5 * last.velocities.squaredNorm();
  EXPECT_NEAR(impulse * (radius_of_box - 0.4), twice_kinetic * o.time + o.totals.virial - (action(last) - action(first)),
              1e-10 * impulse);
}

/// Far apart disks are an ideal gas, whose pressure on the perimeter of the centres is n kT of the area that they have.
TEST(RimFluxes, OfADiluteGasAreThePressureOfTheGas) {
  const Observed o = observe(parse_scene("[box]\ncircle = { centre = [0.0, 0.0], radius = 4.0 }\n[[disks]]\ncount = 60\nradius = "
                                         "0.02\nmass = 2.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n"
                                         "[collision]\nrule = \"specular\"\n[run]\ntime = 400.0\nseed = 1\n[observe]\n"
                                         "wall_fluxes = true\n"),
                             400.0);
  const double kT = o.record.states.back().velocities.squaredNorm() / 60.0;  // m v^2 / 2 of two kT / 2
  const double reach = 4.0 - 0.02, ideal = 60.0 * kT / (pi_of_circles * reach * reach), share = reach / 4.0;
  const Scalar& pressure = o.scalar("wall_fluxes", "momentum_rim");
  ASSERT_TRUE(pressure.error);
  EXPECT_LT(*pressure.error, 0.01 * ideal);
  const double second_virial = 1.0 + 60.0 * 2.0 * pi_of_circles * 0.02 * 0.02 / (pi_of_circles * reach * reach);
  EXPECT_NEAR(*pressure.value, ideal * share * second_virial, 5.0 * *pressure.error);
}

/// The mean number of disks of a species (-1: of all) per state in a part of the box.
template <class Inside>
double mean_count(const Observed& o, int species, const Inside& inside) {
  double sum = 0.0;
  for (const State& state : o.record.states)
    for (std::size_t i = 0; i < o.disks.count(); ++i)
      if (species < 0 || o.disks.species[i] == species) sum += inside(state.positions.col(static_cast<Eigen::Index>(i))) ? 1 : 0;
  return sum / static_cast<double>(o.record.states.size());
}

TEST(DensityInACircle, IsThatOfRingsByDefault) {
  const Observed o = observe(gas_in_a_circle("density_profile = { every = 0.1, bins = 8 }", "", true), 0.1);
  EXPECT_EQ(o.scene.observe[0].axis, 2);
  const auto &r = o.column("density_profile", 0, "r"), &all = o.column("density_profile", 0, "density"),
             &small = o.column("density_profile", 0, "density_small");
  double disks = 0.0;
  for (std::size_t b = 0; b < 8; ++b) {
    const double inner = 0.5 * static_cast<double>(b), outer = inner + 0.5;
    EXPECT_NEAR(r[b], inner + 0.25, 1e-15);
    const double area = pi_of_circles * (outer * outer - inner * inner);
    const auto inside = [&](const Eigen::Vector2d& place) {
      const double distance = (place - centre_of_gas).norm();
      return distance >= inner && distance < outer;
    };
    EXPECT_NEAR(all[b] * area, mean_count(o, -1, inside), 1e-12);
    EXPECT_NEAR(small[b] * area, mean_count(o, 1, inside), 1e-12);
    disks += all[b] * area;
  }
  EXPECT_NEAR(disks, 42.0, 1e-12);
}

TEST(DensityInACircle, OfStripsCountsTheirAreaInside) {
  const Observed o = observe(gas_in_a_circle("density_profile = { every = 0.1, axis = \"x\", bins = 5 }"), 0.1);
  const auto &x = o.column("density_profile", 0, "x"), &density = o.column("density_profile", 0, "density");
  double disks = 0.0;
  const auto left_of = [](double share) {  // the area of a circle of radius 4 left of this share of its radius
    return 16.0 * (pi_of_circles - std::acos(share) + share * std::sqrt(1.0 - share * share));
  };
  for (std::size_t b = 0; b < 5; ++b) {
    const double from = -2.5 + 1.6 * static_cast<double>(b);
    EXPECT_NEAR(x[b], from + 0.8, 1e-14);
    const double area = left_of(std::min(1.0, (from + 1.6 - 1.5) / 4.0)) - left_of((from - 1.5) / 4.0);
    EXPECT_NEAR(density[b] * area,
                mean_count(o, -1, [&](const Eigen::Vector2d& place) { return place.x() >= from && place.x() < from + 1.6; }),
                1e-11);
    disks += density[b] * area;
  }
  EXPECT_NEAR(disks, 28.0, 1e-11);
}

/// So many points in the circle of this radius round the origin, by a density exp(-weight y).
std::vector<Eigen::Vector2d> drawn_in_a_circle(std::size_t count, double radius, double weight) {
  std::mt19937_64 engine(7);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  std::vector<Eigen::Vector2d> found;
  while (found.size() < count) {
    const double x = uniform(), y = uniform(), draw = uniform();
    const Eigen::Vector2d place = radius * Eigen::Vector2d(2.0 * x - 1.0, 2.0 * y - 1.0);
    if (place.norm() < radius && draw < std::exp(-weight * (place.y() + radius))) found.push_back(place);
  }
  return found;
}

/// A drum of disks so small that they hardly meet, which begin as they stay: by the law of an ideal gas.
Observed ideal_drum(std::int64_t count, double weight, const std::string& profile) {
  Scene scene = parse_scene(
      "[box]\ncircle = { centre = [0.0, 0.0], radius = 4.0 }\n[[disks]]\ncount = 1\nradius = 1e-5\nmass = "
      "1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n"
      "[run]\ntime = 16.0\nseed = 2\n[observe]\n" +
      profile);
  scene.species[0].count = count;
  scene.species[0].positions = ListedPositions{drawn_in_a_circle(static_cast<std::size_t>(count), 4.0 - 1e-5, weight)};
  if (weight > 0.0) scene.effects.gravity = Gravity{{0.0, -weight}};
  return observe(scene, 16.0);
}

/// Each disk is in a ring or a strip for a share of the time whose mean over starts is the law's: of so many disks that share has
/// a variance of at most p (1 - p) / N, however long they fly.
void expect_share(double found, double law, std::int64_t count, std::size_t bin) {
  EXPECT_NEAR(found, law, 5.0 * std::sqrt(law * (1.0 - law) / static_cast<double>(count)) + 1e-9) << bin;
}

TEST(DensityInACircle, OfAnIdealGasIsUniform) {
  const std::int64_t count = 2000;
  const Observed o = ideal_drum(count, 0.0, "density_profile = { every = 0.5, bins = 10 }");
  const auto& density = o.column("density_profile", 0, "density");
  for (std::size_t b = 0; b < 10; ++b) {
    const double share = (2.0 * static_cast<double>(b) + 1.0) / 100.0, area = 16.0 * pi_of_circles * share;
    expect_share(density[b] * area / static_cast<double>(count), share, count, b);
  }
}

TEST(DensityInACircle, OfAnIdealGasUnderGravityIsTheBarometersOnItsChords) {
  const std::int64_t count = 2000;
  const double weight = 0.5;
  const Observed o = ideal_drum(count, weight, "density_profile = { every = 0.5, axis = \"y\", bins = 8 }");
  const auto& density = o.column("density_profile", 0, "density");
  constexpr int slices = 20'000;
  std::vector<double> law(8), area(8);
  for (int k = 0; k < 8 * slices; ++k) {
    const double y = -4.0 + 8.0 * (k + 0.5) / (8 * slices), slice = 8.0 / (8 * slices) * 2.0 * std::sqrt(16.0 - y * y);
    const auto bin = static_cast<std::size_t>(k / slices);
    area[bin] += slice;
    law[bin] += slice * std::exp(-weight * y);
  }
  double all = 0.0;
  for (const double one : law) all += one;
  for (std::size_t b = 0; b < 8; ++b) expect_share(density[b] * area[b] / static_cast<double>(count), law[b] / all, count, b);
}

/// Velocities of a start are uniform on the sphere of its energy, in 2N dimensions, of which L / sqrt(I) is one: L^2 / I has the
/// mean kT and, for N disks, nearly the variance 2 kT^2 of a square of a Gaussian.
TEST(CircularStarts, TurnWithOneDegreeOfFreedom) {
  constexpr int starts = 2000;
  Scene scene = gas_in_a_circle("temperature = true");
  double sum = 0.0;
  for (int k = 0; k < starts; ++k) {
    scene.run.seed = static_cast<std::uint64_t>(k + 1);
    const Simulation simulation = make_simulation(scene);
    const State state = simulation.state();
    double momentum = 0.0, inertia = 0.0;
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
      const Eigen::Vector2d r = state.positions.col(i) - centre_of_gas, v = state.velocities.col(i);
      momentum += 1.5 * (r.x() * v.y() - r.y() * v.x());
      inertia += 1.5 * r.squaredNorm();
    }
    const double kT = 1.5 * state.velocities.squaredNorm() / 56.0;
    sum += momentum * momentum / inertia / kT;
  }
  EXPECT_NEAR(sum / starts, 1.0, 4.0 * std::sqrt(2.0 / starts));
}

/// 64 steps are 16 stretches of 4, so nothing is left out.
TEST(FieldsInACircle, SumUpToWhatTheGasHas) {
  for (const char* cells : {"[1, 1]", "[7, 5]", "[20, 20]"}) {
    const Observed o = observe(gas_in_a_circle(std::string("fields = { every = 0.1, cells = ") + cells + " }"), 0.1);
    const auto field = [&](const char* name) { return o.column("fields", 0, name); };
    const std::vector<double> areas = field("area"), density = field("density"), u = field("velocity_x"), v = field("velocity_y"),
                              kT = field("temperature"), xx = field("stress_xx"), yy = field("stress_yy");
    double area = 0.0, disks = 0.0, energy = 0.0, trace = 0.0;
    Eigen::Vector2d momentum(0.0, 0.0);
    for (std::size_t c = 0; c < areas.size(); ++c) {
      area += areas[c];
      if (areas[c] == 0.0) {
        EXPECT_TRUE(std::isnan(density[c]) && std::isnan(kT[c])) << "no part of this cell is in the circle";
        continue;
      }
      disks += density[c] * areas[c];
      if (density[c] == 0.0) continue;
      const double mass = 1.5 * density[c] * areas[c], flow = u[c] * u[c] + v[c] * v[c];
      momentum += mass * Eigen::Vector2d(u[c], v[c]);
      energy += density[c] * areas[c] * kT[c] + 0.5 * mass * flow;
      trace += (xx[c] + yy[c]) * areas[c] + mass * flow;
    }
    EXPECT_NEAR(area, 16.0 * pi_of_circles, 1e-12);
    EXPECT_NEAR(disks, 28.0, 1e-11);
    Eigen::Vector2d of_states(0.0, 0.0);
    for (std::size_t k = 1; k < o.record.states.size(); ++k) of_states += 1.5 * o.record.states[k].velocities.rowwise().sum();
    of_states /= static_cast<double>(o.record.states.size() - 1);
    EXPECT_NEAR((momentum - of_states).norm(), 0.0, 1e-11);
    const double kinetic = 0.75 * o.record.states.back().velocities.squaredNorm();
    EXPECT_NEAR(energy, kinetic, 1e-11 * kinetic);
    // A collision in a cell without a disk at any step has no stress there: its part of the virial is left out.
    if (areas.size() < 100) {
      EXPECT_NEAR(trace * o.time, 2.0 * kinetic * o.time + o.totals.virial, 1e-9 * kinetic);
    }
  }
}

TEST(FieldsInACircle, OfCutCellsCountTheirAreaInside) {
  const Observed o = observe(gas_in_a_circle("fields = { every = 0.1, cells = [6, 6] }"), 0.1);
  for (std::size_t c = 0; c < 36; ++c) {
    const Eigen::Vector2d lower = centre_of_gas +
                                  Eigen::Vector2d(static_cast<double>(c % 6), static_cast<double>(c / 6)) * (8.0 / 6.0) -
                                  Eigen::Vector2d(4.0, 4.0);
    const Rectangle cell{lower, lower + Eigen::Vector2d(8.0 / 6.0, 8.0 / 6.0)};
    const double area = area_by_strips(cell, centre_of_gas, 4.0, 50'000);
    const double disks = mean_count(o, -1, [&](const Eigen::Vector2d& place) {
      return (place.array() >= cell.lower.array()).all() && (place.array() < cell.upper.array()).all();
    });
    // The state at the start counts in neither the fields nor, times its share, here.
    double at_start = 0.0;
    const State& start = o.record.states.front();
    for (Eigen::Index i = 0; i < start.positions.cols(); ++i)
      at_start += (start.positions.col(i).array() >= cell.lower.array()).all() &&
                          (start.positions.col(i).array() < cell.upper.array()).all()
                      ? 1.0
                      : 0.0;
    const auto states = static_cast<double>(o.record.states.size());
    const double expected = (disks * states - at_start) / (states - 1.0);
    EXPECT_NEAR(o.column("fields", 0, "density")[c] * area, expected, 1e-3 * (1.0 + expected)) << c;
  }
}

}  // namespace
}  // namespace carom::test
