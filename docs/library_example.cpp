// Carom as a library: reads a scene, lets it move for one unit of time, and prints what has happened.

#include <carom/carom.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
  const carom::Scene scene = carom::load_scene(argc > 1 ? argv[1] : "box.toml");
  carom::Simulation simulation = carom::make_simulation(scene);

  simulation.run_until(1.0);

  const carom::State state = simulation.state();
  const carom::Totals totals = simulation.totals();
  std::printf("%zu disks at time %g\n", simulation.disks().count(), state.time);
  std::printf("%llu collisions of pairs, %llu with walls\n", static_cast<unsigned long long>(totals.pair),
              static_cast<unsigned long long>(totals.wall));
  std::printf("disk 0 is at (%.15g, %.15g)\n", state.positions(0, 0), state.positions(1, 0));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
