// A comparison in files: what is written is read back to the last bit, and what is not ours is refused.

#include "studies/compare/files.hpp"

#include "core/real.hpp"
#include "support/child_process.hpp"
#include "support/comparisons.hpp"
#include "support/refusal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <carom/version.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Numbers that a careless format would change.
MethodRun awkward_run() {
  MethodRun run;
  run.method = {"naive-edge", 0.1 + 0.2};
  run.seed = std::numeric_limits<std::uint64_t>::max();
  run.error = {1.0 / 3.0, 5e-324, 1.7976931348623157e308, infinity<double>, -0.0, infinity<double>};
  run.setup_seconds = 3e-7;
  run.seconds_early = 1e-300;
  run.seconds = 0.1;
  run.time = 1e22;
  run.pair = (std::uint64_t{1} << 63) + 1;
  run.Z = 2.0 / 3.0;
  run.collision_rate = infinity<double>;
  run.mean_free_path = 4.35;
  run.energy_drift = -1.1102230246251565e-16;
  run.worst_overlap = 0.9999999999999999;
  run.counts = StepCounts{.steps = 1,
                          .time = 0.3,
                          .found = 2,
                          .spurious = 3,
                          .repeated = 4,
                          .missed = 5,
                          .depth_sum = 0.1 + 0.7,
                          .deepest = 1.0 / 7.0};
  run.mistakes = StepMistakes{.steps = 200, .mistaken = 7};
  return run;
}

CostPoint awkward_cost() { return {16384, 0.1 + 0.2, "grid", 1.0 / 3.0, 0.7, 2e-9, 1e-17, -0.3}; }

void expect_same_bits(double a, double b) { EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a; }

void expect_same(const MethodRun& a, const MethodRun& b) {
  EXPECT_EQ(a.method.name, b.method.name);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.pair, b.pair);
  for (const auto member :
       {&MethodRun::setup_seconds, &MethodRun::seconds_early, &MethodRun::seconds, &MethodRun::time, &MethodRun::Z,
        &MethodRun::collision_rate, &MethodRun::mean_free_path, &MethodRun::energy_drift, &MethodRun::worst_overlap})
    expect_same_bits(a.*member, b.*member);
  expect_same_bits(a.method.dt, b.method.dt);
  ASSERT_EQ(a.error.size(), b.error.size());
  for (std::size_t k = 0; k < a.error.size(); ++k) expect_same_bits(a.error[k], b.error[k]);
  ASSERT_EQ(a.mistakes.has_value(), b.mistakes.has_value());
  const StepMistakes none;
  EXPECT_EQ(a.mistakes.value_or(none).steps, b.mistakes.value_or(none).steps);
  EXPECT_EQ(a.mistakes.value_or(none).mistaken, b.mistakes.value_or(none).mistaken);
  ASSERT_EQ(a.counts.has_value(), b.counts.has_value());
  if (!a.counts) return;
  for (const auto member :
       {&StepCounts::steps, &StepCounts::found, &StepCounts::spurious, &StepCounts::repeated, &StepCounts::missed})
    EXPECT_EQ(*a.counts.*member, *b.counts.*member);
  for (const auto member : {&StepCounts::time, &StepCounts::depth_sum, &StepCounts::deepest})
    expect_same_bits(*a.counts.*member, *b.counts.*member);
}

void expect_same(const CostPoint& a, const CostPoint& b) {
  EXPECT_EQ(a.disks, b.disks);
  EXPECT_EQ(a.method, b.method);
  for (const auto member : {&CostPoint::packing_fraction, &CostPoint::dt, &CostPoint::free_time, &CostPoint::seconds,
                            &CostPoint::Z, &CostPoint::bias_slope})
    expect_same_bits(a.*member, b.*member);
}

class Points : public ::testing::Test {
 protected:
  /// A file with one run of an exact engine, one with everything, and a cost.
  void write() {
    PointsFile points(file(), "key", {});
    points.add(KnownLaws{}.run({"fast"}, 1));
    points.add(awkward_run());
    points.add(awkward_cost());
  }
  [[nodiscard]] std::string file() const { return directory_.file("points.jsonl"); }
  [[nodiscard]] std::string refusal_of(const std::string& key) const {
    return refusal<OutputError>([&] { return load_points(file(), key); });
  }

