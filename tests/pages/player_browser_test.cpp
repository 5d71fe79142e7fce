// The player in a real browser: controls do what they say, disks are drawn where the engine has them, memory does not grow.

#include "pages/player_page.hpp"

#include "pages/visited_page.hpp"
#include "support/browser.hpp"
#include "support/child_process.hpp"
#include "support/recorded_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

const std::string watched_gas = R"(
title = "<b>Gas</b> & \"walls\""
[box]
x = [0.0, 10.0]
y = [-4.0, 4.0]
boundary = { x = "periodic", y = "walls" }
[[disks]]
count = 40
radius = 0.3
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[run]
time = 12.0
sample_every = 0.5
seed = 5
[output]
events = true
)";

/// The player of a scene, after `script` ran behind its own.
Visit played(const Scene& scene, const std::string& script, int seconds = 5) {
  const TemporaryDirectory directory;
  record(scene, directory.path() / "run");
  return visit_with(player_page(player_data(RunReader(directory.path() / "run"))), script, seconds);
}

std::vector<double> five_random_instants(double until) {
  std::mt19937 random(20);  // NOLINT: the same instants every time
  std::vector<double> times;
  for (int k = 0; k < 5; ++k) times.push_back(until * static_cast<double>(random()) / 4294967296.0);
  std::sort(times.begin(), times.end());
  return times;
}

void expect_positions_of_the_engine(const Scene& scene, double until) {
  const Visit visit =
      played(scene, states_at(make_simulation(scene), five_random_instants(until)) + script("player_pictures.js"));
  expect_clean(visit);
  EXPECT_EQ(data(visit, "apart"), "less than a hundredth of a pixel");
  EXPECT_EQ(data(visit, "wrong"), "none");
  EXPECT_GT(data(visit, "compared").size(), 5U);  // a million or so
}

TEST(BrowserPlayer, EveryControlDoesWhatItSays) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Visit visit = played(parse_scene(watched_gas), script("page_checks.js") + script("player_cells.js") +
                                                           script("run_player_checks.js") + script("player_controls.js"));
  expect_clean(visit);
  EXPECT_EQ(data(visit, "failures"), "");
  EXPECT_GT(std::stoi(data(visit, "checks")), 100);
  EXPECT_THAT(visit.dom, HasSubstr("<h1 id=\"title\">&lt;b&gt;Gas&lt;/b&gt; &amp; \"walls\"</h1>"));
  EXPECT_THAT(visit.dom, HasSubstr(">exact</span>"));
}

TEST(BrowserPlayer, DrawsDisksWhereTheEngineHasThemAtFiveRandomInstants) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  expect_positions_of_the_engine(parse_scene(watched_gas), 12.0);
}

TEST(BrowserPlayer, DrawsFallingDisksWhereTheEngineHasThem) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Scene scene = parse_scene(watched_gas, "gas", {"gravity.acceleration=[0.0, -1.5]"});
  expect_positions_of_the_engine(scene, 12.0);
}

TEST(BrowserPlayer, DrawsAPistonAndItsGasWhereTheEngineHasThem) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  expect_positions_of_the_engine(parse_scene(watched_gas, "gas", {"walls.top.mass=10.0", "walls.top.load=1.0"}), 12.0);
}

TEST(BrowserPlayer, DrawsGrowingDisksAsLargeAsTheEngineHasThem) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  expect_positions_of_the_engine(parse_scene(watched_gas, "gas", {"growth.rate=0.03"}), 12.0);
}

TEST(BrowserPlayer, ADiskCrossesTheEdgesOfAShearedBoxWhereItShould) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Scene scene = parse_scene(watched_gas, "gas",
                                  {"box.boundary=periodic", "disks.0.count=1", "disks.0.positions=[[5.0, 0.0]]",
                                   "disks.0.velocities=[[3.0, 2.5]]", "shear.rate=0.3"});
  // Its velocity changes at an edge by as much as the images beyond move, so that lines from sample to sample are its path.
  // Places of samples are rounded by half of a 65535th of what the disk visits: at most the box.
  const Visit visit = played(scene, states_at(make_simulation(scene), {0.7, 1.7, 4.9, 5.1, 8.3, 11.6}) + R"(
    let apart = 0;
    for (const { time, positions } of expected) {
      carom.seek(time);
      const dx = carom.moment.x[0] - positions[0][0];
      const dy = carom.moment.y[0] - positions[0][1];
      apart = Math.max(apart, Math.abs(dx - 10 * Math.round(dx / 10)), Math.abs(dy - 8 * Math.round(dy / 8)));
    }
    document.documentElement.dataset.apart = apart < 0.5 * 10 / 65535 + 1e-9 ? "rounding" : String(apart);
)");
  EXPECT_EQ(data(visit, "apart"), "rounding");
}

