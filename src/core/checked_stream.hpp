#pragma once
// Bytes in pieces, each with a checksum of all bytes up to its end: what is read back is what was written, or an exception before
// any of it is used.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <streambuf>
#include <vector>

namespace carom {

namespace detail {

/// FNV-1a over words of 8 bytes, going on from `sum`. Of data of one size, a change within one word always changes the sum.
inline std::uint64_t checksum(std::uint64_t sum, const char* data, std::size_t size) {
  sum = (sum ^ size) * 0x100000001b3U;
  for (std::size_t at = 0; at < size; at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, data + at, std::min<std::size_t>(8, size - at));
    sum = std::rotl((sum ^ word) * 0x100000001b3U, 23);
  }
  return sum;
}

struct PieceHead {
  std::uint64_t size;  ///< bytes that follow; 0 behind the last of them
  std::uint64_t sum;
};

inline constexpr std::uint64_t first_sum = 0xcbf29ce484222325U;
inline constexpr std::size_t largest_piece = std::size_t{1} << 20;

}  // namespace detail

/// Writes to another stream. finish() is to be called at the end.
class CheckedWriting final : public std::streambuf {
 public:
  explicit CheckedWriting(std::ostream& out) : out_(out), piece_(detail::largest_piece) {
    setp(piece_.data(), piece_.data() + piece_.size());
  }
  void finish() {
    if (pptr() > pbase()) write_piece();
    write_piece();
  }

 protected:
  int_type overflow(int_type c) override {
    write_piece();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

 private:
  void write_piece() {
    const auto size = static_cast<std::size_t>(pptr() - pbase());
    sum_ = detail::checksum(sum_, pbase(), size);
    const detail::PieceHead head{size, sum_};
    out_.write(reinterpret_cast<const char*>(&head), sizeof(head));
    out_.write(pbase(), static_cast<std::streamsize>(size));
    if (!out_) throw std::runtime_error("cannot write the state down");
    setp(piece_.data(), piece_.data() + piece_.size());
  }

  std::ostream& out_;
  std::vector<char> piece_;
  std::uint64_t sum_ = detail::first_sum;
};

/// Reads what CheckedWriting has written. Throws std::runtime_error where it is shorter, or its bytes are others.
class CheckedReading final : public std::streambuf {
 public:
  explicit CheckedReading(std::istream& in) : in_(in) {}
  /// Whether all of it has been read.
  [[nodiscard]] bool at_end() { return traits_type::eq_int_type(sgetc(), traits_type::eof()); }

 protected:
  int_type underflow() override {
    if (ended_) return traits_type::eof();
    detail::PieceHead head{};
    read(reinterpret_cast<char*>(&head), sizeof(head));
    if (head.size > detail::largest_piece) throw std::runtime_error(changed);
    piece_.resize(head.size);
    read(piece_.data(), piece_.size());
    sum_ = detail::checksum(sum_, piece_.data(), piece_.size());
    if (sum_ != head.sum) throw std::runtime_error(changed);
    ended_ = head.size == 0;
    if (ended_) return traits_type::eof();
    setg(piece_.data(), piece_.data(), piece_.data() + piece_.size());
    return traits_type::to_int_type(piece_.front());
  }

 private:
  static constexpr const char* changed = "bytes have changed since they were written: their checksum is wrong";

  void read(char* to, std::size_t size) {
    in_.read(to, static_cast<std::streamsize>(size));
    if (static_cast<std::size_t>(in_.gcount()) != size) throw std::runtime_error("the end of what was written is missing");
  }

  std::istream& in_;
  std::vector<char> piece_;
  std::uint64_t sum_ = detail::first_sum;
  bool ended_ = false;
};

}  // namespace carom
