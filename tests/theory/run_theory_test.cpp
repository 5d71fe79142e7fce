// What stands beside the numbers of a run as theory.

#include "theory/run_theory.hpp"

#include "observe/run_report.hpp"
#include "simulation/start.hpp"
#include "theory/equation_of_state.hpp"
#include "theory/kinetic.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <carom/scene.hpp>

#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

/// What theory says of a contact value of heavy and light disks at packing fraction 0.4 or so.
std::optional<Expected> contact_value(const std::string& name, double radius_of_light, const std::string& more = "") {
  const Scene scene = parse_scene(
      fmt::format("[box]\nx = [0.0, 20.0]\ny = [0.0, 10.0]\nboundary = \"periodic\"\n"
                  "[[disks]]\nname = \"heavy\"\ncount = 60\nradius = 0.5\nmass = 5.0\npositions = \"random\"\nvelocities = {{ "
                  "temperature = 1.0 }}\n[[disks]]\nname = \"light\"\ncount = 40\nradius = {}\nmass = 1.0\npositions = "
                  "\"random\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n",
                  radius_of_light) +
      more);
  const Disks disks = all_disks(scene);
  RunReport report;
  report.disks = static_cast<std::int64_t>(disks.count());
  report.packing_fraction = scene.packing_fraction();
  report.temperature_mean = 1.0;
  return RunTheory(report, TheorySource{scene, disks, scene.species.size()}).of("contact_values", name);
}

TEST(TheoryOfContactValues, OfOneSizeFollowsFromTheEquationOfStateWhateverTheMasses) {
  const double eta = 100.0 * std::numbers::pi * 0.25 / 200.0;
  const double g = (theory::kolafa_rottner_finite(eta, 100) - 1.0) * 100.0 / (2.0 * eta * 99.0);
  for (const char* name : {"g_heavy_heavy", "g_heavy_light", "g_light_light", "g_rate_heavy_heavy", "g_rate_heavy_light"})
    EXPECT_NEAR(contact_value(name, 0.5).value().value, g, 1e-12) << name;
  EXPECT_FALSE(contact_value("g_light_heavy", 0.5)) << "there is no such number";
  EXPECT_FALSE(contact_value("Z_share_heavy_heavy", 0.5));
}

TEST(TheoryOfContactValues, OfTwoSizesIsTheApproximationThatCountsCollisions) {
  const std::vector<theory::Component> gas = {{60.0 / 200.0, 0.5, 5.0}, {40.0 / 200.0, 0.3, 1.0}};
  const auto expected = contact_value("g_heavy_light", 0.3);
  ASSERT_TRUE(expected);
  EXPECT_NEAR(expected->value, theory::contact_value(gas, 0.5, 0.3), 1e-12);
  EXPECT_NE(expected->source.find("approximate"), std::string::npos);
}

TEST(TheoryOfContactValues, IsGivenOnlyWhereNothingElseActs) {
  EXPECT_FALSE(contact_value("g_heavy_light", 0.5, "[thermostat]\ntemperature = 1.0\nrate = 1.0\n"));
  EXPECT_FALSE(contact_value("g_heavy_light", 0.5, "[square_well]\nwidth = 1.5\ndepth = 1.0\n"));
  const std::string lone =
      "[[disks]]\nname = \"lone\"\ncount = 1\nradius = 0.5\nmass = 1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 "
      "}\n";
  EXPECT_FALSE(contact_value("g_lone_lone", 0.5, lone)) << "there is no such pair";
  EXPECT_TRUE(contact_value("g_heavy_lone", 0.5, lone));
}

/// Theory of 60 disks at packing fraction 0.3 in a periodic box of this height, all together as fast along x as `common`.
struct PlainGas {
  explicit PlainGas(double height, double common = 0.0)
      : scene(parse_scene(fmt::format(
            "[box]\nx = [0.0, {}]\ny = [0.0, {}]\nboundary = \"periodic\"\n[[disks]]\ncount = 60\nradius = 0.5\nmass = 2.0\n"
            "positions = \"random\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n",
            60.0 * std::numbers::pi * 0.25 / 0.3 / height, height))),
        disks(all_disks(scene)) {
    report.disks = 60;
    report.packing_fraction = scene.packing_fraction();
    report.temperature_mean = 1.0;
    report.measured = true;
    report.momentum_initial = {120.0 * common, 0.0};
  }
  [[nodiscard]] std::optional<Expected> of(const std::string& observable, const std::string& scalar) const {
    return RunTheory(report, TheorySource{scene, disks, 1}).of(observable, scalar);
  }

