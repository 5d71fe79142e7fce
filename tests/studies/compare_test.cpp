// The study of methods on a dozen disks: what it runs, what it may leave out, and that it goes on where it was stopped.

#include "studies/compare/compare.hpp"

#include "scene/drawn.hpp"
#include "studies/compare/answers.hpp"
#include "studies/compare/files.hpp"
#include "studies/compare/reference.hpp"
#include "studies/horizon/event_rates.hpp"
#include "support/comparisons.hpp"
#include "support/refusal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

using Key = std::tuple<std::string, double, std::uint64_t>;

Key key_of(const MethodRun& run) { return {run.method.name, run.method.dt, run.seed}; }

const MethodRun& run_of(const Comparison& comparison, const std::string& name, double dt, std::uint64_t seed) {
  for (const MethodRun& run : comparison.runs)
    if (key_of(run) == Key{name, dt, seed}) return run;
  throw std::runtime_error("there is no run of " + name);
}

/// The plan alone.
ComparePlan plan_of(const Scene& scene, const CompareOptions& options = dozen_options()) {
  bool planned = false;
  CompareHooks hooks;
  hooks.planned = [&](const ComparePlan&, const State&) { planned = true; };
  hooks.proceed = [&](const std::string&, double) { return !planned; };
  const Comparison comparison = compare(scene, options, hooks);
  EXPECT_TRUE(planned);
  EXPECT_FALSE(comparison.complete);
  return comparison.plan;
}

TEST(Compare, HoldsEveryMethodAgainst113BitsFromEveryStart) {
  const Comparison comparison = compare(dozen_scene(), dozen_options(), {});
  EXPECT_TRUE(comparison.complete);
  EXPECT_TRUE(comparison.left_out.empty());
  std::multiset<Key> expected, found;
  for (const std::uint64_t seed : {1U, 2U}) {
    for (const char* engine : {"textbook-float", "textbook", "fast", "textbook-long-double"}) expected.emplace(engine, 0.0, seed);
    for (const double dt : {0.02, 0.01, 0.005})
      for (const char* method : {"naive", "guarded", "grid", "backtrack", "swept", "soft"})
        expected.emplace(method, dt, seed);  // walls alone need naive-edge
  }
  for (const MethodRun& run : comparison.runs) found.insert(key_of(run));
  EXPECT_EQ(found, expected);

  const ComparePlan& plan = comparison.plan;
  EXPECT_EQ(plan.sigma, 1.0);
  EXPECT_NEAR(plan.temperature, 1.0, 1e-13);  // met by the draw, to the rounding of 12 sums of squares
  EXPECT_EQ(plan.thermal_speed, std::sqrt(plan.temperature));
  for (const MethodRun& run : comparison.runs) {
    SCOPED_TRACE(run.method.name);
    EXPECT_EQ(run.error.size(), plan.samples);
    EXPECT_EQ(run.time, static_cast<double>(plan.samples) * plan.sample_step);
    EXPECT_GT(run.seconds, 0.0);
    EXPECT_GE(run.seconds, run.seconds_early);
    EXPECT_GE(run.setup_seconds, 0.0);
    const bool is_looked_at = !run.method.exact() && run.seed == 1;
    EXPECT_EQ(run.counts.has_value(), is_looked_at && !finds_contacts(run.method.name) && run.method.name != "soft");
    EXPECT_EQ(run.mistakes.has_value(), is_looked_at && finds_contacts(run.method.name));
    EXPECT_EQ(run.collision_rate, 2.0 * static_cast<double>(run.pair) / (12.0 * counted_time(run.method, run.time)));
  }
  for (const std::uint64_t seed : {1U, 2U}) {
    const auto error = [&](const std::string& name) { return run_of(comparison, name, 0.0, seed).error[plan.early - 1]; };
    EXPECT_GT(error("textbook-float"), 1e3 * error("textbook"));         // 2^29 apart
    EXPECT_GT(error("textbook"), 10.0 * error("textbook-long-double"));  // 2^11 apart
    for (const double dt : {0.02, 0.01, 0.005})
      EXPECT_EQ(run_of(comparison, "grid", dt, seed).error, run_of(comparison, "guarded", dt, seed).error);
  }
}

