#pragma once
// A sum of doubles without any rounding: the same in whatever order, and by however many threads, its terms are added. The sum is
// a fixed-point number that reaches from the smallest double to beyond the largest, in pieces of 32 bits that carry late: the
// small superaccumulator of Neal, "Fast exact summation using small and large superaccumulators", arXiv:1505.05571 (2015).
//
// Most terms are about as large as others before them. Such a term is split into a multiple of some power of two and a rest, and
// each is added to a double that holds the sum of hundreds without rounding, in fewer instructions.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace carom {

class ExactSum {
 public:
  /// Adds a term. An infinite or undefined term makes the sum infinite or undefined.
  void add(double term) {
    const double size = std::abs(term);
    if (size >= least_ && size < most_) [[likely]] {
      const double multiple = (term + shift_) - shift_;
      multiples_ += multiple;
      rests_ += term - multiple;
      if (++split_ == most_split) gather();
    } else {
      add_other(term);
    }
  }

  /// Adds all terms of another sum.
  void add(const ExactSum& other) {
    ExactSum terms = other;
    terms.gather();
    terms.carry();
    gather();
    carry();
    for (std::size_t k = 0; k < pieces_.size(); ++k) pieces_[k] += terms.pieces_[k];
    beyond_ += terms.beyond_;
    carry();
  }

  /// Returns the sum, rounded once to the nearest double; +0 where it vanishes.
  [[nodiscard]] double value() const {
    if (beyond_ != 0.0) return beyond_;  // a NaN is not 0 either
    ExactSum sum = *this;
    sum.gather();
    sum.carry();
    const bool negative = sum.pieces_.back() < 0;
    if (negative) {
      for (std::int64_t& piece : sum.pieces_) piece = -piece;
      sum.carry();
    }
    std::size_t top = sum.pieces_.size() - 1;
    while (top > 0 && sum.pieces_[top] == 0) --top;
    // Three pieces hold at least 65 bits from the first one that is set; of the rest only whether it is 0 matters for rounding.
    Wide leading = 0;
    std::uint64_t rest = 0;
    for (std::size_t k = 0; k <= top; ++k) {
      const auto piece = static_cast<std::uint64_t>(sum.pieces_[k]);
      if (k + 2 < top)
        rest |= piece;
      else
        leading |= Wide{piece} << (bits_of_piece * (k + 2 - top));
    }
    if (rest != 0) leading |= 1;
    const double size =
        std::ldexp(static_cast<double>(leading), static_cast<int>(bits_of_piece) * (static_cast<int>(top) - 2) - lowest_bit);
    return negative ? -size : size;
  }

 private:
  __extension__ using Wide = unsigned __int128;
  static constexpr std::uint32_t bits_of_piece = 32;
  /// A term with the exponent e stands e - 1075 binary places above 1; the lowest piece begins at 2^-1075.
  static constexpr int lowest_bit = 1075;
  /// A term adds less than 2^52 to a piece, which has been carried to less than 2^32.
  static constexpr std::uint64_t most_added = 1000;

  /// So many terms are split before their sums are added to the pieces.
  static constexpr std::uint64_t most_split = 512;

  /// Adds a term that is not of the size of those that are split, and has those of about its size split from now on.
  [[gnu::noinline]] void add_other(double term) {
    if (term == 0.0) return;
    add_to_pieces(term);
    const auto exponent = static_cast<int>(std::bit_cast<std::uint64_t>(term) >> 52 & 0x7ffU) - 1023;
    if (std::abs(exponent) > 900) return;  // a bound might be no normal number
    // With 2^e <= |term| < 2^(e + 1), terms from 2^(e - 18) to below 2^(e + 19) are split from now on: into a multiple of 2^k, k
    // = e - 25, and a rest of at most 2^(k - 1), which is a multiple of 2^(k - 45), as all of such a term is. 512 of the
    // multiples are at most 2^(e + 28) = 2^53 * 2^k, and 512 of the rests at most 2^(k + 8) = 2^53 * 2^(k - 45): no sum of them
    // is rounded.
    gather();
    least_ = std::ldexp(1.0, exponent - 18);
    most_ = std::ldexp(1.0, exponent + 19);
    shift_ = std::ldexp(1.5, exponent - 25 + 52);
  }

  /// Adds to the pieces what has been split.
  [[gnu::noinline]] void gather() {
    add_to_pieces(multiples_);
    add_to_pieces(rests_);
    multiples_ = rests_ = 0.0;
    split_ = 0;
  }

  /// Adds a term to the pieces, in two integer additions.
  void add_to_pieces(double term) {
    const auto bits = std::bit_cast<std::uint64_t>(term);
    const auto exponent = static_cast<std::uint32_t>(bits >> 52) & 0x7ffU;
    if (exponent == 0x7ffU) [[unlikely]] {
      beyond_ += term;
      return;
    }
    const std::uint64_t fraction = bits & 0xfffffffffffffU;
    // Subnormal numbers have the exponent of the smallest normal ones, and no leading one.
    const std::uint64_t mantissa = exponent == 0 ? fraction : fraction | 0x10000000000000U;
    const std::uint32_t place = exponent == 0 ? 1 : exponent, shift = place % bits_of_piece;
    const auto sign = -static_cast<std::int64_t>(bits >> 63);  // 0 or -1: (x ^ sign) - sign is x or -x
    const auto low = static_cast<std::int64_t>((mantissa << shift) & 0xffffffffU);
    const auto high = static_cast<std::int64_t>(mantissa >> (bits_of_piece - shift));
    std::int64_t* piece = &pieces_[place / bits_of_piece];
    piece[0] += (low ^ sign) - sign;
    piece[1] += (high ^ sign) - sign;
    if (++added_ == most_added) carry();
  }

  /// Leaves 32 bits in every piece but the last, which has the sign.
  void carry() {
    for (std::size_t k = 0; k + 1 < pieces_.size(); ++k) {
      const std::int64_t over = pieces_[k] >> bits_of_piece;
      pieces_[k] -= over << bits_of_piece;
      pieces_[k + 1] += over;
    }
    added_ = 0;
  }

  /// 64 for exponents from 0 to 2047, one for the upper part of the largest, and one for sums beyond these: 2^63 terms.
  std::array<std::int64_t, 66> pieces_{};
  std::uint64_t added_ = 0;  ///< since pieces were carried
  double beyond_ = 0.0;      ///< sum of the terms that are no finite numbers

  double least_ = 0.0, most_ = 0.0;       ///< terms of a size from the one to below the other are split
  double shift_ = 0.0;                    ///< to be added and subtracted: rounds to multiples
  double multiples_ = 0.0, rests_ = 0.0;  ///< sums of what has been split
  std::uint64_t split_ = 0;               ///< terms in them
};

}  // namespace carom
