// Sweep files: which points and seeds they mean, and what is refused with which sentence.

#include "io/summary.hpp"
#include "scene/observables_known.hpp"
#include "studies/sweep/numbers.hpp"
#include "support/recorded_run.hpp"
#include "support/sweep_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string scene_line = "scene = \"gas.toml\"\n";

class SweepReader : public ::testing::Test {
 protected:
  SweepFiles files_;
};

std::vector<std::string> names_of(const Sweep& sweep) {
  std::vector<std::string> names;
  for (const SweepPoint& point : sweep.points) names.push_back(point.name);
  return names;
}

TEST_F(SweepReader, AGridHasEveryCombinationAndItsFirstKeyChangesLast) {
  const Sweep sweep = files_.load(scene_line + "seeds = 2\n[grid]\n\"run.time\" = [1.0, 2]\ndisks.0.count = [10, 20, 30]\n");
  EXPECT_THAT(sweep.keys, ElementsAre("run.time", "disks.0.count"));
  EXPECT_THAT(names_of(sweep), ElementsAre("time=1.0_count=10", "time=1.0_count=20", "time=1.0_count=30", "time=2_count=10",
                                           "time=2_count=20", "time=2_count=30"));
  EXPECT_THAT(sweep.seeds, ElementsAre(1, 2));
  EXPECT_EQ(sweep.run_count(), 12U);
  EXPECT_THAT(sweep.overrides_of(11), ElementsAre("run.time=2", "disks.0.count=30", "run.seed=2"));
  EXPECT_EQ(sweep.directory_of(11), "time=2_count=30/seed=2");
}

TEST_F(SweepReader, AKeyIsNotInSetAndInGrid) {
  EXPECT_THAT(files_.refusal(scene_line + "[set]\n\"run.time\" = 3.0\n[grid]\n\"run.time\" = [1.0, 2.0]\n"),
              HasSubstr("sweep.toml:3:1: run.time is in [grid] too, which gives every point a value of its own; remove it from "
                        "one of the two"));
  EXPECT_EQ(files_.refusal(scene_line + "[set]\n\"run.time\" = 3.0\n[[points]]\nname = \"a\"\n[[points]]\nname = "
                                        "\"b\"\n\"run.time\" = 1.0\n"),
            "")
      << "points that are listed may have what others have not";
}

TEST_F(SweepReader, ListedPointsFollowTheGridAndMayHaveNames) {
  const Sweep sweep = files_.load(scene_line +
                                  "[grid]\n\"run.time\" = [1.0]\n"
                                  "[[points]]\nname = \"walls\"\n\"box.boundary\" = \"walls\"\n"
                                  "[[points]]\nrun.time = 3.0\n\"disks.0.velocities\" = { speed = 2.0 }\n");
  EXPECT_THAT(names_of(sweep), ElementsAre("time=1.0", "walls", "time=3.0_velocities=speed-2.0"));
  EXPECT_THAT(sweep.overrides_of(1), ElementsAre("box.boundary=\"walls\"", "run.seed=1"));
  EXPECT_DOUBLE_EQ(std::get<FixedSpeed>(sweep.scene_of(2).species[0].velocities).speed, 2.0);
}

TEST_F(SweepReader, WithoutPointsTheSceneItselfIsOne) {
  const Sweep sweep = files_.load(scene_line + "seeds = [5, 3]\n");
  EXPECT_THAT(names_of(sweep), ElementsAre("scene"));
  EXPECT_EQ(sweep.directory_of(1), "scene/seed=3");
  EXPECT_EQ(sweep.scene_of(1).run.seed, 3U);
}

TEST_F(SweepReader, ANumberOfSeedsBeginsWithTheScenesOwn) {
  EXPECT_THAT(files_.load(scene_line + "seeds = 3\n[set]\nrun.time = 4.0\n").seeds, ElementsAre(1, 2, 3));
  write_text(files_.directory().file("gas.toml"), fifty_disks + "seed = 7\n");
  EXPECT_THAT(files_.load(scene_line + "seeds = 3\n").seeds, ElementsAre(7, 8, 9));
}

