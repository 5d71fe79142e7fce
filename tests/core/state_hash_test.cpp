// The fingerprint of a state. The digits were worked out with another program: FNV-1a in Python over struct.pack("<9d", ...).

#include <carom/state.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

State two_disks() {
  State state;
  state.time = 1.5;
  state.positions = Eigen::Matrix2Xd{{0.25, 3.0}, {-2.0, 4.0}};
  state.velocities = Eigen::Matrix2Xd{{1.0, 1e-300}, {-0.0, 5e300}};
  return state;
}

TEST(StateHash, IsThatOfTheBytesOfTimePositionsAndVelocities) {
  EXPECT_EQ(state_hash(State{}), "a8c7f832281a39c5");
  EXPECT_EQ(state_hash(two_disks()), "f2a4695924b54d8e");
}

TEST(StateHash, HoldsSpinsWhereThereAreAny) {
  State state = two_disks();
  state.spins = Eigen::Vector2d(7.0, -8.0);
  EXPECT_EQ(state_hash(state), "e8180e664d1fe6ca");
}

TEST(StateHash, TellsEveryBit) {
  const std::string hash = state_hash(two_disks());
  State other = two_disks();
  other.velocities(1, 0) = 0.0;  // not -0
  EXPECT_NE(state_hash(other), hash);
  other = two_disks();
  other.positions(0, 1) = std::nextafter(3.0, 4.0);
  EXPECT_NE(state_hash(other), hash);
}

}  // namespace
}  // namespace carom::test
