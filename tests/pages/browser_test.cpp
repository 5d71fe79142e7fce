// Pages in a real browser: every plot is drawn with its points, nothing goes wrong, and what goes wrong is seen.

#include "support/browser.hpp"
#include "pages/sample_page.hpp"
#include "support/child_process.hpp"

#include <carom/pages/page.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace carom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The document of a page, after `script` ran behind the page's own.
std::string document(std::string html, Screen screen = Screen::light, const std::string& script = {}) {
  if (!script.empty())
    html.insert(html.rfind("</body>"),
                "<script>addEventListener('load', () => setTimeout(async () => {" + script + "}, 2000))</script>");
  const TemporaryDirectory directory;
  write_text(directory.file("page.html"), html);
  return dump_dom(directory.file("page.html"), screen);
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return {};
  return text.substr(from, text.find(end, from) - from);
}

std::string root(const std::string& dom) { return between(dom, "<html", ">"); }
std::string figure(const std::string& dom, const std::string& id) {
  return between(dom, "<figure class=\"plot\" id=\"plot-" + id + "\"", "</figure>");
}

int count(const std::string& text, const std::string& what) {
  int found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

void expect_every_plot(const std::string& dom) {
  EXPECT_THAT(root(dom), HasSubstr("data-errors=\"\""));
  EXPECT_THAT(root(dom), HasSubstr("data-plots=\"4\""));
  EXPECT_THAT(figure(dom, "work-precision"), HasSubstr("data-points=\"78\""));  // 6 x 13
  EXPECT_EQ(count(figure(dom, "work-precision"), "<path class=\"point\""), 78);
  EXPECT_EQ(count(figure(dom, "work-precision"), "<path class=\"yerror\""), 78);
  EXPECT_THAT(figure(dom, "error-growth"), HasSubstr("data-points=\"302\""));  // 3 x 101 without the three zeros, and 2
  EXPECT_EQ(count(figure(dom, "error-growth"), "class=\"js-fill\""), 3);       // bands
  EXPECT_THAT(figure(dom, "pressure"), HasSubstr("data-points=\"25\""));       // 2 x 13 without the one that is not a number
  EXPECT_THAT(figure(dom, "pressure"), HasSubstr("nothing measured (no data)"));
  EXPECT_THAT(figure(dom, "empty"), HasSubstr("data-points=\"0\""));
  EXPECT_THAT(figure(dom, "empty"), HasSubstr(">no data</text>"));
}

TEST(BrowserPage, DrawsEveryPointOnALightAndOnADarkScreen) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const std::string html = html_page(sample_page());
  const std::string light = document(html, Screen::light);
  const std::string dark = document(html, Screen::dark);
  expect_every_plot(light);
  expect_every_plot(dark);
  const std::string light_blue = "rgb(0, 114, 178)";  // --series-0 of page.css
  const std::string dark_blue = "rgb(63, 159, 224)";
  EXPECT_THAT(figure(light, "work-precision"), HasSubstr(light_blue));
  EXPECT_THAT(figure(light, "work-precision"), Not(HasSubstr(dark_blue)));
  EXPECT_THAT(figure(dark, "work-precision"), HasSubstr(dark_blue));
  EXPECT_THAT(figure(dark, "work-precision"), Not(HasSubstr(light_blue)));
}

TEST(BrowserPage, TextThatLooksLikeMarkupIsShownAsItIs) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const std::string hostile = "</script><script>document.title='taken'</script><b>&amp;\"\\%{y} \u03c3";
  const std::string shown = "&lt;/script&gt;&lt;script&gt;document.title='taken'&lt;/script&gt;&lt;b&gt;&amp;amp;\"\\%{y} \u03c3";
  Page page{.title = hostile};
  page.sections = {{hostile,
                    {Plot{.id = "p",
                          .title = hostile,
                          .x = {.title = hostile},
                          .series = {{.name = hostile, .x = {1.0}, .y = {2.0}, .labels = {hostile}}, {.name = "other"}},
                          .marks = {{.value = 1.0, .label = hostile}}}}}};
  const std::string dom =
      document(html_page(page), Screen::light, "Plotly.Fx.hover(drawn[0].canvas, [{curveNumber: 0, pointNumber: 0}]);");
  EXPECT_THAT(root(dom), HasSubstr("data-errors=\"\""));
  EXPECT_THAT(dom, Not(HasSubstr("<title>taken")));
  EXPECT_EQ(count(figure(dom, "p"), ">" + shown + "<"), 6);  // heading; legend, axis, mark; name and note at the mouse
}

