// carom check and carom init: a scene is looked at without being run, and every preset is a right scene.

#include "support/child_process.hpp"

#include "scene/presets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

namespace fs = std::filesystem;

TEST(CheckCommand, SaysWhatWillBeSimulatedAndWritesNothing) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_carom(directory.path(), {"check", CAROM_SOURCE_DIR "/docs/scenes/box.toml"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("[-1, 1] x [-1, 1]"), HasSubstr("reversal"), HasSubstr("5,001 frames"), HasSubstr("engine")));
  EXPECT_TRUE(fs::is_empty(directory.path()));
}

TEST(CheckCommand, ListsWhatWillBeMeasured) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_carom(directory.path(), {"check", CAROM_SOURCE_DIR "/docs/scenes/gas.toml", "--set",
                                                       "observe.viscosity=true", "--set", "observe.pressure={ every = 0.5 }"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("observables pressure every 0.5, viscosity\n"), HasSubstr("tables of observables")));
}

TEST(CheckCommand, DescribesEachEffectAndNamesTheAbsent) {
  const TemporaryDirectory directory;
  const Outcome plain = run_carom(directory.path(), {"check", CAROM_SOURCE_DIR "/docs/scenes/box.toml"});
  EXPECT_THAT(plain.out, AllOf(HasSubstr("hard walls on all sides"),
                               HasSubstr("\nNot simulated: inelastic collisions, rough disks with spin, gravity, ")));
  const Outcome outcome = run_carom(
      directory.path(), {"check", CAROM_SOURCE_DIR "/docs/scenes/box.toml", "--set", "gravity.acceleration=[0.0, -1.0]", "--set",
                         "walls={ left = { temperature = 2.0 }, top = { restitution = 0.8 } }", "--set",
                         "obstacles=[{ disk = { centre = [0.0, 0.0], radius = 0.1 } }]", "--set", "collision.restitution=0.9"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("; restitution 0.9\n"), HasSubstr("  gravity     acceleration (0, -1)\n"),
                    HasSubstr("  wall        left: thermal, kT = 2\n"), HasSubstr("  wall        top: restitution 0.8\n"),
                    HasSubstr("  obstacles   1 fixed disk\n"),
                    HasSubstr("\nNot simulated: rough disks with spin, growing disks, a thermostat, run-and-tumble motion, "
                              "Brownian motion, shear, square wells, stepped potentials, drag, non-additive "
                              "diameters.\n")));
}

TEST(CheckCommand, SaysWhichEngineRunsTheSceneAndWhyAndHowMuchMemoryItTakes) {
  const TemporaryDirectory directory;
  const std::string box = CAROM_SOURCE_DIR "/docs/scenes/box.toml";
  EXPECT_THAT(
      run_carom(directory.path(), {"check", box}).out,
      ContainsRegex(
          "\n  engine      fast: nothing but the collision rule and hard walls acts; [0-9.]+ kB of memory, [0-9]+ bytes per "
          "disk\n"));
  EXPECT_THAT(run_carom(directory.path(), {"check", box, "--set", "gravity.acceleration=[0.0, -1.0]"}).out,
              HasSubstr("\n  engine      general: the scene asks for gravity; "));
  EXPECT_THAT(run_carom(directory.path(), {"check", box, "--engine", "textbook"}).out,
              HasSubstr("\n  engine      textbook: it was asked for; "));
  EXPECT_THAT(run_carom(directory.path(), {"check", box, "--set", "disks=[]"}).out,
              AllOf(ContainsRegex(" kB of memory\n"), Not(HasSubstr("per disk"))));
}

