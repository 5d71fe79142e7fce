// A page of results of one's own: how the energy of one disk changes, as an HTML file with a plot.

#include <carom/carom.hpp>
#include <carom/pages/page.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
  carom::Simulation simulation = carom::make_simulation(carom::load_scene(argc > 1 ? argv[1] : "box.toml"));
  carom::Series energy{.name = "disk 0"};
  for (int k = 0; k <= 100; ++k) {
    simulation.run_until(0.01 * k);
    energy.x.push_back(0.01 * k);
    energy.y.push_back(0.5 * simulation.disks().mass[0] * simulation.state().velocities.col(0).squaredNorm());
  }
  const carom::Plot plot{
      .id = "energy", .title = "Energy of a disk", .x = {.title = "time"}, .y = {.title = "energy"}, .series = {energy}};
  const carom::Page page{.title = "One disk", .sections = {{.heading = "Energy", .blocks = {plot}}}};
  std::fputs(carom::html_page(page).c_str(), stdout);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
