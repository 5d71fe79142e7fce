// The [observe] table: what is asked for, in which order, with which defaults, and back again.

#include "scene/observables_known.hpp"
#include "scene/scene_equality.hpp"
#include "scene/scene_texts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

Scene observed(const std::string& table, const std::string& boundary = "periodic") {
  return parse_scene(changed({{"walls", boundary}}) + "\n[observe]\n" + table);
}

TEST(Observe, NothingIsAskedForWhereNothingIsNamed) {
  EXPECT_TRUE(observed("").observe.empty());
  EXPECT_TRUE(observed("temperature = false\nviscosity = false").observe.empty());
}

TEST(Observe, RequestsComeInTheOrderOfTheFormatWithTheirDefaults) {
  const Scene scene =
      observed("structure_factor = true\nspeeds = { every = 0.5 }\ntemperature = true\ndensity_profile = { bins = 7 }");
  ASSERT_EQ(scene.observe.size(), 4U);
  EXPECT_EQ(scene.observe[0].name, "temperature");
  EXPECT_FALSE(scene.observe[0].every || scene.observe[0].bins);
  EXPECT_EQ(scene.observe[1].name, "speeds");
  EXPECT_EQ(scene.observe[1].every, 0.5);
  EXPECT_EQ(scene.observe[1].bins, 100);
  EXPECT_EQ(scene.observe[2].name, "structure_factor");
  EXPECT_EQ(scene.observe[2].largest, 20.0);
  EXPECT_EQ(scene.observe[3].name, "density_profile");
  EXPECT_EQ(scene.observe[3].axis, 1);
  EXPECT_EQ(scene.observe[3].bins, 7);
}

TEST(Observe, DisksAreFollowedByTheThousandUnlessMoreAreAskedFor) {
  const Scene scene = observed("mean_square_displacement = true\nvelocity_autocorrelation = { disks = 20_000 }");
  EXPECT_EQ(scene.observe[0].disks, 1000);
  EXPECT_EQ(scene.observe[1].disks, 20'000);
}

TEST(Observe, RangesShrinkToHalfOfASmallBox) {
  // The box is 10 by 8, the diameter 0.5: half of it is 8 diameters, less than the 10 of the hexatic correlation, more than the 5
  // of g(r).
  const Scene scene = observed("radial_distribution = true\nhexatic = true");
  EXPECT_EQ(scene.observe[0].range, 5.0);
  EXPECT_EQ(scene.observe[1].range, 8.0);
}

TEST(Observe, ResolvedSceneAsksForTheSame) {
  for (const char* table :
       {"", "temperature = true", "radial_distribution = { every = 0.1, range = 3.3, bins = 17 }\nhexatic = true",
        "density_profile = { axis = \"x\" }\nstructure_factor = { largest = 7.0 }\nviscosity = { every = 1e-3 }",
        "velocity_autocorrelation = { disks = 3 }", "voronoi = { bins = 7 }\nclusters = { gap = 0.25 }",
        "intermediate_scattering = { k = 3.5 }\nvan_hove = { range = 70.0 }\noverlap = { range = 0.2 }",
        "fields = { cells = [3, 7] }", "intermediate_scattering = { k = [6.3, 0.1, 17] }",
        "intermediate_scattering = { k = [3.5] }"}) {
    const Scene scene = observed(table);
    EXPECT_EQ(first_difference(scene, parse_scene(resolved_toml(scene))), "") << table;
  }
  EXPECT_THAT(
      resolved_toml(observed("density_profile = { axis = \"x\" }\nspeeds = true\npressure = true")),
      HasSubstr("\n[observe]\npressure = true\nspeeds = { bins = 100 }\ndensity_profile = { axis = \"x\", bins = 100 }\n"));
}

TEST(Observe, WaveNumbersAreOneOrAList) {
  const auto request = [](const std::string& settings) {
    return observed("intermediate_scattering = " + settings).observe.at(0);
  };
  EXPECT_EQ(request("true").largest, 6.3);
  EXPECT_EQ(request("{ k = 2 }").largest, 2.0);
  EXPECT_TRUE(request("{ k = 2 }").wave_numbers.empty());
  EXPECT_EQ(request("{ k = [6.3, 1, 3.5] }").wave_numbers, (std::vector<double>{6.3, 1.0, 3.5})) << "in the order of the scene";
  EXPECT_FALSE(request("{ k = [2.0] }").largest) << "a list of one is a list";
  EXPECT_EQ(request("{ k = [2.0] }").wave_numbers, std::vector<double>{2.0});
}

TEST(Observe, OverridesReachIt) {
  const Scene scene = parse_scene(changed({}), "scene", {"observe.speeds.bins=5", "observe.wall_fluxes=true"});
  ASSERT_EQ(scene.observe.size(), 2U);
  EXPECT_EQ(scene.observe[0].bins, 5);
  EXPECT_EQ(scene.observe[1].name, "wall_fluxes");
}

TEST(Observe, AThermostatAtRateZeroAllowsEveryObservable) {
  EXPECT_NO_THROW((void)observed("free_flight = true\n[thermostat]\ntemperature = 1.0\nrate = 0.0"));
}

TEST(Observe, EveryExampleOfTheCatalogueIsAccepted) {
  for (const detail::KnownObservable& known : detail::known_observables) {
    const bool walls = known.name == "wall_fluxes";
    std::string example(known.example);
    if (known.name == "hexatic") example = "hexatic = { range = 8.0, bins = 100 }";  // as far as this box reaches
    EXPECT_EQ(observed(example, walls ? "walls" : "periodic").observe.at(0).name, known.name);
  }
}

}  // namespace
}  // namespace carom::test
