// The page of two flights in a real browser: controls, places of both sides to a pixel, overlaps where there are some and nowhere
// else.

#include "studies/compare/side_by_side_page.hpp"

#include "pages/visited_page.hpp"
#include "support/browser.hpp"
#include "support/child_process.hpp"

#include <carom/scene.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

const std::string flown_gas = R"(
title = "Two flights"
[box]
x = [0.0, 10.0]
y = [-4.0, 4.0]
boundary = { x = "periodic", y = "walls" }
[[disks]]
count = 30
radius = 0.35
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[run]
time = 4.0
seed = 5
)";

SideBySide flown_in_steps(const Scene& scene, const std::string& method) {
  return fly_side_by_side(scene, make_simulation(scene).state(),
                          {.step = {method, 0.05}, .until = 4.0, .free_time = 0.6, .sigma = 0.7});
}

Visit played(const Scene& scene, const SideBySide& shown, const std::string& script) {
  const Lyapunov lyapunov{2.0, 0.1, 1.0, 0.05, 2.0, 1000};
  return visit_with(side_by_side_page(shown, scene, lyapunov, "in a test"), script);
}

/// Random ones at which no disks overlap, whose rings would be drawn over them.
std::vector<double> instants_without_overlaps(const SideBySide& shown) {
  std::mt19937 random(20);  // NOLINT: the same instants every time
  std::vector<double> times;
  while (times.size() < 5) {
    const double time = shown.until * static_cast<double>(random()) / 4294967296.0;
    const auto covers = [&](const Overlap& one) { return one.begin <= time && time <= one.end; };
    if (std::none_of(shown.overlaps.begin(), shown.overlaps.end(), covers)) times.push_back(time);
  }
  std::sort(times.begin(), times.end());
  return times;
}

void expect_places(const Visit& visit) {
  expect_clean(visit);
  EXPECT_EQ(data(visit, "apart"), "less than a hundredth of a pixel");
  EXPECT_EQ(data(visit, "wrong"), "none");
  EXPECT_GT(data(visit, "compared").size(), 5U);  // a hundred thousand pixels and more
}

TEST(BrowserSideBySide, EveryControlDoesWhatItSaysAndOverlapsFlashWhereThereAreSome) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Scene scene = parse_scene(flown_gas);
  const SideBySide shown = flown_in_steps(scene, "guarded");
  const Visit visit =
      played(scene, shown, script("page_checks.js") + script("side_by_side_checks.js") + script("player_controls.js"));
  expect_clean(visit);
  EXPECT_EQ(data(visit, "failures"), "");
  EXPECT_GT(std::stoi(data(visit, "checks")), 200);
  EXPECT_THAT(visit.dom, HasSubstr("<h1 id=\"title\">Two flights</h1>"));
}

TEST(BrowserSideBySide, DrawsTheExactSideWhereTheEngineHasIt) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Scene scene = parse_scene(flown_gas);
  const SideBySide shown = flown_in_steps(scene, "guarded");
  expect_places(
      played(scene, shown, states_at(make_simulation(scene), {0.0, 0.71, 1.9, 2.33, 3.99}) + script("player_pictures.js")));
}

TEST(BrowserSideBySide, DrawsTheOtherSideWhereTheMethodHasIt) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Scene scene = parse_scene(flown_gas);
  for (const char* const method : {"guarded", "naive-edge"}) {
    SCOPED_TRACE(method);
    const SideBySide shown = flown_in_steps(scene, method);
    expect_places(played(scene, shown,
                         states_at(make_simulation(scene, FixedStep{method, 0.05}), instants_without_overlaps(shown)) +
                             "window.shown = { canvas: document.getElementById(\"steps\"), moment: carom.stepsMoment };\n" +
                             script("player_pictures.js")));
  }
}

}  // namespace
}  // namespace carom::test