  Scene scene;
  Disks disks;
  RunReport report;
};

TEST(RunTheory, OfABoxThatIsWideEnoughIsGiven) {
  const PlainGas wide(7.0), narrow(6.0);
  for (const char* name : {"Z", "Z_rate"}) {
    EXPECT_TRUE(wide.of("pressure", name)) << name;
    EXPECT_FALSE(narrow.of("pressure", name)) << name;
  }
  EXPECT_TRUE(wide.of("contact_values", "g"));
  EXPECT_FALSE(narrow.of("contact_values", "g"));
  EXPECT_NE(RunTheory(narrow.report, TheorySource{narrow.scene, narrow.disks, 1}).why_not_Z().find("so narrow"),
            std::string::npos);
}

TEST(RunTheory, OfSpeedsAndPathsIsThatOfDisksWhichTogetherAreAtRest) {
  const PlainGas at_rest(10.0, 1e-9), moving(10.0, 3.0);
  EXPECT_TRUE(at_rest.of("velocity_moments", "speed"));
  EXPECT_FALSE(moving.of("velocity_moments", "speed"));
  EXPECT_TRUE(at_rest.of("free_flight", "mean_free_path"));
  EXPECT_FALSE(moving.of("free_flight", "mean_free_path"));
  for (const PlainGas* gas : {&at_rest, &moving}) {
    EXPECT_TRUE(gas->of("free_flight", "mean_free_time")) << "times are those of any common motion";
    EXPECT_TRUE(gas->of("pressure", "Z"));
  }
}

/// The theory for a run of equal disks of radius 0.5 in a box 20 wide and 20 high, whose kT is 1.
struct Gas {
  Gas(std::int64_t count, const std::string& boundary, const std::string& effects)
      : scene(parse_scene(fmt::format(
            "[box]\nx = [0.0, 20.0]\ny = [0.0, 20.0]\nboundary = {}\n[[disks]]\ncount = {}\nradius = 0.5\nmass = 1.0\n"
            "positions = \"hexagonal\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\nrule = \"specular\"\n"
            "[run]\ntime = 1.0\n{}",
            boundary, count, effects))),
        disks(all_disks(scene)) {
    report.disks = count;
    report.packing_fraction = scene.packing_fraction();
    report.temperature_mean = 1.0;
    report.measured = true;
  }
  [[nodiscard]] std::vector<TheoryCurve> curves(const std::string& table, const std::string& axis) const {
    const Table measured{.name = table, .columns = {{axis, "", {5.0, 10.0, 20.0}}}};
    return RunTheory(report, TheorySource{scene, disks, 1}).curves(measured, "density");
  }
  /// Returns the names of the laws of speeds, one after the other.
  [[nodiscard]] std::string law_of_speeds() const {
    std::string names;
    for (const TheoryCurve& curve : curves("speeds", "speed")) names += curve.name;
    return names;
  }

  Scene scene;
  Disks disks;
  RunReport report;
};

const std::string walls = "\"walls\"", channel = "{ x = \"periodic\", y = \"walls\" }", periodic = "\"periodic\"";
const std::string weight = "[gravity]\nacceleration = [0.0, -0.1]\n", bath = "[walls]\ntop = { temperature = 1.0 }\n";

TEST(TheoryOfDensity, UnderGravityHoldsAllDisksInTheWholeWidthOfAStrip) {
  for (const std::string& boundary : {walls, channel}) {
    const std::vector<TheoryCurve> curves = Gas(60, boundary, weight).curves("density_profile", "y");
    ASSERT_EQ(curves.size(), 1U) << boundary;
    double disks = 0.0;  // a density is per area of strips 20 wide, at equal steps of the 19 that centres can reach
    for (const double density : curves[0].y) disks += density * 20.0 * 19.0 / static_cast<double>(curves[0].y.size());
    EXPECT_NEAR(disks, 60.0, 0.01) << boundary;
  }
}

