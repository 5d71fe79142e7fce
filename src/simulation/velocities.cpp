// How the disks start to move.

#include "core/random.hpp"
#include "simulation/start.hpp"

#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <cmath>
#include <numbers>

namespace carom {

namespace {

/// Overloads in one place for std::visit.
template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};

/// Each disk draws from its own stream: its velocity does not depend on which other disks there are.
Eigen::Vector2d draw(const Velocities& asked, double mass, std::size_t index, RandomStream random) {
  return std::visit(
      Overloaded{
          [](const AtRest&) -> Eigen::Vector2d { return Eigen::Vector2d::Zero(); },
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
            const double angle = boost::random::uniform_real_distribution<double>(0.0, 2.0 * std::numbers::pi)(random);
            return {fixed.speed * std::cos(angle), fixed.speed * std::sin(angle)};
          },
          [&](const ListedVelocities& listed) -> Eigen::Vector2d { return listed.values[index]; },
          [&](const FileVelocities& file) -> Eigen::Vector2d { return file.values[index]; },
      },
      asked);
}

bool is_drawn(const Velocities& asked) {
  return std::holds_alternative<UniformVelocities>(asked) || std::holds_alternative<MaxwellVelocities>(asked) ||
         std::holds_alternative<FixedSpeed>(asked);
}

bool is_given(const Velocities& asked) {
  return std::holds_alternative<ListedVelocities>(asked) || std::holds_alternative<FileVelocities>(asked);
}

void scale_to(double kinetic, const Eigen::Ref<const Eigen::VectorXd>& mass, Eigen::Ref<Eigen::Matrix2Xd> velocities) {
  const double now = 0.5 * velocities.colwise().squaredNorm().dot(mass);
  if (now > 0.0) velocities *= std::sqrt(kinetic / now);
}

/// Gives every Maxwellian species the kinetic energy of its temperature: kT for each of its disks, less its share of the
/// two degrees of freedom that a conserved momentum takes away.
void meet_temperatures(const Scene& scene, const Eigen::VectorXd& mass, bool remove_momentum, Eigen::Matrix2Xd& velocities) {
  const double n = static_cast<double>(velocities.cols());
  const double share = remove_momentum ? (n - 1.0) / n : 1.0;
  // Scaling one species moves the common mean, and removing that changes every species' energy: both settle at once.
  for (int round = 0; round < (remove_momentum ? 20 : 1); ++round) {
    if (remove_momentum) velocities.colwise() -= (velocities * mass / mass.sum()).eval();
    Eigen::Index first = 0;
    for (const Species& species : scene.species) {
      if (const auto* maxwell = std::get_if<MaxwellVelocities>(&species.velocities)) {
        scale_to(maxwell->temperature * static_cast<double>(species.count) * share, mass.segment(first, species.count),
                 velocities.middleCols(first, species.count));
      }
      first += species.count;
    }
  }
  if (!remove_momentum) return;
  velocities.colwise() -= (velocities * mass / mass.sum()).eval();
  double kinetic = 0.0;
  for (const Species& species : scene.species) {
    const auto* maxwell = std::get_if<MaxwellVelocities>(&species.velocities);
    if (maxwell == nullptr) return;
    kinetic += maxwell->temperature * static_cast<double>(species.count) * share;
  }
  scale_to(kinetic, mass, velocities);  // where a handful of disks cannot meet every share, their sum is still exact
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
  const bool remove_momentum = scene.box.periodic(0) && scene.box.periodic(1) && !any_given;
  const Eigen::VectorXd mass = Eigen::Map<const Eigen::VectorXd>(disks.mass.data(), velocities.cols());
  meet_temperatures(scene, mass, remove_momentum, velocities);
  return velocities;
}

}  // namespace carom
