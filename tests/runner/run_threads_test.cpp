// How many threads a run gets, and why.

#include "runner/run_threads.hpp"

#include "support/refusal.hpp"
#include "support/systems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <carom/simulation.hpp>

#include <stdexcept>
#include <string>

namespace carom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Scene lattice(std::int64_t disks) { return gas_scene(disks, 0.4, Boundary::periodic); }

Scene with_drag() {
  Scene scene = lattice(100);
  scene.effects.drag = Drag{.rate = 0.1};
  return scene;
}

TEST(RunThreads, AreOneBelowTheSizeThatPays) {
  const SuggestedThreads small = suggested_threads(make_simulation(lattice(2'000)), 8, 8);
  EXPECT_EQ(small.threads, 1);
  EXPECT_EQ(small.words, "one core: 2,000 disks are fewer than the 50,000 from which on several cores pay");
  EXPECT_THAT(suggested_threads(make_simulation(lattice(1)), 8, 8).words, StartsWith("one core: 1 disk is fewer"));
}

TEST(RunThreads, AreOneForEachFreeProcessorOfALargeRun) {
  const Simulation large = make_simulation(lattice(50'000));
  EXPECT_EQ(suggested_threads(large, 6, 8).threads, 6);
  EXPECT_EQ(suggested_threads(large, 6, 8).words, "6 cores: 6 of 8 are free");
  EXPECT_EQ(suggested_threads(large, 64, 64).threads, 16);
  EXPECT_EQ(suggested_threads(large, 1, 8).threads, 1);
  EXPECT_EQ(suggested_threads(large, 1, 8).words, "one core: other programs keep the rest busy");
  EXPECT_EQ(suggested_threads(large, 1, 1).words, "one core: there is no other");
}

TEST(RunThreads, AreOneWhereASimulationCannotBeSharedOut) {
  const SuggestedThreads suggested = suggested_threads(make_simulation(with_drag()), 8, 8);
  EXPECT_EQ(suggested.threads, 1);
  EXPECT_THAT(suggested.words, StartsWith("one core: drag slows the clock"));
}

TEST(FreeProcessors, AreAtLeastOneAndAtMostAll) {
  EXPECT_GE(free_processors(), 1);
  EXPECT_LE(free_processors(), processors());
}

TEST(RunThreads, AreReadAsANumberOrAuto) {
  EXPECT_EQ(threads_in("auto"), std::nullopt);
  EXPECT_EQ(threads_in("1"), 1);
  EXPECT_EQ(threads_in("32"), 32);
  for (const char* wrong : {"0", "33", "-1", "2.5", "two", "", "4 ", "99999999999999999999"})
    EXPECT_THROW((void)threads_in(wrong), std::invalid_argument) << wrong;
}

TEST(RunThreads, ShareASimulationOutOrSayWhyNot) {
  Simulation gas = make_simulation(lattice(2'000));
  set_threads_of_run(gas, 3);
  EXPECT_EQ(gas.thread_counts().threads, 3U);
  set_threads_of_run(gas, {});
  EXPECT_EQ(gas.thread_counts().threads, 1U);
  EXPECT_THROW(set_threads_of_run(gas, 0), std::invalid_argument);
  Simulation dragged = make_simulation(with_drag());
  set_threads_of_run(dragged, 1);
  EXPECT_THAT(refusal<std::invalid_argument>([&] { set_threads_of_run(dragged, 2); }),
              HasSubstr("only one core can compute this run, for drag slows the clock"));
}

TEST(RunThreads, OfASceneWithObservablesMayBeTwoInAnyCase) {
  Scene scene = with_drag();
  scene.observe.push_back({.name = "pressure"});
  Simulation dragged = make_simulation(scene);
  set_threads_of_run(dragged, 2);
  EXPECT_EQ(dragged.thread_counts().threads, 1U);
  EXPECT_THROW(set_threads_of_run(dragged, 3), std::invalid_argument);
}

}  // namespace
}  // namespace carom::test
