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
  const PlainGas wide(4.5), narrow(3.5);
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

}  // namespace
}  // namespace carom::test
