// A large gas on two cores, and once more on one: the bits are the same, and so is every number that is made of them.

#include <carom/carom.hpp>

#include <cstdio>
#include <exception>

int main() try {
  const carom::Scene scene{
      .box = {.lower = {0.0, 0.0}, .upper = {160.0, 150.0}, .boundary = {carom::Boundary::periodic, carom::Boundary::periodic}},
      .species = {{.count = 20'000,
                   .radius = 0.5,
                   .mass = 1.0,
                   .positions = carom::HexagonalLattice{},
                   .velocities = carom::MaxwellVelocities{1.0}}}};
  carom::Simulation alone = carom::make_simulation(scene), shared = carom::make_simulation(scene);

  if (const std::string reason = shared.why_not_threads(); !reason.empty()) {
    std::printf("one core: %s\n", reason.c_str());
    return 1;
  }
  shared.set_threads({.threads = 2});
  for (carom::Simulation* simulation : {&alone, &shared}) simulation->run_until(2.0);

  const carom::ThreadCounts counts = shared.thread_counts();
  std::printf("%llu windows, %llu of them done again; %.0f %% of the events computed twice\n",
              static_cast<unsigned long long>(counts.windows), static_cast<unsigned long long>(counts.windows_redone),
              100.0 * static_cast<double>(counts.copied_events) / static_cast<double>(counts.events));
  const bool same = carom::state_hash(alone.state()) == carom::state_hash(shared.state());
  std::printf("state hash %s, %s\n", carom::state_hash(shared.state()).c_str(), same ? "the same bits" : "other bits");
  return same ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
