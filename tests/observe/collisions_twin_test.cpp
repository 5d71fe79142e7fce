// Observables of collisions against the obvious computation on the event log.

#include "observe/observed_system.hpp"
#include "support/systems.hpp"

#include "observe/mechanics.hpp"
#include "observe/tracked_disks.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace carom::test {
namespace {

/// Of sums over 1e3 terms of order one: the replay moves disks by 10 diameters or less from event to event, and so errs by some
/// 80 u of a place; a random walk of 1e3 such terms ends at sqrt(1e3) times that.
constexpr double rounding_of_transfers = 1e-12;

/// Plays an event log through again: `visit(event, before, partner_before, r)` for collisions of pairs, r from partner to disk.
template <class Visit>
void replay(const Observed& o, Visit visit) {
  struct Disk {
    Eigen::Vector2d r, v;
    double since = 0.0;
  };
  std::vector<Disk> disks(o.disks.count());
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    disks[i] = {o.record.states.front().positions.col(c), o.record.states.front().velocities.col(c)};
  }
  const auto move = [&](std::int32_t i, double time) -> Disk& {
    Disk& disk = disks[static_cast<std::size_t>(i)];
    disk.r += (time - disk.since) * disk.v;
    disk.since = time;
    return disk;
  };
  for (const Event& event : o.record.events) {
    Disk& a = move(event.disk, event.time);
    if (event.partner >= 0) {
      Disk& b = move(event.partner, event.time);
      Eigen::Vector2d r = a.r - b.r;
      for (int axis = 0; axis < 2; ++axis)
        if (o.scene.box.periodic(axis)) r[axis] = std::remainder(r[axis], o.scene.box.lengths()[axis]);
      visit(event, a.v, b.v, r);
      b.v = event.partner_velocity;
    }
    a.v = event.velocity;
  }
}

double mean_flow(const Observed& o, int a, int b) {
  double sum = 0.0;
  const auto flow = [&](const State& state) {
    double now = 0.0;
    for (std::size_t i = 0; i < o.disks.count(); ++i)
      now +=
          o.disks.mass[i] * state.velocities(a, static_cast<Eigen::Index>(i)) * state.velocities(b, static_cast<Eigen::Index>(i));
    return now;
  };
  for (std::size_t k = 0; k + 1 < o.record.states.size(); ++k)
    sum += 0.5 * (flow(o.record.states[k]) + flow(o.record.states[k + 1]));
  return sum / static_cast<double>(o.record.states.size() - 1);
}

class ObservedCollisions : public ::testing::TestWithParam<const char*> {};

TEST_P(ObservedCollisions, PressureTensorIsTheFlowOfMomentumAndWhatCollisionsTransfer) {
  const Observed o = observe(parse_scene(small_fluid("pressure = { every = 0.05 }", GetParam())), 0.05);
  Eigen::Matrix2d transfer = Eigen::Matrix2d::Zero();
  replay(o, [&](const Event& event, const Eigen::Vector2d& before, const Eigen::Vector2d&, const Eigen::Vector2d& r) {
    transfer += r * (1.5 * (event.velocity - before)).transpose();
  });
  const double area = o.scene.box.area();
  static constexpr std::array<std::array<const char*, 2>, 2> names = {{{"P_xx", "P_xy"}, {"P_yx", "P_yy"}}};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      EXPECT_NEAR(o.value("pressure", names[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]),
                  (mean_flow(o, a, b) * 40.0 / 39.0 + transfer(a, b) / 5.0) / area, rounding_of_transfers);
  const double kT = kinetic_temperature(o.scene.box, o.disks, o.record.states.front());
  const double Z = 1.0 + transfer.trace() / (2.0 * 5.0 * 40.0 * kT);
  EXPECT_NEAR(o.value("pressure", "Z"), Z, rounding_of_transfers);
  EXPECT_NEAR(0.5 * (o.value("pressure", "P_xx") + o.value("pressure", "P_yy")), 40.0 * kT * Z / area, rounding_of_transfers);
}

