// What observables found, as JSON, as tables and in the H5MD file.

#include "app/info.hpp"
#include "io/h5md_reader.hpp"
#include "io/hand_made_run.hpp"
#include "io/observable_output.hpp"
#include "io/run_directory.hpp"
#include "io/run_writer.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace carom::test {
namespace {

using detail::Json;
using ::testing::HasSubstr;

std::vector<Measurement> hand_made() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Measurement measured{.name = "flights"};
  measured.scalars = {{.name = "mean",
                       .unit = "time",
                       .average = Average::collisions,
                       .value = 0.5,
                       .error = 0.25,
                       .integrated_correlation_time = 2.0},
                      {.name = "other", .note = "there is none"}};
  measured.tables = {{.name = "free_times",
                      .average = Average::collisions,
                      .columns = {{"middle", "time", {0.25, 0.75}}, {"density", "1 / time", {1.0 / 3.0, nan}}}}};
  measured.note = "by hand";
  return {measured};
}

TEST(ObservablesOutput, JsonCarriesValueErrorAndWhatTheAverageIsOver) {
  const Json json = detail::observables_json(hand_made());
  EXPECT_EQ(
      json["flights"]["mean"],
      (Json{{"value", 0.5}, {"error", 0.25}, {"integrated_correlation_time", 2.0}, {"average", "collisions"}, {"unit", "time"}}));
  EXPECT_EQ(json["flights"]["other"], (Json{{"value", nullptr},
                                            {"error", nullptr},
                                            {"integrated_correlation_time", nullptr},
                                            {"average", "time"},
                                            {"note", "there is none"}}));
  EXPECT_EQ(json["flights"]["note"], "by hand");
  EXPECT_EQ(json["flights"]["tables"]["free_times"],
            (Json{{"file", "observe_free_times.csv"}, {"average", "collisions"}, {"columns", {"middle", "density"}}}));
}

TEST(ObservablesOutput, TableIsACommentAHeadingAndRowsThatReadBack) {
  const TemporaryDirectory directory;
  write_table(directory.path() / "t.csv", hand_made()[0].tables[0]);
  EXPECT_EQ(text_of(directory.path() / "t.csv"),
            "# averages over collisions; units: time, 1 / time\nmiddle,density\n0.25,0.3333333333333333\n0.75,NaN\n");
  EXPECT_THAT(describe_file(directory.path() / "t.csv"), HasSubstr("table of an observable"));
  EXPECT_THAT(describe_file(directory.path() / "t.csv"), HasSubstr("middle,density"));
}

TEST(ObservablesOutput, WordsOfAveragesReadBack) {
  for (const auto& [average, word] :
       {std::pair(Average::time, "time"), {Average::collisions, "collisions"}, {Average::sum, "sum"}}) {
    EXPECT_STREQ(average_word(average), word);
    EXPECT_EQ(average_of_word(word), average);
    const TemporaryDirectory directory;
    write_table(directory.path() / "t.csv", {.name = "t", .average = average, .columns = {{"x", "", {1.0}}}});
    EXPECT_EQ(average_in_comment(text_of(directory.path() / "t.csv")), average);
    EXPECT_THAT(describe_file(directory.path() / "t.csv"), HasSubstr("table of an observable"));
  }
  EXPECT_FALSE(average_of_word("speed"));
  EXPECT_FALSE(average_in_comment("time,id,x,y,vx,vy"));
}

TEST(ObservablesOutput, RunWritesThemBesideSamplesAndIntoTheFileOfSamples) {
  const TemporaryDirectory directory;
  Scene scene = scene_of(2, 2);
  scene.run.sample_every.reset();
  scene.observe.emplace_back().name = "free_flight";
  RunReport report = hand_made_report(scene);
  report.observables = hand_made();
  const std::vector<std::string> files = [&] {
    RunWriter writer(RunDirectory(directory.path() / "run", false), scene, hand_made_disks(scene), provenance());
    return writer.finish(report);
  }();
  EXPECT_THAT(files, ::testing::ElementsAre("trajectory.h5md", "observe_free_times.csv", "summary.json"));
  const H5Reader file(directory.path() / "run" / "trajectory.h5md");
  ASSERT_TRUE(file.opens());
  EXPECT_EQ(file.doubles("measurements/flights/table_free_times/middle"), (std::vector<double>{0.25, 0.75}));
  EXPECT_TRUE(std::isnan(file.doubles("measurements/flights/table_free_times/density")[1]));
  EXPECT_THAT(describe_file(directory.path() / "run"), HasSubstr("flights: mean 0.50 ± 0.25, observe_free_times.csv"));
  EXPECT_NO_THROW(RunDirectory(directory.path() / "run", true)) << "--force replaces tables too";
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "run" / "observe_free_times.csv"));
}

}  // namespace
}  // namespace carom::test
