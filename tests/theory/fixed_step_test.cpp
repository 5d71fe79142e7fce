// What a fixed step does to an isolated pair: the integrals against their small- and large-step laws, and against plain sums.
//
// A pair meets with relative speed g (flux weight g^2 exp(-g^2 / 4)) and impact parameter b, even on [0, 1] in diameters. With
// the half chord c = sqrt(1 - b^2) it is in contact for 2 c / g and approaches for the first half of that. A step of random phase
// falls into a stretch of time with probability min(1, stretch / dt).

#include "theory/fixed_step.hpp"

#include "theory/equation_of_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

using theory::Detects;

const double root_pi = std::sqrt(std::numbers::pi);

/// The mean of f(g, b, c) over collisions by n x n midpoints, in g and in the angle of b = sin(angle), which is smooth at b = 1.
/// Speeds are cut off at 13, where 1e-16 of them are left.
template <class Function>
double mean_over_collisions(int n, Function f) {
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < n; ++i) {
    const double g = 13.0 * (i + 0.5) / n;
    for (int k = 0; k < n; ++k) {
      const double angle = std::numbers::pi / 2.0 * (k + 0.5) / n, c = std::cos(angle);
      const double weight = g * g * std::exp(-g * g / 4.0) * c;  // db = c d(angle)
      sum += weight * f(g, std::sin(angle), c);
      weights += weight;
    }
  }
  return sum / weights;
}

double missed_by_sums(int n, double step, double half_chords) {
  return mean_over_collisions(n,
                              [&](double g, double /*b*/, double c) { return 1.0 - std::min(1.0, half_chords * c / g / step); });
}

/// Depth at the first step after contact, over the phases in which that step still finds the pair approaching.
double depth_by_sums(int n, double step) {
  const double depth = mean_over_collisions(n, [&](double g, double b, double c) {
    const double longest = std::min(step, c / g);
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += 1.0 - std::hypot(b, c - g * longest * (k + 0.5) / n);
    return sum / n * longest / step;
  });
  return depth / (1.0 - missed_by_sums(n, step, 1.0));
}

/// The error of midpoints falls as n^-2, so what n and 2 n differ by is twelve times the error that 4 n has left: the place of a
/// bend within its cell may make that error ten times larger.
template <class Sums>
void expect_sums(double value, Sums sums, int n) {
  const double allowed = std::abs(sums(2 * n) - sums(n)), fine = sums(4 * n);
  EXPECT_NEAR(value, fine, allowed);
  EXPECT_LT(allowed, 1e-2 * fine);  // so that the comparison says something
}

TEST(FixedStepTheory, StepsThatNoticeApproachMissTheSquareOfTheStep) {
  // The share of chords below w = g step, each missed with 1 - c / w, is w^2 / 6 + w^4 / 40 + w^6 / 112 + ...; the means of g^2,
  // g^4 and g^6 are 6, 60 and 840: step^2 + 1.5 step^4 + 7.5 step^6, and what follows is below 0.5 step^6 for steps below 0.03.
  // Below w = 1e-3 the code leaves out w^4 / 40, at most 2.5e-14.
  for (const double step : {1e-5, 1e-4, 1e-3, 1e-2, 3e-2}) {
    const double law = step * step + 1.5 * std::pow(step, 4);
    EXPECT_NEAR(theory::missed_fraction(step, Detects::approaching), law, 8.0 * std::pow(step, 6) + 2.5e-14) << step;
  }
}

TEST(FixedStepTheory, StepsThatNoticeContactMissAQuarterOfThat) {
  for (const double step : {1e-5, 1e-4, 1e-3, 1e-2, 3e-2}) {  // contact lasts twice as long as approach: the law of half the step
    const double half = step / 2.0, law = half * half + 1.5 * std::pow(half, 4);
    EXPECT_NEAR(theory::missed_fraction(step, Detects::contact), law, 8.0 * std::pow(half, 6) + 2.5e-14) << step;
    EXPECT_NEAR(law, step * step / 4.0, 0.1 * std::pow(step, 4));
  }
}

TEST(FixedStepTheory, DisksAreHalfTheRootOfPiOfAStepDeepWhenTheyAreFound) {
  // 1 - sqrt(1 - 2 c x + x^2) = c x - (1 - c^2) x^2 / 2 - (c - c^3) x^3 / 2 - ..., x even on [0, g step]; the mean half chord is
  // pi / 4 and the mean of g is 4 / sqrt(pi). The third order has the share of the noticed, 1 - step^2, in it. The fourth is
  // -(11/6) step^4: -1/2 of the series, -1 of chords shorter than a step's flight, -1/3 of that share.
  for (const double step : {1e-4, 1e-3, 1e-2, 2e-2}) {
    const double law = root_pi / 2.0 * step - step * step / 3.0 + root_pi / 4.0 * std::pow(step, 3);
    EXPECT_NEAR(theory::mean_depth(step), law, 2.0 * std::pow(step, 4) + 1e-14) << step;
  }
}

