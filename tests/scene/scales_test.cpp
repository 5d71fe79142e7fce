// Numbers so large or small that arithmetic would not stand them are refused, and numbers within a hundredth of that are not.
// Where the limits are is worked out here by hand, from what follows from each number: speeds times lengths between 1e-150 and
// 1e150, at most 2^53 passes, kicks and samples, places to a thousandth of the smallest radius.

#include "support/refusal.hpp"

#include <carom/scene.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Five disks of radius 1/32 and mass 1 in [-1, 1] x [-1, 1]; they move at 1.
std::string refusal_of(const std::string& boundary, const std::string& run, const std::vector<std::string>& overrides) {
  const std::string text =
      "[box]\nx = [-1.0, 1.0]\ny = [-1.0, 1.0]\nboundary = \"" + boundary +
      "\"\n[[disks]]\ncount = 5\nradius = 0.03125\nmass = 1.0\npositions = \"random\"\nvelocities = { speed = 1.0 }\n"
      "[collision]\nrule = \"specular\"\n[run]\n" +
      run + "\n";
  return refusal<SceneError>([&] { return parse_scene(text, "scene", overrides); });
}

const std::string by_collisions = "collisions = 1000", for_a_while = "time = 4.0";

/// `override` has {} where the number stands; numbers beyond `limit` (its size) are refused.
void expect_most(const std::string& boundary, const std::string& run, const std::string& override, double limit,
                 const char* why) {
  const auto with = [&](double value) { return refusal_of(boundary, run, {fmt::format(fmt::runtime(override), value)}); };
  EXPECT_THAT(with(0.99 * limit), IsEmpty()) << override;
  EXPECT_THAT(with(1.01 * limit), HasSubstr(why)) << override;
}
void expect_least(const std::string& boundary, const std::string& run, const std::string& override, double limit,
                  const char* why) {
  const auto with = [&](double value) { return refusal_of(boundary, run, {fmt::format(fmt::runtime(override), value)}); };
  EXPECT_THAT(with(1.01 * limit), IsEmpty()) << override;
  EXPECT_THAT(with(0.99 * limit), HasSubstr(why)) << override;
}

TEST(Scales, SpeedsThatEffectsGiveStayInRange) {
  const char* fast = "and speed times the length of the box, 2, must stay below 1e+150";
  const char* slow = "and speed times the smallest radius, 0.03125, must stay above 1e-150";
  const double most = 1e150 / 2.0, least = 1e-150 * 32.0;
  expect_most("walls", by_collisions, "walls.top={{ velocity = -{:e} }}", most, fast);
  expect_least("walls", by_collisions, "walls.top={{ velocity = {:e} }}", least, slow);
  expect_most("walls", by_collisions, "walls.top={{ temperature = {:e} }}", most * most, fast);  // v^2 = kT / m
  expect_least("walls", by_collisions, "walls.top={{ temperature = {:e} }}", least * least, slow);
  expect_most("walls", by_collisions, "walls.top={{ mass = 2.0, load = {:e} }}", most * most / 8.0, fast);  // m v^2 / 2 = 4 load
  expect_most("walls", by_collisions, "walls.top={{ mass = 0.25, load = {:e} }}", most * most / 32.0, fast);
  expect_most("walls", by_collisions, "gravity.acceleration=[0.0, -{:e}]", most * most / 4.0, fast);  // v^2 = 2 g 2
  expect_most("periodic", by_collisions, "disks.0.velocities={{ temperature = {:e} }}", most * most, fast);
  expect_most("periodic", by_collisions, "growth={{ rate = {:e}, until = {{ pressure = 10.0 }} }}", most / 2.0, fast);
  expect_most("periodic", by_collisions, "thermostat={{ temperature = {:e}, rate = 1.0 }}", most * most, fast);
  expect_least("periodic", by_collisions, "thermostat={{ temperature = {:e}, rate = 1e-150 }}", least * least, slow);
  expect_most("periodic", by_collisions, "shear.rate=-{:e}", most / 2.0, fast);
  expect_most("periodic", by_collisions, "square_well={{ width = 1.5, depth = {:e} }}", most * most / 4.0,
              fast);  // v^2 = 2 d / (1/2)
  expect_most("periodic", by_collisions, "square_well={{ width = 1.5, depth = -{:e} }}", most * most / 4.0, fast);
}

