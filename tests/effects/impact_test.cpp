// Collisions of two disks against the closed forms of classical mechanics.

#include "effects/impact.hpp"

#include "effects/reversal.hpp"
#include "effects/specular.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

namespace carom::test {
namespace {

using V = Vec2<double>;

struct Outcome {
  V v_i;
  V v_j;
  double virial;
};

template <class Rule>
Outcome collided(const V& r, double m_i, V v_i, double m_j, V v_j) {
  const double virial = collide<Rule, double>(r, m_i, v_i, m_j, v_j).virial;
  return {v_i, v_j, virial};
}

/// Random contacts with approaching velocities, and mass ratios from 1 to 1e12.
template <class Check>
void for_contacts(Check&& check) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const double ratio : {1.0, 2.0, 10.0, 1e3, 1e12}) {
    for (int k = 0; k < 500; ++k) {
      const double angle = 6.28 * normal(random);
      const V r(std::cos(angle), std::sin(angle));
      V v_i(normal(random), normal(random));
      V v_j(normal(random), normal(random));
      if (r.dot(v_i - v_j) > 0) std::swap(v_i, v_j);
      if (k % 2 == 0) {
        check(r, 1.0, v_i, ratio, v_j);
      } else {
        check(r, ratio, v_i, 1.0, v_j);
      }
    }
  }
}

// One rounding of each term: a few ulps of the largest speed there is.
constexpr double rounding_of_speeds = 16 * 0x1p-53;

TEST(Reversal, IsMinusVPlusTwiceTheCentreOfMassVelocity) {
  for_contacts([](const V& r, double m_i, const V& v_i, double m_j, const V& v_j) {
    const V centre = (m_i * v_i + m_j * v_j) / (m_i + m_j);
    const Outcome after = collided<Reversal>(r, m_i, v_i, m_j, v_j);
    const double speed = v_i.norm() + v_j.norm();
    EXPECT_LE((after.v_i - (2 * centre - v_i)).norm(), rounding_of_speeds * speed);
    EXPECT_LE((after.v_j - (2 * centre - v_j)).norm(), rounding_of_speeds * speed);
  });
}

TEST(Reversal, EqualMassesExchangeTheirVelocitiesExactly) {
  const Outcome after = collided<Reversal>({1.0, 0.2}, 0.7, {-0.3, 0.1}, 0.7, {0.4, 0.5});
  EXPECT_EQ(after.v_i, V(0.4, 0.5));
  EXPECT_EQ(after.v_j, V(-0.3, 0.1));
}

TEST(Reversal, AppliedTwiceIsNoCollisionAtAll) {
  for_contacts([](const V& r, double m_i, const V& v_i, double m_j, const V& v_j) {
    const Outcome once = collided<Reversal>(r, m_i, v_i, m_j, v_j);
    const Outcome twice = collided<Reversal>(-r, m_i, once.v_i, m_j, once.v_j);  // seen from behind, they approach again
    const double speed = v_i.norm() + v_j.norm();
    EXPECT_LE((twice.v_i - v_i).norm() + (twice.v_j - v_j).norm(), 4 * rounding_of_speeds * speed);
  });
}

TEST(Reversal, ConservesTheWholeTensorOfMomentumFlux) {
  for_contacts([](const V& r, double m_i, const V& v_i, double m_j, const V& v_j) {
    const Outcome after = collided<Reversal>(r, m_i, v_i, m_j, v_j);
    const Eigen::Matrix2d before_tensor = m_i * v_i * v_i.transpose() + m_j * v_j * v_j.transpose();
    const Eigen::Matrix2d after_tensor = m_i * after.v_i * after.v_i.transpose() + m_j * after.v_j * after.v_j.transpose();
    // An error of rounding_of_speeds in each velocity moves m v v by at most twice that.
    EXPECT_LE((after_tensor - before_tensor).norm(), 4 * rounding_of_speeds * (m_i + m_j) * std::pow(v_i.norm() + v_j.norm(), 2));
  });
}

TEST(Reversal, ChangesAngularMomentumByMinusTwoSigmaMuTimesTheTangentialVelocity) {
  for_contacts([](const V& r, double m_i, const V& v_i, double m_j, const V& v_j) {
    const Outcome after = collided<Reversal>(r, m_i, v_i, m_j, v_j);
    const double mu = m_i * m_j / (m_i + m_j);
    // Relative to the centre of mass the angular momentum is mu r x v.
    const double before = mu * cross<double>(r, v_i - v_j);
    const double change = mu * cross<double>(r, after.v_i - after.v_j) - before;
    EXPECT_NEAR(change, -2 * before, 4 * rounding_of_speeds * mu * (v_i.norm() + v_j.norm()));
  });
}

