#pragma once
// Pressures of 1024^2 hard disks across the transition from liquid to hexatic: Bernard & Krauth, Phys. Rev. Lett. 107, 155704
// (2011). Liquid and hexatic coexist from 0.700 to 0.716.

#include <array>

namespace carom::theory {

struct TransitionPressure {
  double packing_fraction;
  double pressure;  ///< P sigma^2 / kT
  double error;     ///< one standard error
};

inline constexpr std::array<TransitionPressure, 7> bernard_krauth_2011 = {{{0.698, 9.169311, 0.000073},
                                                                           {0.700, 9.18545, 0.00011},
                                                                           {0.704, 9.18692, 0.00012},
                                                                           {0.708, 9.18502, 0.00010},
                                                                           {0.712, 9.18354, 0.00011},
                                                                           {0.716, 9.18336, 0.00012},
                                                                           {0.720, 9.22765, 0.00025}}};

/// 128^2 disks at density 0.8887212022251435: the validation point of HOOMD-blue (Engel et al., Phys. Rev. E 87, 042134 (2013)).
inline constexpr double engel_2013_density = 0.8887212022251435;
inline constexpr double engel_2013_pressure = 9.17079;

}  // namespace carom::theory
