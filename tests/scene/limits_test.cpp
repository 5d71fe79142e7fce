// The last value that a limit of the format allows, and the first that it refuses.

#include "support/refusal.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::string until_4 = "time = 4.0\n";

/// Two species of five disks of radius 1/32 in [-1, 1] x [-1, 1].
std::string limits_text(const std::string& boundary, const std::string& run) {
  const std::string species =
      "[[disks]]\ncount = 5\nradius = 0.03125\nmass = 1.0\npositions = \"random\"\nvelocities = { speed = 1.0 }\n";
  return "[box]\nx = [-1.0, 1.0]\ny = [-1.0, 1.0]\nboundary = \"" + boundary + "\"\n" + species + species +
         "[collision]\nrule = \"specular\"\n[run]\n" + run;
}

std::string limit_refusal(const std::string& boundary, const std::string& run, const std::vector<std::string>& overrides) {
  return refusal<SceneError>([&] { (void)parse_scene(limits_text(boundary, run), "scene", overrides); });
}

/// What a program is told that changes the scene.
std::string limit_refusal(const std::function<void(Scene&)>& change) {
  Scene scene = parse_scene(limits_text("periodic", until_4));
  change(scene);
  return refusal<SceneError>([&] { (void)make_simulation(scene); });
}

std::string steps(int count) {
  std::string list;
  for (int k = 1; k <= count; ++k) list += fmt::format("{{ width = {}, energy = 1.0 }}, ", 1.0 + 1e-3 * k);
  return "stepped_potential={ steps = [" + list + "] }";
}

TEST(Limits, OfBinsAndCells) {
  const auto with = [](const std::string& observable) { return limit_refusal("periodic", until_4, {"observe." + observable}); };
  EXPECT_THAT(with("speeds={ bins = 100000 }"), IsEmpty());
  EXPECT_THAT(with("speeds={ bins = 100001 }"), HasSubstr("it must be a whole number from 2 to 100000"));
  for (const char* most : {"[10000, 1]", "[1, 10000]", "[100, 100]"})
    EXPECT_THAT(with(fmt::format("fields={{ cells = {} }}", most)), IsEmpty()) << most;
  // Four times 2^62 is 0 to 64 bits.
  for (const char* more : {"[10001, 1]", "[1, 10001]", "[100, 101]", "[4, 4611686018427387904]", "[4611686018427387904, 4]"})
    EXPECT_THAT(with(fmt::format("fields={{ cells = {} }}", more)), HasSubstr("of 10000 cells at most")) << more;
}

TEST(Limits, OfSteps) {
  EXPECT_THAT(limit_refusal("periodic", until_4, {steps(1000)}), IsEmpty());
  EXPECT_THAT(limit_refusal("periodic", until_4, {steps(1001)}), HasSubstr("has 1001 steps; it must have 1000 at most"));
}

TEST(Limits, OfWhatAFileCanCount) {
  const auto with = [](std::uint64_t collisions) {
    return limit_refusal([collisions](Scene& scene) { scene.run.sample_every_collisions = collisions; });
  };
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  EXPECT_THAT(with(most), IsEmpty());
  EXPECT_THAT(with(most + 1), HasSubstr("run.sample_every.collisions is 9223372036854775808; it must be a whole number from 0"));
}

TEST(Limits, OfPackingFractionsThatDisksGrowTo) {
  const auto until = [](double fraction) {
    return limit_refusal([fraction](Scene& scene) { scene.effects.growth = Growth{.rate = 0.1, .packing_fraction = fraction}; });
  };
  const double present = parse_scene(limits_text("periodic", until_4)).packing_fraction();
  EXPECT_THAT(until(1.0), HasSubstr("growth.until.packing_fraction is 1; it must be below 1"));
  EXPECT_THAT(until(present), HasSubstr("but the disks start at"));
  EXPECT_THAT(until(1.01 * present), IsEmpty());
  EXPECT_THAT(until(0.90), IsEmpty());
  EXPECT_THAT(until(0.92), HasSubstr("but that of equal disks cannot exceed 0.9069"));
  const auto nearer = [](double delta) {
    return limit_refusal([delta](Scene& scene) {
      scene.effects.non_additivity = NonAdditivity{delta};
      scene.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.92};
    });
  };
  EXPECT_THAT(nearer(-0.5), IsEmpty()) << "circles of unlike disks overlap";
  EXPECT_THAT(nearer(0.5), HasSubstr("cannot exceed 0.9069"));
}

TEST(Limits, OfTheTimeThatOneDiskGrows) {
  // By time 4 it is 5 times as large with rate 1, and 2.5 across with rate 9.75. Two disks may end the run before that.
  const auto with = [](int disks, double rate) {
    const std::string list = fmt::format(
        "disks=[{{ count = {}, radius = 0.03125, mass = 1.0, positions = \"random\", velocities = {{ speed = 1.0 }} }}]", disks);
    return limit_refusal("walls", until_4 + "collisions = 10\n", {list, fmt::format("growth={{ rate = {} }}", rate)});
  };
  EXPECT_THAT(with(1, 1.0), IsEmpty());
  EXPECT_THAT(with(1, 9.75), HasSubstr("by run.time = 4 the largest disk would be 2.5 across"));
  EXPECT_THAT(with(2, 9.75), IsEmpty());
}

TEST(Limits, OfWallsThatMeetWhereNoDiskIs) {
  const auto closing = [](double speed) {
    return limit_refusal("walls", until_4, {"disks=[]", fmt::format("walls.left={{ velocity = {} }}", speed)});
  };
  EXPECT_THAT(closing(0.49), IsEmpty());
  EXPECT_THAT(closing(0.5), HasSubstr("would leave 0 between left and right"));
}

}  // namespace
}  // namespace carom::test
