// A scene put together in a program: an aggregate with the names of the scene format. What is left out has its default or is
// absent.

#include <carom/carom.hpp>

#include <cstdio>
#include <exception>

int main() try {
  using carom::Boundary;
  const carom::Scene scene{
      .title = "Large and small disks in a channel that falls",
      .box = {.lower = {0.0, 0.0}, .upper = {40.0, 20.0}, .boundary = {Boundary::periodic, Boundary::walls}},
      .species = {{.name = "large",
                   .count = 60,
                   .radius = 1.0,
                   .mass = 4.0,
                   .positions = carom::RandomPositions{},
                   .velocities = carom::MaxwellVelocities{.temperature = 1.0}},
                  {.name = "small",
                   .count = 120,
                   .radius = 0.5,
                   .mass = 1.0,
                   .positions = carom::RandomPositions{},
                   .velocities = carom::MaxwellVelocities{.temperature = 1.0}}},
      .effects = {.gravity = carom::Gravity{{0.0, -0.1}},
                  .obstacles = {carom::DiskObstacle{.centre = {20.0, 10.0}, .radius = 2.0}}},
      .run = {.time = 20.0, .seed = 7},
  };
  carom::check(scene);  // the sentence of a refusal is that for a file; make_simulation() checks too

  carom::Simulation simulation = carom::make_simulation(scene);
  const carom::RunResult result = carom::run_schedule(simulation);
  std::printf("%s at time %g, after %llu collisions of pairs and %llu with the obstacle\n", to_string(result.stopped).c_str(),
              simulation.time(), static_cast<unsigned long long>(simulation.counts().pair),
              static_cast<unsigned long long>(simulation.counts().obstacle));
  std::printf("as a file it would be:\n%s", carom::resolved_toml(scene).c_str());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
