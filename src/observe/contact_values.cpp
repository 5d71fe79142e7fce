// Contact values g_ij of the pair distributions, by pairs of species, from what collisions transfer and from how often disks
// collide; and the share of each pair of species in Z - 1. All are averages over time.
//
// A pair of disks a, b of species i and j is within dr beyond its contact distance sigma_ab with the probability
// 2 pi sigma_ab dr g_ab / A. Velocities do not depend on places in equilibrium, and the normal relative velocity of every pair
// has the mean square kT / mu, mu the reduced mass, and among disks of one kinetic energy the mean size c sqrt(2 kT / (pi mu)), c
// as in pressures.cpp. So of the pairs of two species, per time,
//
//   sum over collisions of sigma times the normal impulse = 2 pi kT S g / A,           g, by the virial
//   sum over collisions of sigma sqrt(mu)                 = c sqrt(2 pi kT) S g / A,   g_rate, by the rate
//
// with S the sum of sigma_ab^2 over all pairs. Where all pairs touch at one distance S is their number times sigma_ij^2; in a
// species of many sizes g is the mean of g_ab with the weights sigma_ab^2, as Z has it. The virial over 2 N kT is the share of
// the pair of species in Z - 1: (pi / 2) rho x_i x_j sigma_ij^2 g_ij, twice that for two species, but for 1 / N (Lebowitz, Phys.
// Rev. 133, A895 (1964)). The rates are those of Enskog's theory of mixtures, nu_ij = n_j sigma_ij g_ij sqrt(2 pi kT / mu_ij)
// (Jenkins & Mancini, J. Appl. Mech. 54, 27 (1987)).

#include "core/reduced_mass.hpp"
#include "observe/blocking.hpp"
#include "observe/equilibrium.hpp"
#include "observe/observables.hpp"
#include "observe/pressure.hpp"
#include "observe/saved_observable.hpp"
#include "scene/contact_scales.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {

namespace {

constexpr double pi = std::numbers::pi;

/// Two species, the first of which is not after the second, and their pairs of disks.
struct SpeciesPair {
  std::size_t first = 0, second = 0;
  double pairs = 0.0;    ///< number of pairs of disks
  double squares = 0.0;  ///< sum of the squares of their contact distances; length^2
};

class ContactValues final : public SavedObservable<ContactValues> {
 public:
  ContactValues(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        scales_(contact_scales<double>(run.scene.effects, run.disks)),
        index_(run.species_count() * run.species_count()),
        freedom_(run.degrees_of_freedom()),
        why_no_Z_(carom::why_no_Z(run.scene)) {
    for (std::size_t first = 0; first < run.species_count(); ++first)
      for (std::size_t second = first; second < run.species_count(); ++second) {
        index_[first * run.species_count() + second] = index_[second * run.species_count() + first] = pairs_.size();
        pairs_.push_back({first, second});
      }
    sum_squares();
    virial_.resize(pairs_.size()), rate_.resize(pairs_.size()), share_.resize(pairs_.size());
    contacts_.resize(pairs_.size()), meetings_.resize(pairs_.size()), transfers_.resize(pairs_.size());
  }

  [[nodiscard]] bool needs_positions() const override { return run_.has_flow(); }
  [[nodiscard]] bool follows_collisions() const override { return true; }

  void collisions(std::span<const PairCollision> collisions) override {
    for (const PairCollision& met : collisions) {
      const auto a = static_cast<std::size_t>(met.disk), b = static_cast<std::size_t>(met.partner);
      const std::size_t k = index_[species(a) * run_.species_count() + species(b)];
      const double virial = met.separation.dot(met.impulse);
      transfers_[k] += virial;
      if (!met.contact) continue;
      const Disks& disks = run_.disks;
      contacts_[k] += virial;
      meetings_[k] += scales_.of_disks(met.disk, met.partner) * (disks.radius[a] + disks.radius[b]) *
                      std::sqrt(reduced_mass(disks.mass[a], disks.mass[b]));
    }
  }

  void sample(const State& state, const Totals&) override {
    const double kT = temperature(state), dt = state.time - time_;
    if (dt > 0.0) add_step(dt, 0.5 * (kT + kT_), 0.5 * (std::sqrt(kT) + std::sqrt(kT_)));
    for (std::vector<double>* sums : {&contacts_, &meetings_, &transfers_}) sums->assign(pairs_.size(), 0.0);
    time_ = state.time;
    kT_ = kT;
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    const std::string no_rate = why_no_Z_.empty() && run_.scene.effects.collision.rule == CollisionRule::reversal
                                    ? "under reversal velocities need not be Maxwell's"
                                    : std::string(why_no_Z_);
    put_all(found, "g", virial_, std::string(why_no_Z_));
    put_all(found, "g_rate", rate_, no_rate);
    put_all(found, "Z_share", share_, std::string(why_no_Z_));
    const Effects& effects = run_.scene.effects;
    constexpr std::size_t few = 64;
    if (run_.disks.count() < few && !effects.potential_steps().empty() && !effects.bath_temperature())
      found.note =
          "a pair in contact has the energy of a step, and so few disks have another kT then: g and g_rate are too low or "
          "too high by some 1 / N";
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(virial_, rate_, share_, contacts_, meetings_, transfers_, time_, kT_);
  }

 private:
  [[nodiscard]] std::size_t species(std::size_t disk) const { return static_cast<std::size_t>(run_.disks.species[disk]); }

  /// Sums (r_a + r_b)^2 over all pairs: with n, R and Q the number of disks, the sum of their radii and that of their squares,
  /// n Q' + n' Q + 2 R R' over two species, and (n - 2) Q + R^2 within one.
  void sum_squares() {
    struct Radii {
      double count = 0.0, sum = 0.0, squares = 0.0;
    };
    std::vector<Radii> of(run_.species_count());
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      const double radius = run_.disks.radius[i];
      Radii& radii = of[species(i)];
      radii.count += 1.0, radii.sum += radius, radii.squares += radius * radius;
    }
    for (SpeciesPair& pair : pairs_) {
      const Radii &a = of[pair.first], &b = of[pair.second];
      const bool same = pair.first == pair.second;
      pair.pairs = same ? 0.5 * a.count * (a.count - 1.0) : a.count * b.count;
      const double squares =
          same ? (a.count - 2.0) * a.squares + a.sum * a.sum : a.count * b.squares + b.count * a.squares + 2.0 * a.sum * b.sum;
      if (!(pair.pairs > 0.0)) continue;
      const double scale =
          scales_.additive() ? 1.0
                             : scales_.of_species(static_cast<std::int32_t>(pair.first), static_cast<std::int32_t>(pair.second));
      pair.squares = scale * scale * squares;
    }
  }