TEST_F(SweepReader, SharedChangesAreAtEveryPointAndAPointsOwnComeAfterThem) {
  const Sweep sweep = files_.load(scene_line + "[set]\nrun.time = 4.0\ndisks.0.count = 9\n[[points]]\nrun.time = 5.0\n");
  EXPECT_EQ(sweep.scene_of(0).run.time, 5.0);
  EXPECT_EQ(sweep.scene_of(0).disk_count(), 9);
  EXPECT_THAT(names_of(sweep), ElementsAre("time=5.0"));
}

TEST_F(SweepReader, AResolvedSceneReadsBackAsItself) {
  const Sweep sweep = files_.load(scene_line +
                                  "[grid]\ndisks.0.packing_fraction = [0.1]\n\"observe.speeds\" = [{ bins = 20 }]\n"
                                  "[set]\ndisks.0.radius = 0.3\n\"title\" = \"a \\\"name\\\"\"\nbox = { aspect = 2.0, "
                                  "boundary = \"periodic\" }\n");
  const std::string resolved = resolved_toml(sweep.scene_of(0));
  EXPECT_EQ(resolved_toml(parse_scene(resolved)), resolved);
}

TEST_F(SweepReader, WhatIsWrongWithTheFileIsSaidWithItsPlace) {
  const auto refusal = [&](const std::string& text) { return files_.refusal(text); };
  EXPECT_EQ(refusal("seeds = 2\n"), "sweep.toml:1:1: the sweep names no scene; give it, such as scene = \"gas.toml\"");
  EXPECT_THAT(refusal("scene = 3\n"), StartsWith("sweep.toml:1:9: scene is an integer (3); it must be a string"));
  EXPECT_THAT(refusal("scene = \"gone.toml\"\n"),
              AllOf(StartsWith("sweep.toml:1:9: "), HasSubstr("gone.toml: there is no such")));
  EXPECT_EQ(refusal(scene_line + "sedes = 2\n"), "sweep.toml:2:1: a sweep has no key \"sedes\"; did you mean \"seeds\"?");
  EXPECT_THAT(refusal(scene_line + "seeds = 0\n"),
              StartsWith("sweep.toml:2:9: seeds is an integer (0); it must be how many, from 1"));
  EXPECT_THAT(refusal(scene_line + "seeds = []\n"), StartsWith("sweep.toml:2:9: seeds is an empty list"));
  EXPECT_THAT(refusal(scene_line + "seeds = [1, -2]\n"), StartsWith("sweep.toml:2:13: seeds.1 is an integer (-2)"));
  EXPECT_EQ(refusal(scene_line + "seeds = [1, 2, 1]\n"),
            "sweep.toml:2:16: seed 1 is there twice; a seed gives one run, so name it once");
  EXPECT_THAT(refusal(scene_line + "grid = 3\n"), StartsWith("sweep.toml:2:8: grid is an integer (3)"));
  EXPECT_THAT(refusal(scene_line + "[grid]\n"), StartsWith("sweep.toml:2:1: [grid] is empty"));
  EXPECT_THAT(refusal(scene_line + "[grid]\nrun.time = 3.0\n"),
              StartsWith("sweep.toml:3:12: grid.run.time is a floating-point number (3.0); it must be a list of values"));
  EXPECT_THAT(refusal(scene_line + "[grid]\n\"run.seed\" = [1, 2]\n"), StartsWith("sweep.toml:3:1: run.seed cannot be swept"));
  EXPECT_EQ(refusal(scene_line + "[grid]\n\"run.time\" = [1.0]\nrun.time = [2.0]\n"),
            "sweep.toml:4:5: run.time is there twice; give it once");
  EXPECT_THAT(refusal(scene_line + "points = 3\n"),
              StartsWith("sweep.toml:2:10: points is an integer (3); it must be a list of tables"));
  EXPECT_THAT(refusal(scene_line + "[[points]]\nname = \"../up\"\n"),
              StartsWith("sweep.toml:3:8: points.0.name is a string (\"../up\")"));
  EXPECT_THAT(refusal(scene_line + "[[points]]\nname = \"sweep.csv\"\n"), HasSubstr("no file of the sweep"));
  EXPECT_THAT(refusal(scene_line + "[[points]]\nrun.time = 1979-05-27\n"),
              HasSubstr("is a date or time; it must be a value that a scene"));
  EXPECT_THAT(refusal("scene = \n"), StartsWith("sweep.toml:1:"));
}

