#include "parallel/broadcast_stream.hpp"

#include <cstddef>

namespace carom::detail {

namespace {
constexpr std::size_t block_bytes = std::size_t{1} << 20;
}

BroadcastOutput::BroadcastOutput(Ranks& ranks)
    : std::ostream(static_cast<std::streambuf*>(this)), ranks_(ranks), block_(block_bytes, '\0') {
  exceptions(badbit | failbit);
  setp(block_.data(), block_.data() + block_bytes);
}

BroadcastOutput::~BroadcastOutput() {
  if (pptr() == epptr()) send();
  block_.resize(static_cast<std::size_t>(pptr() - pbase()));
  ranks_.broadcast(block_);
}

/// Sends the block, which is full, and begins another.
void BroadcastOutput::send() {
  ranks_.broadcast(block_);
  setp(block_.data(), block_.data() + block_bytes);
}

std::streambuf::int_type BroadcastOutput::overflow(std::streambuf::int_type byte) {
  send();
  if (std::streambuf::traits_type::eq_int_type(byte, std::streambuf::traits_type::eof()))
    return std::streambuf::traits_type::not_eof(byte);
  return sputc(std::streambuf::traits_type::to_char_type(byte));
}

BroadcastInput::BroadcastInput(Ranks& ranks) : std::istream(static_cast<std::streambuf*>(this)), ranks_(ranks) {}

BroadcastInput::~BroadcastInput() {
  while (receive()) {
  }
}

bool BroadcastInput::receive() {
  if (was_last_) return false;
  ranks_.broadcast(block_);
  was_last_ = block_.size() < block_bytes;
  setg(block_.data(), block_.data(), block_.data() + block_.size());
  return true;
}

std::streambuf::int_type BroadcastInput::underflow() {
  if (!receive() || gptr() == egptr()) return std::streambuf::traits_type::eof();
  return std::streambuf::traits_type::to_int_type(*gptr());
}

}  // namespace carom::detail
