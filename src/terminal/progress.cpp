#include "terminal/progress.hpp"

#include "terminal/command.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace carom::cli {

namespace {

using namespace std::chrono_literals;

// A line in place is read by a person; lines in a log are kept.
constexpr auto terminal_interval = 200ms;
constexpr auto log_interval = 2s;

/// The share of the work after which the pace says something of the rest.
constexpr double least_done = 0.02;

constexpr auto clear_line = "\r\x1b[K";

std::string share(const std::string& doing, double fraction) {
  return fmt::format("{}  {:.0f} %", doing, 100.0 * std::clamp(fraction, 0.0, 1.0));
}

}  // namespace

ProgressMode progress_mode(const std::string& when, bool quiet) {
  if (when == "always") return ProgressMode::always;
  if (when == "never") return ProgressMode::never;
  if (when != "auto") throw UsageError(fmt::format("--progress {}: it can be auto, always or never", when));
  return quiet ? ProgressMode::never : ProgressMode::automatic;
}

ProgressLine::ProgressLine(ProgressMode mode, const Scene& scene) : terminal_(isatty(STDERR_FILENO) == 1), estimate_(scene) {
  shown_ = mode == ProgressMode::always || (mode == ProgressMode::automatic && terminal_);
}

ProgressLine::~ProgressLine() {
  if (last_ && terminal_) std::fputs(clear_line, stderr);
}

void ProgressLine::update(const Progress& progress) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  if (is_due(now)) show(line(progress, now), now);
}

void ProgressLine::update(const std::string& doing, double fraction) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  if (!begun_) begun_ = {now, fraction};
  if (!is_due(now)) return;
  std::string text = share(doing, fraction);
  // The rest takes as long as its share says, by the pace since the first call.
  const double done = fraction - begun_->second;
  if (done > least_done && fraction < 1.0) {
    const double seconds = std::chrono::duration<double>(now - begun_->first).count();
    text += fmt::format("  about {} left", duration(seconds * (1.0 - fraction) / done));
  }
  show(text, now);
}

void ProgressLine::update_share(const std::string& doing, double fraction) {
  const Clock::time_point now = Clock::now();
  if (shown_ && is_due(now)) show(share(doing, fraction), now);
}

bool ProgressLine::is_due(Clock::time_point now) const {
  return !last_ || now - *last_ >= (terminal_ ? Clock::duration(terminal_interval) : Clock::duration(log_interval));
}

void ProgressLine::show(const std::string& text, Clock::time_point now) {
  last_ = now;
  if (terminal_) {
    std::fprintf(stderr, "%s%s", clear_line, text.c_str());
  } else {
    std::fprintf(stderr, "%s\n", text.c_str());
  }
  std::fflush(stderr);
}

std::string ProgressLine::line(const Progress& progress, Clock::time_point now) {
  const RunEstimate::Estimate estimate = estimate_.at(progress, now);
  std::string text = fmt::format("{}time {:.6g}  {:.0f} %  {} collisions", progress.equilibrating ? "equilibrating: " : "",
                                 progress.time, 100.0 * estimate.done, grouped(progress.totals.pair));
  if (estimate.per_second > 0.0) text += fmt::format("  {}/s", rate(estimate.per_second));
  if (estimate.seconds_left) text += fmt::format("  {} left", duration(*estimate.seconds_left));
  return text;
}

}  // namespace carom::cli