TEST_F(SweepReader, TwoPointsOfOneNameAreRefused) {
  EXPECT_EQ(files_.refusal(scene_line + "[[points]]\nname = \"a\"\nrun.time = 1.0\n[[points]]\nname = \"a\"\nrun.time = 2.0\n"),
            "sweep.toml:5:1: two points are called a, the other one in line 2; give one of them a name of its own");
}

TEST_F(SweepReader, OfPointsWithOneSceneTheFirstStays) {
  const Sweep sweep = files_.load(scene_line +
                                  "seeds = 2\n[grid]\n\"collision.restitution\" = [1, 1.0, 0.9, 0.9]\n"
                                  "[[points]]\nname = \"elastic\"\ncollision.restitution = 1\n"

                                  "[[points]]\nname = \"short\"\nrun.time = 1.0\n");
  EXPECT_THAT(names_of(sweep), ElementsAre("restitution=1", "restitution=0.9", "short"));
  EXPECT_EQ(sweep.run_count(), 6U);
  EXPECT_THAT(sweep.overrides_of(5), ElementsAre("run.time=1.0", "run.seed=2"));
  std::vector<std::string> repeated;
  for (const RepeatedPoint& point : sweep.repeated) repeated.push_back(point.name + " of " + point.of);
  EXPECT_THAT(repeated,
              ElementsAre("restitution=1.0 of restitution=1", "restitution=0.9 of restitution=0.9", "elastic of restitution=1"));
}

TEST_F(SweepReader, WhatASceneRefusesIsSaidOfThePointThatAsksForIt) {
  EXPECT_THAT(files_.refusal(scene_line + "[grid]\ndisks.0.radius = [0.1, -0.2]\n"),
              AllOf(StartsWith("sweep.toml:3:24: the scene of the point radius=-0.2 is refused: --set disks.0.radius=-0.2: "),
                    HasSubstr("above zero")));
  EXPECT_THAT(
      files_.refusal(scene_line + "[grid]\nrun.time = [1.0]\ndisks.1.radius = [0.1]\n"),
      StartsWith("sweep.toml:4:19: the scene of the point time=1.0_radius=0.1 is refused: --set disks.1.radius=0.1: disks has 1 "
                 "entry"));
  EXPECT_THAT(files_.refusal(scene_line + "[set]\nrun.tim = 2.0\n"),
              StartsWith("sweep.toml:3:5: the scene of the point scene is refused: "));
  EXPECT_THAT(files_.refusal(scene_line + "[grid]\n\"disks.0.a b\" = [1]\n"), HasSubstr("is not a dotted key"));
}

TEST_F(SweepReader, TooManyRunsAreRefused) {
  EXPECT_THAT(files_.refusal(scene_line + "seeds = 1000000\n[grid]\nrun.time = [1.0, 2.0]\n"),
              StartsWith("sweep.toml:1:1: these are 2 points with 1000000 seeds each"));
}

TEST_F(SweepReader, ATableHasNumbersThatSummariesHave) {
  const std::string observed = scene_line + "table = [\"pressure.Z\", \"observables.temperature.kT\"]\n[set]\n";
  EXPECT_THAT(files_.load(observed + "observe.temperature = true\n").table,
              ElementsAre("pressure.Z", "observables.temperature.kT"));
  EXPECT_EQ(files_.refusal(scene_line + "table = [\"presure.Z\"]\n"),
            "sweep.toml:2:10: table.0 is \"presure.Z\", and no run has that number; did you mean \"pressure.Z\"?");
  EXPECT_THAT(files_.refusal(scene_line + "table = [\"wall_seconds\"]\n"),
              HasSubstr("no run has that number; there are disks, packing_fraction, time, samples, "));
  EXPECT_THAT(files_.refusal(scene_line + "table = [\"time\", \"time\"]\n"), HasSubstr("in the list already"));
  EXPECT_THAT(files_.refusal(scene_line + "table = []\n"), StartsWith("sweep.toml:2:9: table is an empty list"));
}