TEST(CheckCommand, SaysWhatTheRunWillCost) {
  const TemporaryDirectory directory;
  const std::string gas = CAROM_SOURCE_DIR "/docs/scenes/gas.toml";
  const auto cost = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"check", gas});
    const Outcome outcome = run_carom(directory.path(), more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  // Nothing is so fast that it would come to the end of these in a fifth of a second, nor so slow that it would in none.
  EXPECT_THAT(cost({"--set", "run.time=1e6"}),
              ContainsRegex("\n  cost        about .* on this machine for [0-9.e+]+ million collisions by kinetic theory \\(a "
                            "trial run of [0-9.]+ m?s: .* collisions per second\\)\n"));
  EXPECT_THAT(cost({"--set", "run.time=1e7"}),
              ContainsRegex("\n  cost        about .* on this machine for [0-9.]+ billion collisions by"));
  EXPECT_THAT(cost({"--set", "run.time=1e12"}),
              ContainsRegex("\n  cost        about .* on this machine for [0-9.]+e\\+14 collisions by"));
  EXPECT_THAT(cost({"--set", "run.time=1e6", "--set", "collision.restitution=0.9999"}),
              ContainsRegex("\n  cost        about .* on this machine for .* million collisions \\("));
  const std::string observed = cost({"--set", "run.time=1e6", "--set", "observe={ temperature = true, pressure = true }"});
  EXPECT_THAT(observed, ContainsRegex("\n  cost        about .* with 2 observables on this machine for .* million collisions"));
  EXPECT_THAT(cost({"--set", "run.time=0.01", "--set", "observe={ hexatic = true }"}),
              ContainsRegex("\n  cost        .* with 1 observable on this machine for .* collisions"));
  EXPECT_THAT(cost({"--set", "run.time=1e-9", "--set", "run.sample_every=1e-9", "--set", "run.equilibrate={ time = 0.0 }"}),
              HasSubstr(" on this machine for 0 collisions (a trial run reached the end)\n"));
  const std::string changed = cost({"--set", "run.time=1e-3", "--set", "run.equilibrate={ time = 0.0 }", "--set",
                                    "changes=[{time=1e-4, scale_velocities=2.0}]"});
  EXPECT_THAT(changed, HasSubstr("(a trial run without the scene's changes reached the end)\n"));
  EXPECT_THAT(changed, HasSubstr(", until a change asks for more; "));
  EXPECT_TRUE(fs::is_empty(directory.path()));
}

TEST(CheckCommand, TakesScenesThatEquilibrateByCollisionsAndEndAtATime) {
  const TemporaryDirectory directory;
  write_text(directory.path() / "gas.toml",
             "[box]\nx = [0.0, 20.0]\ny = [0.0, 20.0]\nboundary = \"walls\"\n"
             "[[disks]]\ncount = 100\nradius = 0.5\nmass = 1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n"
             "[collision]\nrule = \"specular\"\n[run]\ntime = 20.0\nequilibrate = { collisions_per_disk = 20 }\n");
  for (const char* effect : {"thermostat={ temperature = 1.0, rate = 10.0 }", "walls.right={ velocity = -0.05 }"}) {
    const Outcome outcome = run_carom(directory.path(), {"check", "gas.toml", "--set", effect});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, ContainsRegex("\n  cost        about .* on this machine for [0-9,]+ collisions \\(a trial run"));
  }
}

TEST(CheckCommand, SaysWhatIsConservedBetweenChanges) {
  const TemporaryDirectory directory;
  const auto checked = [&](const std::string& change) {
    write_text(directory.path() / "gas.toml",
               "[box]\nx = [0.0, 8.0]\ny = [0.0, 8.0]\nboundary = \"periodic\"\n"
               "[[disks]]\ncount = 5\nradius = 0.4\nmass = 1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n"
               "[collision]\nrule = \"specular\"\n[run]\ntime = 2.0\n" +
                   change);
    return run_carom(directory.path(), {"check", "gas.toml"}).out;
  };
  EXPECT_THAT(checked(""), HasSubstr("\n  conserved   energy, momentum, angular momentum"));
  EXPECT_THAT(checked("[[changes]]\ntime = 1.0\nscale_velocities = 0.5\n"),
              HasSubstr("\n  conserved   between changes: energy, momentum, angular momentum"));
  EXPECT_THAT(checked("[[changes]]\ntime = 1.0\nset = [\"thermostat={ temperature = 1, rate = 1 }\"]\n"),
              HasSubstr("\n  conserved   nothing\n"));
}

