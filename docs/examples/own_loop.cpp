// Observables of Carom in a loop of one's own: the loop leads the simulation from sample to sample and may do between them what
// it likes. Here it equilibrates, then measures the pressure and the collision rate, with their errors.

#include <carom/carom.hpp>

#include <cstdio>
#include <exception>

int main() try {
  using carom::Boundary;
  const carom::Scene scene{
      .box = {.lower = {0.0, 0.0}, .upper = {20.0, 20.0}, .boundary = {Boundary::periodic, Boundary::periodic}},
      .species = {{.count = 200,
                   .radius = 0.5,
                   .mass = 1.0,
                   .positions = carom::HexagonalLattice{},
                   .velocities = carom::MaxwellVelocities{.temperature = 1.0}}},
      .observe = {{.name = "pressure", .every = 0.25}, {.name = "collision_rate"}},
  };
  carom::Simulation simulation = carom::make_simulation(scene);
  simulation.run_until(50.0);  // until the lattice is forgotten
  simulation.reset_clock();

  carom::Observation observation(simulation);
  while (observation.next_sample() <= 200.0) {
    simulation.run_until(observation.next_sample());
    observation.sample(simulation);
  }
  simulation.run_until(200.0);
  observation.sample(simulation);  // what has happened since the last one

  for (const carom::Measurement& measured : observation.results())
    for (const carom::Scalar& number : measured.scalars)
      if (number.value && number.error)  // the pressure on walls is absent here: the box has none
        std::printf("%s.%s = %.6g +- %.2g\n", measured.name.c_str(), number.name.c_str(), *number.value, *number.error);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
