#pragma once
// Stepped pair potentials, square wells and shoulders among them: the potential energy of a pair is the energy of the narrowest
// step that is wider than its distance, in contact distances, and 0 beyond the last step. At the edge of a step the relative
// velocity along the line of centres changes as energy demands, u'^2 = u^2 - 2 (U' - U) / mu, or is reversed where there is not
// enough of it.
//
// The step of a pair is remembered and not read from its distance, which at an edge is the edge to rounding.

#include "core/contact_time.hpp"
#include "core/pair_step.hpp"
#include "core/reduced_mass.hpp"
#include "core/vec2.hpp"
#include "effects/impact.hpp"

#include <carom/effects.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

/// The pair potential of a scene, and the step of every pair. Steps count from 0, the innermost; outside() is beyond all.
template <class Real>
class PairPotential {
 public:
  PairPotential(const Effects& effects, std::size_t disks) {
    const std::vector<PotentialStep> steps = effects.potential_steps();
    if (steps.empty()) return;
    for (const PotentialStep& step : steps) {
      edges_.push_back(Real(step.width));
      energies_.push_back(Real(step.energy));
    }
    energies_.push_back(Real(0));
    pairs_.resize(steps.size());
    partners_.resize(disks);
  }

  [[nodiscard]] bool present() const { return !partners_.empty(); }
  /// The potential of disks in so many slots of their own, each pair of them outside.
  [[nodiscard]] PairPotential with_slots(std::size_t slots) const {
    PairPotential part = *this;
    part.partners_.assign(partners_.empty() ? 0 : slots, {});
    std::fill(part.pairs_.begin(), part.pairs_.end(), std::uint64_t{0});
    return part;
  }
  /// Sets the partners of disk i, for engines that exchange disks; the lists of those disks hold it too.
  void set(std::int32_t i, const std::vector<PairStep>& inside) { partners(i) = inside; }
  /// Counts the pairs anew, after set().
  void count_pairs() {
    std::fill(pairs_.begin(), pairs_.end(), std::uint64_t{0});
    for (const auto& one : partners_)
      for (const PairStep& pair : one) ++pairs_[static_cast<std::size_t>(pair.step)];
    for (std::uint64_t& count : pairs_) count /= 2;
  }
  /// Returns the ratio of the largest distance at which disks interact to their contact distance.
  [[nodiscard]] Real reach() const { return edges_.back(); }
  /// Returns the widths of the hard core, which is 1, and of all steps, rising.
  [[nodiscard]] const std::vector<Real>& edges() const { return edges_; }