INSTANTIATE_TEST_SUITE_P(Rules, ObservedCollisions, ::testing::Values("specular", "reversal"));

TEST(ObservedPressure, FromTheRateIsTheRatesShareOfTheMaxwellRate) {
  const Observed o = observe(parse_scene(small_fluid("pressure = { every = 0.05 }")), 0.05);
  const double kT = kinetic_temperature(o.scene.box, o.disks, o.record.states.front());
  const double rate = 2.0 * static_cast<double>(o.totals.pair) / (40.0 * 5.0);
  const double d = 78.0;  // 2 N - 2 degrees of freedom
  const double slower = std::sqrt(d / 2.0) * std::tgamma(d / 2.0) / std::tgamma((d + 1.0) / 2.0);
  EXPECT_NEAR(o.value("pressure", "Z_rate"), 1.0 + std::sqrt(std::numbers::pi) / 4.0 * rate / std::sqrt(kT / 1.5) / slower,
              rounding_of_transfers);
}

/// sqrt(kT) changes from sample to sample, and its mean is not the root of the mean.
TEST(ObservedPressure, FromTheRateInABathTakesTheMeanThermalSpeed) {
  std::string scene = small_fluid("pressure = { every = 0.05 }");
  scene.insert(scene.find("[observe]"), "[thermostat]\ntemperature = 1.0\nrate = 2.0\n");
  const Observed o = observe(parse_scene(scene), 0.05);
  double thermal = 0.0;
  for (std::size_t k = 1; k < o.record.states.size(); ++k)
    for (const std::size_t end : {k - 1, k})
      thermal += 0.5 * 0.05 * std::sqrt(kinetic_temperature(o.scene.box, o.scene.effects, o.disks, o.record.states[end]));
  const double d = 80.0, met = static_cast<double>(o.totals.pair) * std::sqrt(0.75);
  const double slower = std::sqrt(d / 2.0) * std::tgamma(d / 2.0) / std::tgamma((d + 1.0) / 2.0);
  EXPECT_NEAR(o.value("pressure", "Z_rate"),
              1.0 + std::numbers::pi * met / (40.0 * std::sqrt(2.0 * std::numbers::pi) * thermal * slower),
              rounding_of_transfers);
}

TEST(ObservedPressure, FromWallsIsTheirPushOverTheRoomOfCentres) {
  std::string scene = small_fluid("pressure = { every = 0.05 }\nwall_fluxes = { every = 0.05 }");
  scene.replace(scene.find("periodic"), 8, "walls");
  const Observed o = observe(parse_scene(scene), 0.05);
  const double kT = kinetic_temperature(o.scene.box, o.disks, o.record.states.front());
  const auto& push = o.totals.wall_impulse;
  const double room = o.scene.box.lengths().x() - 1.0;
  EXPECT_NEAR(o.value("pressure", "Z_walls"), 0.5 * (push[0] + push[1] + push[2] + push[3]) / 5.0 * room / (2.0 * 40.0 * kT),
              rounding_of_transfers);
  EXPECT_NEAR(o.value("wall_fluxes", "momentum_top"), push[3] / (5.0 * o.scene.box.lengths().x()), rounding_of_transfers);
  EXPECT_EQ(o.value("wall_fluxes", "energy_left"), 0.0);
}

/// In a narrow channel disks meet along it less often than across: P_xx and P_yy differ, and walls tell one of them.
TEST(ObservedPressure, FromWallsNeedsThemAlongBothAxes) {
  std::string scene = small_fluid("pressure = true");
  scene.replace(scene.find("\"periodic\""), 10, "{ x = \"periodic\", y = \"walls\" }");
  const Observed o = observe(parse_scene(scene), 0.05);
  EXPECT_FALSE(o.scalar("pressure", "Z_walls").value);
  EXPECT_THAT(o.scalar("pressure", "Z_walls").note, testing::HasSubstr("P_yy alone"));
  EXPECT_TRUE(o.scalar("pressure", "P_yy").value);
}

