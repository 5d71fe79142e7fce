#pragma once
// Packing fractions as a scene writes them: the share of one species, and that of all disks together which a grown start names.
// All that is wrong with them is thrown as a Refusal.

#include "scene/draft.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace carom::detail {

/// A packing fraction as it was written.
struct Share {
  double value = 0.0;
  std::string path;  ///< "disks.0.packing_fraction"
  std::string key;   ///< the path of what was written
};

/// Throws unless it is below 1.
void require_fraction(const Share& share);

/// Returns whether values that say the same twice are near enough.
bool agree(double a, double b);

/// Returns the area that a species' disks cover; empty where count or radius is still unknown.
std::optional<double> disk_area(const DisksDraft& disks);
/// Returns the area that all disks cover; empty where that of a species is still unknown.
std::optional<double> total_area(const std::vector<DisksDraft>& species);

/// Returns the packing fraction of the grown start of a scene; empty where no start is grown. All species are grown or none is.
/// `species`: the positions of each, null for those without disks.
std::optional<Share> grown_share(std::span<const Positions* const> species);

/// Fills the one radius that may be left open, from what the other species leave of the grown share. Throws where two are open.
/// Requires every count.
void radius_from_grown(std::vector<DisksDraft>& species, const Share& grown, double area);

}  // namespace carom::detail
