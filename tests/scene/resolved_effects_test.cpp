// Every effect stands in the resolved scene, and reading it gives the same effect to the last bit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "scene/random_numbers.hpp"
#include "scene/scene_equality.hpp"
#include "scene/scene_texts.hpp"

namespace carom::test {
namespace {

using detail::number_text;

TEST(ResolvedEffects, PrintsWhatIsThere) {
  const std::string effects = R"([collision]
rule = "specular"
restitution = 0.9
roughness = -0.5
elastic_below = { time = 1e-06 }

[gravity]
acceleration = [0.0, -1.0]

[walls]
left = { restitution = 0.8, velocity = -0.1 }

[[obstacles]]
disk = { centre = [5.0, 4.0], radius = 0.3 }

[[obstacles]]
segment = { from = [0.0, 2.0], to = [3.0, 2.0] }

[thermostat]
temperature = 1.0
rate = 0.1

[square_well]
width = 1.5
depth = -1.0
)";
  EXPECT_THAT(resolved_toml(parse_scene(changed({{"[collision]\nrule = \"specular\"\n", effects}}))),
              testing::HasSubstr("\n" + effects + "\n[run]\n"));
  const std::string piston = "[walls]\ntop = { mass = 10.0, load = 5.0 }\n";
  EXPECT_THAT(resolved_toml(parse_scene(changed({{"[run]", piston + "[run]"}}))), testing::HasSubstr("\n" + piston));
  const std::string growth = "[growth]\nrate = 0.01\nuntil = { pressure = 1000000.0 }\n";
  EXPECT_THAT(resolved_toml(parse_scene(changed({{"[run]", growth + "[run]"}}))), testing::HasSubstr("\n" + growth));
  const std::string steps = "[stepped_potential]\nsteps = [{ width = 1.2, energy = 1.5 }, { width = 1.6, energy = -0.5 }]\n";
  EXPECT_THAT(resolved_toml(parse_scene(changed({{"[run]", steps + "[run]"}}))), testing::HasSubstr("\n" + steps));
  const std::string shear = "[shear]\nrate = -0.05\n";
  EXPECT_THAT(resolved_toml(parse_scene(changed({{"\"walls\"", "\"periodic\""}, {"[run]", shear + "[run]"}}))),
              testing::HasSubstr("\n" + shear));
}

bool maybe() { return *rc::gen::arbitrary<bool>(); }
std::string entry(const std::string& key, double value) { return key + " = " + number_text(value); }

/// The small scene with effects that go together.
class EffectsMaker {
 public:
  static std::string stepped_potential() {
    std::string steps;
    double width = 1.0;
    const int count = *rc::gen::inRange(1, 9);
    for (int k = 0; k < count; ++k) {
      width += 0.01 + 0.1 * unit_interval();
      steps += (k > 0 ? ", { " : "{ ") + entry("width", width) + ", " + entry("energy", moderate_double()) + " }";
    }
    return "[stepped_potential]\nsteps = [" + steps + "]\n";
  }

  std::string make() {
    for (bool& axis : periodic_) axis = maybe();
    std::string text = collision();
    const bool all_periodic = periodic_[0] && periodic_[1];
    if (all_periodic && maybe()) {
      text += "[shear]\n" + entry("rate", moderate_double()) + "\n";
    } else {
      if (maybe()) text += gravity();
      text += walls();
      const int obstacles = piston_ ? 0 : *rc::gen::inRange(0, 4);
      for (int o = 0; o < obstacles; ++o) text += obstacle();
      if (!moving_ && maybe()) {
        text += growth();
      } else if (maybe()) {
        text += "[square_well]\n" + entry("width", 1.5 + unit_interval()) + "\n" + entry("depth", moderate_double()) + "\n";
      } else if (maybe()) {
        text += stepped_potential();
      }
    }
    if (maybe())
      text += "[thermostat]\n" + entry("temperature", 0.5 + unit_interval()) + "\n" + entry("rate", moderate_positive_double()) +
              "\n";
    const auto boundary = [&](int axis) { return std::string(periodic_[axis] ? "\"periodic\"" : "\"walls\""); };
    return changed({{"boundary = \"walls\"", "boundary = { x = " + boundary(0) + ", y = " + boundary(1) + " }"},
                    {"[collision]\nrule = \"specular\"\n", text}});
  }

