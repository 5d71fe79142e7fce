// Which word the user meant.

#include "scene/known_keys.hpp"

#include <gtest/gtest.h>

#include <array>

namespace carom::detail {
namespace {

TEST(KnownKeys, DistanceCountsEditsAndSwapsAsOne) {
  EXPECT_EQ(edit_distance("radius", "radius"), 0U);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1U);
  EXPECT_EQ(edit_distance("Radius", "radius"), 0U);
  EXPECT_EQ(edit_distance("radis", "radius"), 1U);
  EXPECT_EQ(edit_distance("", "mass"), 4U);
  EXPECT_EQ(edit_distance("time", "mass"), 4U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(KnownKeys, NearestIsEmptyWhereNothingIsNear) {
  constexpr std::array<std::string_view, 3> words = {"time", "seed", "sample_every"};
  EXPECT_EQ(nearest_word("tme", words), "time");
  EXPECT_EQ(nearest_word("sample_evry", words), "sample_every");
  EXPECT_EQ(nearest_word("sampleevery", words), "sample_every");
  EXPECT_EQ(nearest_word("x", words), "");
  EXPECT_EQ(nearest_word("viscosity", words), "");
  EXPECT_EQ(nearest_word(std::string(1'000'000, 't'), words), "");
}

TEST(KnownKeys, ASlipIsNotTakenForAKeyOfAnotherTable) {
  constexpr std::array<std::string_view, 2> tables = {"disks", "obstacles"};
  EXPECT_EQ(unknown_key_sentence("disk", "", tables), "the scene has no key \"disk\"; did you mean \"disks\"?");
  EXPECT_EQ(unknown_key_sentence("disk", "box", {}), "[box] has no key \"disk\"; it belongs to [[obstacles]]");
}

TEST(KnownKeys, WordsOfTimeSteppersLeadToOurs) {
  const auto leads = [](std::string_view word, std::string_view key) {
    const std::string sentence = unknown_key_sentence(word, "run", std::array<std::string_view, 2>{"time", "seed"});
    EXPECT_NE(sentence.find(key), std::string::npos) << sentence;
  };
  for (const char* word : {"dt", "timestep", "time_step", "Delta_t", "h"}) leads(word, "sample_every");
  for (const char* word : {"steps", "nsteps", "N_steps", "num-steps", "iterations", "t_max"}) leads(word, "time or collisions");
  for (const char* word : {"N", "n", "num", "n_particles", "numParticles"}) leads(word, "count");
  for (const char* word : {"T", "temp", "kT", "temperature"}) leads(word, "velocities = {");
  for (const char* word : {"L", "box_size", "Lx", "width"}) leads(word, "[box]");
  for (const char* word : {"R", "diameter", "sigma"}) leads(word, "radius");
  leads("viscosity", "[observe]");
  leads("density", "packing_fraction");
  EXPECT_EQ(unknown_key_sentence("r", "obstacles.0.disk", std::array<std::string_view, 2>{"centre", "radius"}),
            "obstacles.0.disk has no key \"r\"; its keys are centre, radius");
}

TEST(KnownKeys, APartOfAnObstacleLeadsToTheShapeThatHasIt) {
  constexpr std::array<std::string_view, 3> shapes = {"disk", "segment", "arc"};
  for (const std::string key : {"centre", "radius"})
    EXPECT_EQ(unknown_key_sentence(key, "obstacles.0", shapes),
              "[[obstacles]] has no key \"" + key +
                  "\"; it belongs to a shape in it, such as disk = { centre = [0.0, 0.0], radius = 0.3 }");
  EXPECT_EQ(
      unknown_key_sentence("to", "obstacles.0", shapes),
      "[[obstacles]] has no key \"to\"; it belongs to a shape in it, such as segment = { from = [0.0, -1.0], to = [0.0, -0.1] }");
}

TEST(KnownKeys, TablesAreNamedAsTheyAreWritten) {
  EXPECT_EQ(table_title("walls"), "[walls]");
  EXPECT_EQ(table_title("obstacles.3"), "[[obstacles]]");
  EXPECT_EQ(table_title("obstacles.3.disk"), "obstacles.3.disk");
  EXPECT_EQ(table_title("walls.left"), "walls.left");
}

}  // namespace
}  // namespace carom::detail
