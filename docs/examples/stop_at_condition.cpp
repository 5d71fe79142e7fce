// A run that ends when something happens: how long does a heavy disk take to reach the right wall among light ones? The condition
// is asked after every event, so that the run ends at the same event on every machine.

#include <carom/carom.hpp>

#include <cstdio>
#include <exception>

int main() try {
  const carom::Scene scene{
      .box = {.lower = {0.0, 0.0}, .upper = {20.0, 20.0}},
      .species = {{.count = 1,
                   .radius = 1.0,
                   .mass = 10.0,
                   .positions = carom::ListedPositions{{{2.0, 10.0}}},
                   .velocities = carom::AtRest{}},
                  {.count = 100,
                   .radius = 0.4,
                   .mass = 1.0,
                   .positions = carom::RandomPositions{},
                   .velocities = carom::MaxwellVelocities{.temperature = 1.0}}},
  };
  carom::Simulation simulation = carom::make_simulation(scene);
  const auto has_arrived = [](const carom::Event& event) { return event.disk == 0 && event.partner == carom::wall_right; };
  const carom::StopReason stopped = simulation.run_until(1e4, {.events = 10'000'000, .stop_when = has_arrived});

  std::printf("stopped by %s at time %.6f, at event %llu\n", to_string(stopped).c_str(), simulation.time(),
              static_cast<unsigned long long>(simulation.counts().events()));
  std::printf("the heavy disk is at x = %.6f, its radius from the wall\n", simulation.state().positions(0, 0));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
