// Flows between walls that slide, and along a channel: what must be the same at every height, by the balance of momentum.

#include "observe/observed_system.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace carom::test {
namespace {

/// Two hundred disks in a channel 20 wide, with ten layers of cells.
Scene channel(const std::string& effects) {
  return parse_scene(
      "[box]\nx = [0.0, 20.0]\ny = [0.0, 20.0]\nboundary = { x = \"periodic\", y = \"walls\" }\n[[disks]]\ncount = 200\nradius = "
      "0.5\nmass = 1.0\npositions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = "
      "\"specular\"\n[run]\ntime = "
      "8000.0\nequilibrate = { time = 200.0 }\n[observe]\nfields = { cells = [1, 10], every = 0.5 }\n" +
      effects);
}

struct Layer {
  double value, error;
};
/// A field in the layers that no wall touches.
std::vector<Layer> inner_layers(const Observed& run, const std::string& field) {
  const std::vector<double>&values = run.column("fields", 0, field), &errors = run.column("fields", 0, field + "_error");
  std::vector<Layer> layers;
  for (std::size_t k = 1; k + 1 < values.size(); ++k) layers.push_back({values[k], errors[k]});
  return layers;
}

/// Expects that all layers have a stress within four standard errors, beside what the gas itself may keep of a momentum over the
/// time of the run: m v N at most, with v = 3 v_T.
template <class Expected>
void expect_stress(const Observed& run, const std::vector<Layer>& layers, const Expected& expected, const char* what) {
  for (std::size_t k = 0; k < layers.size(); ++k)
    EXPECT_NEAR(layers[k].value, expected(k), 4.0 * layers[k].error + 3.0 * 200.0 / (run.time * 20.0))
        << what << ", layer " << k << ", error " << layers[k].error;
}

TEST(PhysicsCouetteFlow, HasOnePressureAndOneShearStressAtEveryHeight) {
  const Observed run = observe(
      channel(
          "[walls]\nbottom = { temperature = 1.0, tangential_velocity = -1.0 }\ntop = { temperature = 1.0, tangential_velocity = "
          "1.0 }\n"),
      100.0);
  const double area = run.time * 20.0;
  // The walls know both to O(1/t).
  const double pressure = (run.totals.wall_impulse[2] + run.totals.wall_impulse[3]) / (2.0 * area);
  const double shear = (run.totals.wall_shear[3] - run.totals.wall_shear[2]) / (2.0 * area);
  EXPECT_LT(shear, 0.0) << "momentum flows down";
  expect_stress(
      run, inner_layers(run, "stress_yy"), [&](std::size_t) { return pressure; }, "P_yy");
  expect_stress(
      run, inner_layers(run, "stress_xy"), [&](std::size_t) { return shear; }, "P_xy");
  // The gas follows the walls, slips, and is warmest in the middle.
  const std::vector<Layer> flow = inner_layers(run, "velocity_x"), warmth = inner_layers(run, "temperature");
  for (std::size_t k = 0; k + 1 < flow.size(); ++k) EXPECT_LT(flow[k].value, flow[k + 1].value);
  EXPECT_GT(flow.front().value, -1.0);
  EXPECT_GT(warmth[3].value, warmth[0].value + 4.0 * std::hypot(warmth[3].error, warmth[0].error));
  // Work that becomes heat: 2 u |P_xy| per area of both walls, of which the gas keeps a bounded part.
  const double work = run.totals.wall_shear[2] * 1.0 - run.totals.wall_shear[3] * 1.0;
  const double gained = -(run.totals.wall_energy[2] + run.totals.wall_energy[3]);
  EXPECT_LT(std::abs(gained), 0.02 * work);
}

TEST(PhysicsPoiseuilleFlow, HasTheShearStressOfTheWeightAboveEveryHeight) {
  constexpr double g = 0.02;
  const Observed run =
      observe(channel(fmt::format(
                  "[gravity]\nacceleration = [{}, 0.0]\n[walls]\nbottom = {{ temperature = 1.0 }}\ntop = {{ temperature = 1.0 "
                  "}}\n",
                  g)),
              100.0);
  const double area = run.time * 20.0;
  EXPECT_NEAR((run.totals.wall_shear[2] + run.totals.wall_shear[3]) / area, 200.0 * g / 20.0, 0.02 * 200.0 * g / 20.0)
      << "the walls bear all weight";
  const double pressure = (run.totals.wall_impulse[2] + run.totals.wall_impulse[3]) / (2.0 * area);
  expect_stress(
      run, inner_layers(run, "stress_yy"), [&](std::size_t) { return pressure; }, "P_yy");
  // d P_xy / dy = n m g: what a layer of height 2 weighs.
  const std::vector<Layer> shear = inner_layers(run, "stress_xy"), density = inner_layers(run, "density");
  std::vector<Layer> steps;
  for (std::size_t k = 0; k + 1 < shear.size(); ++k)
    steps.push_back({shear[k + 1].value - shear[k].value, std::hypot(shear[k].error, shear[k + 1].error)});
  expect_stress(
      run, steps, [&](std::size_t k) { return g * (density[k].value + density[k + 1].value); }, "P_xy");
  const std::vector<Layer> flow = inner_layers(run, "velocity_x");
  EXPECT_GT(flow[3].value, flow[0].value);
  EXPECT_GT(flow[0].value, 0.0);
}

}  // namespace
}  // namespace carom::test
