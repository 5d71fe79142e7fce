#pragma once
// The two sources of positions between samples.

#include "pages/exact_run.hpp"
#include "pages/playback.hpp"
#include "pages/trails.hpp"

namespace carom {

class Playback::Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;
  virtual void read(double time, Moment& moment) = 0;
};

namespace detail {

std::unique_ptr<Playback::Source> exact_source(const RunReader& run, ExactRun exact, std::optional<Trails> trails);
std::unique_ptr<Playback::Source> sample_source(const RunReader& run, std::optional<Trails> trails);

}  // namespace detail

}  // namespace carom