 private:
  TemporaryDirectory directory_;
};

TEST_F(Points, AreReadBackToTheLastBit) {
  write();
  const Comparison loaded = load_points(file(), "key");
  ASSERT_EQ(loaded.runs.size(), 2U);
  ASSERT_EQ(loaded.costs.size(), 1U);
  expect_same(loaded.runs[0], KnownLaws{}.run({"fast"}, 1));
  expect_same(loaded.runs[1], awkward_run());
  expect_same(loaded.costs[0], awkward_cost());
  EXPECT_EQ(loaded.plan.samples, 0U);  // it is made anew
  EXPECT_FALSE(loaded.complete);
}

TEST_F(Points, OfAnEarlierStudyBeginANewFile) {
  write();
  const Comparison loaded = load_points(file(), "key");
  const std::string text = text_of(file());
  PointsFile again(file(), "key", loaded);
  EXPECT_EQ(text_of(file()), text);
  again.add(awkward_cost());
  EXPECT_EQ(load_points(file(), "key").costs.size(), 2U);
  std::filesystem::remove(file());
  std::filesystem::create_directory(file());  // which no file replaces
  EXPECT_THROW(PointsFile(file(), "key", loaded), OutputError);
}

TEST_F(Points, ALineThatWasNotFinishedIsLeftOut) {
  write();
  const std::string text = text_of(file());
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  for (std::size_t kept = last; kept < text.size() - 1; kept += 7) {
    write_text(file(), text.substr(0, kept));
    const Comparison loaded = load_points(file(), "key");
    ASSERT_EQ(loaded.runs.size(), 2U) << kept;
    ASSERT_EQ(loaded.costs.size(), 0U) << kept;
  }
}

TEST_F(Points, OfAnotherStudyAreRefusedInASentence) {
  write();
  EXPECT_EQ(refusal_of("key"), "");
  EXPECT_THAT(refusal_of("another"), AllOf(HasSubstr(file()), HasSubstr("another scene, other options"), HasSubstr("--force")));
  write_text(file(), "");
  EXPECT_THAT(refusal_of("key"), HasSubstr("another scene"));
  std::filesystem::remove(file());
  EXPECT_THAT(refusal_of("key"), HasSubstr(file()));
}

TEST_F(Points, OfAnotherOriginAreRefusedWithTheirLine) {
  for (const char* line : {R"({"run":{}})", R"({"run":{"method":7}})", R"({"cost":[]})", R"({"run":null})"}) {
    write();
    write_text(file(), text_of(file()) + line + "\n");
    EXPECT_THAT(refusal_of("key"), AllOf(HasSubstr(file() + ":5: "), HasSubstr("--force"))) << line;
  }
}

TEST_F(Points, ThatCannotBeWrittenAreReported) {
  EXPECT_THROW(PointsFile(file() + "/no/such/directory", "key", {}), OutputError);
}

TEST(StudyKey, ChangesWithWhateverShapesAPoint) {
  const Scene scene = dozen_scene();
  const CompareOptions options = dozen_options();
  const std::string key = study_key(scene, options);
  EXPECT_EQ(key, study_key(scene, options));
  Scene denser = scene;
  denser.box.upper *= 0.99;
  Scene reseeded = scene;
  reseeded.run.seed = 2;
  CompareOptions other_steps = options, more_seeds = options, longer = options, other_engine = options, with_costs = options,
                 stiffer = options;
  other_steps.dts.push_back(1e-3);
  more_seeds.seeds = 3;
  longer.longest = 200.0;
  other_engine.engine = "textbook";
  with_costs.costs = true;
  stiffer.stiffness = 1e5;
  std::vector<std::string> keys = {key, study_key(denser, options), study_key(reseeded, options)};
  for (const CompareOptions& one : {other_steps, more_seeds, longer, other_engine, with_costs, stiffer})
    keys.push_back(study_key(scene, one));
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::unique(keys.begin(), keys.end()), keys.end());
}