TEST_F(SweepReader, ATableHasNumbersThatSomePointOfThisVerySweepHas) {
  // Walls and thermostats are known, and this gas has neither.
  for (const char* name : {"walls.left.force", "thermostat.thermostat", "events.thermostat", "growth.scale", "overlap.start"})
    EXPECT_THAT(files_.refusal(scene_line + "table = [\"time\", \"" + name + "\"]\n"),
                StartsWith(std::string("sweep.toml:2:18: table.1 is \"") + name + "\", and no run has that number"))
        << name;
  const std::string kicks = scene_line + "table = [\"thermostat.events\"]\n";
  EXPECT_EQ(files_.refusal(kicks + "[set]\nthermostat = { temperature = 1.0, rate = 0.0 }\n"), "");
  EXPECT_EQ(files_.refusal(kicks + "[[points]]\nname = \"a\"\n[[points]]\nname = \"b\"\n"
                                   "thermostat = { temperature = 1.0, rate = 0.1 }\n"),
            "");
  const auto observed = [&](const std::string& name) {
    return files_.refusal(scene_line + "table = [\"observables." + name +
                          "\"]\n[set]\nobserve = { pressure = true, non_gaussian = true }\n");
  };
  EXPECT_EQ(observed("pressure.Z_error"), "");
  EXPECT_THAT(observed("pressure.Zet"), HasSubstr("did you mean \"observables.pressure.Z\"?"));
  EXPECT_THAT(observed("pressure.something_else"), HasSubstr("of pressure there are observables.pressure.Z"));
  EXPECT_THAT(observed("overlap.overlap@1"), AllOf(HasSubstr("does not ask for overlap, or it makes tables alone; there are"),
                                                   HasSubstr("observables.pressure.Z")));
  EXPECT_THAT(observed("non_gaussian.something_else"),
              HasSubstr("of non_gaussian there are observables.non_gaussian.alpha_2@lag"));
  EXPECT_THAT(observed("msd.D"), HasSubstr("there is no observable \"msd\"; there are observables.pressure.Z"));
}

TEST_F(SweepReader, ATableHasFunctionsOfALagAtALag) {
  const auto at = [&](const std::string& name) {
    return files_.refusal(
        scene_line + "table = [\"observables." + name +
        "\"]\n[set]\nrun.time = 4.0\nobserve = { mean_square_displacement = true, overlap = true, speeds = true }\n");
  };
  for (const char* name : {"mean_square_displacement.diffusion@0.5", "mean_square_displacement.msd_error@4", "overlap.chi_4@1e-1",
                           "energies.density@0.25"})
    EXPECT_EQ(at(name), "") << name;
  EXPECT_THAT(at("overlap.overlap@4.5"), HasSubstr("no run is that long; a lag is at most run.time"));
  EXPECT_THAT(at("overlap.overlap@long"),
              HasSubstr("behind @ there is to be a value of lag, such as observables.overlap.overlap@1.5"));
  EXPECT_THAT(at("overlap.overlap@"), HasSubstr("behind @ there is to be a value of lag"));
  EXPECT_THAT(at("overlap.overlap@inf"), HasSubstr("behind @ there is to be a value of lag"));
  EXPECT_THAT(at("overlap.overlop@1"), HasSubstr("did you mean \"observables.overlap.overlap@1\"?"));
  EXPECT_THAT(at("mean_square_displacement.diffuson@2.5"),
              HasSubstr("did you mean \"observables.mean_square_displacement.diffusion@2.5\"?"));
  EXPECT_THAT(at("overlap.overlap@lag"), HasSubstr("behind @ there is to be a value of lag"));
}

