#pragma once
// The momentum that walls receive, and the error of its rate. Between walls at +-h from the middle (for the centres of disks) the
// momentum P of the disks and their action G = sum of m (x - middle) v along the axis change by
//
//   dP = I_low - I_high,   dG = S dt - h (I_low + I_high),   S = sum of m v^2 + virial of collisions,
//
// where I is what each wall receives, outward positive. So I_low = S dt / 2h - d(G / h - P) / 2 and I_high = S dt / 2h - d(G / h
// + P) / 2. Sound and the flight of disks from wall to wall are in G and P, which stay bounded; the pressure is in S. Disks of
// several sizes, weight and thermal walls leave a part of G and P in the rest, which does no harm.

#include "observe/observed_run.hpp"

#include <carom/blocking.hpp>

#include <cstdint>

namespace carom {

/// The error of a rate of which one part is the change of a bounded quantity. That part cancels from one sample to the next, so
/// short blocks give far too large an error, and only blocks longer than most runs give the right one. Where the quantity is
/// known, blocks may be short: the rest is blocked without it, and the part adds no more to the total than the values of the
/// quantity at the two ends.
class RateWithBoundedPart {
 public:
  /// x is the rest less the increase of the quantity from `before` to `after`.
  void add(double x, double weight, double before, double after);
  /// offset + <x> / <w>, as Blocking has it, with the error of the rest and of the ends.
  void fill(Scalar& scalar, double step, double offset = 0.0) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(all_, rest_, weight_, count_, mean_, squares_);
  }

 private:
  Blocking all_, rest_;
  double weight_ = 0.0;      ///< total weight of all samples
  std::uint64_t count_ = 0;  ///< number of the quantity's values, with their mean and sum of squares about it
  double mean_ = 0.0, squares_ = 0.0;
};

/// P and G along one axis.
struct WallMomentum {
  double momentum = 0.0;  ///< P
  double action = 0.0;    ///< G
};

/// Returns P and G of the state along an axis.
[[nodiscard]] WallMomentum wall_momentum(const ObservedRun& run, const State& state, int axis);

/// Returns h for disks of the mean diameter; 0 where there is no room.
[[nodiscard]] double reach_between_walls(const ObservedRun& run, int axis);

}  // namespace carom