TEST(FixedStepTheory, MissedFractionsAreThoseOfPlainSums) {
  for (const double step : {0.1, 0.3, 0.7, 1.0, 3.0}) {
    SCOPED_TRACE(step);
    expect_sums(
        theory::missed_fraction(step, Detects::approaching), [&](int n) { return missed_by_sums(n, step, 1.0); }, 150);
    expect_sums(
        theory::missed_fraction(step, Detects::contact), [&](int n) { return missed_by_sums(n, step, 2.0); }, 150);
  }
}

TEST(FixedStepTheory, MeanDepthsAreThoseOfPlainSums) {
  for (const double step : {0.1, 0.3, 0.7, 1.0, 3.0}) {
    SCOPED_TRACE(step);
    expect_sums(
        theory::mean_depth(step), [&](int n) { return depth_by_sums(n, step); }, 30);
  }
}

TEST(FixedStepTheory, HugeStepsMissAllButTheShareOfTheirTimeThatACollisionTakes) {
  // Then a pair is noticed with (c / g) / dt, whose mean is sqrt(pi) / (4 step); for contact twice that. Pairs slower than
  // 1 / step are noticed for certain instead, which makes pi / (16 sqrt(pi) step^3) at most, 0.111 / step^3 (for contact, slower
  // than 2 / step, eight times that), and what the quadrature makes of that corner is no more than as much again.
  for (const double step : {30.0, 1e3, 1e6}) {
    const double corner = 0.222 / std::pow(step, 3) + 1e-15;
    EXPECT_NEAR(1.0 - theory::missed_fraction(step, Detects::approaching), root_pi / (4.0 * step), corner) << step;
    EXPECT_NEAR(1.0 - theory::missed_fraction(step, Detects::contact), root_pi / (2.0 * step), 8.0 * corner) << step;
  }
}

TEST(FixedStepTheory, WhatHugeStepsFindIsAThirdDeep) {
  // Then it may be anywhere in the half of the contact disk where it approaches, where 1 - |r| has the mean 1/3. Pairs that are
  // noticed for certain are less deep; they are 0.111 / step^3 of all against sqrt(pi) / (4 step), a share of 0.26 / step^2,
  // which with the quadrature's as much again is 0.52 / step^2. Where the chord is a diameter 1 - |r| has a cone's tip, which
  // thirty points per panel know to 1e-8.
  for (const double step : {30.0, 1e3, 1e6})
    EXPECT_NEAR(theory::mean_depth(step), 1.0 / 3.0, 0.52 / (step * step) + 1e-8) << step;
}

TEST(FixedStepTheory, LongerStepsMissMore) {
  double before = 0.0;
  for (double step = 1e-3; step < 100.0; step *= 1.3) {
    const double missed = theory::missed_fraction(step, Detects::approaching);
    EXPECT_GT(missed, before);
    EXPECT_LT(theory::missed_fraction(step, Detects::contact), missed);
    EXPECT_LT(missed, 1.0);
    before = missed;
  }
}

TEST(FixedStepTheory, TheBiasOfZIsThatOfASmallerDiameter) {
  // A diameter smaller by 3 step / (2 sqrt(pi)) takes the fraction 3 step / sqrt(pi) = 1e-3 from the packing fraction. The
  // central difference of Z has an error of third order: 1e-9 / 6 times eta^3 and the third derivative of Z, which is below 1e3.
  const double step = 1e-3 * root_pi / 3.0;
  for (const double eta : {0.01, 0.05, 0.2, 0.4, 0.6, 0.68}) {
    const double smaller = theory::kolafa_rottner(eta * (1.0 - 1e-3)), larger = theory::kolafa_rottner(eta * (1.0 + 1e-3));
    EXPECT_NEAR(theory::bias_of_Z(step, eta), (smaller - larger) / 2.0 / theory::kolafa_rottner(eta), 1e-6) << eta;
  }
  // In a dilute gas Z - 1 is 2 eta and loses the fraction 3 step / sqrt(pi); the next term of Z is 3.13 eta^2.
  const double eta = 1e-6;
  EXPECT_NEAR(theory::bias_of_Z(step, eta) / (2.0 * eta), -1e-3, 1e-3 * 1e-5);
}

}  // namespace
}  // namespace carom::test
