// Observables from what a run has kept are those of the run itself, to the last bit.

#include "studies/analysis/analysis.hpp"

#include "io/output_error.hpp"
#include "scene/observables_known.hpp"
#include "support/child_process.hpp"
#include "support/recorded_run.hpp"
#include "support/refusal.hpp"
#include "support/same_measurements.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string fluid_of_one_kind = R"(
[box]
aspect = 1.0
boundary = "periodic"
[[disks]]
count = 60
radius = 0.5
mass = 1.5
packing_fraction = 0.5
positions = "random"
velocities = { temperature = 2.0 }
)";

const std::string mixture_between_walls = R"(
[box]
x = [0.0, 9.0]
y = [0.0, 7.0]
boundary = { x = "periodic", y = "walls" }
[[disks]]
name = "big"
count = 12
radius = 0.5
mass = 2.0
positions = "random"
velocities = { temperature = 1.0 }
[[disks]]
name = "small"
count = 20
radius = 0.3
mass = 0.5
positions = "random"
velocities = { temperature = 2.0 }
)";

/// Steps are multiples of 0.1, though 3 * 0.1 is not the double 0.3.
const std::string of_states =
    "temperature = { every = 0.1 }\nspeeds = { every = 0.3 }\nvelocity_moments = { every = 0.2 }\ndensity_profile = { every = "
    "0.7 "
    "}\n"
    "h_function = { every = 0.3 }\npressure = { every = 0.3 }\ncollision_rate = { every = 0.6 }\n";
const std::string of_structure =
    "radial_distribution = { every = 0.3, range = 2.0 }\nstructure_factor = { every = 1.0 }\nvoronoi = { every = 1.0 }\nclusters "
    "= { every = 0.5 }\nintermediate_scattering = { every = 0.1, k = [2.5, 6.3] }\nhexatic = { every = 0.5, range = "
    "2.0 "
    "}\n";
const std::string of_motion =
    "mean_square_displacement = { every = 0.1 }\noverlap = { every = 0.1 }\nnon_gaussian = { every = 0.2 }\nvan_hove = { every = "
    "0.2 }\nvelocity_autocorrelation = { every = 0.3 }\n";
const std::string of_contacts = "contact_values = { every = 0.3 }\n";
const std::string of_collisions = "free_flight = true\nviscosity = { every = 0.07 }\nheat_conductivity = true\n";

struct Kept {
  const char* name;
  std::string scene;  ///< all but [run] and [output]
  std::string run = "time = 12.0\nsample_every = 0.1\n";
};

void PrintTo(const Kept& kept, std::ostream* out) { *out << kept.name; }

std::string scene_text(const Kept& kept) { return kept.scene + "[run]\n" + kept.run + "[output]\nevents = true\n"; }

