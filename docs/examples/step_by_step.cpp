// From event to event: which disk met what, when, and how it flew on.

#include <carom/carom.hpp>

#include <cstdio>
#include <exception>
#include <optional>

int main() try {
  const carom::Scene scene{
      .box = {.lower = {0.0, 0.0}, .upper = {10.0, 10.0}},
      .species = {{.count = 3,
                   .radius = 0.5,
                   .mass = 1.0,
                   .positions = carom::ListedPositions{{{2.0, 5.0}, {5.0, 5.25}, {8.0, 5.5}}},
                   .velocities = carom::ListedVelocities{{{1.0, 0.0}, {0.0, 0.0}, {-1.0, 0.0}}}}},
  };
  carom::Simulation simulation = carom::make_simulation(scene);
  while (const std::optional<carom::Event> event = simulation.step(20.0)) {
    std::printf("time %.6f: disk %d meets ", event->time, event->disk);
    if (event->partner >= 0)
      std::printf("disk %d", event->partner);
    else
      std::printf("the %s wall", event->partner == carom::wall_left     ? "left"
                                 : event->partner == carom::wall_right  ? "right"
                                 : event->partner == carom::wall_bottom ? "lower"
                                                                        : "upper");
    std::printf(" and flies on at (%.6f, %.6f)\n", event->velocity.x(), event->velocity.y());
  }
  std::printf("%llu events up to time %g\n", static_cast<unsigned long long>(simulation.counts().events()), simulation.time());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