TEST(Specular, TurnsOnlyTheComponentAlongTheLineOfCentres) {
  for_contacts([](const V& r, double m_i, const V& v_i, double m_j, const V& v_j) {
    const Outcome after = collided<Specular>(r, m_i, v_i, m_j, v_j);
    const V n = r.normalized();
    const V t(-n.y(), n.x());
    const double speed = v_i.norm() + v_j.norm();
    EXPECT_NEAR(n.dot(after.v_i - after.v_j), -n.dot(v_i - v_j), rounding_of_speeds * speed);
    EXPECT_NEAR(t.dot(after.v_i), t.dot(v_i), rounding_of_speeds * speed);
    EXPECT_NEAR(t.dot(after.v_j), t.dot(v_j), rounding_of_speeds * speed);
  });
}

TEST(Specular, HeadOnEqualMassesExchangeVelocities) {
  const Outcome after = collided<Specular>({1.0, 0.0}, 1.0, {-3.0, 0.5}, 1.0, {1.0, 0.25});
  EXPECT_EQ(after.v_i, V(1.0, 0.5));
  EXPECT_EQ(after.v_j, V(-3.0, 0.25));
}

template <class Rule>
void expect_conservation() {
  for_contacts([](const V& r, double m_i, const V& v_i, double m_j, const V& v_j) {
    const Outcome after = collided<Rule>(r, m_i, v_i, m_j, v_j);
    const double speed = v_i.norm() + v_j.norm();
    const double mass = m_i + m_j;
    EXPECT_LE((m_i * after.v_i + m_j * after.v_j - m_i * v_i - m_j * v_j).norm(), rounding_of_speeds * mass * speed);
    const double before = m_i * v_i.squaredNorm() + m_j * v_j.squaredNorm();
    EXPECT_NEAR(m_i * after.v_i.squaredNorm() + m_j * after.v_j.squaredNorm(), before,
                4 * rounding_of_speeds * mass * speed * speed);
    EXPECT_GE(r.dot(after.v_i - after.v_j), 0.0) << "they still approach";
  });
}

TEST(Impact, BothRulesConserveMomentumAndEnergyAndLeavePairsReceding) {
  expect_conservation<Reversal>();
  expect_conservation<Specular>();
}

template <class Rule>
void expect_the_same_bits_from_either_side() {
  for_contacts([](const V& r, double m_i, const V& v_i, double m_j, const V& v_j) {
    const Outcome from_i = collided<Rule>(r, m_i, v_i, m_j, v_j), from_j = collided<Rule>(-r, m_j, v_j, m_i, v_i);
    EXPECT_EQ(from_i.v_i, from_j.v_j);
    EXPECT_EQ(from_i.v_j, from_j.v_i);
    EXPECT_EQ(from_i.virial, from_j.virial);
  });
}

TEST(Impact, BothRulesGiveTheSameBitsWhicheverDiskIsFirst) {
  expect_the_same_bits_from_either_side<Reversal>();
  expect_the_same_bits_from_either_side<Specular>();
}

TEST(Impact, BothRulesHandOverTheSameVirial) {
  for_contacts([](const V& r, double m_i, const V& v_i, double m_j, const V& v_j) {
    const double mu = m_i * m_j / (m_i + m_j);
    const double expected = -2 * mu * r.dot(v_i - v_j);
    const Outcome specular = collided<Specular>(r, m_i, v_i, m_j, v_j);
    EXPECT_NEAR(specular.virial, expected, 8 * 0x1p-53 * std::abs(expected));
    EXPECT_EQ(specular.virial, collided<Reversal>(r, m_i, v_i, m_j, v_j).virial);
    // It is what the momenta say: r . dp_i = -r . dp_j.
    const double mass = m_i + m_j;
    EXPECT_NEAR(specular.virial, m_j * r.dot(v_j - specular.v_j), rounding_of_speeds * mass * (v_i.norm() + v_j.norm()));
  });
}

TEST(Impact, RecedingPairsExchangeNothing) {
  const Outcome after = collided<Specular>({1.0, 0.0}, 1.0, {1.0, 2.0}, 3.0, {0.5, 0.0});
  EXPECT_EQ(after.v_i, V(1.0, 2.0));
  EXPECT_EQ(after.v_j, V(0.5, 0.0));
  EXPECT_EQ(after.virial, 0.0);
}

TEST(Impact, ARepeatedRoundTripDoesNotDriftForAnyMassRatio) {
  // A biased coefficient would heat or cool by a fixed 1e-16 per collision and show after 1e6 of them as 1e-10; random
  // rounding grows as its square root. Ten standard deviations of a walk of steps of two ulps: 10 * 1e3 * 2 * 1.1e-16.
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const double m_j : {1.0, 0.3, 3.7, 123.456, 1e6}) {
    V v_i(1.0, 0.2);
    V v_j(-0.1, 0.4);
    const double start = v_i.squaredNorm() + m_j * v_j.squaredNorm();
    for (int k = 0; k < 1'000'000; ++k) {
      V r(normal(random), normal(random));
      if (r.dot(v_i - v_j) > 0) r = -r;
      collide<Specular, double>(r, 1.0, v_i, m_j, v_j);
    }
    const double end = v_i.squaredNorm() + m_j * v_j.squaredNorm();
    EXPECT_NEAR(end / start, 1.0, 2.2e-12) << "mass " << m_j;
  }
}