std::vector<Kept> kept_runs() {
  const std::string specular = "[collision]\nrule = \"specular\"\n";
  const std::string fluid = fluid_of_one_kind + specular, mixture = mixture_between_walls + specular;
  const auto observing = [](const std::string& what) { return "[observe]\n" + what; };
  return {
      {"fluid", fluid + observing(of_states + of_structure + of_motion + of_contacts + of_collisions)},
      {"equilibrated", fluid + observing(of_states + of_motion + of_collisions),
       "time = 12.0\nsample_every = 0.1\nequilibrate = { collisions_per_disk = 3 }\n"},
      {"ends_by_collisions", fluid + observing(of_states + of_motion + of_collisions), "collisions = 1777\nsample_every = 0.1\n"},
      {"blocks",
       fluid +
           observing("temperature = { every = 3.0 }\nradial_distribution = { every = 6.0, range = 2.0 }\nfree_flight = true\n"),
       "time = 60.0\nsample_log = { base = 1.7, per_block = 7, block = 3.0 }\n"},
      {"events_alone", fluid + observing(of_collisions), "time = 12.0\n"},
      {"counted", fluid + observing(of_collisions), "time = 12.0\nsample_every = { collisions = 100 }\n"},
      {"reversal",
       fluid_of_one_kind + "[collision]\nrule = \"reversal\"\n" + observing(of_states + of_motion + "free_flight = true\n")},
      {"mixture", mixture + observing(of_states + of_motion + "free_flight = true\nwall_fluxes = { every = 0.3 }\n")},
      {"gravity", mixture + "[gravity]\nacceleration = [0.0, -0.5]\n" +
                      observing(of_states + of_motion + "free_flight = true\nwall_fluxes = { every = 0.3 }\n")},
      {"rough", mixture_between_walls + "[collision]\nrule = \"specular\"\nroughness = 0.5\nrestitution = 0.95\n" +
                    observing(of_states + of_motion + "free_flight = true\n")},
      {"changed", mixture + observing(of_states + of_motion + "free_flight = true\nwall_fluxes = { every = 0.3 }\n") +
                      "[[changes]]\ntime = 3.05\nscale_velocities = 2.0\n[[changes]]\ntime = 7.0\nset = "
                      "[\"gravity.acceleration=[0,-0.5]\"]\n"},
      {"walls_that_do_something",
       mixture + "[walls]\ntop = { velocity = 0.05 }\nbottom = { temperature = 3.0 }\n" +
           observing("temperature = { every = 0.1 }\npressure = { every = 0.3 }\nwall_fluxes = { every = 0.3 }\n")},
      {"fields_between_walls_that_have_moved",
       mixture + "[walls]\ntop = { velocity = 0.05 }\n" +
           observing("fields = { every = 0.3 }\ndensity_profile = { every = 0.7 }\n"),
       "time = 12.0\nsample_every = 0.1\nequilibrate = { time = 5.0 }\n"},
      {"fields_where_a_well_is_changed",
       fluid + observing("fields = { every = 0.1 }\n") +
           "[[changes]]\ntime = 3.0\nset = [\"square_well.width=1.5\", \"square_well.depth=0.7\"]\n[[changes]]\ntime = 7.05\n"
           "set = [\"square_well.depth=0.2\"]\n"},
      {"fields_of_rough_disks_made_faster", mixture_between_walls + "[collision]\nrule = \"specular\"\nroughness = 0.5\n" +
                                                observing("fields = { every = 0.3 }\n") +
                                                "[[changes]]\ntime = 3.05\nscale_velocities = 2.0\n"},
      {"thermostat", fluid + "[thermostat]\ntemperature = 1.0\nrate = 0.5\n" + observing(of_states + of_structure + of_motion)},
      {"growth", fluid + "[growth]\nrate = 0.005\n" + observing("temperature = { every = 0.1 }\npressure = { every = 0.3 }\n")},
      {"shear", fluid + "[shear]\nrate = 0.1\n" +
                    observing("temperature = { every = 0.1 }\npressure = { every = 0.3 }\nvoronoi = { every = 1.0 }\n")},
      {"well", fluid + "[square_well]\nwidth = 1.5\ndepth = 0.5\n" +
                   observing(of_states + of_motion + of_contacts + "free_flight = true\n")},
      {"obstacle", mixture + "[[obstacles]]\nsegment = { from = [2.0, 1.0], to = [2.0, 2.0] }\n" +
                       observing(of_states + of_motion + "free_flight = true\n")},
  };
}

class Analysed : public ::testing::TestWithParam<Kept> {
 protected:
  TemporaryDirectory directory_;
  fs::path run_ = directory_.path() / "run";
};

TEST_P(Analysed, WhatARunHasKeptGivesWhatTheRunHasMeasured) {
  Scene scene = parse_scene(scene_text(GetParam()), "kept");
  const RunReport report = record(scene, run_);
  ASSERT_GT(report.totals.pair, 200U);
  ASSERT_FALSE(report.observables.empty());
  const Analysis analysis = analyse(run_, {});
  expect_same_measurements(analysis.observables, report.observables);
  EXPECT_EQ(analysis.samples, report.samples);
}