TEST_F(SweepReader, AValueAtWhichNoTableHasARowIsRefused) {
  const auto at = [&](const std::string& name) {
    return files_.refusal(scene_line + "table = [\"observables." + name + "\"]\n[set]\nrun.time = 4.0\n" +
                          "box.x = [0.0, 10.0]\nobserve = { mean_square_displacement = true, overlap = true, voronoi = true, "
                          "radial_distribution = { range = 3.0, bins = 30 }, structure_factor = true, h_function = true, "
                          "velocity_autocorrelation = true, density_profile = { axis = \"x\", bins = 5 } }\n");
  };
  for (const char* right :
       {"radial_distribution.g@0.05", "radial_distribution.g@1.75", "density_profile.density@1", "density_profile.density@9",
        "voronoi_neighbours.fraction@6", "h_function.H@0", "velocity_autocorrelation.correlation@0", "structure_factor.S@2"})
    EXPECT_EQ(at(right), "") << right;
  for (const char* lag : {"mean_square_displacement.msd@-1", "mean_square_displacement.msd@0", "overlap.overlap@-0.1"})
    EXPECT_THAT(at(lag), HasSubstr("no run has a row there; the table begins at a larger lag")) << lag;
  EXPECT_THAT(at("h_function.H@-1"), HasSubstr("a time at most run.time"));
  for (const char* r : {"radial_distribution.g@0", "radial_distribution.g@1e9", "radial_distribution.g@1.9"})
    EXPECT_THAT(at(r), HasSubstr("the table begins at a larger r, or ends at a smaller")) << r;
  EXPECT_THAT(at("structure_factor.S@1e9"), HasSubstr("the table begins at a larger k, or ends at a smaller"));
  for (const char* x : {"density_profile.density@0", "density_profile.density@9.5"})
    EXPECT_THAT(at(x), HasSubstr("rows are at the x of the middles of cells")) << x;
  EXPECT_THAT(at("voronoi_neighbours.fraction@6.5"), HasSubstr("neighbours is a whole number"));
  EXPECT_THAT(at("mean_square_displacement.msd@0.1@0.2"), HasSubstr("behind @ there is to be a value of lag, such as"));
}

TEST_F(SweepReader, AValueBeyondWhatASceneSaysOfATableIsRefused) {
  const auto at = [&](const std::string& name, const std::string& velocities = "temperature = 4.0") {
    return files_.refusal(scene_line + "table = [\"observables." + name + "\"]\n[set]\nrun.time = 4.0\n" +
                          "disks.0.velocities = { " + velocities + " }\ndisks.0.count = 20\n" +
                          "observe = { clusters = true, voronoi = true, speeds = true }\n");
  };
  for (const char* right : {"clusters.clusters_per_disk@1", "clusters.clusters_per_disk@20", "voronoi_neighbours.fraction@12",
                            "voronoi_areas.density@3.5", "speeds.density@9", "energies.density@45"})
    EXPECT_EQ(at(right), "") << right;
  for (const char* name : {"clusters.clusters_per_disk@0", "clusters.clusters_per_disk@21"})
    EXPECT_THAT(at(name), HasSubstr("no run has a row there; the table begins at a larger size, or ends at a smaller")) << name;
  EXPECT_THAT(at("voronoi_neighbours.fraction@13"), HasSubstr("begins at a larger neighbours, or ends at a smaller"));
  EXPECT_THAT(at("voronoi_areas.density@5"), HasSubstr("the table begins at a larger area, or ends at a smaller"));
  for (const char* name : {"speeds.density@10.1", "energies.density@51", "speeds.density@0"})
    EXPECT_THAT(at(name), HasSubstr("the table begins at a larger middle, or ends at a smaller")) << name;
  EXPECT_EQ(at("speeds.density@11", "speed = 4.0"), "") << "the temperature is that of what is drawn";
}