TEST(Scales, RangesAreThoseOfAllDisks) {
  const char* fast = "must stay below 1e+150";
  EXPECT_THAT(refusal_of("walls", by_collisions, {"walls.top={ temperature = 1e200 }"}), IsEmpty());
  EXPECT_THAT(refusal_of("walls", by_collisions, {"walls.top={ temperature = 1e200 }", "disks.0.mass=1e-140"}), HasSubstr(fast));
  EXPECT_THAT(refusal_of("walls", by_collisions, {"walls.top={ temperature = 1e200 }", "disks.0.mass=1e140"}), IsEmpty());
}

TEST(Scales, RangesAreNotThoseOfSpeciesWithoutDisks) {
  const auto beside = [](int count) {
    return fmt::format(
        "disks=[{{ count = 5, radius = 0.03125, mass = 1.0, positions = \"random\", velocities = {{ speed = 1.0 }} }}, "
        "{{ count = {}, radius = 0.03125, mass = 1e-140, positions = \"random\", velocities = {{ speed = 1.0 }} }}]",
        count);
  };
  const std::string hot = "walls.top={ temperature = 1e200 }";
  EXPECT_THAT(refusal_of("walls", by_collisions, {beside(0), hot}), IsEmpty());
  EXPECT_THAT(refusal_of("walls", by_collisions, {beside(1), hot}), HasSubstr("must stay below 1e+150"));
}

TEST(Scales, RunsThatTimeAloneEndsCanBeComputed) {
  const char* passes = "and more than 2^53 times cannot be computed";
  const double most = 0x1p53 * 2.0 / 4.0;  // passes of a box of 2 until time 4
  expect_most("walls", for_a_while, "walls.top={{ temperature = {:e} }}", most * most, passes);
  expect_most("walls", for_a_while, "walls.top={{ mass = 2.0, load = {:e} }}", most * most / 8.0, passes);
  expect_most("walls", for_a_while, "gravity.acceleration=[0.0, -{:e}]", most * most / 4.0, passes);
  expect_most("periodic", for_a_while, "thermostat={{ temperature = {:e}, rate = 1.0 }}", most * most, passes);
  expect_most("periodic", for_a_while, "shear.rate={:e}", most / 2.0, passes);
  expect_most("periodic", for_a_while, "square_well={{ width = 1.5, depth = {:e} }}", most * most / 4.0, passes);
  EXPECT_THAT(refusal_of("periodic", for_a_while + "\ncollisions = 5", {"shear.rate=1e100"}), IsEmpty());  // may end by these
}

TEST(Scales, WallsThatRunAwayStayWhereDoublesTellTheDisks) {
  const char* far = "and positions must be resolved to a thousandth of the smallest radius, 0.03125";
  const double reach = 1e-3 * 0x1p52 / 32.0;
  expect_most("walls", for_a_while, "walls.top={{ velocity = {:e} }}", reach / 4.0, far);
  expect_most("walls", for_a_while, "walls.left={{ velocity = -{:e} }}", reach / 4.0, far);
  expect_most("walls", "time = 4.0\nequilibrate = { time = 12.0 }", "walls.top={{ velocity = {:e} }}", reach / 16.0, far);
  expect_most("walls", by_collisions, "walls.top={{ velocity = {:e} }}", reach * 32.0,
              far);  // a disk moves by its radius in 1/32
}

TEST(Scales, CoordinatesTellTheDisks) {
  const char* far = "move the box to the origin, make it smaller, or disks larger";
  const double reach = 1e-3 * 0x1p52 / 32.0;
  expect_most("periodic", by_collisions, "box.x=[0.0, {:e}]", reach, far);
  expect_most("periodic", by_collisions, "box.y=[-{:e}, 0.0]", reach, far);
  expect_least("periodic", by_collisions, "disks.0.radius={:e}", 1e3 * 0x1p-52, far);
}