/// Nothing of the run but its files may matter.
TEST_P(Analysed, WhetherTheRunMeasuredItOrNot) {
  Scene scene = parse_scene(scene_text(GetParam()), "kept");
  Simulation simulation = make_simulation(scene);
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach(hooks);
  run_schedule(simulation, hooks);
  const std::vector<ObservableRequest> asked = scene.observe;
  scene.observe.clear();
  record(scene, run_);
  std::vector<std::string> words;
  for (const ObservableRequest& request : asked) {
    std::string settings = request.every ? "every = " + std::to_string(*request.every) + ", " : "";
    if (request.range)
      settings += std::string(detail::find_observable(request.name)->range_key) + " = " + std::to_string(*request.range) + ", ";
    if (!request.wave_numbers.empty()) settings += fmt::format("k = [{}], ", fmt::join(request.wave_numbers, ", "));
    if (!settings.empty()) settings.resize(settings.size() - 2);
    words.push_back(request.name + (settings.empty() ? "" : "={ " + settings + " }"));
  }
  expect_same_measurements(analyse(run_, words).observables, observation.results());
}

INSTANTIATE_TEST_SUITE_P(All, Analysed, ::testing::ValuesIn(kept_runs()),
                         [](const auto& kept) { return std::string(kept.param.name); });

class Analysis : public ::testing::Test {
 protected:
  void record_fluid(const std::string& run = "time = 5.0\nsample_every = 0.1\n", bool events = true) {
    record(parse_scene(fluid_of_one_kind + "[collision]\nrule = \"specular\"\n[run]\n" + run +
                       "[output]\nevents = " + (events ? "true" : "false") + "\n"),
           run_);
  }
  template <class Error>
  [[nodiscard]] std::string refusal(const std::vector<std::string>& observables) const {
    return test::refusal<Error>([&] { return analyse(run_, observables); });
  }

  TemporaryDirectory directory_;
  fs::path run_ = directory_.path() / "run";
};

TEST_F(Analysis, TakesTheNearestStepThatTheRunHas) {
  record_fluid();
  const carom::Analysis analysis = analyse(run_, {"temperature", "pressure", "mean_square_displacement"});
  ASSERT_EQ(analysis.scene.observe.size(), 3U);
  for (const ObservableRequest& request : analysis.scene.observe) EXPECT_EQ(request.every, 0.1) << request.name;
}

TEST_F(Analysis, WithoutCollisionsGivesWhatNeedsNone) {
  record_fluid("time = 5.0\nsample_every = 0.1\n", false);
  const carom::Analysis analysis = analyse(run_, {"pressure", "velocity_autocorrelation"});
  const std::vector<Scalar>& pressure = analysis.observables.at(0).scalars;
  EXPECT_TRUE(pressure.at(0).value) << "Z comes from the virial up to each sample";
  EXPECT_FALSE(pressure.back().value);
  EXPECT_EQ(pressure.back().note, "the run kept no collisions (--events)");
  EXPECT_TRUE(analysis.observables.at(1).scalars.empty());
  EXPECT_THAT(refusal<std::invalid_argument>({"viscosity"}), StartsWith("viscosity follows collisions, and the run kept none"));
}

TEST_F(Analysis, WithoutSamplesCountsTheCollisionsOfTheLog) {
  const Scene scene = parse_scene(fluid_of_one_kind +
                                  "[collision]\nrule = \"specular\"\n[run]\ntime = 5.0\n[output]\nevents = true\n"
                                  "[observe]\nfree_flight = true\nviscosity = true\n");
  const std::vector<Measurement> measured = record(scene, run_).observables;
  const std::vector<Measurement> analysed = analyse(run_, {"free_flight", "viscosity"}).observables;
  ASSERT_EQ(analysed.size(), measured.size());
  for (std::size_t k = 0; k < measured.size(); ++k) EXPECT_EQ(analysed[k].note, measured[k].note);
}