TEST_F(SweepReader, ATableHasCellsByAPlaceInThem) {
  const auto at = [&](const std::string& name, const std::string& more = "") {
    return files_.refusal(scene_line + "table = [\"observables." + name + "\"]\n[set]\nrun.time = 4.0\n" +
                          "observe = { fields = { cells = [4, 3] } }\n" + more);
  };
  EXPECT_EQ(at("fields.density@2.5,1"), "");
  EXPECT_EQ(at("fields.stress_xy_error@0,0"), "");
  EXPECT_EQ(at("fields_in_time.temperature@3,1,1"), "");
  for (const char* wrong : {"@5", "@5,", "@1,2,3", "@1,two"})
    EXPECT_THAT(at(std::string("fields.density") + wrong),
                HasSubstr("behind @ there is to be a value of x,y, such as observables.fields.density@1.5,1.5"));
  EXPECT_THAT(at("fields.density@2.5,99"), HasSubstr("no run has a row there; a place is in the box"));
  EXPECT_EQ(at("fields.density@2.5,99", "box.boundary = \"walls\"\nwalls.top.velocity = 50.0\n"), "");
  EXPECT_THAT(at("fields_in_time.density@4.5,1,1"), HasSubstr("and a time at most run.time"));
}

TEST_F(SweepReader, AColumnThatATableHasNotIsToldItsColumns) {
  const auto at = [&](const std::string& name) {
    return files_.refusal(scene_line + "table = [\"" + name + "\"]\n[set]\nrun.time = 4.0\n" +
                          "observe = { fields = { cells = [4, 3] }, viscosity = true }\n");
  };
  EXPECT_THAT(
      at("observables.fields_in_time.kT@1,2.5,1"),
      HasSubstr("and no column \"kT\" is in the table fields_in_time; its columns, each at a value of time,x,y, are density, "
                "velocity_x, velocity_y, temperature, stress_xx, "));
  EXPECT_THAT(at("observables.fields.densty@2.5,1"), HasSubstr("did you mean \"observables.fields.density@2.5,1\"?"));
  EXPECT_THAT(at("observables.feilds.density@2.5,1"), HasSubstr("did you mean \"observables.fields.density@2.5,1\"?"));
}

TEST_F(SweepReader, ColumnsThatSayWhichRowItIsAreNoNumbers) {
  const auto at = [&](const std::string& name) {
    return files_.refusal(
        scene_line + "table = [\"observables." + name + "\"]\n[set]\nrun.time = 4.0\n" +
        "observe = { fields = { cells = [4, 3] }, viscosity = true, velocity_autocorrelation = true, clusters = true }\n");
  };
  for (const char* name : {"fields.x@1,1", "fields.y@1,1", "fields_in_time.y@1,1,1", "fields_in_time.time@1,1,1",
                           "viscosity.integral_to@1", "velocity_autocorrelation.window@1", "clusters.size_to@2"})
    EXPECT_THAT(at(name),
                AllOf(HasSubstr("says which row it is; its others, each at a value of "), Not(HasSubstr("integral_to,"))))
        << name;
}

TEST_F(SweepReader, ANumberOfAnObservableWithoutItsFirstWordIsKnown) {
  const auto at = [&](const std::string& name) {
    return files_.refusal(scene_line + "table = [\"" + name + "\"]\n[set]\nrun.time = 4.0\n" +
                          "observe = { voronoi = true, overlap = true }\n");
  };
  EXPECT_THAT(at("voronoi.fraction_5"), HasSubstr("did you mean \"observables.voronoi.fraction_5\"?"));
  EXPECT_THAT(at("voronoi.fracton_5"), HasSubstr("did you mean \"observables.voronoi.fraction_5\"?"));
  EXPECT_THAT(at("overlap.chi_4@2"), HasSubstr("did you mean \"observables.overlap.chi_4@2\"?"));
  EXPECT_THAT(at("overlap.chi_4"), HasSubstr("did you mean \"observables.overlap.chi_4@lag\"?"));
}

TEST_F(SweepReader, AColumnThatBeginsAsAnotherIsThatOne) {
  EXPECT_THAT(files_.refusal(scene_line + "table = [\"observables.intermediate_scattering.F_s@0.3\"]\n[set]\nrun.time = 4.0\n"
                                          "observe = { intermediate_scattering = true }\n"),
              HasSubstr("did you mean \"observables.intermediate_scattering.F_self@0.3\"?"));
}