TEST(Compare, GoesOnWhereItWasStoppedAndComputesNothingTwice) {
  const CompareOptions options = dozen_options({0.02}, 2, "textbook");
  const Comparison whole = compare(dozen_scene(), options, {});
  constexpr std::size_t stop_after = 8;  // within the second start, of six runs each
  std::vector<Key> done;
  CompareHooks hooks;
  hooks.run_done = [&](const MethodRun& run) { done.push_back(key_of(run)); };
  hooks.proceed = [&](const std::string&, double) { return done.size() < stop_after; };
  const Comparison stopped = compare(dozen_scene(), options, hooks);
  EXPECT_FALSE(stopped.complete);
  ASSERT_EQ(stopped.runs.size(), stop_after);
  Comparison kept;
  kept.runs = stopped.runs;
  hooks.proceed = {};
  const Comparison resumed = compare(dozen_scene(), options, hooks, kept);
  EXPECT_TRUE(resumed.complete);
  EXPECT_EQ(done.size(), whole.runs.size());
  EXPECT_EQ(std::set<Key>(done.begin(), done.end()).size(), done.size());
  ASSERT_EQ(resumed.runs.size(), whole.runs.size());
  for (std::size_t k = 0; k < whole.runs.size(); ++k) {
    EXPECT_EQ(key_of(resumed.runs[k]), key_of(whole.runs[k]));
    EXPECT_EQ(resumed.runs[k].error, whole.runs[k].error);
    EXPECT_EQ(resumed.runs[k].Z, whole.runs[k].Z);
  }
}

TEST(Compare, OfASceneThatDrawsNothingOneStartIsRunAndNoErrorGiven) {
  Scene scene = dozen_scene();
  const State start = make_simulation(scene).state();
  ListedPositions places;
  ListedVelocities velocities;
  for (Eigen::Index i = 0; i < start.positions.cols(); ++i) {
    places.values.push_back(start.positions.col(i));
    velocities.values.push_back(start.velocities.col(i));
  }
  scene.species.front().velocities = velocities;
  EXPECT_EQ(plan_of(scene).seeds.size(), 2U) << "random places are drawn";
  scene.species.front().positions = places;
  const Comparison comparison = compare(scene, dozen_options({0.02}, 2, "textbook"), {});
  EXPECT_EQ(comparison.plan.seeds, std::vector<std::uint64_t>{scene.run.seed});
  EXPECT_FALSE(comparison.plan.drawn);
  for (const MethodSummary& summary : summaries_of(comparison)) {
    ASSERT_TRUE(summary.Z);
    EXPECT_TRUE(std::isnan(summary.Z->error));
  }
  const Answers answers = answers_of(comparison);
  EXPECT_TRUE(answers.time_to_Z.empty());
  EXPECT_THAT(answers.sentences.back(), testing::HasSubstr("There is one start, and a bias has no error bar"));
  EXPECT_THAT(compare_json(comparison, scene, "carom"), testing::HasSubstr("\"drawn\": false"));
  scene.species.front().velocities = MaxwellVelocities{1.0};
  EXPECT_EQ(plan_of(scene).seeds.size(), 2U) << "velocities are drawn";
  scene.species.front().velocities = MaxwellVelocities{0.0};
  EXPECT_FALSE(start_is_drawn(scene)) << "no temperature is rest";
}

TEST(Compare, ARunThatWouldTakeTooLongIsLeftOutByName) {
  CompareOptions options = dozen_options({0.01, 1e-9}, 1, "textbook");
  options.longest = 0.05;
  const Comparison comparison = compare(dozen_scene(), options, {});
  EXPECT_TRUE(comparison.complete);
  ASSERT_EQ(comparison.left_out.size(), 6U);  // a billion steps per time
  for (const LeftOut& one : comparison.left_out) {
    EXPECT_EQ(one.method.dt, 1e-9);
    EXPECT_GT(one.seconds, 0.05);
  }
  EXPECT_EQ(comparison.runs.size(), 3U + 6U);
}

TEST(Compare, AStepIsPaidWhole) {
  EXPECT_EQ(end_of_step({"fast"}, 1.7), 1.7);
  EXPECT_EQ(end_of_step({"swept", 2.5}, 1.7), 2.5);
  EXPECT_EQ(end_of_step({"swept", 0.5}, 1.7), 2.0);
  EXPECT_EQ(end_of_step({"swept", 0.5}, 2.0), 2.0);
  EXPECT_NEAR(end_of_step({"swept", 0.1}, 0.3), 0.3, 1e-15);  // 3 * 0.1 to rounding: no fourth step
}

TEST(Compare, WallsAddTheNaiveMethodThatMeetsThemAtTheEdge) {
  const Comparison comparison = compare(dozen_scene(Boundary::walls), dozen_options({0.01}, 1, "textbook"), {});
  std::set<std::string> names;
  for (const MethodRun& run : comparison.runs) names.insert(run.method.name);
  EXPECT_EQ(names, (std::set<std::string>{"textbook-float", "textbook", "textbook-long-double", "naive", "naive-edge", "guarded",
                                          "grid", "backtrack", "swept", "soft"}));
}

