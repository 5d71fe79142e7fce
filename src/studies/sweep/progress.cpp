#include "studies/sweep/progress.hpp"

#include "core/seconds_since.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

namespace carom::cli {

SweepProgress::SweepProgress(ProgressMode mode, std::size_t runs, std::size_t before)
    : line_(mode, Scene{}), runs_(runs), before_(before) {}

void SweepProgress::begun() {
  const std::scoped_lock lock(mutex_);
  ++begun_;
  show();
}

void SweepProgress::ended(const RunEnd& end) {
  const std::scoped_lock lock(mutex_);
  ++(end.finished ? finished_ : end.failure.empty() ? stopped_ : failed_);
  show();
}

void SweepProgress::tick() {
  const std::scoped_lock lock(mutex_);
  show();
}

std::string SweepProgress::words() const {
  const std::size_t ended = finished_ + failed_ + stopped_;
  std::string text = fmt::format("{} of {} runs, {} at work", grouped(before_ + finished_), grouped(runs_), begun_ - ended);
  if (failed_ > 0) text += fmt::format(", {} failed", failed_);
  if (ended > 0) {
    const double seconds = seconds_since(start_);
    const auto left = static_cast<double>(runs_ - before_ - ended);
    text += fmt::format("  about {} left", duration(seconds * left / static_cast<double>(ended)));
  }
  return text;
}

void SweepProgress::show() {
  const std::size_t done = before_ + finished_ + failed_;
  line_.update(words(), static_cast<double>(done) / static_cast<double>(runs_));
}

}  // namespace carom::cli