TEST_F(SweepReader, ColumnsOfSeveralWaveNumbersAreForetold) {
  const auto at = [&](const std::string& name) {
    return files_.refusal(scene_line + "table = [\"observables.intermediate_scattering." + name +
                          "\"]\n[set]\nrun.time = 4.0\nobserve = { intermediate_scattering = { k = [3.5, 10.0] } }\n");
  };
  for (const char* right : {"F_3.5@0.3", "F_self_10@0.3", "F_self_3.5_error@0.3", "relaxation_time_10", "k_3.5"})
    EXPECT_EQ(at(right), "") << right;
  EXPECT_THAT(at("F_self_10.0@0.3"), HasSubstr("no run has that number"));
  EXPECT_THAT(at("F_self@0.3"), HasSubstr("did you mean \"observables.intermediate_scattering.F_self_3.5@0.3\"?"));
}

TEST_F(SweepReader, ASceneIsToldFromASweep) {
  EXPECT_THAT(files_.refusal(fifty_disks), HasSubstr("this is a scene: carom run runs it"));
}

/// The names of a run that has been made.
std::vector<std::string> names_in_summary(const Scene& scene) {
  const TemporaryDirectory directory;
  const RunReport report = record(scene, directory.path() / "run");
  std::vector<std::string> names;
  const auto summary = nlohmann::ordered_json::parse(summary_json(report, {}));
  for (const SummaryNumber& number : numbers_of(summary)) names.push_back(number.name);
  return names;
}

TEST(ScenesSweepNumbers, AreForetoldForEveryEffectAndObservable) {
  const std::vector<std::vector<std::string>> bases = {
      {},
      {"box.boundary=walls", "gravity.acceleration=[0.0,-0.1]", "walls.left.temperature=1.0"},
      {"box.boundary=walls", "walls.top.mass=10.0", "walls.top.load=1.0", "walls.right.restitution=0.9"},
      {"collision.restitution=0.9", "collision.roughness=0.1", "run.accept_overlap=true"},
      {"collision.rule=reversal", "obstacles=[{ segment = { from = [0.0, 0.0], to = [0.1, 0.0] } }]", "disks.0.positions=random"},
      {"growth.rate=0.001"},
      {"observe.intermediate_scattering.k=[3.5, 10.0]"},
      {"thermostat.temperature=1.0", "thermostat.rate=1.0"},
      {"shear.rate=0.1"},
      {"square_well.width=1.1", "square_well.depth=0.1"},
      {"disks=[{ name = \"small\", count = 6, radius = 0.1, mass = 1.0, positions = \"random\", velocities = \"rest\" }, "
       "{ count = 6, radius = 0.3, mass = 2.0, positions = \"random\", velocities = { temperature = 1.0 } }]"}};
  std::size_t observed = 0;
  for (const auto& base : bases)
    for (const char* time : {"run.time=0.0", "run.time=0.02"}) {
      std::vector<std::string> changes = base;
      if (changes.empty() || !changes.front().starts_with("disks=")) changes.emplace_back("disks.0.count=12");
      changes.emplace_back(time);
      for (const detail::KnownObservable& known : detail::known_observables) {
        changes.push_back(fmt::format("observe.{}=true", known.name));
        try {
          (void)number_names(parse_scene(fifty_disks, "gas.toml", changes));
          ++observed;
        } catch (const SceneError&) {  // it has no meaning there
          changes.pop_back();
        }
      }
      const Scene scene = parse_scene(fifty_disks, "gas.toml", changes);
      std::vector<std::string> names = number_names(scene);
      std::erase_if(names, [](const std::string& name) { return name.find('@') != std::string::npos; });
      EXPECT_EQ(names, names_in_summary(scene)) << fmt::format("{}", fmt::join(changes, " "));
    }
  EXPECT_GT(observed, 200U);
}

}  // namespace
}  // namespace carom::test
