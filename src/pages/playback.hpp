#pragma once
// A recorded run at any time: exactly, from its events, where it kept them; else on straight lines from sample to sample.

#include "pages/moment.hpp"
#include "pages/recording.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace carom {

struct PlaybackOptions {
  double trail = 0.0;                          ///< length of trails, in time; 0: none
  std::optional<std::int32_t> trails_of = {};  ///< the species that leaves them; absent: all
  std::uint64_t most_events = 10'000'000;      ///< more are not replayed: they take 1.1 GB of memory
};

class Playback {
 public:
  /// Throws OutputError where the run cannot be read.
  explicit Playback(const Recording& run, const PlaybackOptions& options = {});
  ~Playback();
  Playback(const Playback&) = delete;
  Playback& operator=(const Playback&) = delete;

  [[nodiscard]] bool exact() const { return why_not_.empty(); }
  [[nodiscard]] const std::string& why_not() const { return why_not_; }  ///< half a sentence where it is not exact
  [[nodiscard]] double begin() const { return begin_; }
  [[nodiscard]] double end() const { return end_; }
  [[nodiscard]] double last_sample() const { return last_sample_; }

  /// Requires begin() <= time <= end(). Quick where times increase from call to call: others begin anew. What is returned holds
  /// until the next call.
  const Moment& at(double time);

  class Source;

 private:
  std::unique_ptr<Source> source_;
  std::string why_not_;
  double begin_ = 0.0, end_ = 0.0, last_sample_ = 0.0;
  Moment moment_;
};

}  // namespace carom
