#pragma once
// Square wells and shoulders: the potential energy of a pair is -depth while its distance is less than width times the hard
// contact distance. At the well's edge the relative velocity along the line of centres changes as energy demands, u'^2 = u^2 -+ 2
// depth / mu, or is reversed where there is not enough of it.
//
// Whether a pair is inside is remembered and not read from its distance, which at the edge is the edge to rounding.

#include "core/contact_time.hpp"
#include "core/reduced_mass.hpp"
#include "core/vec2.hpp"
#include "effects/impact.hpp"

#include <carom/effects.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace carom {

template <class Real>
class SquareWells {
 public:
  SquareWells(const std::optional<SquareWell>& well, std::size_t disks) {
    if (!well || well->depth == 0.0) return;
    width_ = Real(well->width);
    depth_ = Real(well->depth);
    partners_.resize(disks);
  }

  [[nodiscard]] bool present() const { return !partners_.empty(); }
  /// The wells of disks in so many slots of their own, none of them inside another's.
  [[nodiscard]] SquareWells with_slots(std::size_t slots) const {
    SquareWells part = *this;
    part.partners_.assign(partners_.empty() ? 0 : slots, {});
    part.pairs_ = 0;
    return part;
  }
  /// Tells which disks are inside the well of disk i, for engines that exchange disks; the lists of those disks say it too.
  void set(std::int32_t i, const std::vector<std::int32_t>& inside) { partners(i) = inside; }
  /// Counts the pairs anew, after set().
  void count_pairs() {
    std::uint64_t ends = 0;
    for (const auto& one : partners_) ends += one.size();
    pairs_ = ends / 2;
  }
  /// Returns the ratio of the largest distance at which disks interact to their contact distance.
  [[nodiscard]] Real reach() const { return present() ? width_ : Real(1); }

  [[nodiscard]] bool inside(std::int32_t i, std::int32_t j) const {
    const std::vector<std::int32_t>& mine = of(i);
    return std::find(mine.begin(), mine.end(), j) != mine.end();
  }
  void enter(std::int32_t i, std::int32_t j) {
    partners(i).push_back(j);
    partners(j).push_back(i);
    ++pairs_;
  }
  void leave(std::int32_t i, std::int32_t j) {
    erase(i, j);
    erase(j, i);
    --pairs_;
  }
  [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = partners_.capacity() * sizeof(std::vector<std::int32_t>);
    for (const auto& one : partners_) sum += one.capacity() * sizeof(std::int32_t);
    return sum;
  }
  /// Returns a list for each disk of those inside its well.
  [[nodiscard]] const std::vector<std::int32_t>* table() const { return partners_.data(); }
  /// Returns the disks inside the well of disk i.
  [[nodiscard]] const std::vector<std::int32_t>& of(std::int32_t i) const { return partners_[static_cast<std::size_t>(i)]; }

  /// Returns whether a pair begins inside, at separation r.
  [[nodiscard]] bool begins_inside(const Vec2<Real>& r, Real sigma) const {
    const Real edge = reach() * sigma;
    return r.squaredNorm() < edge * edge;
  }
  /// Returns whether a separation is that of the edge, to rounding: it then does not tell whether the pair is inside.
  [[nodiscard]] bool is_edge(const Vec2<Real>& r, Real sigma) const {
    using std::abs;
    const Real edge = reach() * sigma;
    return abs(r.squaredNorm() - edge * edge) <= std::max<Real>(Real(0x1p-30), 64 * epsilon<Real>) * edge * edge;
  }

  /// Returns the time until a pair at separation r with relative velocity v comes to its hard core or to the edge of its well.
  [[nodiscard]] Real next_time(bool inside, const Vec2<Real>& r, const Vec2<Real>& v, Real sigma) const {
    if (!inside) return contact_time<Real>(r, v, width_ * sigma);
    return std::min<Real>(contact_time<Real>(r, v, sigma), escape_time<Real>(r, v, width_ * sigma));
  }

  /// Returns whether a pair that an event has brought together is at the edge of the well and not at the core.
  [[nodiscard]] bool at_edge(const Vec2<Real>& r, Real sigma) const {
    const Real between = sigma * (1 + width_) / 2;
    return r.squaredNorm() > between * between;
  }

  /// The pair is at the edge: lets it in or out, or turns it round. Changes velocities; `energy` is kinetic, gained.
  ImpactResult<Real> cross_edge(std::int32_t i, std::int32_t j, const Vec2<Real>& r, Real m_i, Vec2<Real>& v_i, Real m_j,
                                Vec2<Real>& v_j) {
    using std::sqrt;
    const bool leaving = inside(i, j);
    const Real distance = sqrt(r.squaredNorm());
    const Vec2<Real> n = r / distance;
    const Real u = n.dot(v_i - v_j);
    if (leaving ? !(u > 0) : !(u < 0)) return {};
    const Real reduced = reduced_mass_by_product(m_i, m_j);
    const Real gained = leaving ? -depth_ : depth_;  // kinetic energy, if it passes
    const Real square = u * u + 2 * gained / reduced;
    Real change;
    if (square > 0) {
      const Real after = (leaving ? 1 : -1) * sqrt(square);
      change = 2 * gained / (reduced * (after + u));
      leaving ? leave(i, j) : enter(i, j);
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
  [[nodiscard]] std::vector<std::int32_t>& partners(std::int32_t i) { return partners_[static_cast<std::size_t>(i)]; }
  void erase(std::int32_t i, std::int32_t j) {
    std::vector<std::int32_t>& mine = partners(i);
    mine.erase(std::remove(mine.begin(), mine.end(), j), mine.end());
  }

  Real width_ = 1;
  Real depth_ = 0;
  std::vector<std::vector<std::int32_t>> partners_;  ///< of each disk
  std::uint64_t pairs_ = 0;
};

}  // namespace carom
