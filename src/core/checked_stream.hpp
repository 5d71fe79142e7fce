#pragma once
// Bytes in pieces, each with a checksum of all bytes up to its end: what is read back is what was written, or an exception before
// any of it is used.

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <streambuf>
#include <vector>

namespace carom {

namespace detail {

/// XXH3 of 64 bits, going on from `sum`.
inline std::uint64_t checksum(std::uint64_t sum, const void* data, std::size_t size) {
  return XXH3_64bits_withSeed(data, size, sum);
}

struct PieceHead {
  std::uint64_t size;  ///< bytes that follow; 0 behind the last of them
  std::uint64_t sum;
};

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
  std::uint64_t sum_ = 0;
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
  std::uint64_t sum_ = 0;
  bool ended_ = false;
};

/// Calls `write` with a stream, whose bytes go to `out` in checked pieces.
template <class Write>
void write_checked(std::ostream& out, Write write) {
  CheckedWriting checked(out);
  std::ostream within(&checked);
  write(within);
  checked.finish();
}

/// Calls `read` with a stream of what write_checked() has written to `in`. Throws std::runtime_error where that has changed or is
/// cut short, and where `read` leaves something over.
template <class Read>
void read_checked(std::istream& in, Read read) {
  CheckedReading checked(in);
  std::istream within(&checked);
  read(within);
  if (!checked.at_end()) throw std::runtime_error("there is more than what was to be read");
}

}  // namespace carom