TEST(ObservedPressure, TracesOfAMixtureBetweenWallsAgree) {
  const Observed o = observe(parse_scene(small_mixture("pressure = { every = 0.1 }")), 0.1);
  // Momentum flows both ways through walls, none through the box's edges: the trace is what the virial says, to rounding.
  const double trace = (o.value("pressure", "P_xx") + o.value("pressure", "P_yy")) * o.scene.box.area() / 2.0;
  const double kT = kinetic_temperature(o.scene.box, o.disks, o.record.states.front());
  EXPECT_NEAR(trace, 32.0 * kT * o.value("pressure", "Z"), 32.0 * kT * rounding_of_transfers);
  EXPECT_FALSE(o.scalar("pressure", "Z_walls").value);
  EXPECT_FALSE(o.scalar("pressure", "Z_walls").note.empty());
}

/// Three species without walls: one of many sizes, whose unlike disks come nearer than their circles, and one of a single disk.
std::string periodic_mixture(const std::string& observe, const std::string& rule) {
  return "[box]\nx = [0.0, 9.0]\ny = [0.0, 7.0]\nboundary = \"periodic\"\n[[disks]]\nname = \"big\"\ncount = 12\nradius = { "
         "uniform = [0.4, 0.6] }\nmass = { per_area = 2.0 }\npositions = \"random\"\nvelocities = { temperature = 1.0 "
         "}\n[[disks]]\nname = \"small\"\ncount = 20\nradius = 0.3\nmass = 0.5\npositions = \"random\"\nvelocities = { "
         "temperature = 1.0 }\n[[disks]]\nname = \"lone\"\ncount = 1\nradius = 0.5\nmass = 1.0\npositions = "
         "\"random\"\nvelocities = { temperature = 1.0 }\n[non_additivity]\ndelta = 0.0\npairs = [{ species = [0, 1], delta = "
         "-0.2 "
         "}]\n[collision]\nrule = \"" +
         rule + "\"\n[run]\ntime = 10.0\n[observe]\n" + observe + "\n";
}

class ObservedContactValues : public ::testing::TestWithParam<const char*> {};

/// What the pairs of two species have transferred, over what they would at g = 1.
TEST_P(ObservedContactValues, AreSumsOverTheCollisionsOfEachPairOfSpecies) {
  const std::string rule = GetParam();
  const Observed o = observe(parse_scene(periodic_mixture("contact_values = { every = 0.1 }", rule)), 0.1);
  const Disks& disks = o.disks;
  const auto species = [&](std::size_t i) { return static_cast<std::size_t>(disks.species[i]); };
  const auto distance = [&](std::size_t i, std::size_t j) {
    return (species(i) + species(j) == 1 ? 0.8 : 1.0) * (disks.radius[i] + disks.radius[j]);
  };
  struct Sums {
    double squares = 0.0, virial = 0.0, meetings = 0.0;
  };
  std::array<std::array<Sums, 3>, 3> sums{};
  for (std::size_t i = 0; i < disks.count(); ++i)
    for (std::size_t j = i + 1; j < disks.count(); ++j) sums[species(i)][species(j)].squares += std::pow(distance(i, j), 2);
  replay(o, [&](const Event& event, const Eigen::Vector2d& before, const Eigen::Vector2d&, const Eigen::Vector2d& r) {
    const auto i = static_cast<std::size_t>(event.disk), j = static_cast<std::size_t>(event.partner);
    Sums& pair = sums[std::min(species(i), species(j))][std::max(species(i), species(j))];
    pair.virial += disks.mass[i] * r.dot(event.velocity - before);
    pair.meetings += distance(i, j) * std::sqrt(disks.mass[i] * disks.mass[j] / (disks.mass[i] + disks.mass[j]));
  });
  const double kT = kinetic_temperature(o.scene.box, disks, o.record.states.front());
  const double d = 64.0;  // 2 N - 2 degrees of freedom
  const double fixed_energy = std::sqrt(d / 2.0) * std::tgamma(d / 2.0) / std::tgamma((d + 1.0) / 2.0);
  static constexpr std::array<const char*, 3> names = {"_big", "_small", "_lone"};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a; b < 3; ++b) {
      const std::string pair = std::string(names[a]) + names[b];
      const Sums& sum = sums[a][b];
      if (a == 2) {
        EXPECT_FALSE(o.scalar("contact_values", "g" + pair).value);
        EXPECT_THAT(o.scalar("contact_values", "g" + pair).note, testing::HasSubstr("no such pair"));
        continue;
      }
      const double each = sum.squares * 10.0 / o.scene.box.area();
      EXPECT_GT(sum.virial, 0.0) << pair;
      EXPECT_NEAR(o.value("contact_values", "g" + pair), sum.virial / (2.0 * std::numbers::pi * kT * each), rounding_of_transfers)
          << pair;
      EXPECT_NEAR(o.value("contact_values", "Z_share" + pair), sum.virial / (2.0 * 33.0 * kT * 10.0), rounding_of_transfers)
          << pair;
      if (rule == "specular")
        EXPECT_NEAR(o.value("contact_values", "g_rate" + pair),
                    sum.meetings / (std::sqrt(2.0 * std::numbers::pi * kT) * fixed_energy * each), rounding_of_transfers)
            << pair;
      else
        EXPECT_FALSE(o.scalar("contact_values", "g_rate" + pair).value);
    }
}

