// Sums without rounding, against numbers of 4,000 bits: any terms in any order, split as one likes.

#include "core/exact_sum.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace carom::test {
namespace {

using Whole = boost::multiprecision::cpp_int;

constexpr double largest = std::numeric_limits<double>::max(), smallest = std::numeric_limits<double>::denorm_min();

/// In units of the smallest double.
Whole in_smallest(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // x = mantissa 2^exponent
  Whole whole(static_cast<std::int64_t>(std::ldexp(mantissa, 53)));
  const int shift = exponent - 53 + 1074;
  return shift >= 0 ? Whole(whole << shift) : Whole(whole >> -shift);  // what is shifted out of a subnormal number is 0
}

/// To the nearest double, ties to even: the slow twin.
double rounded(Whole sum) {
  const bool negative = sum < 0;
  if (negative) sum = -sum;
  if (sum == 0) return 0.0;
  const int bits = static_cast<int>(msb(sum)) + 1, dropped = std::max(0, bits - 53);
  Whole kept = sum >> dropped;
  const Whole rest = sum - (kept << dropped);
  if (dropped > 0) {
    const Whole half = Whole(1) << (dropped - 1);
    if (rest > half || (rest == half && (kept & 1) != 0)) ++kept;
  }
  const double size = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(kept)), dropped - 1074);
  return negative ? -size : size;
}

double exact(const std::vector<double>& terms) {
  Whole sum = 0;
  for (const double term : terms) sum += in_smallest(term);
  return rounded(sum);
}

double found(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double term : terms) sum.add(term);
  return sum.value();
}

/// Any finite bits, terms that nearly cancel, or terms of about one size, which are split.
std::vector<double> any_terms(std::mt19937_64& random, int count) {
  std::vector<double> terms;
  const int kind = static_cast<int>(random() % 4), size = static_cast<int>(random() % 1700) - 950;
  for (int k = 0; k < count; ++k) {
    double term = std::bit_cast<double>(random());
    while (!std::isfinite(term)) term = std::bit_cast<double>(random());
    if (kind == 1) term = std::ldexp(static_cast<double>(random() % 1000) - 499.5, static_cast<int>(random() % 120) - 1074);
    if (kind == 2 && k % 2 == 1) term = std::nextafter(-terms.back(), 0.0);
    if (kind == 3) term = std::ldexp(static_cast<double>(random() >> 11 | 1), size + static_cast<int>(random() % 39));
    if (std::abs(term) > 1e300) term *= 1e-10;
    terms.push_back(term);
  }
  return terms;
}

RC_GTEST_PROP(PropertyExactSum, IsRoundedOnceWhateverTheTermsAndTheirOrder, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  std::vector<double> terms = any_terms(random, *rc::gen::inRange(0, 3000));
  const double sum = exact(terms);
  RC_ASSERT(found(terms) == sum);
  std::shuffle(terms.begin(), terms.end(), random);
  RC_ASSERT(found(terms) == sum);
  ExactSum first, second;
  const std::size_t middle = terms.empty() ? 0 : random() % terms.size();
  for (std::size_t k = 0; k < terms.size(); ++k) (k < middle ? first : second).add(terms[k]);
  first.add(second);
  RC_ASSERT(first.value() == sum);
}

TEST(ExactSum, KeepsWhatDoublesLose) {
  EXPECT_EQ(found({1e308, 1.0, -1e308}), 1.0);
  EXPECT_EQ(found({largest, smallest, -largest}), smallest);
  EXPECT_EQ(found({1.0, 0x1p-53}), 1.0);  // a tie, to even
  EXPECT_EQ(found({1.0, 0x1p-53, smallest}), std::nextafter(1.0, 2.0));
  EXPECT_EQ(found({-1.0, -0x1p-53, -smallest}), -std::nextafter(1.0, 2.0));
  EXPECT_EQ(found(std::vector<double>(1'000'000, 0.1)), exact(std::vector<double>(1'000'000, 0.1)));
}

TEST(ExactSum, LosesNothingOfTermsAsSmallAndAsLargeAsAreSplitBesideTheFirst) {
  // All terms have one sign, and sums of multiples and of rests are as long as they can be, if terms are split at 2^(exponent -
  // 25) or next to it: the large terms end with that digit, and the small ones have the largest rest that does not end before
  // they do. The last term leaves only what a double cannot hold of the sum of the others.
  for (const int exponent : {-960, -900, 0, 900, 960})
    for (const int up : {-19, -18, 0, 18, 19})
      for (const int down : {-19, -18})
        for (const int split : {-24, -25, -26})
          for (const int one_of : {1, 3})
            for (const double sign : {1.0, -1.0}) {
              const double large = std::ldexp(sign * (2.0 - std::ldexp(1.0, split - up)), exponent + up);
              const double small = std::ldexp(sign * (1.0 + std::ldexp(1.0, split - 1 - down) - 0x1p-52), exponent + down);
              std::vector<double> terms = {std::ldexp(sign, exponent)};
              for (int k = 0; k < 1501; ++k) terms.push_back(k % one_of == 0 ? large : small);
              terms.push_back(-exact(terms));
              ASSERT_EQ(found(terms), exact(terms)) << exponent << " " << up << " " << down;
            }
}

TEST(ExactSum, OfNothingIsPlusZero) {
  EXPECT_FALSE(std::signbit(found({})));
  EXPECT_FALSE(std::signbit(found({-0.0})));
  EXPECT_FALSE(std::signbit(found({1.5, -1.5})));
}

TEST(ExactSum, GoesBeyondTheLargestDoubleOnItsWayBack) {
  EXPECT_EQ(found({largest, largest, -largest}), largest);
  EXPECT_EQ(found({largest, largest}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(found(std::vector<double>(5000, -largest)), -std::numeric_limits<double>::infinity());
}

TEST(ExactSum, OfWhatIsNoFiniteNumberIsNone) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(found({1.0, infinity, -1e308}), infinity);
  EXPECT_TRUE(std::isnan(found({infinity, -infinity})));
  EXPECT_TRUE(std::isnan(found({std::nan(""), 1.0})));
}

}  // namespace
}  // namespace carom::test