TEST(Compare, TakesErrorsOnTheScenesOwnSamplesWhereItHasSome) {
  Scene scene = dozen_scene();
  scene.run.sample_every = 0.0625;
  const ComparePlan plan = plan_of(scene);
  const double thinned = plan.sample_step / 0.0625;
  EXPECT_EQ(thinned, std::nearbyint(thinned));
  EXPECT_GE(thinned, 1.0);
  EXPECT_LE(plan.samples, 100U);
  EXPECT_LE(plan.until(), 10.0);
  EXPECT_GE(plan.early, 1U);
  EXPECT_LE(plan.early, plan.samples);
  scene.run.sample_every = 5.0;  // two samples show no growth
  EXPECT_EQ(plan_of(scene).samples, 100U);
}

TEST(Compare, EndsAtTheScenesOwnEndAndOtherwiseAQuarterBeyondTheHorizon) {
  Scene scene = dozen_scene();
  scene.run.time = 0.5;
  const ComparePlan brief = plan_of(scene);
  EXPECT_NEAR(brief.until(), 0.5, 1e-14);  // a hundred steps of a hundredth, each rounded once
  scene.run.time = 1e6;
  const ComparePlan plan = plan_of(scene);
  const HorizonRow* row = plan.horizon.row("fast");
  ASSERT_TRUE(row != nullptr && row->time);
  EXPECT_NEAR(plan.until(), 1.25 * *row->time, 1e-14 * plan.until());
  EXPECT_NEAR(plan.early_time(), *row->time / 16.0, 0.5 * plan.sample_step * (1.0 + 1e-12));  // the sample nearest to it
}

TEST(Compare, TheUsualStepsFallThreePerDecadeFromTwoFreeTimes) {
  CompareOptions options = dozen_options();
  options.dts.clear();
  const ComparePlan plan = plan_of(dozen_scene(), options);
  ASSERT_EQ(plan.dts.size(), 21U);
  for (std::size_t k = 0; k + 3 < plan.dts.size(); ++k) EXPECT_NEAR(plan.dts[k] / plan.dts[k + 3], 10.0, 1e-13);  // rounding
  EXPECT_NEAR(plan.in_free_times(plan.dts[1]), 1.0, 1e-15);
  EXPECT_EQ(plan_of(dozen_scene(), options).dts, plan.dts);  // to the last bit: a study that goes on finds its points by them
  options.dts = {0.01, 0.04, 0.02};
  EXPECT_EQ(plan_of(dozen_scene(), options).dts, (std::vector<double>{0.04, 0.02, 0.01}));
}

TEST(Compare, OfASceneWithGravityAndRestitutionEnergyShowsALateContactAndAMethodThatCannotRunItIsNamed) {
  Scene scene = dozen_scene(Boundary::walls);
  scene.effects.collision.restitution = 0.8;
  scene.effects.gravity = Gravity{{0.0, -0.5}};
  const Comparison comparison = compare(scene, dozen_options({0.01}, 1, "textbook"), {});
  EXPECT_TRUE(comparison.complete);
  EXPECT_FALSE(comparison.plan.conservative);
  EXPECT_TRUE(comparison.left_out.empty());
  const std::uint64_t seed = comparison.plan.seeds.front();
  const MethodRun& exact = run_of(comparison, "textbook", 0.0, seed);
  const std::size_t early = comparison.plan.early - 1;
  EXPECT_LT(exact.error[early], 1e-13);
  EXPECT_LT(run_of(comparison, "swept", 0.01, seed).error[early], 1e-12);
  EXPECT_GT(run_of(comparison, "grid", 0.01, seed).error[early], 1e-4);
  EXPECT_GT(std::abs(run_of(comparison, "grid", 0.01, seed).energy_drift), 1e-6);
  scene.effects.collision.rule = CollisionRule::reversal;
  const Comparison reversed = compare(scene, dozen_options({0.01}, 1, "textbook"), {});
  ASSERT_EQ(reversed.left_out.size(), 1U);
  EXPECT_EQ(reversed.left_out[0].method.name, "soft");
  EXPECT_THAT(reversed.left_out[0].reason, HasSubstr("the rule \"reversal\""));
  scene.effects.gravity.reset();
  scene.effects.drag = Drag{0.1};
  EXPECT_THROW((void)compare(scene, dozen_options({0.01}, 1, "textbook"), {}), std::invalid_argument);
}

TEST(Compare, AnEngineByNameIsTheOneThatIsCompared) {
  EXPECT_EQ(compared_engines(dozen_scene(), "textbook"),
            (std::vector<std::string>{"textbook-float", "textbook", "textbook-long-double"}));
  EXPECT_EQ(compared_engines(dozen_scene(), "fast"),
            (std::vector<std::string>{"textbook-float", "textbook", "fast", "textbook-long-double"}));
}