INSTANTIATE_TEST_SUITE_P(Rules, ObservedContactValues, ::testing::Values("specular", "reversal"));

/// Shares of Z - 1 add up to it; with wells, what passes at their edges is in the shares, and not in the contact values.
TEST(ObservedSharesOfZ, AddUpToThatOfThePressure) {
  const std::string both = "contact_values = { every = 0.1 }\npressure = { every = 0.1 }";
  const Observed mixture = observe(parse_scene(periodic_mixture(both, "specular")), 0.1);
  double sum = 1.0;
  for (const Scalar& scalar : mixture.of("contact_values").scalars)
    if (scalar.name.starts_with("Z_share")) sum += scalar.value.value_or(0.0);
  EXPECT_NEAR(sum, mixture.value("pressure", "Z"), rounding_of_transfers);
  const Observed wells = observe(parse_scene(small_fluid(both) + "[square_well]\nwidth = 1.5\ndepth = 0.5\n"), 0.1);
  EXPECT_NEAR(1.0 + wells.value("contact_values", "Z_share"), wells.value("pressure", "Z"), rounding_of_transfers);
  const double of_contacts = 2.0 * 0.4 * 39.0 / 40.0 * wells.value("contact_values", "g");
  EXPECT_GT(of_contacts, wells.value("contact_values", "Z_share") + 0.1) << "wells pull";
}

TEST(ObservedRates, CountCollisionsByPairsOfSpecies) {
  const Observed o = observe(parse_scene(small_mixture("collision_rate = { every = 0.1 }")), 0.1);
  std::array<std::array<double, 2>, 2> counts{};
  for (const Event& event : o.record.events) {
    if (event.partner < 0) continue;
    const auto a = static_cast<std::size_t>(o.disks.species[static_cast<std::size_t>(event.disk)]);
    const auto b = static_cast<std::size_t>(o.disks.species[static_cast<std::size_t>(event.partner)]);
    counts[a][b] += 1.0;
    counts[b][a] += 1.0;
  }
  ASSERT_GT(counts[0][1], 0.0);
  EXPECT_NEAR(o.value("collision_rate", "rate"), 2.0 * static_cast<double>(o.totals.pair) / (32.0 * 6.0), rounding_of_transfers);
  EXPECT_NEAR(o.value("collision_rate", "rate_big_big"), counts[0][0] / (12.0 * 6.0), rounding_of_transfers);
  EXPECT_NEAR(o.value("collision_rate", "rate_big_small"), counts[0][1] / (12.0 * 6.0), rounding_of_transfers);
  EXPECT_NEAR(o.value("collision_rate", "rate_small_big"), counts[1][0] / (20.0 * 6.0), rounding_of_transfers);
  EXPECT_NEAR(o.value("collision_rate", "rate_small_small"), counts[1][1] / (20.0 * 6.0), rounding_of_transfers);
}

