// What the player is given, unpacked again by slow obvious code, against the engine.

#include "pages/player_data.hpp"

#include "pages/html_parts.hpp"
#include "pages/number_columns.hpp"
#include "pages/player_page.hpp"
#include "support/child_process.hpp"
#include "support/recorded_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string packed_gas = R"(
title = "Gas"
[box]
x = [0.0, 8.0]
y = [-3.0, 3.0]
boundary = { x = "periodic", y = "walls" }
[[disks]]
count = 30
radius = 0.25
mass = 2.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[run]
time = 6.0
sample_every = 0.5
[output]
events = true
)";

class PlayerDataTest : public ::testing::Test {
 protected:
  PlayerData packed(const std::vector<std::string>& overrides = {}, const PlayerLimits& limits = {}) {
    scene_ = parse_scene(packed_gas, "gas", overrides);
    record(scene_, directory_.path() / "run");
    PlayerData data = player_data(RunReader(directory_.path() / "run"), limits);
    description_ = json::parse(data.description);
    return data;
  }
  /// A column, as the page would find it.
  template <class Number>
  std::vector<double> column(const PlayerData& data, const std::string& name, const std::string& type) const {
    for (const json& one : description_.at("columns")) {
      if (one.at("name") != name) continue;
      EXPECT_EQ(one.at("type"), type) << name;
      std::vector<Number> numbers(one.at("length").get<std::size_t>());
      std::memcpy(numbers.data(), data.columns.data() + one.at("offset").get<std::size_t>(), numbers.size() * sizeof(Number));
      return {numbers.begin(), numbers.end()};
    }
    ADD_FAILURE() << "no column " << name;
    return {};
  }
  /// From the longer way round to the shorter.
  [[nodiscard]] double apart(Eigen::Vector2d d) const {
    d.x() -= std::round(d.x() / 8.0) * 8.0;
    return d.norm();
  }

  TemporaryDirectory directory_;
  Scene scene_;
  json description_;
};

TEST_F(PlayerDataTest, EventsLeadWithinTheToleranceOfTheEngineAtAnyTime) {
  const PlayerData data = packed();
  ASSERT_TRUE(data.exact);
  const auto start = column<double>(data, "start", "Float64Array"), time = column<double>(data, "time", "Float64Array");
  const auto disk = column<std::uint16_t>(data, "disk", "Uint16Array");
  const auto partner = column<std::uint16_t>(data, "partner", "Uint16Array");
  const auto velocity = column<float>(data, "velocity", "Float32Array");
  ASSERT_GT(time.size(), 100U);
  Simulation simulation = make_simulation(scene_);
  for (const double until : {0.1, 1.7, 3.3, 4.9, 5.99}) {
    simulation.run_until(until);
    const State expected = simulation.state();
    for (std::size_t i = 0; i < 30; ++i) {
      Eigen::Vector2d r(start[4 * i], start[4 * i + 1]), v(start[4 * i + 2], start[4 * i + 3]);
      double t = 0.0;
      const auto fly = [&](double to) {
        r += v * (to - t);
        t = to;
      };
      for (std::size_t e = 0; e < time.size() && time[e] <= until; ++e) {
        const std::size_t which = static_cast<double>(i) == disk[e] ? 0 : static_cast<double>(i) == partner[e] ? 2 : 4;
        if (which == 4) continue;
        fly(time[e]);
        v = {velocity[4 * e + which], velocity[4 * e + which + 1]};
      }
      fly(until);
      EXPECT_LT(apart(r - expected.positions.col(static_cast<Eigen::Index>(i))), player_tolerance * 8.0);
    }
  }
  EXPECT_LE(description_.at("rounding").get<double>(), player_tolerance * 8.0);
}

TEST_F(PlayerDataTest, VelocitiesKeepAllDigitsWhereALongRunNeedsThem) {
  // As a float, 0.3 is 1.2e-8 too large: after 4e4 units of time the disk would be 4.8e-4 from where it should, and the tolerance
  // is 8e-6.
  const PlayerData data = packed({"disks.0.count=1", "disks.0.positions=[[4.0, 0.0]]", "disks.0.velocities=[[0.3, 0.1]]",
                                  "run.time=4e4", "run.sample_every=1e4"});
  ASSERT_TRUE(data.exact);
  column<double>(data, "velocity", "Float64Array");
  EXPECT_EQ(description_.at("rounding"), 0.0);
}