TEST(Compare, OfAGasThatCoolsTheEngineThatRunsItIsComparedAndThereIsNoZ) {
  Scene scene = dozen_scene();
  scene.effects.collision.restitution = 0.8;
  const Comparison comparison = compare(scene, dozen_options({0.01}, 1, "auto"), {});
  EXPECT_EQ(comparison.plan.horizon.engine, "general");
  for (const MethodSummary& summary : summaries_of(comparison)) {
    EXPECT_FALSE(summary.Z) << summary.method.name;
    EXPECT_FALSE(summary.Z_bias) << summary.method.name;
  }
  // The rates are those of the start: the gas has not yet lost half of its speed.
  const EventRates rates = measure_event_rates(scene, make_simulation(scene).state());
  scene.effects.collision.restitution.reset();
  const EventRates elastic = measure_event_rates(scene, make_simulation(scene).state());
  EXPECT_GT(rates.collision_rate, 0.5 * elastic.collision_rate);
}

TEST(Compare, ScenesWithoutCollisionsAreRefusedInASentence) {
  const auto sentence = [](const Scene& scene) {
    return refusal<std::invalid_argument>([&] { return compare(scene, dozen_options(), {}); });
  };
  Scene parallel =
      scene_of(box_of(8.0, 8.0, Boundary::periodic),
               {species_of(2, 0.5, 1.0, ListedPositions{{{1.0, 1.0}, {4.0, 4.0}}}, ListedVelocities{{{1.0, 0.0}, {1.0, 0.0}}})});
  parallel.run.time = 1.0;
  Scene alone = parallel;
  alone.species = {species_of(1, 0.5, 1.0, ListedPositions{{{1.0, 1.0}}}, ListedVelocities{{{1.0, 0.0}}})};
  Scene empty = parallel;
  empty.species.clear();
  for (const Scene& scene : {parallel, alone, empty})
    EXPECT_THAT(sentence(scene), HasSubstr("no two disks of this scene collide"));
  Scene at_rest = parallel;
  at_rest.species[0].velocities = AtRest{};
  EXPECT_THAT(sentence(at_rest), HasSubstr("no two disks of this scene collide"));
  at_rest.run.equilibrate = Run::Equilibrate{5.0, std::nullopt};
  EXPECT_THAT(sentence(at_rest), HasSubstr("the scene stops while it equilibrates"));
}

TEST(Reference, DistancesAreThoseOfAPlainLoopOverNearestImages) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::walls}) {
    const Scene scene = dozen_scene(boundary);
    const State start = make_simulation(scene).state();
    const Reference reference(scene, start, 0.5, 4, [] { return true; });
    ASSERT_TRUE(reference.complete());
    Simulation exact = make_simulation(scene, start, "textbook-quad");
    Simulation crude = make_simulation(scene, start, FixedStep{"guarded", 0.05});
    for (std::uint64_t k = 1; k <= 4; ++k) {
      exact.run_until_sample(k, 0.5);
      crude.run_until_sample(k, 0.5);
      const State a = exact.state(), b = crude.state();
      long double squares = 0.0L;
      for (Eigen::Index i = 0; i < 12; ++i) {
        for (Eigen::Index axis = 0; axis < 2; ++axis) {
          long double apart = static_cast<long double>(b.positions(axis, i)) - a.positions(axis, i) - a.remainders(axis, i);
          if (scene.box.periodic(static_cast<int>(axis))) {
            while (apart > 2.5L) apart -= 5.0L;
            while (apart < -2.5L) apart += 5.0L;
          }
          squares += apart * apart;
        }
      }
      const double plain = static_cast<double>(std::sqrt(squares / 12.0L));
      EXPECT_GT(plain, 1e-4);
      // Each difference rounds thrice at 5, by 4.4e-16 each, however small it is itself.
      EXPECT_NEAR(reference.rms_distance(k, b), plain, 2e-15);
      EXPECT_EQ(reference.rms_distance(k, a), 0.0);
    }
    State lost = crude.state();
    lost.positions(0, 3) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(reference.rms_distance(1, lost), std::numeric_limits<double>::infinity());
  }
}

TEST(Reference, IsIncompleteWhereItWasStopped) {
  const Scene scene = dozen_scene();
  int asked = 0;
  const Reference reference(scene, make_simulation(scene).state(), 0.5, 4, [&] { return ++asked < 3; });
  EXPECT_FALSE(reference.complete());
}

}  // namespace
}  // namespace carom::test
