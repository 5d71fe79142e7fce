#pragma once
// The reduced pressure of a gas that changes while it is measured, as growing disks make it: a mean over the last while.

#include <cmath>
#include <cstdint>
#include <numbers>

namespace carom::detail {

/// A window lasts 64 collisions of every disk: 32 N of pairs. The relative error of Z - 1 is about 1 / sqrt(pairs), so 3 % at
/// N = 32 and 0.6 % at N = 1000; a shorter window would end a growth by chance, a much longer one late. The pressure it gives is
/// that of the middle of the window, not of its end. Where growth is slow (contact distances grow by less than 1e-2 sigma
/// while a disk moves by sigma) the two differ little; fast growth passes the pressure asked for before it is noticed.
class PressureWindow {
 public:
  PressureWindow(std::uint64_t disks, double degrees_of_freedom)
      : disks_(static_cast<double>(disks)), freedom_(degrees_of_freedom), length_(32 * disks) {}

  /// A stretch of time in which so many pairs collided and handed over so much virial, with the translational kinetic energy
  /// when it began and when it ended.
  void add(double time, std::uint64_t pairs, double virial, double energy_before, double energy_after) {
    time_ += time;
    pairs_ += pairs;
    virial_ += virial;
    energy_time_ += 0.5 * (energy_before + energy_after) * time;
  }

  [[nodiscard]] bool complete() const { return pairs_ >= length_ && time_ > 0.0 && energy_time_ > 0.0; }

  /// P* = (4 eta / pi) Z with Z = 1 + virial / (2 t N kT), kT the mean over the window. Requires complete(). Begins a new window.
  double take(double packing_fraction) {
    const double temperature = 2.0 * (energy_time_ / time_) / freedom_;
    const double z = 1.0 + virial_ / (2.0 * time_ * disks_ * temperature);
    *this = PressureWindow(*this, 0);
    return 4.0 * packing_fraction / std::numbers::pi * z;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time_, pairs_, virial_, energy_time_);
  }

 private:
  PressureWindow(const PressureWindow& like, int) : disks_(like.disks_), freedom_(like.freedom_), length_(like.length_) {}

  double disks_;
  double freedom_;
  std::uint64_t length_;
  double time_ = 0.0;
  std::uint64_t pairs_ = 0;
  double virial_ = 0.0;
  double energy_time_ = 0.0;  ///< integral of the kinetic energy
};

}  // namespace carom::detail