TEST(CompareJson, HoldsThePlanThePointsAndTheAnswers) {
  Comparison comparison = KnownLaws{}.comparison({"grid", "naive"});
  comparison.runs.push_back(awkward_run());
  comparison.costs = {awkward_cost()};
  comparison.left_out = {{{"guarded", 1e-9}, 1e5, ""}};
  comparison.plan.stiffness = 2500.0;
  const json all = json::parse(compare_json(comparison, dozen_scene(), "carom compare \xff"));
  EXPECT_EQ(all["carom"]["version"], build_info().version);
  EXPECT_EQ(all["title"], "A dozen disks");
  EXPECT_EQ(all["disks"], 12);
  EXPECT_EQ(all["complete"], true);
  EXPECT_EQ(all["command_line"], "carom compare \xEF\xBF\xBD");  // the replacement character: JSON is UTF-8
  EXPECT_FALSE(all["sentences"].empty());
  EXPECT_EQ(all["plan"]["dt"], json(KnownLaws{}.dts));
  EXPECT_EQ(all["plan"]["stiffness"], 2500.0);
  EXPECT_TRUE(all["answers"]["backtrack_mistakes"].is_null());
  EXPECT_EQ(all["plan"]["early_time"], KnownLaws::early_time);
  EXPECT_EQ(all["plan"]["until"], KnownLaws::end);
  EXPECT_EQ(all["horizon"]["engine"], "fast");
  EXPECT_EQ(all["runs"].size(), comparison.runs.size());
  EXPECT_EQ(all["runs"].back()["error"], json({1.0 / 3.0, 5e-324, 1.7976931348623157e308, nullptr, -0.0, nullptr}));
  EXPECT_EQ(all["runs"].back()["counts"]["missed"], 5);
  EXPECT_FALSE(all["runs"].front().contains("counts"));
  EXPECT_EQ(all["summary"].size(), 1U + 7U + 7U + 1U);
  EXPECT_EQ(all["summary"][0]["error_early"]["median"], 1e-15);
  EXPECT_EQ(all["summary"][1]["method"], "grid");
  EXPECT_EQ(all["time_to_Z"].size(), 2U * 5U);  // two accuracies; four methods and Richardson
  // Four methods for each of two errors, and the rows of time_to_Z.
  ASSERT_EQ(all["prices"].size(), 2U * 4U + 2U * 5U);
  const json& price = all["prices"][1];
  EXPECT_EQ(price["method"], "grid");
  EXPECT_EQ(price["target"], "error 1e-6");
  EXPECT_NEAR(price["ratio"].get<double>(), 50.0, 1e-10);
  EXPECT_EQ(price["spread"][0], price["ratio"]);
  EXPECT_EQ(price["spread"][1], price["ratio"]);
  EXPECT_EQ(price["extrapolated"], true);
  EXPECT_TRUE(all["best_fixed_step"].is_null()) << "extrapolated too far";
  EXPECT_EQ(all["plan"]["machine"], "Some Processor");
  EXPECT_EQ(all["left_out"][0]["method"], "guarded");
  EXPECT_EQ(all["left_out"][0]["seconds_predicted"], 1e5);
  EXPECT_EQ(all["costs"][0]["seconds_per_disk_and_free_time"], 2e-9);
}

TEST(CompareCsv, HasOneLinePerRunAndAsManyFieldsInEach) {
  Comparison comparison = KnownLaws{.dts = {0.1}}.comparison();
  comparison.runs.push_back(awkward_run());
  comparison.runs.emplace_back();  // nothing measured
  std::istringstream text(compare_csv(comparison));
  std::string header, line;
  std::getline(text, header);
  EXPECT_EQ(header.substr(0, 14), "method,dt,seed");
  std::size_t lines = 0;
  for (; std::getline(text, line); ++lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::ranges::count(header, ','));
  EXPECT_EQ(lines, comparison.runs.size());
  EXPECT_THAT(
      compare_csv(comparison),
      HasSubstr("fast,0.0,1,8.0,0.0,0.001,1e-15,0.004,8e-15,NaN,10000,1.98,"));  // shortest digits that give the same bits
}

}  // namespace
}  // namespace carom::test
