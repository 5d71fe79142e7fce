// A quench: disks that attract each other, as a gas at a high temperature, which from one moment to the next is coupled to a cold
// bath. Clusters form: pairs inside each other's wells.

#include <carom/carom.hpp>

#include <cstdio>
#include <exception>

int main() try {
  using carom::Boundary;
  const carom::Scene scene{
      .box = {.lower = {0.0, 0.0}, .upper = {40.0, 40.0}, .boundary = {Boundary::periodic, Boundary::periodic}},
      .species = {{.count = 400,
                   .radius = 0.5,
                   .mass = 1.0,
                   .positions = carom::RandomPositions{},
                   .velocities = carom::MaxwellVelocities{.temperature = 3.0}}},
      .effects = {.thermostat = carom::Thermostat{.temperature = 3.0, .rate = 0.5},
                  .square_well = carom::SquareWell{.width = 1.5, .depth = 1.0}},
  };
  carom::Simulation simulation = carom::make_simulation(scene);
  const auto show = [&] {
    const carom::State state = simulation.state();
    const double energy = 0.5 * state.velocities.squaredNorm();
    std::printf("time %5.1f  kT %.3f  bonds %llu\n", simulation.time(), energy / 400.0,
                static_cast<unsigned long long>(state.bonds));
    return state.bonds;
  };
  simulation.run_until(20.0);
  const std::uint64_t hot = show();

  carom::Effects effects = simulation.scene().effects;
  effects.thermostat->temperature = 0.3;
  simulation.set_effects(effects);  // time, totals and the thermostat's random numbers go on

  std::uint64_t cold = hot;
  for (const double time : {21.0, 25.0, 40.0, 80.0}) {
    simulation.run_until(time);
    cold = show();
  }
  std::printf("%s\n", cold > 2 * hot ? "clusters have formed" : "nothing to see");
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
