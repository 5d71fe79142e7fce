// Steady flows between thermal walls: what the balances of momentum and energy leave no choice in.

#include "studies/validate/gas.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace carom::validation {

namespace {

/// Momentum and energy of all disks, and how far they have come along x.
struct FlowBalance {
  double momentum = 0.0, energy = 0.0, place = 0.0;
};

FlowBalance balance_of(const State& state, double length) {
  return {state.velocities.row(0).sum(), 0.5 * state.velocities.squaredNorm(),
          state.positions.row(0).sum() + length * state.images.row(0).cast<double>().sum()};
}

/// Notes how the measured run begins.
class FlowBeginning final : public Observable {
 public:
  FlowBeginning(double length, FlowBalance& begun) : length_(length), begun_(begun) {}
  [[nodiscard]] std::string name() const override { return "flow_beginning"; }
  void start(const State& state) override { begun_ = balance_of(state, length_); }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  double length_;
  FlowBalance& begun_;
};

constexpr std::int64_t flow_disks = 200, flow_layers = 10;
constexpr double flow_width = 20.0;

/// Returns a component of the fields in the layers that no wall touches, for each stretch of the run.
std::vector<std::vector<double>> in_stretches(const Found& found, const std::string& component) {
  std::vector<std::vector<double>> stretches;
  for (const Measurement& one : found.measurements)
    for (const Table& table : one.tables) {
      if (table.name != "fields_in_time") continue;
      for (const Column& column : table.columns) {
        if (column.name != component) continue;
        for (auto first = column.values.begin(); first != column.values.end(); first += flow_layers)
          stretches.emplace_back(first + 1, first + flow_layers - 1);
      }
    }
  return stretches;
}

/// A gas between thermal walls at the bottom and the top.
Scene channel(double bottom_temperature, double top_temperature, const Effort& effort) {
  Scene scene{.box = {.upper = {flow_width, flow_width}, .boundary = {Boundary::periodic, Boundary::walls}},
              .species = {{.count = flow_disks, .radius = 0.5, .mass = 1.0, .velocities = MaxwellVelocities{1.0}}},
              .run = {.time = effort.full ? 100'000.0 : 5000.0,
                      .equilibrate = Run::Equilibrate{.time = 200.0},
                      .seed = effort.seed_of(0)},
              .observe = {{.name = "fields", .every = 0.25, .cells = std::array<std::int64_t, 2>{1, flow_layers}},
                          {.name = "work", .every = 1.0}}};
  scene.effects.walls[2].temperature = bottom_temperature;
  scene.effects.walls[3].temperature = top_temperature;
  return scene;
}

/// Checks that a component of the fields is the same in every layer, and returns its deviations from the mean.
Curve put_layers(TrialResult& result, const Found& found, const char* symbol, const char* component, const char* balance,
                 const std::string& what, double largest_error) {
  Curve measured{.plot = "flow-pressure", .name = what};
  const auto stretches = in_stretches(found, component);
  for (std::size_t k = 0; k + 2 < flow_layers; ++k) {
    std::vector<double> deviations;
    for (const std::vector<double>& layers : stretches) deviations.push_back(layers[k] / mean_of(layers).value - 1.0);
    const Measured mean = mean_of(deviations);
    const double height = (static_cast<double>(k) + 1.5) * flow_width / flow_layers;
    measured.x.push_back(height), measured.y.push_back(mean.value), measured.error.push_back(mean.error);
    result.checks.push_back({.name = fmt::format("{} at height {:g} over its mean, {}", symbol, height, what),
                             .theory = "1, the same at every height of a steady flow",
                             .source = balance,
                             .expected = 1.0,
                             .measured = {1.0 + mean.value, mean.error, mean.freedom},
                             .largest_error = largest_error});
  }
  return measured;
}

TrialResult flow(const std::string& trial, const std::string& what, double wall_speed, double acceleration,
                 const Effort& effort) {
  TrialResult result{.trial = trial};
  Scene scene = channel(1.0, 1.0, effort);
  if (wall_speed != 0.0) {
    scene.effects.walls[2].tangential_velocity = -wall_speed;
    scene.effects.walls[3].tangential_velocity = wall_speed;
  }
  if (acceleration != 0.0) scene.effects.gravity = Gravity{{acceleration, 0.0}};
  FlowBalance begun;
  std::vector<std::unique_ptr<Observable>> own;
  own.push_back(std::make_unique<FlowBeginning>(flow_width, begun));
  const Found found = run(scene, effort, result, std::move(own));
  const FlowBalance ended = balance_of(found.simulation.state(), flow_width);
  const Totals totals = found.simulation.totals();
  const double time = *scene.run.time, weight = static_cast<double>(flow_disks) * acceleration;

  constexpr const char* balance = "balance of momentum";
  result.curves.push_back(put_layers(result, found, "P_yy", "stress_yy", balance, what, 1e-3));
  if (acceleration == 0.0)  // a weight along x makes it rise with y
    (void)put_layers(result, found, "P_xy", "stress_xy", balance, what, effort.full ? 3e-3 : 0.0);
  result.curves.push_back({.plot = "flow-pressure", .name = "constant", .theory = true, .x = {0.0, flow_width}, .y = {0.0, 0.0}});

  // The work is that of walls that slide and of the weight, by their way alone; heat is what the observable has.
  const double work = wall_speed * (totals.wall_shear[2] - totals.wall_shear[3]) + acceleration * (ended.place - begun.place);
  const double gained = found.scalar("work", "work").value.value() + found.scalar("work", "heat").value.value();
  result.checks.push_back({.name = "heat that the walls took and energy that the gas kept, over the work, " + what,
                           .theory = "1",
                           .source = "conservation of energy",
                           .expected = 1.0,
                           .measured = {1.0 + ((ended.energy - begun.energy) - gained) / work, 0.0},
                           .allowance = 1e-9,
                           .allowance_for = "rounding"});
  const double sheared = totals.wall_shear[2] + totals.wall_shear[3] + ended.momentum - begun.momentum;
  const double passed = std::abs(totals.wall_shear[2]) + std::abs(totals.wall_shear[3]);
  result.checks.push_back(
      {.name = "momentum that walls took and the gas kept, less that of the weight, over what passed, " + what,
       .theory = "0",
       .source = "conservation of momentum",
       .expected = 0.0,
       .measured = {(sheared - weight * time) / passed, 0.0},
       .allowance = 1e-9,
       .allowance_for = "rounding"});
  return result;
}

TrialResult heat_conduction(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  const std::string what = "walls at kT = 1 and 2";
  const Scene scene = channel(1.0, 2.0, effort);
  FlowBalance begun;
  std::vector<std::unique_ptr<Observable>> own;
  own.push_back(std::make_unique<FlowBeginning>(flow_width, begun));
  const Found found = run(scene, effort, result, std::move(own));
  (void)put_layers(result, found, "heat flux", "heat_flux_y", "balance of energy", what, effort.full ? 3e-3 : 0.0);
  (void)put_layers(result, found, "P_yy", "stress_yy", "balance of momentum", what, 1e-3);

  std::vector<double> fluxes;  // in each stretch of the run, the mean of all layers
  for (const std::vector<double>& layers : in_stretches(found, "heat_flux_y")) fluxes.push_back(mean_of(layers).value);
  const Measured flux = mean_of(fluxes);
  const std::array<double, 4> taken = found.simulation.totals().wall_energy;
  const double through_walls = 0.5 * (taken[3] - taken[2]) / (flow_width * *scene.run.time);
  result.checks.push_back({.name = "heat flux in the gas over that through the walls, " + what,
                           .theory = "1",
                           .source = "balance of energy",
                           .expected = 1.0,
                           .measured = {flux.value / through_walls, flux.error / std::abs(through_walls), flux.freedom},
                           .error_is_bound = true,
                           .largest_error = effort.full ? 0.01 : 0.0});
  const double kept = balance_of(found.simulation.state(), flow_width).energy - begun.energy;
  result.checks.push_back({.name = "heat that the cold wall took and the gas kept, over what the warm wall gave, " + what,
                           .theory = "1",
                           .source = "conservation of energy",
                           .expected = 1.0,
                           .measured = {-(taken[2] + kept) / taken[3], 0.0},
                           .allowance = 1e-9,
                           .allowance_for = "rounding"});
  return result;
}

}  // namespace

void add_flows(std::vector<Trial>& trials) {
  const std::string group = "cooling, weight and walls";
  trials.push_back({"couette", group, false,
                    [](const Effort& effort) { return flow("couette", "walls that slide at 1 and -1", 1.0, 0.0, effort); }});
  trials.push_back({"poiseuille", group, false,
                    [](const Effort& effort) { return flow("poiseuille", "a weight along the channel", 0.0, 0.02, effort); }});
  trials.push_back(
      {"heat-conduction", group, false, [](const Effort& effort) { return heat_conduction("heat-conduction", effort); }});
}

}  // namespace carom::validation
