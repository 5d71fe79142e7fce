#pragma once
// What rank 0 tells all others (carom/ranks.hpp) as a C++ stream, so that an archive can be sent in as much memory as a block
// takes.

#include <carom/ranks.hpp>

#include <istream>
#include <ostream>
#include <streambuf>
#include <string>

namespace carom::detail {

/// Sends to all other ranks what is written, on rank 0: blocks of one length, and behind them one that is shorter. The last is
/// sent when this is destroyed.
class BroadcastOutput final : private std::streambuf, public std::ostream {
 public:
  explicit BroadcastOutput(Ranks& ranks);
  ~BroadcastOutput() override;
  BroadcastOutput(const BroadcastOutput&) = delete;
  BroadcastOutput& operator=(const BroadcastOutput&) = delete;

 private:
  std::streambuf::int_type overflow(std::streambuf::int_type byte) override;
  void send();

  Ranks& ranks_;
  std::string block_;
};

/// Reads, on a rank other than 0, what is sent by a BroadcastOutput. It takes what has not been read when it is destroyed.
class BroadcastInput final : private std::streambuf, public std::istream {
 public:
  explicit BroadcastInput(Ranks& ranks);
  ~BroadcastInput() override;
  BroadcastInput(const BroadcastInput&) = delete;
  BroadcastInput& operator=(const BroadcastInput&) = delete;

 private:
  std::streambuf::int_type underflow() override;
  /// Returns whether there was a further block.
  bool receive();

  Ranks& ranks_;
  std::string block_;
  bool was_last_ = false;
};

}  // namespace carom::detail
