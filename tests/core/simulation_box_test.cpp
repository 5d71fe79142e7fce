#include "core/simulation_box.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace carom::test {
namespace {

const SimulationBox<double> periodic_domain(Box{{-1.0, 2.0}, {1.0, 5.0}, {Boundary::periodic, Boundary::periodic}});

TEST(SimulationBox, PositionsInsideAreNotTouched) {
  Vec2<double> r(-1.0, 4.999);
  EXPECT_EQ(periodic_domain.wrap(r), Winding(0, 0));
  EXPECT_EQ(r, Vec2<double>(-1.0, 4.999));
}

TEST(SimulationBox, TheUpperEdgeIsTheLowerEdgeOfTheNextBox) {
  Vec2<double> r(1.0, 5.0);
  EXPECT_EQ(periodic_domain.wrap(r), Winding(1, 1));
  EXPECT_EQ(r, Vec2<double>(-1.0, 2.0));
}

TEST(SimulationBox, WalledAxesAreNeverFolded) {
  const SimulationBox<double> channel(Box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::walls, Boundary::periodic}});
  Vec2<double> r(1.5, 1.5);
  EXPECT_EQ(channel.wrap(r), Winding(0, 1));
  EXPECT_EQ(r, Vec2<double>(1.5, 0.5));
}

TEST(SimulationBox, AnUlpBelowTheLowerEdgeEndsInsideTheBox) {
  const SimulationBox<double> unit(Box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::periodic}});
  Vec2<double> r(-1e-300, 0.5);
  const Winding winding = unit.wrap(r);
  EXPECT_TRUE(r.x() >= 0.0 && r.x() < 1.0) << r.x() << " " << winding.x();
}

RC_GTEST_PROP(PropertyDomain, FoldingEndsInsideAndMovesByWholeBoxLengths, ()) {
  const double x =
      static_cast<double>(*rc::gen::inRange<std::int64_t>(-(1ll << 52), 1ll << 52)) * std::ldexp(1.0, *rc::gen::inRange(-60, -9));
  Vec2<double> r(x, 3.0);
  const Winding winding = periodic_domain.wrap(r);
  RC_ASSERT(r.x() >= -1.0 && r.x() < 1.0);
  // The product and the difference are rounded once each, at the size of x; folding an ulp short of an edge adds one.
  RC_ASSERT(std::abs(r.x() + static_cast<double>(winding.x()) * 2.0 - x) <= 0x1p-51 * (std::abs(x) + 2.0));
}

}  // namespace
}  // namespace carom::test