TEST(TheoryOfDensity, IsGivenOnlyForHardDisksThatFallAlongOneAxis) {
  EXPECT_TRUE(Gas(60, walls, "[gravity]\nacceleration = [0.2, -0.1]\n").curves("density_profile", "y").empty());
  EXPECT_TRUE(Gas(60, channel, bath + "[gravity]\nacceleration = [0.2, -0.1]\n").curves("density_profile", "y").empty());
  EXPECT_TRUE(Gas(60, walls, weight + "[square_well]\nwidth = 1.5\ndepth = 0.6\n").curves("density_profile", "y").empty());
}

TEST(TheoryOfSpeeds, IsTheLawOfTheEnergyAndMomentumThatAreKept) {
  EXPECT_EQ(Gas(5, periodic, "").law_of_speeds(), "law for 5 disks");
  EXPECT_EQ(Gas(5, walls, "").law_of_speeds(), "law for 5 disks");
  EXPECT_EQ(Gas(5, periodic, "[tumbling]\nrate = 1.0\n").law_of_speeds(), "law for 5 disks") << "tumbles keep speeds";
  EXPECT_EQ(Gas(5, walls, weight).law_of_speeds(), "Maxwell and Boltzmann") << "weight takes energy and gives it back";
  EXPECT_EQ(Gas(5, channel, "").law_of_speeds(), "") << "their momentum along one axis is kept";
  EXPECT_EQ(Gas(100, channel, "").law_of_speeds(), "Maxwell and Boltzmann");
  EXPECT_EQ(Gas(100, channel, bath).law_of_speeds(), "Maxwell and Boltzmann");
  EXPECT_EQ(Gas(100, channel, bath + "[gravity]\nacceleration = [0.1, 0.0]\n").law_of_speeds(), "") << "they flow";
}

/// <v^2> of a disk of many is 2 kT / m (1 - m / M) where momentum is conserved; half of that is missing where it is along one
/// axis.
TEST(TheoryOfSpeeds, HasWhatAConservedMomentumLeaves) {
  const std::string well = "[square_well]\nwidth = 1.5\ndepth = 0.2\n";
  for (const auto& [boundary, missing] : {std::pair{periodic, 1.0}, std::pair{channel, 0.5}, std::pair{walls, 0.0}}) {
    const Gas gas(4, boundary, well);
    const Table speeds{.name = "speeds", .columns = {{"speed", "", {8.0}}}};  // beyond is e^-32 of the disks
    const std::vector<TheoryCurve> curves =
        RunTheory(gas.report, TheorySource{gas.scene, gas.disks, 1}).curves(speeds, "density");
    ASSERT_EQ(curves.size(), 1U);
    double square = 0.0;
    const std::vector<double>&v = curves[0].x, &density = curves[0].y;
    for (std::size_t k = 0; k < v.size(); ++k) square += v[k] * v[k] * density[k] * (v[1] - v[0]);
    EXPECT_NEAR(square, 2.0 * (1.0 - missing / 4.0), 1e-3) << boundary;
  }
}

TEST(TheoryOfZ, OfADenseFluidIsThatOfManyDisks) {
  RunReport report;
  for (const std::int64_t disks : {144, 2000}) {
    const Scene scene = parse_scene(fmt::format(
        "[box]\naspect = 1.1547\nboundary = \"periodic\"\n[[disks]]\ncount = {}\nradius = 0.5\nmass = 1.0\npacking_fraction = "
        "0.68\npositions = \"hexagonal\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\nrule = \"specular\"\n"
        "[run]\ntime = 1.0\n",
        disks));
    const Disks all = all_disks(scene);
    report.disks = disks;
    report.packing_fraction = scene.packing_fraction();
    report.temperature_mean = 1.0;
    report.measured = true;
    const RunTheory theory(report, TheorySource{scene, all, 1});
    EXPECT_EQ(theory.Z().has_value(), disks == 2000);
    EXPECT_EQ(theory.of("contact_values", "g").has_value(), disks == 2000);
    EXPECT_EQ(theory.why_not_Z().find("from 2000 disks on") != std::string::npos, disks < 2000);
  }
}

}  // namespace
}  // namespace carom::test