TEST(ObservedFlights, AreThoseBetweenTwoCollisionsOfADisk) {
  const Observed o = observe(parse_scene(small_mixture("free_flight = { bins = 20 }")), 0.1);
  std::map<std::int32_t, std::pair<double, Eigen::Vector2d>> last;  // time and position, mirrored by walls: so the path is summed
  std::map<std::int32_t, double> path, since;
  double flights = 0.0, time = 0.0, length = 0.0;
  std::map<std::int32_t, Eigen::Vector2d> velocity;
  for (std::int32_t i = 0; i < 32; ++i) velocity[i] = o.record.states.front().velocities.col(i);
  std::map<std::int32_t, double> collided;
  std::vector<double> histogram(20);
  const double width = 2.0 * o.column("free_flight", 0, "middle")[0];
  for (const Event& event : o.record.events) {
    const auto fly = [&](std::int32_t i, const Eigen::Vector2d& after) {
      path[i] += velocity[i].norm() * (event.time - since[i]);
      since[i] = event.time;
      velocity[i] = after;
    };
    const auto end = [&](std::int32_t i) {
      if (collided.contains(i)) {
        flights += 1.0;
        time += event.time - collided[i];
        length += path[i];
        const auto bin = static_cast<std::size_t>((event.time - collided[i]) / width);
        if (bin < 20) histogram[bin] += 1.0;
      }
      collided[i] = event.time;
      path[i] = 0.0;
    };
    fly(event.disk, event.velocity);
    if (event.partner < 0) continue;
    fly(event.partner, event.partner_velocity);
    end(event.disk);
    end(event.partner);
  }
  ASSERT_GT(flights, 50.0);
  EXPECT_NEAR(o.value("free_flight", "mean_free_time"), time / flights, rounding_of_transfers);
  EXPECT_NEAR(o.value("free_flight", "mean_free_path"), length / flights, rounding_of_transfers);
  for (std::size_t b = 0; b < 20; ++b)
    EXPECT_NEAR(o.column("free_flight", 0, "density")[b], histogram[b] / flights / width, rounding_of_transfers);
}

TEST(ObservedFlights, OfALargeSystemAreThoseOfAFourthOfItsDisks) {
  const Scene scene = parse_scene(
      "[box]\naspect = 1.0\nboundary = \"periodic\"\n[[disks]]\ncount = 2500\nradius = 0.5\nmass = 1.0\npacking_fraction = "
      "0.5\npositions = "
      "\"hexagonal\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n[run]\ntime = "
      "0.5\n[observe]\nfree_flight = true");
  const Observed o = observe(scene, 0.5);
  std::vector<std::int32_t> ids(2500);
  std::iota(ids.begin(), ids.end(), 0);
  const std::vector<std::int32_t> followed = sampled_disks(ids, 625, scene.run.seed);
  std::map<std::int32_t, double> last;
  double flights = 0.0, time = 0.0;
  for (const Event& event : o.record.events)
    for (const std::int32_t disk : {event.disk, event.partner}) {
      if (!std::ranges::binary_search(followed, disk)) continue;
      if (last.contains(disk)) {
        flights += 1.0;
        time += event.time - last[disk];
      }
      last[disk] = event.time;
    }
  ASSERT_GT(flights, 500.0);
  EXPECT_NEAR(o.value("free_flight", "mean_free_time"), time / flights, rounding_of_transfers);
}