TEST_F(PlayerDataTest, SamplesAreRoundedByAFractionOfAPixel) {
  const PlayerData data = packed({"thermostat.temperature=1.0", "thermostat.rate=0.5"});
  ASSERT_FALSE(data.exact);
  EXPECT_THAT(data.why_not, HasSubstr("thermostat"));
  const auto position = column<std::uint16_t>(data, "samplePosition", "Uint16Array");
  const auto velocity = column<std::int16_t>(data, "sampleVelocity", "Int16Array");
  const json& samples = description_.at("samples");
  const RunReader run(directory_.path() / "run");
  ASSERT_EQ(samples.at("count"), run.samples());
  for (std::uint64_t k = 0; k < run.samples(); ++k) {
    const State state = run.sample(k);
    for (Eigen::Index i = 0; i < 30; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const auto at = static_cast<std::size_t>(2 * (static_cast<Eigen::Index>(k) * 30 + i) + axis);
        const double step = samples.at("positionStep")[static_cast<std::size_t>(axis)].get<double>();
        const double place = samples.at("lower")[static_cast<std::size_t>(axis)].get<double>() + step * position[at];
        EXPECT_NEAR(place, state.positions(axis, i), 0.5000001 * step);  // to the nearest step, and a trace of rounding
        const double v = samples.at("velocityStep").get<double>() * velocity[at];
        EXPECT_NEAR(v, state.velocities(axis, i), 0.5000001 * samples.at("velocityStep").get<double>());
      }
  }
}

TEST_F(PlayerDataTest, MoreEventsOrSamplesThanAPageCanHoldAreThinnedOut) {
  const PlayerData data = packed({}, {.events = 10, .sample_bytes = 5 * 8 * 30});
  EXPECT_FALSE(data.exact);
  EXPECT_THAT(data.why_not, HasSubstr("more than the 10 that a page can hold"));
  EXPECT_EQ(description_.at("samples").at("count"), 5);  // of 13, every third
  EXPECT_EQ(description_.at("samples").at("every"), 3);
}

TEST_F(PlayerDataTest, SamplesThatAreThinnedOutKeepTheLast) {
  const PlayerData data = packed({"run.time=5.5"}, {.events = 10, .sample_bytes = 5 * 8 * 30});
  EXPECT_THAT(column<double>(data, "sampleTime", "Float64Array"), ::testing::ElementsAre(0.0, 1.5, 3.0, 4.5, 5.5));
  EXPECT_EQ(description_.at("duration"), 5.5);
}

TEST_F(PlayerDataTest, GrowingDisksAreRescaledByEventsOfTheirOwn) {
  const PlayerData data = packed({"growth.rate=0.02"});
  ASSERT_TRUE(data.exact);
  const auto partner = column<std::uint16_t>(data, "partner", "Uint16Array");
  const auto pairs = std::count_if(partner.begin(), partner.end(), [](double p) { return p < 30.0; });
  EXPECT_EQ(std::count(partner.begin(), partner.end(), 34.0), pairs / 15);  // whenever each disk has collided once
}

TEST(NumberColumns, BeginWhereAnyTypeMay) {
  detail::NumberColumns columns;
  columns.add("a", std::vector<std::uint16_t>{1, 2, 3});
  columns.add("b", std::vector<double>{0.5});
  EXPECT_EQ(columns.list()[1].at("offset"), 8);
  EXPECT_EQ(columns.take_bytes().size(), 16U);
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(detail::base64(""), "");
  EXPECT_EQ(detail::base64("f"), "Zg==");
  EXPECT_EQ(detail::base64("fo"), "Zm8=");
  EXPECT_EQ(detail::base64("foo"), "Zm9v");
  EXPECT_EQ(detail::base64("foob"), "Zm9vYg==");
  EXPECT_EQ(detail::base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(detail::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(detail::base64({"\xff\xfe\x00\x80", 4}), "//4AgA==");
}

TEST_F(PlayerDataTest, TitlesCannotEndTheScriptThatHoldsThem) {
  const std::string page = player_page(packed({"title=\"</script><b>\""}));
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cb>"));
  EXPECT_THAT(page.substr(0, 512), HasSubstr(std::string(player_mark)));
  for (const char* const outside : {"http://", "https://", "@import", "src=\""})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST_F(PlayerDataTest, APageRepeatsTheLicenceOfTheLibraryInIt) {
  const std::string page = player_page(packed({}));
  for (const char* const name : {"delaunator/delaunator.min.js", "delaunator/LICENSE"})
    EXPECT_TRUE(page.find(detail::embedded_text(name)) != std::string::npos) << name;
}

TEST(SlowPlayerPage, OfAThousandDisksAndAHundredThousandCollisionsTakesLessThanFiveMegabytes) {
  const TemporaryDirectory directory;
  record(parse_scene(packed_gas, "gas",
                     {"disks.0.count=1000", "disks.0.radius=0.1", "box.x=[0.0, 80.0]", "run.time=1e9", "run.collisions=100000",
                      "run.sample_every=5.0"}),
         directory.path() / "run");
  const RunReader run(directory.path() / "run");
  ASSERT_GE(run.events(), 100000U);
  const PlayerData data = player_data(run);
  EXPECT_TRUE(data.exact);
  EXPECT_LT(player_page(data).size(), 5'000'000U);
}

}  // namespace
}  // namespace carom::test
