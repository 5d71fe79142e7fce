#pragma once
// Contact distances of pairs of disks over the sums of their radii, by species. They are 1 where diameters are additive.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom {

template <class Real>
class ContactScales {
 public:
  /// Additive diameters.
  ContactScales() = default;
  /// `species` has the species of each disk. `scales` has a row for each species, with the scale of its contact distance with
  /// each: all of them above 0, symmetric, and 1 for disks of one species.
  ContactScales(std::vector<std::int32_t> species, std::size_t kinds, std::vector<Real> scales)
      : species_(std::move(species)), kinds_(kinds), scales_(std::move(scales)) {}

  [[nodiscard]] bool additive() const { return scales_.empty(); }

  /// Returns the scale of disks i and j, by their ids.
  [[nodiscard]] Real of_disks(std::int32_t i, std::int32_t j) const {
    return additive() ? Real(1) : of_species(species_[static_cast<std::size_t>(i)], species_[static_cast<std::size_t>(j)]);
  }
  /// Returns the scale of two species. Requires diameters that are not additive.
  [[nodiscard]] Real of_species(std::int32_t one, std::int32_t other) const {
    return scales_[static_cast<std::size_t>(one) * kinds_ + static_cast<std::size_t>(other)];
  }
  /// Returns the largest scale of all, at least 1: no two disks touch farther apart than this times the sum of their radii.
  [[nodiscard]] Real largest() const { return additive() ? Real(1) : *std::max_element(scales_.begin(), scales_.end()); }

  /// Returns the same scales without the species of the disks, for of_species() alone.
  [[nodiscard]] ContactScales of_kinds() const { return {{}, kinds_, scales_}; }
  [[nodiscard]] std::int32_t kinds() const { return static_cast<std::int32_t>(kinds_); }
  /// Returns the rows of all species, one behind the other; null where diameters are additive.
  [[nodiscard]] const Real* rows() const { return additive() ? nullptr : scales_.data(); }

 private:
  std::vector<std::int32_t> species_;
  std::size_t kinds_ = 0;
  std::vector<Real> scales_;
};

}  // namespace carom
