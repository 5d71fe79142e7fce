#pragma once
// The intermediate scattering function of one long wave: a part that heat conduction lets die out, and a sound wave.

#include <vector>

namespace carom::validation {

/// F(t) = h (e^(-a t) + (a / w) e^(-b t) sin w t) + s e^(-b t) (cos w t + (b / w) sin w t): a Lorentzian at 0 (Rayleigh's peak)
/// and two at the frequencies +-w (Brillouin's). The sines make dF/dt = 0 at t = 0, which is exact.
struct BrillouinFit {
  double heat = 0.0;        ///< h
  double sound = 0.0;       ///< s
  double heat_decay = 0.0;  ///< a
  double damping = 0.0;     ///< b
  double frequency = 0.0;   ///< w

  [[nodiscard]] double at(double time) const;
};

/// Returns the fit of F at these times with the least sum of squares, all points of one weight, by Levenberg and Marquardt's
/// method from `guess`. Requires more than five times. Throws std::runtime_error where it finds none.
[[nodiscard]] BrillouinFit fit_brillouin(const std::vector<double>& times, const std::vector<double>& F,
                                         const BrillouinFit& guess);

}  // namespace carom::validation