TEST(CheckCommand, WarnsOfDisksThatComeToRestOnAnElasticFloor) {
  const TemporaryDirectory directory;
  write_text(directory.path() / "heap.toml",
             "[box]\nx = [0.0, 8.0]\ny = [0.0, 16.0]\nboundary = \"walls\"\n"
             "[[disks]]\ncount = 20\nradius = 0.4\nmass = 1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n"
             "[collision]\nrule = \"specular\"\nrestitution = 0.6\n[gravity]\nacceleration = [0.0, -1.0]\n"
             "[walls]\nbottom = { vibration = { form = \"sine\", amplitude = 0.01, frequency = 0.5 } }\n[run]\ntime = 1e4\n");
  const auto cost = [&](const char* change) {
    const std::string out = run_carom(directory.path(), {"check", "heap.toml", "--set", change}).out;
    return out.substr(out.find("\n  cost "));
  };
  // The heap lies after some thousand collisions, and then has a million in a unit of time.
  const char* warned =
      "^\n  cost        (at least .*|unknown) \\(.*; by time [0-9.]+ disks collide at ever shorter intervals, as where they "
      "come to rest: give collision.elastic_below";
  EXPECT_THAT(cost("walls.bottom.vibration.amplitude=0.01"), ContainsRegex(warned));
  EXPECT_THAT(cost("walls.bottom.vibration.amplitude=0"), ContainsRegex(warned));
  EXPECT_THAT(cost("collision.elastic_below.time=1e-3"), Not(HasSubstr("shorter intervals")));
  EXPECT_THAT(cost("collision.restitution=1"), Not(HasSubstr("shorter intervals")));
  // On an inelastic floor the trial sees that they collapse, or that they are about to.
  EXPECT_THAT(cost("walls.bottom.restitution=0.6"),
              ContainsRegex("^\n  cost        (unknown: collapsed by time |(at least .*|unknown) \\(.*; by time [0-9.]+ disks "
                            "collide at ever shorter)"));
}

TEST(CheckCommand, ResolvedSceneResolvesToItself) {
  const TemporaryDirectory directory;
  const Outcome once = run_carom(directory.path(), {"check", CAROM_SOURCE_DIR "/docs/scenes/box.toml", "--resolved"});
  ASSERT_EQ(once.exit_code, 0);
  EXPECT_THAT(once.out, AllOf(HasSubstr("seed"), HasSubstr("unwrapped")));
  write_text(directory.path() / "resolved.toml", once.out);
  EXPECT_EQ(run_carom(directory.path(), {"check", "resolved.toml", "--resolved"}).out, once.out);
}

TEST(CheckCommand, OverlapInAListedStartIsNamed) {
  const TemporaryDirectory directory;
  ASSERT_EQ(run_carom(directory.path(), {"init", "-o", "scene.toml"}).exit_code, 0);
  const Outcome outcome =
      run_carom(directory.path(), {"check", "scene.toml", "--set", "disks.0.count=2", "--set", "disks.0.radius=0.25", "--set",
                                   "disks.0.positions=[[0.0, 0.0], [0.25, 0.0]]"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, AllOf(StartsWith("carom: "), HasSubstr("overlap")));
}

TEST(InitCommand, WritesTheBoxByDefault) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_carom(directory.path(), {"init"}).exit_code, 0);
  EXPECT_EQ(text_of(directory.path() / "box.toml"), text_of(CAROM_SOURCE_DIR "/docs/scenes/box.toml"));
}

TEST(InitCommand, NeverReplacesAFileUnasked) {
  const TemporaryDirectory directory;
  write_text(directory.path() / "box.toml", "mine");
  const Outcome refused = run_carom(directory.path(), {"init"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(StartsWith("carom: box.toml: "), HasSubstr("--force")));
  EXPECT_EQ(text_of(directory.path() / "box.toml"), "mine");
  EXPECT_EQ(run_carom(directory.path(), {"init", "--force"}).exit_code, 0);
  EXPECT_NE(text_of(directory.path() / "box.toml"), "mine");
  EXPECT_EQ(run_carom(directory.path(), {"init", "--force", "-o", "/dev/null"}).exit_code, 2);
}

TEST(InitCommand, EveryPresetIsListedAndPassesCheck) {
  const TemporaryDirectory directory;
  const std::string listed = run_carom(directory.path(), {"init", "--list"}).out;
  ASSERT_FALSE(preset_names().empty());
  for (const std::string& name : preset_names()) {
    EXPECT_THAT(listed, HasSubstr(name));
    ASSERT_EQ(run_carom(directory.path(), {"init", name}).exit_code, 0);
    const Outcome outcome = run_carom(directory.path(), {"check", name + ".toml"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
}

}  // namespace
}  // namespace carom::test
