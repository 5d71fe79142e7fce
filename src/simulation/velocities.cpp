// How the disks start to move.

#include "core/random.hpp"
#include "simulation/start.hpp"

#include <boost/hana/functional/overload.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace carom {

namespace {

/// Rounds in which momentum and the temperatures of several species settle; each gains a digit or more.
constexpr int settling_rounds = 60;

/// Each disk draws from its own stream: its velocity does not depend on which other disks there are.
Eigen::Vector2d draw(const Velocities& asked, double mass, std::size_t index, RandomStream random) {
  return std::visit(
      boost::hana::overload([](const AtRest&) -> Eigen::Vector2d { return Eigen::Vector2d::Zero(); },
                            [&](const UniformVelocities& uniform) -> Eigen::Vector2d {
                              if (uniform.maximum == 0.0) return Eigen::Vector2d::Zero();
                              boost::random::uniform_real_distribution<double> component(-uniform.maximum, uniform.maximum);
                              const double x = component(random);
                              const double y = component(random);
                              return {x, y};
                            },
                            [&](const MaxwellVelocities& maxwell) -> Eigen::Vector2d {
                              boost::random::normal_distribution<double> component(0.0, std::sqrt(maxwell.temperature / mass));
                              const double x = component(random);
                              const double y = component(random);
                              return {x, y};
                            },
                            [&](const FixedSpeed& fixed) -> Eigen::Vector2d {
                              // A direction without sine and cosine, whose last bits differ between machines: of points in a
                              // square, the first in the unit disk.
                              boost::random::uniform_real_distribution<double> component(-1.0, 1.0);
                              for (;;) {
                                const double x = component(random);
                                const double y = component(random);
                                const double square = x * x + y * y;
                                if (square > 1.0 || square < 1e-6) continue;
                                const double scale = fixed.speed / std::sqrt(square);
                                return {scale * x, scale * y};
                              }
                            },
                            [&](const ListedVelocities& listed) -> Eigen::Vector2d { return listed.values[index]; },
                            [&](const FileVelocities& file) -> Eigen::Vector2d { return file.values[index]; }),
      asked);
}

bool is_drawn(const Velocities& asked) {
  return std::holds_alternative<UniformVelocities>(asked) || std::holds_alternative<MaxwellVelocities>(asked) ||
         std::holds_alternative<FixedSpeed>(asked);
}

bool is_given(const Velocities& asked) {
  return std::holds_alternative<ListedVelocities>(asked) || std::holds_alternative<FileVelocities>(asked);
}

/// Disks [begin, end): those of one species, or all.
struct IdRange {
  Eigen::Index begin;
  Eigen::Index end;
};

// Sums run disk by disk: the order in which Eigen adds depends on the vector instructions of the machine.

double kinetic_energy(const Disks& disks, const Eigen::Matrix2Xd& velocities, IdRange ids) {
  double sum = 0.0;
  for (Eigen::Index i = ids.begin; i < ids.end; ++i)
    sum += 0.5 * disks.mass[static_cast<std::size_t>(i)] *
           (velocities(0, i) * velocities(0, i) + velocities(1, i) * velocities(1, i));
  return sum;
}

/// Returns the factor by which the velocities were scaled.
double scale_to(double kinetic, const Disks& disks, IdRange ids, Eigen::Matrix2Xd& velocities) {
  const double now = kinetic_energy(disks, velocities, ids);
  if (!(now > 0.0)) return 1.0;
  const double factor = std::sqrt(kinetic / now);
  velocities.middleCols(ids.begin, ids.end - ids.begin) *= factor;
  return factor;
}

double total_mass(const Disks& disks, IdRange ids) {
  double sum = 0.0;
  for (Eigen::Index i = ids.begin; i < ids.end; ++i) sum += disks.mass[static_cast<std::size_t>(i)];
  return sum;
}

/// Along the periodic axes, where no collision would ever change it.
void remove_momentum(const Box& box, const Disks& disks, Eigen::Matrix2Xd& velocities) {
  Eigen::Vector2d momentum(0.0, 0.0);
  for (Eigen::Index i = 0; i < velocities.cols(); ++i) momentum += disks.mass[static_cast<std::size_t>(i)] * velocities.col(i);
  const double mass = total_mass(disks, {0, velocities.cols()});
  for (int a = 0; a < 2; ++a)
    if (box.periodic(a)) velocities.row(a).array() -= momentum[a] / mass;
}

/// Gives every Maxwellian species the kinetic energy of its temperature T: T for each of its disks, less T m / 2M for
/// each axis along which the momentum of all disks, of mass M, is zero. That is what equipartition gives a disk of mass m
/// then; over all disks of a periodic box it adds up to the N - 1 of the definition kT = K / (N - 1).
void meet_temperatures(const Scene& scene, const Disks& disks, int axes_without_momentum, Eigen::Matrix2Xd& velocities) {
  struct Target {
    IdRange ids;
    double kinetic;
  };
  const IdRange all{0, velocities.cols()};
  const double mass = total_mass(disks, all);
  std::vector<Target> targets;
  double total = 0.0;
  Eigen::Index first = 0;
  for (const Species& species : scene.species) {
    const IdRange ids{first, first + species.count};
    first = ids.end;
    const auto* maxwell = std::get_if<MaxwellVelocities>(&species.velocities);
    if (maxwell == nullptr || species.count == 0) continue;
    const double lost = 0.5 * axes_without_momentum * total_mass(disks, ids) / mass;
    targets.push_back({ids, maxwell->temperature * (static_cast<double>(species.count) - lost)});
    total += targets.back().kinetic;
  }
  if (axes_without_momentum == 0) {
    for (const Target& target : targets) scale_to(target.kinetic, disks, target.ids, velocities);
    return;
  }
  // Scaling one species moves the common mean, and removing that changes every species' energy: both settle together.
  remove_momentum(scene.box, disks, velocities);
  for (int round = 0; round < settling_rounds; ++round) {
    bool settled = true;
    for (const Target& target : targets) {
      const double factor = scale_to(target.kinetic, disks, target.ids, velocities);
      settled = settled && std::abs(factor - 1.0) < 1e-14;
    }
    if (settled) break;
    remove_momentum(scene.box, disks, velocities);
  }
  // Where a handful of disks cannot meet every share, their sum is still exact.
  Eigen::Index maxwellian = 0;
  for (const Target& target : targets) maxwellian += target.ids.end - target.ids.begin;
  if (maxwellian == all.end) scale_to(total, disks, all, velocities);
}

}  // namespace

Eigen::Matrix2Xd draw_velocities(const Scene& scene, const Disks& disks) {
  Eigen::Matrix2Xd velocities(2, static_cast<Eigen::Index>(disks.count()));
  Eigen::Index i = 0;
  bool any_drawn = false;
  bool any_given = false;
  for (const Species& species : scene.species) {
    if (species.count > 0) {
      any_drawn = any_drawn || is_drawn(species.velocities);
      any_given = any_given || is_given(species.velocities);
    }
    for (std::int64_t k = 0; k < species.count; ++k, ++i) {
      RandomStream random(scene.run.seed, Stream::velocities, static_cast<std::uint64_t>(i));
      velocities.col(i) = draw(species.velocities, disks.mass[static_cast<std::size_t>(i)], static_cast<std::size_t>(k), random);
    }
  }
  if (scene.run.keep_momentum || !any_drawn) return velocities;

  // Velocities that the user gives one by one stay as given, and with them the total momentum.
  const int axes_without_momentum = any_given ? 0 : (scene.box.periodic(0) ? 1 : 0) + (scene.box.periodic(1) ? 1 : 0);
  meet_temperatures(scene, disks, axes_without_momentum, velocities);
  return velocities;
}

}  // namespace carom
