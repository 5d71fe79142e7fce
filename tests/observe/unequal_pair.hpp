#pragma once
// Two disks whose energies and momenta are numbers that a reader can add up.

#include "support/systems.hpp"

namespace carom::test {

/// In the box [0, 10] x [0, 10]: radius 0.5, masses 2 and 4.
inline const System unequal_pair =
    system_of(square_box(10.0, Boundary::walls), {{{1, 1}, {1.0, 2.0}, 0.5, 2.0}, {{5, 7}, {-3.0, 0.5}, 0.5, 4.0}});

}  // namespace carom::test