  [[nodiscard]] double temperature(const State& state) const {
    const Eigen::Matrix2Xd velocities = peculiar_velocities(run_, state);
    double sum = 0.0;
    for (std::size_t i = 0; i < run_.disks.count(); ++i)
      sum += run_.disks.mass[i] * velocities.col(static_cast<Eigen::Index>(i)).squaredNorm();
    return freedom_ > 0.0 ? sum / freedom_ : 0.0;
  }

  /// Requires the mean of kT and that of sqrt(kT) over the step.
  void add_step(double dt, double kT, double thermal) {
    const double area = run_.scene.box.area(), fixed_energy = mean_speed_factor(freedom_);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      virial_[k].add(contacts_[k], 2.0 * pi * kT * pairs_[k].squares * dt / area);
      rate_[k].add(meetings_[k], std::sqrt(2.0 * pi) * thermal * fixed_energy * pairs_[k].squares * dt / area);
      share_[k].add(transfers_[k], 2.0 * static_cast<double>(run_.disks.count()) * kT * dt);
    }
  }

  void put_all(Measurement& found, std::string_view what, const std::vector<Blocking>& series, const std::string& why_not) const {
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      Scalar scalar{.name = std::string(what) + run_.suffix(pairs_[k].first) + run_.suffix(pairs_[k].second)};
      if (why_not.empty() && pairs_[k].pairs > 0.0) series[k].fill(scalar, step_);
      if (!scalar.value)
        scalar.note = !why_not.empty()           ? why_not
                      : !(pairs_[k].pairs > 0.0) ? "there is no such pair of disks"
                                                 : "nothing was measured";
      found.scalars.push_back(std::move(scalar));
    }
  }

  ContactScales<double> scales_;
  std::vector<std::size_t> index_;  ///< of a pair of species in pairs_, a row for each species
  std::vector<SpeciesPair> pairs_;
  double freedom_;
  std::string_view why_no_Z_;
  std::vector<Blocking> virial_, rate_, share_;
  /// Since the sample before, by pairs of species: virial of contacts; sum of sigma sqrt(mu); virial, that of steps of a
  /// potential included.
  std::vector<double> contacts_, meetings_, transfers_;
  double time_ = 0.0, kT_ = 0.0;
};

}  // namespace

MadeObservable make_contact_values(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<ContactValues>(request, run);
}

}  // namespace carom