TEST(BrowserPage, PointsThatCannotBeDrawnAreLeftOutAndListed) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const double infinity = std::numeric_limits<double>::infinity();
  Page page{.sections = {{.blocks = {Plot{.id = "p",
                                          .y = {.log = true},
                                          .series = {{.name = "a,b", .x = {1, 2, 3, 4, 5}, .y = {1, 0, -1, infinity, 2}}}}}}}};
  const std::string dom = document(html_page(page), Screen::light,
                                   "document.querySelector('details.numbers').open = true;"
                                   "document.body.dataset.csv = numbersCsv(drawn[0].plot);");
  EXPECT_THAT(root(dom), HasSubstr("data-errors=\"\""));
  EXPECT_THAT(figure(dom, "p"), HasSubstr("data-points=\"2\""));
  EXPECT_EQ(count(figure(dom, "p"), "<th scope=\"row\">a,b</th>"), 5);
  EXPECT_THAT(figure(dom, "p"), HasSubstr("<td class=\"number\">4</td><td class=\"number\">\u2013</td>"));
  EXPECT_THAT(dom, HasSubstr("data-csv=\"series,x,y\n&quot;a,b&quot;,1,1\n&quot;a,b&quot;,2,0\n&quot;a,b&quot;,3,-1\n&quot;a,b&"
                             "quot;,4,nan\n&quot;a,b&quot;,5,2\n\""));
}

TEST(BrowserPage, PaperAndSavedPicturesAreLightWhateverTheScreen) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const std::string dom =
      document(html_page(sample_page()), Screen::dark,
               "Plotly.downloadImage = async (figure, options) => {"
               "  document.body.dataset.picture = decodeURIComponent(await Plotly.toImage(figure, options)); };"
               "await savePicture(drawn[0].canvas, drawn[0].plot, 'svg');"
               "window.dispatchEvent(new Event('beforeprint'));");
  EXPECT_THAT(root(dom), HasSubstr("data-errors=\"\""));
  const std::string picture = between(dom, "data-picture=\"", "\">");
  EXPECT_THAT(picture, HasSubstr("Error at the end against computing time"));
  EXPECT_THAT(picture, HasSubstr("rgb(0, 114, 178)"));
  EXPECT_THAT(picture, Not(HasSubstr("rgb(63, 159, 224)")));
  EXPECT_THAT(figure(dom, "error-growth"), HasSubstr("rgb(0, 114, 178)"));
  EXPECT_THAT(figure(dom, "error-growth"), Not(HasSubstr("rgb(63, 159, 224)")));
}

TEST(BrowserPage, LongNamesStayInTheirColumnsAndPlots) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const std::string name = "observables.intermediate_scattering.relaxation_time_of_species@2.5,12";
  Page page;
  for (const char* const id : {"a", "b", "c", "d"})
    page.sections.push_back({name,
                             {Plot{.id = id,
                                   .title = name,
                                   .x = {.title = name},
                                   .y = {.title = name + " (length^2 / time in scene units)"},
                                   .series = {{.name = name, .x = {1.0, 2.0}, .y = {2.0, 3.0}}}}}});
  const std::string dom = document(html_page(page), Screen::light,
                                   "const box = (element) => element.getBoundingClientRect();"
                                   "const isIn = (one, other) => one.left >= other.left && one.right <= other.right &&"
                                   "  one.top >= other.top && one.bottom <= other.bottom;"
                                   "const titles = [...document.querySelectorAll('.ytitle')];"
                                   "const entries = [...document.querySelectorAll('nav li')];"
                                   "document.body.dataset.titles = titles.filter((title) =>"
                                   "  isIn(box(title), box(title.closest('.canvas')))).length;"
                                   "document.body.dataset.entries = entries.filter((entry) =>"
                                   "  box(entry.querySelector('a')).right <= box(entry).right).length;");
  EXPECT_THAT(dom, HasSubstr("data-titles=\"4\""));
  EXPECT_THAT(dom, HasSubstr("data-entries=\"4\""));
}

TEST(BrowserPage, WhatGoesWrongIsReportedAndShownWhereThePlotWouldBe) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  std::string html = html_page(sample_page());
  const std::string data = "\"title\":\"Pressure of the runs\"";
  html.replace(html.find(data), data.size(), "\"broken");
  const std::string dom = document(html, Screen::light, "fetch('https://example.org/').catch(() => {}); nonsense();");
  EXPECT_THAT(root(dom), HasSubstr("plot-pressure: SyntaxError"));
  EXPECT_THAT(root(dom), HasSubstr("nonsense is not defined"));
  EXPECT_THAT(root(dom), HasSubstr("refused to load https://example.org/"));
  EXPECT_THAT(root(dom), HasSubstr("data-plots=\"3\""));
  EXPECT_THAT(figure(dom, "pressure"), HasSubstr("<p class=\"error\">Error: plot-pressure: SyntaxError"));
}

}  // namespace
}  // namespace carom::test
