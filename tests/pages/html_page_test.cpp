// A page as text: what it contains, what it cannot contain.

#include "pages/html_parts.hpp"
#include "pages/sample_page.hpp"

#include <carom/pages/page.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace carom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The page without the embedded files, which would make every failure print a megabyte.
std::string own_text(const Page& page) {
  std::string html = html_page(page);
  for (const detail::EmbeddedFile& file : detail::embedded_files()) {
    const std::string text = detail::embedded_text(file.name);
    const std::size_t at = html.find(text);
    if (at != std::string::npos) html.erase(at, text.size());
  }
  return html;
}

Page page_with(Block block) { return {.sections = {{.blocks = {std::move(block)}}}}; }

TEST(HtmlPage, HoldsTheLibraryAndItsLicenceAndStaysBelowThreeMegabytes) {
  const std::string html = html_page(sample_page());
  EXPECT_TRUE(html.find(detail::embedded_text("plotly/plotly-basic.min.js")) != std::string::npos);
  EXPECT_TRUE(html.find(detail::html_text(detail::embedded_text("plotly/LICENSE"))) != std::string::npos);
  EXPECT_LT(html.size(), 3'000'000u);
}

TEST(HtmlPage, RefersToNothingOutsideItself) {
  const std::string html = own_text(sample_page());
  for (const char* const reference : {"http:", "https:", "//cdn", "src=", "<link", "@import", "url("})
    EXPECT_THAT(html, Not(HasSubstr(reference)));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

TEST(HtmlPage, ShowsItsTextAndTablesWithoutScripts) {
  const std::string html = own_text(sample_page());
  EXPECT_THAT(html, HasSubstr("<h1>Event-driven against time-stepped: the classic box</h1>"));
  EXPECT_THAT(html, HasSubstr("<code>dt = 1e-6</code>"));
  EXPECT_THAT(html, HasSubstr("<dt>faster than the stepper at equal error</dt><dd>400 \u00d7</dd>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">penalty force</th><td class=\"number\">0.5</td>"));
  EXPECT_THAT(html, HasSubstr("<noscript>"));
  EXPECT_THAT(html, HasSubstr("<dt>Seed</dt><dd>1</dd>"));
}

TEST(HtmlPage, HasContentsWhereItHasMoreThanThreeSections) {
  Page page = sample_page();
  EXPECT_THAT(own_text(page), HasSubstr("<a href=\"#section-4\">What was not measured</a>"));
  page.sections.pop_back();
  EXPECT_THAT(own_text(page), Not(HasSubstr("<nav")));
}

TEST(HtmlPage, NoTextOfTheUserIsMarkup) {
  const std::string hostile = "</script></title></style>--><script>alert(1)</script>\"'\\";
  Page page{
      .title = hostile, .subtitle = hostile, .lead = hostile, .key_numbers = {{hostile, hostile}}, .facts = {{hostile, hostile}}};
  const Plot plot{.id = "p",
                  .title = hostile,
                  .caption = hostile,
                  .x = {.title = hostile},
                  .series = {{.name = hostile, .x = {1.0}, .y = {1.0}, .labels = {hostile}}},
                  .marks = {{.label = hostile}}};
  const TextTable table{.title = hostile, .columns = {hostile}, .rows = {{hostile}}, .caption = hostile};
  page.sections = {{hostile, {Paragraph{hostile}, plot, table, Listing{hostile, hostile}}}};
  const std::string html = own_text(page);
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("</script></title>")));
}

TEST(HtmlPage, OnlyColumnsOfNumbersAreFlushRight) {
  const std::string html = own_text(page_with(
      TextTable{.columns = {"name", "n", "mixed", "empty"}, .rows = {{"a", "1e-3", "1", ""}, {"b", "\u2013", "none", ""}}}));
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">1e-3</td><td>1</td><td></td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">\u2013</td><td>none</td><td></td>"));
}

TEST(HtmlPage, AnIdThatIsUnfitOrThereTwiceIsRefused) {
  for (const char* const id : {"", "Plot", "a b", "a\""})
    EXPECT_THROW(html_page(page_with(Plot{.id = id})), std::invalid_argument) << id;
  Page page = page_with(Plot{.id = "a"});
  page.sections.push_back(page.sections.front());
  EXPECT_THROW(html_page(page), std::invalid_argument);
}

TEST(HtmlPage, ARowOfAnotherLengthIsRefused) {
  EXPECT_THROW(html_page(page_with(TextTable{.columns = {"a", "b"}, .rows = {{"1"}}})), std::invalid_argument);
}

}  // namespace
}  // namespace carom::test
