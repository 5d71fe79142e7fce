// What the reader of files refuses, every way to make a simulation refuses in the same words: each case is a change of a file and
// the same change of a Scene.

#include "simulation/refused_cases.hpp"
#include "support/refusal.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace carom::test {
namespace {

using testing::HasSubstr;

TEST_P(FileAndProgramChecks, RefuseTheSameInTheSameWords) {
  const RefusedCase& one = GetParam();
  const std::string text = base_text(one.boundary);
  Scene scene = parse_scene(text);
  ASSERT_NO_THROW(check(scene));
  std::ostringstream saved;
  make_simulation(scene).save(saved);
  const State start = make_simulation(scene).state();

  std::string sentence, with_place;
  try {
    (void)parse_scene(text, "file", one.overrides);
    FAIL() << "the reader accepts it";
  } catch (const SceneError& error) {
    sentence = error.sentence(), with_place = error.what();
  }
  EXPECT_THAT(with_place, HasSubstr(": " + sentence));

  one.change(scene);
  EXPECT_EQ(refusal<SceneError>([&] { check(scene); }), sentence);
  EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene); }), sentence);
  EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene, start); }), sentence);
  EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene, FixedStep{"guarded", 0.01}); }), sentence);
  EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene, start, FixedStep{"guarded", 0.01}); }), sentence);
  std::istringstream back(saved.str());
  EXPECT_EQ(refusal<SceneError>([&] { (void)restore_simulation(scene, back); }), sentence);
}

}  // namespace
}  // namespace carom::test