  /// Returns the number of steps: the step of pairs beyond all.
  [[nodiscard]] std::int32_t outside() const { return static_cast<std::int32_t>(edges_.size()) - 1; }
  /// Returns the step of a pair.
  [[nodiscard]] std::int32_t step_of(std::int32_t i, std::int32_t j) const { return find_step(of(i), j, outside()); }
  /// Moves a pair to a step.
  void move(std::int32_t i, std::int32_t j, std::int32_t to) {
    const std::int32_t from = step_of(i, j);
    if (from != outside()) --pairs_[static_cast<std::size_t>(from)];
    if (to != outside()) ++pairs_[static_cast<std::size_t>(to)];
    put(i, j, from, to);
    put(j, i, from, to);
  }
  /// Returns the number of pairs in each step.
  [[nodiscard]] const std::vector<std::uint64_t>& pairs() const { return pairs_; }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = partners_.capacity() * sizeof(std::vector<PairStep>);
    for (const auto& one : partners_) sum += one.capacity() * sizeof(PairStep);
    return sum;
  }
  /// Returns for each disk the disks within the outermost step round it.
  [[nodiscard]] const std::vector<PairStep>* table() const { return partners_.data(); }
  /// Returns the disks within the outermost step round disk i.
  [[nodiscard]] const std::vector<PairStep>& of(std::int32_t i) const { return partners_[static_cast<std::size_t>(i)]; }

  /// Returns the step of a pair at separation r by its distance, for the start of a run.
  [[nodiscard]] std::int32_t step_at(const Vec2<Real>& r, Real sigma) const {
    const Real square = r.squaredNorm();
    for (std::int32_t step = 0; step < outside(); ++step)
      if (const Real edge = outer(step) * sigma; square < edge * edge) return step;
    return outside();
  }
  /// Returns the step of a pair at separation r by its distance, or, at an edge to rounding, that side of the edge on which the
  /// pair is that was within `middle` contact distances: infinity for one that was outside.
  [[nodiscard]] std::int32_t step_at(const Vec2<Real>& r, Real sigma, double middle) const {
    using std::abs;
    const Real square = r.squaredNorm();
    for (std::int32_t step = 0; step < outside(); ++step) {
      const Real edge = outer(step) * sigma;
      if (abs(square - edge * edge) <= std::max<Real>(Real(0x1p-30), 64 * epsilon<Real>) * edge * edge)
        return Real(middle) < outer(step) ? step : step + 1;
    }
    return step_at(r, sigma);
  }
  /// Returns a distance within a step, in contact distances: the middle between its edges, infinity outside.
  [[nodiscard]] double middle(std::int32_t step) const {
    if (step == outside()) return infinity<double>;
    return static_cast<double>((inner(step) + outer(step)) / 2);
  }

  /// Returns the time until a pair in a step, at separation r with relative velocity v, comes to the inner edge of that step,
  /// which may be the hard core, or to the outer one.
  [[nodiscard]] Real next_time(std::int32_t step, const Vec2<Real>& r, const Vec2<Real>& v, Real sigma) const {
    return time_to_edge<Real>(edges_.data(), step, outside(), r, v, sigma);
  }

  /// Returns whether a pair that an event has brought together is at the edge of a step and not at the core.
  [[nodiscard]] bool at_edge(const Vec2<Real>& r, Real sigma) const {
    const Real between = sigma * (1 + edges_[1]) / 2;
    return r.squaredNorm() > between * between;
  }

  /// The pair is at an edge of its step: lets it pass, or turns it round. Changes velocities; `energy` is kinetic, gained.
  ImpactResult<Real> cross_edge(std::int32_t i, std::int32_t j, const Vec2<Real>& r, Real sigma, Real m_i, Vec2<Real>& v_i,
                                Real m_j, Vec2<Real>& v_j) {
    using std::sqrt;
    const std::int32_t step = step_of(i, j);
    const bool leaving = at_outer_edge(step, r, sigma);
    const Real distance = sqrt(r.squaredNorm());
    const Vec2<Real> n = r / distance;
    const Real u = n.dot(v_i - v_j);
    if (leaving ? !(u > 0) : !(u < 0)) return {};
    const Real reduced = reduced_mass_by_product(m_i, m_j);
    const std::int32_t beyond = leaving ? step + 1 : step - 1;
    const Real gained = energy(step) - energy(beyond);  // kinetic energy, if it passes
    const Real square = u * u + 2 * gained / reduced;
    Real change;
    if (square > 0) {
      const Real after = (leaving ? 1 : -1) * sqrt(square);
      change = 2 * gained / (reduced * (after + u));
      move(i, j, beyond);
    } else {
      change = -2 * u;
    }
    const Vec2<Real> impulse = (reduced * change) * n;
    v_i += impulse / m_i;
    v_j -= impulse / m_j;
    return {distance * reduced * change, square > 0 ? gained : Real(0)};
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(partners_, pairs_);
  }

 private:
  [[nodiscard]] std::vector<PairStep>& partners(std::int32_t i) { return partners_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Real inner(std::int32_t step) const { return edges_[static_cast<std::size_t>(step)]; }
  [[nodiscard]] Real outer(std::int32_t step) const { return edges_[static_cast<std::size_t>(step) + 1]; }
  [[nodiscard]] Real energy(std::int32_t step) const { return energies_[static_cast<std::size_t>(step)]; }
  /// Returns whether a pair at an edge of its step is at the outer one.
  [[nodiscard]] bool at_outer_edge(std::int32_t step, const Vec2<Real>& r, Real sigma) const {
    if (step == outside() || step == 0) return step == 0;  // within the innermost step the inner edge is the core
    const Real between = sigma * (inner(step) + outer(step)) / 2;
    return r.squaredNorm() > between * between;
  }
  void put(std::int32_t i, std::int32_t j, std::int32_t from, std::int32_t to) {
    std::vector<PairStep>& mine = partners(i);
    if (from == outside()) return mine.push_back({j, to});
    const auto at = std::find_if(mine.begin(), mine.end(), [j](const PairStep& pair) { return pair.disk == j; });
    if (to == outside())
      mine.erase(at);
    else
      at->step = to;
  }

  std::vector<Real> edges_ = {Real(1)};          ///< of the core and of all steps
  std::vector<Real> energies_;                   ///< of all steps, and 0 of pairs outside
  std::vector<std::vector<PairStep>> partners_;  ///< of each disk
  std::vector<std::uint64_t> pairs_;             ///< in each step
};

}  // namespace carom
