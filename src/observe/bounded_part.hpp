#pragma once
// Errors of a rate of which one part is the change of a bounded quantity. That part cancels from one sample to the next, so that
// short blocks give far too large an error, and only blocks of a length that few runs have give the right one. Where the quantity
// is known no block need be so long: the rest is blocked without it, and the part itself adds to the total no more than the
// quantity's values at the two ends.
//
// The momentum that walls receive is of this kind: see wall_momentum.hpp.

#include <carom/blocking.hpp>

#include <cstdint>

namespace carom {

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

}  // namespace carom
