#pragma once
// Random systems for fixed steps.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <rapidcheck.h>

#include <vector>

namespace carom::test {

inline double any_number(double from, double to) {
  return from + (to - from) * *rc::gen::inRange(0, 1 << 20) / static_cast<double>(1 << 20);
}

/// Any disks anywhere, upon each other too, in any box that is at least so wide.
inline System any_disks(double least_width) {
  const auto boundary = [] { return *rc::gen::arbitrary<bool>() ? Boundary::walls : Boundary::periodic; };
  const Box box = box_of(any_number(least_width, 20.0), any_number(least_width, 20.0), boundary(), boundary());
  const int disks = *rc::gen::inRange(0, 40);
  std::vector<Placed> placed;
  for (int i = 0; i < disks; ++i)
    placed.push_back({{any_number(0.0, 0.999) * box.lengths()[0], any_number(0.0, 0.999) * box.lengths()[1]},
                      {any_number(-2.0, 2.0), any_number(-2.0, 2.0)},
                      any_number(0.05, 0.9),
                      any_number(0.1, 9.0)});
  return system_of(box, placed);
}

}  // namespace carom::test
