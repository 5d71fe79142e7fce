// The page of two flights: what it says of them, and that it is one file of bounded size.

#include "studies/compare/side_by_side_page.hpp"

#include "support/comparisons.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SideBySide flown(const Scene& scene, double until = 1.0) {
  return fly_side_by_side(scene, make_simulation(scene).state(),
                          {.step = {"guarded", 0.02}, .until = until, .free_time = 0.4, .sigma = 1.0});
}

/// A matcher would print a page of a hundred kilobytes.
bool contains(const std::string& html, std::string_view words) { return html.find(words) != std::string::npos; }

TEST(SideBySidePage, IsOneFileThatSaysWhatItShowsAndFetchesNothing) {
  Scene scene = dozen_scene();
  scene.title = "<b>A dozen</b> & \"more\"";
  const std::string html = side_by_side_page(flown(scene), scene, std::nullopt, "carom compare dozen.toml --play");
  EXPECT_LT(html.find(side_by_side_mark), 512U);
  for (const char* const there :
       {"<title>&lt;b&gt;A dozen&lt;/b&gt; &amp; &quot;more&quot;</title>", "12 disks from one start",
        "in steps of 0.02 (0.05 mean free times)", "carom compare dozen.toml --play", "default-src 'none'"})
    EXPECT_TRUE(contains(html, there)) << there;
  for (const char* const absent : {"<b>A dozen", "src=\"", "{panel}"}) EXPECT_FALSE(contains(html, absent)) << absent;
}

TEST(SideBySidePage, SaysWhatGrowthMeansWhereItIsKnown) {
  const Scene scene = dozen_scene();
  const SideBySide shown = flown(scene);
  const Lyapunov chaotic{4.0, 0.1, 2.0, 0.05, 2.0, 1000};
  const std::string html = side_by_side_page(shown, scene, chaotic, "");
  for (const char* const there : {"every Lyapunov time, here 0.25 or 0.5 collisions of a disk",
                                  "a step ten times shorter gains 0.576 of time", "\"perTime\":4.0"})
    EXPECT_TRUE(contains(html, there)) << there;
  const Lyapunov unknown{4.0, 2.0, 2.0, 1.0, 2.0, 10};  // by chance
  for (const auto& none : {std::optional<Lyapunov>(), std::optional(unknown)}) {
    const std::string without = side_by_side_page(shown, scene, none, "");
    EXPECT_FALSE(contains(without, "Lyapunov time, here"));
    EXPECT_TRUE(contains(without, "convex mirrors"));
  }
}

TEST(SideBySidePage, SaysWhyItShowsLessThanTheRun) {
  Scene scene = dozen_scene();
  SideBySide shown = flown(scene);
  EXPECT_THAT(why_no_longer(shown, scene), IsEmpty());
  shown.because = ShownUntil::numbers;
  EXPECT_EQ(why_no_longer(shown, scene), "shown until time 1 of 10: a page holds no more collisions and turns");
  shown.because = ShownUntil::parted;
  shown.times = {0.0, 0.25, 0.5};
  shown.distance = {0.0, 0.1, 1.5};
  EXPECT_THAT(why_no_longer(shown, scene), HasSubstr("half a diameter apart at 0.5"));
  EXPECT_TRUE(contains(side_by_side_page(shown, scene, std::nullopt, ""), "\"Shown until time 1 of 10: the two are"));
  scene.run.time.reset();
  shown.because = ShownUntil::work;
  EXPECT_THAT(why_no_longer(shown, scene), AllOf(HasSubstr("shown until time 1:"), HasSubstr("too long")));
}

TEST(SideBySidePage, AsMuchAsItMayHoldIsFiveMegabytes) {
  const Scene scene = dozen_scene();
  SideBySide shown = flown(scene);
  const std::size_t numbers = SideBySideLimits{}.numbers;
  for (const int kind : {0, 1, 2}) {  // all of it collisions, turns or overlaps: the mixture lies between
    SideBySide full = shown;
    if (kind == 0) full.events.assign(numbers / 6, full.events.front());
    if (kind == 1) full.turns.assign(numbers / 3, full.turns.front());
    if (kind == 2) full.overlaps.assign(numbers / 3, full.overlaps.front());
    EXPECT_LT(side_by_side_page(full, scene, std::nullopt, "").size(), 5'000'000U) << kind;
  }
}

}  // namespace
}  // namespace carom::test
