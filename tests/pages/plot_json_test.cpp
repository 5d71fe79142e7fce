// The numbers of a plot as the page holds them.

#include "pages/html_parts.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <limits>
#include <stdexcept>

namespace carom::detail {
namespace {

using Json = nlohmann::json;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(PlotJson, HasEverythingOfThePlot) {
  Plot plot{.id = "p", .title = "T", .x = {.title = "x", .log = true}, .y = {.title = "y"}};
  plot.series = {{.name = "s",
                  .x = {1.0},
                  .y = {0.1},
                  .y_low = {0.0},
                  .y_high = {0.2},
                  .labels = {"note"},
                  .style = Style::band,
                  .group = 3,
                  .visible = false}};
  plot.marks = {{.axis = Mark::Across::x, .value = 2.0, .label = "m"}};
  EXPECT_EQ(Json::parse(plot_json(plot)), Json::parse(R"({
    "id": "p", "title": "T", "x": {"title": "x", "log": true}, "y": {"title": "y", "log": false},
    "series": [{"name": "s", "group": 3, "style": "band", "visible": false, "x": [1.0], "y": [0.1], "y_low": [0.0], "y_high": [0.2],
                "labels": ["note"]}],
    "marks": [{"axis": "x", "value": 2.0, "label": "m"}]})"));
}

TEST(PlotJson, WhatIsNotFiniteIsNullAndMarksThereAreLeftOut) {
  const Plot plot{.id = "p", .series = {{.x = {1.0, infinity, 3.0}, .y = {nan, 2.0, -infinity}}}, .marks = {{.value = nan}}};
  const Json json = Json::parse(plot_json(plot));
  EXPECT_EQ(json["series"][0]["x"], Json::parse("[1.0, null, 3.0]"));
  EXPECT_EQ(json["series"][0]["y"], Json::parse("[null, 2.0, null]"));
  EXPECT_TRUE(json["marks"].empty());
}

TEST(PlotJson, NumbersReadBackToTheSameBits) {
  const std::vector<double> values = {0.1, 1.0 / 3.0, 5e-324, -0.0, 1.7976931348623157e308};
  const Plot plot{.id = "p", .series = {{.x = values, .y = values}}};
  EXPECT_EQ(Json::parse(plot_json(plot))["series"][0]["y"].get<std::vector<double>>(), values);
}

TEST(PlotJson, NoTextCanEndItsScriptElement) {
  const std::string hostile = "</script><!--<script>\"\\\u2028";
  const Plot plot{.id = "p", .title = hostile, .series = {{.name = hostile}}};
  const std::string text = plot_json(plot);
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(Json::parse(text)["title"], hostile);
}

TEST(PlotJson, BytesThatAreNotUtf8AreReplaced) {
  EXPECT_EQ(Json::parse(plot_json({.id = "p", .title = "a\xff"}))["title"], "a\uFFFD");
}

TEST(PlotJson, LengthsThatDifferAndNegativeGroupsAreRefused) {
  const auto refused = [](const Series& series) {
    EXPECT_THROW(plot_json({.id = "p", .series = {series}}), std::invalid_argument);
  };
  refused({.x = {1.0}, .y = {}});
  refused({.x = {1.0}, .y = {1.0}, .y_low = {1.0}});
  refused({.x = {1.0}, .y = {1.0}, .y_low = {1.0, 2.0}, .y_high = {1.0, 2.0}});
  refused({.x = {1.0}, .y = {1.0}, .labels = {"a", "b"}});
  refused({.x = {1.0}, .y = {1.0}, .style = Style::band});
  refused({.x = {1.0}, .y = {1.0}, .group = -1});
}

}  // namespace
}  // namespace carom::detail
