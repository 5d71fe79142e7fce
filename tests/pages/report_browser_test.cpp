// The page of a run in a real browser: every plot is drawn, the player in it plays, nothing goes wrong in either.

#include "pages/report_page.hpp"

#include "pages/visited_page.hpp"
#include "support/browser.hpp"
#include "support/child_process.hpp"
#include "support/recorded_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace carom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string reported_gas = R"(
title = "</script><b>A gas</b>"
[box]
x = [0.0, 10.0]
y = [0.0, 8.0]
boundary = "periodic"
[[disks]]
count = 30
radius = 0.4
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[run]
time = 20.0
sample_every = 0.5
[output]
events = true
[observe]
pressure = true
free_flight = true
speeds = { bins = 30 }
radial_distribution = { range = 3.0, bins = 30 }
fields = { cells = [4, 4] }
viscosity = true
)";

/// The page after `script` ran, seconds after its own.
Visit visited(const std::vector<std::string>& overrides, const std::string& script, Screen screen = Screen::light) {
  const TemporaryDirectory directory;
  record(parse_scene(reported_gas, "gas.toml", overrides), directory.path() / "run");
  std::string html = report_of(directory.path() / "run").html;
  html.insert(html.rfind("</body>"),
              "<script>addEventListener('load', () => setTimeout(async () => {\n"
              "const root = document.documentElement.dataset;\n"
              "const frame = document.querySelector('iframe');\n" +
                  script + "}, 2000))</script>\n");
  write_text(directory.path() / "report.html", html);
  return visit(directory.path() / "report.html", screen);
}

TEST(BrowserReport, DrawsEveryPlotAndPlaysTheRun) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  for (const Screen screen : {Screen::light, Screen::dark}) {
    const Visit visit = visited({},
                                "const { carom } = frame.contentWindow;\n"
                                "root.exact = carom.description.exact;\n"
                                "root.inside = frame.contentDocument.documentElement.dataset.errors;\n"
                                "root.before = carom.moment.time;\n"
                                "carom.change({ isPlaying: true });\n"
                                "carom.frame(0.5);\n"
                                "root.moved = carom.moment.time > 0;\n"
                                "root.wide = frame.clientWidth > 700 && frame.clientHeight > 400;\n"
                                "const last = frame.contentDocument.getElementById('keys').getBoundingClientRect();\n"
                                "root.fits = last.right <= frame.clientWidth;\n",
                                screen);
    EXPECT_THAT(visit.console, IsEmpty());
    EXPECT_EQ(data(visit, "errors"), "");
    // Energy, Z, two of flights, two of speeds, g(r), two of viscosity.
    EXPECT_EQ(data(visit, "plots"), "9");
    EXPECT_EQ(data(visit, "exact"), "true");
    EXPECT_EQ(data(visit, "inside"), "");
    EXPECT_EQ(data(visit, "before"), "0");
    EXPECT_EQ(data(visit, "moved"), "true");
    EXPECT_EQ(data(visit, "wide"), "true");
    EXPECT_EQ(data(visit, "fits"), "true") << "the last control of the player is within its frame";
    EXPECT_THAT(visit.dom, HasSubstr("<h1>&lt;/script&gt;&lt;b&gt;A gas&lt;/b&gt;</h1>"));
  }
}

TEST(BrowserReport, WhatGoesWrongInThePlayerIsSaidOnThePage) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Visit visit = visited({"output.events=false"},
                              "root.exact = frame.contentWindow.carom.description.exact;\n"
                              "const script = frame.contentDocument.createElement('script');\n"
                              "script.textContent = 'nonsense()';\n"
                              "frame.contentDocument.body.append(script);\n"
                              "await new Promise((done) => setTimeout(done, 100));\n");
  EXPECT_EQ(data(visit, "exact"), "false");
  EXPECT_THAT(data(visit, "errors"), HasSubstr("Replay of the run: Uncaught ReferenceError: nonsense is not defined"));
}

TEST(BrowserReport, TheMapsOfFieldsAreThoseOfAStretchWhereItsSliderStands) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Visit visit =
      visited({},
              "const maps = document.querySelector(\"iframe[title='Maps of the fields']\").contentDocument;\n"
              "const cells = () => [...maps.querySelectorAll('svg')].map((map) => [...map.querySelectorAll('path')]"
              ".map((path) => path.getAttribute('fill') + path.getAttribute('d') + path.textContent).join());\n"
              "const go = (to) => {\n"
              "  maps.getElementById('time').value = to;\n"
              "  maps.getElementById('time').dispatchEvent(new Event('input'));\n"
              "  return cells();\n"
              "};\n"
              "const average = cells(), captions = maps.body.textContent;\n"
              "const one = go(1), last = go(20);\n"
              "root.each = one.every((map, k) => map !== average[k] && map !== last[k]);\n"
              "root.stretch = maps.getElementById('stretch').textContent;\n"
              "root.back = go(0).join() === average.join() && maps.body.textContent === captions;\n"
              "maps.getElementById('play').click();\n"
              "await new Promise((done) => setTimeout(done, 1000));\n"
              "root.plays = Number(maps.getElementById('time').value) > 0;\n"
              "root.inside = maps.documentElement.dataset.errors;\n");
  EXPECT_THAT(visit.console, IsEmpty());
  EXPECT_EQ(data(visit, "errors"), "");
  EXPECT_EQ(data(visit, "inside"), "");
  EXPECT_EQ(data(visit, "each"), "true");
  EXPECT_EQ(data(visit, "back"), "true");
  EXPECT_EQ(data(visit, "plays"), "true");
  EXPECT_THAT(data(visit, "stretch"), testing::StartsWith("time 1"));
}

TEST(BrowserReport, ANarrowFrameIsAsHighAsAllOfThePlayer) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Visit visit = visited({},
                              "frame.style.width = '360px';\n"
                              "for (let k = 0; k < 3; ++k) window.dispatchEvent(new Event('resize'));\n"
                              "const { body } = frame.contentDocument;\n"
                              "root.scrolls = body.scrollHeight > frame.clientHeight;\n"
                              "const top = (selector) => body.querySelector(selector).getBoundingClientRect().top;\n"
                              "root.order = top('.stage') < top('footer') && top('footer') < top('aside');\n");
  EXPECT_EQ(data(visit, "errors"), "");
  EXPECT_EQ(data(visit, "scrolls"), "false");
  EXPECT_EQ(data(visit, "order"), "true");
}

}  // namespace
}  // namespace carom::test
