// A collision rule of one's own: viscoelastic disks, whose restitution approaches 1 for slow collisions, e(u) = 1 - 0.2 u^(1/5).
// As they cool they become elastic, and cool more slowly than disks of constant restitution.

#include <carom/carom.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

namespace {

void viscoelastic(carom::CollidingPair& pair) {
  const double u = pair.normal.dot(pair.velocity - pair.partner_velocity);  // negative: they approach
  const double restitution = std::max(0.0, 1.0 - 0.2 * std::pow(-u, 0.2));
  const double reduced = pair.mass * pair.partner_mass / (pair.mass + pair.partner_mass);
  const Eigen::Vector2d impulse = -(1.0 + restitution) * reduced * u * pair.normal;
  pair.velocity += impulse / pair.mass;
  pair.partner_velocity -= impulse / pair.partner_mass;
}

}  // namespace

int main() try {
  using carom::Boundary;
  carom::Scene scene{
      .box = {.lower = {0.0, 0.0}, .upper = {30.0, 30.0}, .boundary = {Boundary::periodic, Boundary::periodic}},
      .species = {{.count = 200,
                   .radius = 0.5,
                   .mass = 1.0,
                   .positions = carom::RandomPositions{},
                   .velocities = carom::MaxwellVelocities{.temperature = 1.0}}},
  };
  carom::Simulation own = carom::make_simulation(scene);
  own.set_collision_rule(viscoelastic);
  scene.effects.collision.restitution = 0.8;
  carom::Simulation constant = carom::make_simulation(scene);

  const auto temperature = [](const carom::Simulation& simulation) {
    return simulation.state().velocities.squaredNorm() / 400.0;
  };
  for (const double time : {10.0, 100.0, 1000.0}) {
    own.run_until(time);
    constant.run_until(time);
    std::printf("time %6.0f  kT %.3e viscoelastic, %.3e at restitution 0.8\n", time, temperature(own), temperature(constant));
  }
  std::printf("%s\n", temperature(own) > temperature(constant) ? "viscoelastic disks cool more slowly" : "nothing to see");
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