TEST(Scales, PistonsAreNotTooLightToTurnADisk) {
  expect_least("walls", by_collisions, "walls.top={{ mass = {:e}, load = 1.0 }}", 0x1p-53,
               "and more than 2^53 times cannot be computed");
  EXPECT_THAT(refusal_of("walls", by_collisions, {"walls.top={ mass = 1e-100, load = 0.0 }"}), IsEmpty());
}

TEST(Scales, MassesHaveProducts) {
  const char* why = "or its inverse would lose digits";
  expect_most("walls", by_collisions, "disks.0.mass={:e}", 1e300, why);
  expect_least("walls", by_collisions, "disks.0.mass={:e}", 1e-300, why);
  expect_least("walls", by_collisions, "walls.top={{ mass = {:e}, load = 0.0 }}", 1e-300, why);
}

TEST(Scales, ThermostatsLetDisksMove) {
  // A disk moves at 1 / 2 from kick to kick: 2^-50 of its radius.
  expect_most("periodic", by_collisions, "thermostat={{ temperature = 0.25, rate = {:e} }}", 0.5 * 0x1p55,
              "less than coordinates resolve");
  expect_most("periodic", for_a_while, "thermostat={{ temperature = 0.25, rate = {:e} }}", 0x1p53 / 20.0,
              "and there can be at most 2^53");
}

TEST(Scales, SamplesCanBeCounted) {
  for (const std::string key : {"run.sample_every={:e}", "observe.temperature={{ every = {:e} }}",
                                "run.sample_log={{ base = 2.0, per_block = 2, block = {:e} }}"}) {
    const double per_step = key.starts_with("run.sample_log") ? 2.0 : 1.0;
    expect_least("periodic", for_a_while, key, per_step * 4.0 / 0x1p53, "there can be at most 2^53");
    expect_least("periodic", by_collisions, key, 0x1p-55, "less than coordinates resolve");
  }
}

TEST(Scales, AnythingGoesWhereNothingIsThere) {
  EXPECT_THAT(refusal_of("walls", for_a_while, {"disks=[]", "walls.top={ velocity = 1e300 }", "box.x=[0.0, 1e15]"}), IsEmpty());
}

/// The numbers of the table in docs/scene-format.md.
TEST(Scales, AreWhatTheDocumentationSays) {
  const auto in_the_example = [](const std::string& boundary, const std::string& change) {
    return refusal_of(boundary, by_collisions, {"disks.0.radius=0.03", change});
  };
  const struct {
    const char* boundary;
    const char* change;
    double limit;
  } rows[] = {{"walls", "walls.top={{ temperature = {:e} }}", 2.5e299},
              {"walls", "walls.top={{ mass = 1.0, load = {:e} }}", 3.1e298},
              {"walls", "gravity.acceleration=[0.0, -{:e}]", 6.2e298},
              {"periodic", "shear.rate={:e}", 2.5e149},
              {"periodic", "growth={{ rate = {:e}, until = {{ pressure = 10.0 }} }}", 2.5e149},
              {"periodic", "square_well={{ width = 1.5, depth = {:e} }}", 6.2e298},
              {"periodic", "thermostat={{ temperature = 1.0, rate = {:e} }}", 3.8e16},
              {"periodic", "box.x=[0.0, {:e}]", 1.4e11}};
  for (const auto& row : rows) {
    EXPECT_THAT(in_the_example(row.boundary, fmt::format(fmt::runtime(row.change), 0.96 * row.limit)), IsEmpty()) << row.change;
    EXPECT_NE(in_the_example(row.boundary, fmt::format(fmt::runtime(row.change), 1.04 * row.limit)), "") << row.change;
  }
}

}  // namespace
}  // namespace carom::test