/// Thirty disks of a triangular lattice in a square box: P_xx and P_yy differ for good.
TEST(ObservedTransport, OfAStrainedCrystalIsNone) {
  const Observed o = observe(
      parse_scene(
          "[box]\naspect = 1.0\nboundary = \"periodic\"\n[[disks]]\ncount = 30\nradius = 0.5\nmass = 1.0\npacking_fraction = "
          "0.8\n"
          "positions = \"hexagonal\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n[run]\ntime = 100.0\n"
          "equilibrate = { collisions_per_disk = 50 }\n[observe]\nviscosity = true\nheat_conductivity = true\n"),
      100.0);
  for (const char* name : {"green_kubo", "einstein_helfand"}) {
    EXPECT_FALSE(o.scalar("viscosity", name).value) << name;
    EXPECT_THAT(o.scalar("viscosity", name).note, testing::HasSubstr("strained crystal")) << name;
    EXPECT_TRUE(o.scalar("heat_conductivity", name).value) << name;
  }
}

/// Helfand's moments by their definition, from the replayed log.
TEST(ObservedTransport, MomentsGrowWithTheFluxAndJumpAtCollisions) {
  const double every = 0.25;
  const Observed o =
      observe(parse_scene(small_fluid("viscosity = { every = 0.25 }\nheat_conductivity = { every = 0.25 }")), every);
  // The flux between two samples is constant but for collisions: its integral is a sum over the flights of all disks.
  std::vector<std::array<double, 4>> growth(20);  // of G_xy, (G_xx - G_yy) / 2, G_x, G_y, in each step
  const auto fly = [&](double from, double to, const Eigen::Vector2d& v) {
    for (std::size_t k = 0; k < growth.size(); ++k) {
      const double time = std::min(to, every * static_cast<double>(k + 1)) - std::max(from, every * static_cast<double>(k));
      if (time <= 0.0) continue;
      const double energy = 0.5 * 1.5 * v.squaredNorm();
      growth[k][0] += time * 1.5 * v.x() * v.y();
      growth[k][1] += time * 0.75 * (v.x() * v.x() - v.y() * v.y());
      growth[k][2] += time * energy * v.x();
      growth[k][3] += time * energy * v.y();
    }
  };
  std::vector<double> since(40);
  std::vector<Eigen::Vector2d> velocity;
  for (Eigen::Index i = 0; i < 40; ++i) velocity.emplace_back(o.record.states.front().velocities.col(i));
  replay(o,
         [&](const Event& event, const Eigen::Vector2d& before, const Eigen::Vector2d& partner_before, const Eigen::Vector2d& r) {
           const auto i = static_cast<std::size_t>(event.disk), j = static_cast<std::size_t>(event.partner);
           fly(since[i], event.time, before);
           fly(since[j], event.time, partner_before);
           since[i] = since[j] = event.time;
           velocity[i] = event.velocity;
           velocity[j] = event.partner_velocity;
           const Eigen::Vector2d impulse = 1.5 * (event.velocity - before);
           const double gain = 0.75 * (event.velocity.squaredNorm() - before.squaredNorm());
           auto& now = growth[std::min<std::size_t>(growth.size() - 1, static_cast<std::size_t>(event.time / every))];
           now[0] += r.x() * impulse.y();
           now[1] += 0.5 * (r.x() * impulse.x() - r.y() * impulse.y());
           now[2] += r.x() * gain;
           now[3] += r.y() * gain;
         });
  for (std::size_t i = 0; i < 40; ++i) fly(since[i], 5.0, velocity[i]);

  const double kT = kinetic_temperature(o.scene.box, o.disks, o.record.states.front()), area = o.scene.box.area();
  for (const auto& [name, first, scale] :
       {std::tuple{"viscosity", 0U, area * kT}, std::tuple{"heat_conductivity", 2U, area * kT * kT}}) {
    const auto& lags = o.column(name, 0, "lag");
    for (std::size_t k = 0; k < 10; ++k) {
      ASSERT_NEAR(lags[k], every * static_cast<double>(k), 1e-12);
      double product = 0.0, square = 0.0;
      for (std::size_t t = k; t < growth.size(); ++t)
        for (const std::size_t c : {first, first + 1}) product += 0.5 * growth[t][c] * growth[t - k][c] / (every * every);
      for (std::size_t t = k; k > 0 && t <= growth.size(); ++t)
        for (const std::size_t c : {first, first + 1}) {
          double sum = 0.0;
          for (std::size_t s = t - k; s < t; ++s) sum += growth[s][c];
          square += 0.5 * sum * sum;
        }
      const double pairs = static_cast<double>(growth.size() - k);
      EXPECT_NEAR(o.column(name, 0, "correlation")[k] / (product / pairs), 1.0, 1e-9) << name << " " << k;
      if (k > 0) {
        EXPECT_NEAR(o.column(name, 0, "einstein_helfand")[k] / (square / (pairs + 1.0) / (2.0 * lags[k] * scale)), 1.0, 1e-9)
            << name << " " << k;
      }
    }
  }
}