/// Disks in a box, which is all that it says.
Scene disks_in(const std::string& box, const std::string& more, int count = 40) {
  return parse_scene(
      "[box]\n" + box + "\n[[disks]]\ncount = " + std::to_string(count) +
      "\nradius = 0.3\nmass = 1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n"
      "[collision]\nrule = \"specular\"\n[run]\ntime = 8.0\nsample_every = 0.25\nseed = 5\n[output]\nevents = true\n" +
      more);
}

TEST(BrowserPlayer, FindsTheCellsOfPeriodicShearedAndCircularBoxes) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const std::string periodic = "x = [0.0, 10.0]\ny = [-4.0, 4.0]\nboundary = \"periodic\"";
  const std::string flat = "x = [0.0, 30.0]\ny = [0.0, 2.5]\nboundary = \"periodic\"";
  for (const Scene& scene : {disks_in(periodic, ""), disks_in(periodic, "[shear]\nrate = 0.3\n"),
                             disks_in("circle = { centre = [1.0, 2.0], radius = 4.5 }", ""), disks_in(flat, "", 3),
                             disks_in(flat, "[shear]\nrate = 0.3\n", 3)}) {
    const Visit visit = played(scene, script("page_checks.js") + script("player_cells.js") + "noteChecks();\n");
    expect_clean(visit);
    EXPECT_EQ(data(visit, "failures"), "");
  }
}

TEST(BrowserPlayer, ImagesOfAShearedBoxFillTheView) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Scene scene = disks_in("x = [0.0, 10.0]\ny = [-4.0, 4.0]\nboundary = \"periodic\"", "[shear]\nrate = 0.3\n");
  const Visit visit = played(scene, R"(
    carom.seek(3.3);
    zoom(0.3);
    const shifts = visibleShifts(true, moment);
    const lengths = box.lengths;
    // Of a place in box lengths from the lower left corner.
    const isInside = (shares) => shares.every((share) => share >= -1e-9 && share <= 1 + 1e-9);
    let [seen, holes] = [0, 0];
    for (let px = 0; px <= view.width; px += 10)
      for (let py = 0; py <= view.height; py += 10) {
        const [x, y] = [(placeX(px) - box.lower[0]) / lengths[0], (placeY(py) - box.lower[1]) / lengths[1]];
        if (Math.abs(x - 0.5) > 4.5 || Math.abs(y - 0.5) > 4.5) continue;  // farther than four boxes away
        ++seen;
        if (!shifts.some(([a, b]) => isInside([x - a - (b * moment.displacement) / lengths[0], y - b]))) ++holes;
      }
    document.documentElement.dataset.displacement = moment.displacement;
    document.documentElement.dataset.seen = seen;
    document.documentElement.dataset.holes = holes;
)");
  expect_clean(visit);
  EXPECT_GT(std::stod(data(visit, "displacement")), 1.0);
  EXPECT_GT(std::stoi(data(visit, "seen")), 1000);
  EXPECT_EQ(data(visit, "holes"), "0");
}

TEST(BrowserPlayer, ShowsAllOfTheBoxWhileAWallVibrates) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  // The 65 moments that the player looks at are half a period apart, and the wall is in the middle of its way at each.
  const Scene scene = disks_in("x = [0.0, 10.0]\ny = [-4.0, 4.0]\nboundary = \"walls\"",
                               "[walls]\nbottom = { vibration = { form = \"sine\", amplitude = 0.5, frequency = 4.0 } }\n");
  const Visit visit = played(scene, "document.documentElement.dataset.extent = extent.join();\n");
  expect_clean(visit);
  EXPECT_EQ(data(visit, "extent"), "0,10,-4.5,4");
}

TEST(BrowserPlayer, DrawsDisksFromSamplesAtTheirInstantsAndSaysSo) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Scene scene = parse_scene(watched_gas, "gas", {"thermostat.temperature=1.0", "thermostat.rate=1.0"});
  const Visit visit = played(scene, states_at(make_simulation(scene), {6.5}) + script("player_pictures.js"));
  expect_clean(visit);
  EXPECT_EQ(data(visit, "apart"), "less than a hundredth of a pixel");
  EXPECT_EQ(data(visit, "wrong"), "none");
  EXPECT_THAT(visit.dom, HasSubstr(">interpolated</span>"));
  EXPECT_THAT(visit.dom, HasSubstr("because the thermostat changes velocities between collisions"));
}

TEST(SlowBrowserPlayer, MemoryDoesNotGrowOverAThousandLoops) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Visit visit = played(parse_scene(watched_gas), script("player_loops.js"), 300);
  expect_clean(visit);
  // Each of 3000 frames leaves behind an object of 16 bytes or more where it leaves one, and each loop a list of six numbers: 48
  // kB.
  EXPECT_LT(std::stol(data(visit, "leaked")), 48000);
  EXPECT_GE(std::stol(data(visit, "drawn")), 2000);
}

}  // namespace
}  // namespace carom::test