 private:
  static std::string collision() {
    const bool specular = maybe();
    std::string text = std::string("[collision]\nrule = ") + (specular ? "\"specular\"\n" : "\"reversal\"\n");
    if (maybe()) text += entry("restitution", unit_interval()) + "\n";
    if (specular && maybe()) text += entry("roughness", 2.0 * unit_interval() - 1.0) + "\n";
    if (maybe()) text += "elastic_below = { " + entry("time", std::abs(any_double())) + " }\n";
    return text;
  }

  std::string gravity() const {
    const double x = periodic_[0] ? -0.0 : moderate_double();
    return "[gravity]\nacceleration = " + pair_text(x, periodic_[1] ? 0.0 : moderate_double()) + "\n";
  }

  /// Within the run's time of 5 no wall moves by more than 0.5, half of what keeps the obstacles from them.
  std::string walls() {
    std::string text;
    const char* names[] = {"left", "right", "bottom", "top"};
    for (int w = 0; w < 4; ++w) {
      if (periodic_[w / 2] || maybe()) continue;
      const int kind = *rc::gen::inRange(0, 5);
      std::string entries;
      const auto put = [&](const char* key, double value) { entries += (entries.empty() ? "" : ", ") + entry(key, value); };
      if (kind == 0) put("temperature", moderate_positive_double());
      if (kind == 0 && maybe()) put("tangential_velocity", moderate_double());
      if (kind == 4 && maybe())
        put("vibration", std::abs(moderate_double()));
      else if (kind == 4)
        entries += std::string("vibration = { form = ") + (maybe() ? "\"sine\", " : "\"sawtooth\", ") +
                   entry("amplitude", 0.01 + 0.1 * unit_interval()) + ", " + entry("frequency", 0.5 + unit_interval()) +
                   (maybe() ? ", " + entry("phase", unit_interval()) : "") + " }",
            moving_ = true;
      if (kind != 0 && (kind == 1 || maybe())) put("restitution", unit_interval());
      if (kind == 2 || (kind == 0 && maybe())) put("velocity", 0.2 * unit_interval() - 0.1), moving_ = true;
      if (kind == 3) put("mass", 0.5 + unit_interval()), put("load", std::abs(moderate_double())), moving_ = piston_ = true;
      text += std::string(names[w]) + " = { " + entries + " }\n";
    }
    return text.empty() ? text : "[walls]\n" + text;
  }

  static std::string point() {
    const double x = 3.0 + 4.0 * unit_interval();
    return pair_text(x, 3.0 + 2.0 * unit_interval());
  }

  static std::string obstacle() {
    if (maybe()) return "[[obstacles]]\ndisk = { centre = " + point() + ", " + entry("radius", 0.1 + unit_interval()) + " }\n";
    if (maybe())
      return "[[obstacles]]\narc = { centre = " + point() + ", " + entry("radius", 0.1 + unit_interval()) + ", " +
             entry("from", 180.0 + 359.0 * unit_interval()) + ", to = 540.0 }\n";
    return "[[obstacles]]\nsegment = { from = " + point() + ", to = [7.0, " + number_text(5.0 + 2.0 * unit_interval()) + "] }\n";
  }

  static std::string growth() {
    std::string text = "[growth]\n" + entry("rate", 0.1 * unit_interval()) + "\n";
    const int end = *rc::gen::inRange(0, 3);
    if (end == 1) text += "until = { " + entry("packing_fraction", 0.1 + 0.7 * unit_interval()) + " }\n";
    if (end == 2) text += "until = { " + entry("pressure", moderate_positive_double()) + " }\n";
    return text;
  }

  bool periodic_[2] = {};
  bool moving_ = false, piston_ = false;
};

RC_GTEST_PROP(PropertyEffects, ReadingTheResolvedEffectsGivesTheSameBits, ()) {
  const Scene scene = parse_scene(EffectsMaker().make(), "made");
  const std::string resolved = resolved_toml(scene);
  const Scene again = parse_scene(resolved, "resolved");
  RC_ASSERT(first_difference(scene, again) == "");
  RC_ASSERT(resolved_toml(again) == resolved);
}

}  // namespace
}  // namespace carom::test