TEST(ObservedTransport, GreenKuboIsTheSlopeOfEinsteinAndHelfand) {
  const Observed o = observe(parse_scene(small_fluid("viscosity = { every = 0.05 }", "specular", "100.0")), 10.0);
  const auto& lags = o.column("viscosity", 0, "lag");
  const auto& helfand = o.column("viscosity", 0, "einstein_helfand");
  const auto& integral = o.column("viscosity", 0, "green_kubo");
  for (std::size_t k = 1; k < 10; ++k) {
    const double slope = (lags[k + 1] * helfand[k + 1] - lags[k] * helfand[k]) / 0.05;
    // Both are sums over the same 2000 steps, but for the k at either end.
    EXPECT_NEAR(integral[k], slope, 0.1 * std::abs(slope)) << k;
  }
}

TEST(ObservedPressure, ZOfACrystalSaysThatItsErrorIsTooLarge) {
  const auto note_at = [](double packing_fraction, const char* number) {
    Scene scene = gas_scene(64, packing_fraction, Boundary::periodic);
    scene.run.time = 1.0;
    scene.observe = {{.name = "pressure", .every = 0.1}};
    return observe(scene, 0.1).scalar("pressure", number).note;
  };
  for (const char* number : {"Z", "reduced"}) {
    EXPECT_THAT(note_at(0.73, number), testing::HasSubstr("in a crystal")) << number;
    EXPECT_EQ(note_at(0.71, number), "") << number;
  }
}

/// What the only wall that exchanges energy has taken is what the disks have lost, and errs as much as two states of them.
TEST(ObservedWalls, OneThatAloneIsThermalTakesADifferenceOfTwoStates) {
  const Observed o = observe(
      parse_scene("[box]\nx = [0.0, 8.0]\ny = [0.0, 9.0]\nboundary = { x = \"periodic\", y = \"walls\" }\n[[disks]]\ncount = 36\n"
                  "radius = 0.5\nmass = 1.5\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\n"
                  "rule = \"specular\"\n[walls]\nbottom = { temperature = 1.0 }\n[run]\ntime = 100.0\n[observe]\n"
                  "wall_fluxes = { every = 0.5 }\n"),
      0.5);
  const auto expect = [&](const char* name, auto&& quantity) {
    const State &first = o.record.states.front(), &last = o.record.states.back();
    const Scalar& found = o.scalar("wall_fluxes", name);
    EXPECT_NEAR(found.value.value(), (quantity(first) - quantity(last)) / 800.0, 1e-12) << name;
    double mean = 0.0, squares = 0.0;
    const double count = static_cast<double>(o.record.states.size()) - 1.0;  // without that of the start
    for (const State& state : o.record.states) mean += &state == &first ? 0.0 : quantity(state) / count;
    for (const State& state : o.record.states) squares += &state == &first ? 0.0 : std::pow(quantity(state) - mean, 2);
    EXPECT_NEAR(found.error.value(), std::sqrt(2.0 * squares / (count - 1.0)) / 800.0, 1e-12) << name;
    EXPECT_EQ(found.note, "") << name;
    EXPECT_FALSE(found.halves) << name;
  };
  expect("energy_bottom", [](const State& state) { return 0.75 * state.velocities.squaredNorm(); });
  expect("shear_bottom", [](const State& state) { return 1.5 * state.velocities.row(0).sum(); });
}

}  // namespace
}  // namespace carom::test