TEST(Impact, ContactDistancesThatArePowersOfTwoDoNotHeat) {
  // With |r| = 1 to rounding the quotient (r . v) / r^2 alone is biased: 1e-10 after 4e6 collisions. Bound as above.
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> angle(0.0, 6.283185307179586);
  for (const double m_j : {1.0, 0.3}) {
    V v_i(1.0, 0.2);
    V v_j(-0.1, 0.4);
    const double start = v_i.squaredNorm() + m_j * v_j.squaredNorm();
    for (int k = 0; k < 1'000'000; ++k) {
      const double a = angle(random);
      V r(std::cos(a), std::sin(a));
      if (r.dot(v_i - v_j) > 0) r = -r;
      collide<Specular, double>(r, 1.0, v_i, m_j, v_j);
    }
    EXPECT_NEAR((v_i.squaredNorm() + m_j * v_j.squaredNorm()) / start, 1.0, 2.2e-12) << "mass " << m_j;
  }
}

TEST(Impact, SpeedsTooLowToBeSquaredAreTurnedAsAllOthers) {
  // 2^-550 squared is 0, 2^-520 squared has lost digits.
  for_contacts([](const V& r, double m_i, const V& v_i, double m_j, const V& v_j) {
    const Outcome usual = collided<Specular>(r, m_i, v_i, m_j, v_j);
    for (const int power : {-550, -520}) {
      const double unit = std::ldexp(1.0, power);
      const Outcome after = collided<Specular>(r, m_i, unit * v_i, m_j, unit * v_j);
      const double speed = v_i.norm() + v_j.norm();
      EXPECT_LE((after.v_i / unit - usual.v_i).norm(), rounding_of_speeds * speed) << power;
      EXPECT_LE((after.v_j / unit - usual.v_j).norm(), rounding_of_speeds * speed) << power;
    }
  });
}

TEST(Impact, AGrazingPairIsLeftRecedingEvenWhereItsVelocitiesCannotResolveTheImpulse) {
  // b = r . v is 1e-20 of |r| |v|: subtracting the impulse changes no bit.
  V v_i(0.0, 1.0);
  V v_j(1e-20, 0.0);
  const V r(1.0, 0.0);
  collide<Specular, double>(r, 1.0, v_i, 2.0, v_j);
  EXPECT_GE(r.dot(v_i - v_j), 0.0);
  EXPECT_NEAR(v_i.norm(), 1.0, 4 * 0x1p-52);
}

template <class Real>
void expect_receding_at_any_speed(std::initializer_list<int> powers) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const int power : powers)
    for (const double ratio : {1.0, 3.0, 1e12, 1e-12})
      for (const double turn : {0.5, 0.75})
        for (int k = 0; k < 200; ++k) {
          using std::ldexp;
          const auto draw = [&] { return Vec2<Real>(ldexp(Real(normal(random)), power), ldexp(Real(normal(random)), power)); };
          const Vec2<Real> r(Real(normal(random)), Real(normal(random)));
          Vec2<Real> v_i = draw(), v_j = draw();
          const Real fastest = std::max(v_i.cwiseAbs().maxCoeff(), v_j.cwiseAbs().maxCoeff());
          collide<Specular, Real>(r, Real(1), v_i, Real(ratio), v_j, {Real(turn), 0});
          collide<Reversal, Real>(r, Real(1), v_i, Real(ratio), v_j, {Real(turn), 0});
          ASSERT_GE(r.dot(v_i - v_j), Real(0)) << power << ", " << ratio;
          // No collision makes a disk faster than by twice the closing speed, and pushes apart are of the last digits: of the
          // smallest numbers the last digit is all.
          ASSERT_LE(std::max(v_i.cwiseAbs().maxCoeff(), v_j.cwiseAbs().maxCoeff()), 16 * fastest) << power;
        }
}

TEST(Impact, LeavesPairsRecedingAtTheLowestSpeedsThatThereAre) {
  expect_receding_at_any_speed<double>({-550, -1000, -1060, -1070, -1073});
  expect_receding_at_any_speed<float>({-80, -120, -140, -147});
}

TEST(Impact, BooksTheLossOfGrowingDisksApartFromTheWorkOfTheirSurfaces) {
  // Head on along (0.6, 0.8): surfaces that grow towards each other by 1/4 close in at 5/4; at e = 1/2 they part at 5/8.
  const V r(0.6, 0.8);
  V v_i = -0.5 * r, v_j = 0.5 * r;
  const InelasticResult<double> met = collide<Specular, double>(r, 1.0, v_i, 3.0, v_j, {0.75, 0.25});
  constexpr double mu = 0.75, closing = 1.25, e = 0.5, growth = 0.25;
  EXPECT_NEAR(r.dot(v_i - v_j), e * closing + growth, 8 * 0x1p-53);
  EXPECT_NEAR(met.lost, mu * (1 - e * e) * closing * closing / 2, 8 * 0x1p-53);
  EXPECT_NEAR(met.energy + met.lost, mu * growth * (1 + e) * closing, 8 * 0x1p-53) << "speed of the surfaces times impulse";
}

}  // namespace
}  // namespace carom::test