TEST_F(Analysis, WithoutSamplesRefusesWhatLooksAtStates) {
  for (const bool sampled : {false, true}) {
    record(parse_scene(fluid_of_one_kind + "[collision]\nrule = \"specular\"\n[run]\ntime = 5.0\n" +
                       (sampled ? "sample_every = 0.1\n" : "") + "[output]\nevents = true\ntrajectory = false\n"),
           run_);
    EXPECT_THAT(refusal<std::invalid_argument>({"temperature"}),
                StartsWith("temperature needs states, and the run kept no samples"));
    fs::remove_all(run_);
  }
}

TEST_F(Analysis, OfWhatTheRunMeasuredLeavesWorkOut) {
  const auto record_with = [&](const std::string& observe) {
    record(parse_scene(fluid_of_one_kind +
                       "[collision]\nrule = \"specular\"\n[run]\ntime = 5.0\nsample_every = 0.1\n[observe]\n" + observe),
           run_);
  };
  record_with("work = true\ntemperature = { every = 0.1 }\n");
  const carom::Analysis analysis = analyse(run_, {});
  ASSERT_EQ(analysis.observables.size(), 1U);
  EXPECT_EQ(analysis.observables[0].name, "temperature");
  EXPECT_THAT(refusal<std::invalid_argument>({"work"}), StartsWith("work and heat are measured while the scene runs"));
  fs::remove_all(run_);
  record_with("work = true\n");
  EXPECT_THAT(refusal<std::invalid_argument>({}), StartsWith("work and heat are measured while the scene runs"));
}

TEST_F(Analysis, RefusesWhatTheRunHasNot) {
  record_fluid();
  EXPECT_THAT(refusal<std::invalid_argument>({}), HasSubstr("has no [observe] table"));
  EXPECT_THAT(refusal<std::invalid_argument>({"temperature={ every = 0.25 }"}),
              StartsWith("temperature asks for states every 0.25, and the run has them every 0.1"));
  EXPECT_THAT(refusal<std::invalid_argument>({"temperature={ every = 0.01 }"}), HasSubstr("take a multiple of that"));
  EXPECT_THAT(refusal<SceneError>({"presure"}), HasSubstr("did you mean \"pressure\"?"));
  EXPECT_THAT(refusal<SceneError>({"wall_fluxes"}), HasSubstr("this box is periodic"));
  run_ = directory_.path() / "nowhere";
  EXPECT_THAT(refusal<OutputError>({"pressure"}), AllOf(HasSubstr("nowhere"), HasSubstr("there is no such directory")));
}

TEST_F(Analysis, SamplesCountedInCollisionsAreNoAverageOverTime) {
  record_fluid("time = 5.0\nsample_every = { collisions = 50 }\n");
  EXPECT_THAT(refusal<std::invalid_argument>({"temperature"}), StartsWith("temperature is an average over time"));
}

/// Adding some box lengths and taking them away again rounds.
TEST_F(Analysis, UnwrappedPositionsGiveTheSameToRounding) {
  Scene scene = parse_scene(fluid_of_one_kind +
                            "[collision]\nrule = \"specular\"\n[run]\ntime = 20.0\nsample_every = 0.1\n[output]\n"
                            "unwrapped = true\n[observe]\nmean_square_displacement = { every = 0.1 }\n");
  const RunReport report = record(scene, run_);
  const carom::Analysis analysis = analyse(run_, {});
  const std::vector<double>&expected = report.observables.at(0).tables.at(0).columns.at(1).values,
        &found = analysis.observables.at(0).tables.at(0).columns.at(1).values;
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t r = 0; r < found.size(); ++r) EXPECT_NEAR(found[r], expected[r], 1e-13 * (1.0 + expected[r]));
}

}  // namespace
}  // namespace carom::test
