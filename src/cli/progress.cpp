// One line on stderr that says how far a run has come: rewritten in place on a terminal, appended now and then elsewhere.

#include "cli/progress.hpp"

#include "cli/commands.hpp"
#include "cli/format.hpp"

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

constexpr auto clear_line = "\r\x1b[K";

double seconds(std::chrono::steady_clock::duration span) { return std::chrono::duration<double>(span).count(); }

}  // namespace

ProgressMode progress_mode(const std::string& when, bool quiet) {
  if (when == "always") return ProgressMode::always;
  if (when == "never") return ProgressMode::never;
  if (when != "auto") throw UsageError(fmt::format("--progress {}: it can be auto, always or never", when));
  return quiet ? ProgressMode::never : ProgressMode::automatic;
}

ProgressLine::ProgressLine(ProgressMode mode, const Scene& scene)
    : scene_(scene), terminal_(isatty(STDERR_FILENO) == 1), phase_start_(Clock::now()) {
  shown_ = mode == ProgressMode::always || (mode == ProgressMode::automatic && terminal_);
}

ProgressLine::~ProgressLine() {
  if (last_ && terminal_) std::fputs(clear_line, stderr);
}

void ProgressLine::update(const Progress& progress) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  if (progress.equilibrating != equilibrating_) {
    equilibrating_ = progress.equilibrating;
    phase_start_ = now;
  }
  if (is_due(now)) show(line(progress, now), now);
}

void ProgressLine::update(const std::string& doing, double fraction) {
  const Clock::time_point now = Clock::now();
  if (shown_ && is_due(now)) show(fmt::format("{}  {:.0f} %", doing, 100.0 * std::clamp(fraction, 0.0, 1.0)), now);
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

double ProgressLine::fraction_done(const Progress& progress) const {
  const auto pairs = static_cast<double>(progress.totals.pair);
  double fraction = 0.0;
  if (progress.equilibrating) {
    if (!scene_.run.equilibrate) return 0.0;
    const Run::Equilibrate& goal = *scene_.run.equilibrate;
    if (goal.time && *goal.time > 0.0) fraction = progress.time / *goal.time;
    // One collision is one for each of its two disks.
    if (goal.collisions_per_disk && *goal.collisions_per_disk > 0.0) {
      fraction = 2.0 * pairs / (*goal.collisions_per_disk * static_cast<double>(scene_.disk_count()));
    }
  } else {
    if (scene_.run.time && *scene_.run.time > 0.0) fraction = progress.time / *scene_.run.time;
    if (scene_.run.collisions && *scene_.run.collisions > 0) {
      fraction = std::max(fraction, pairs / static_cast<double>(*scene_.run.collisions));
    }
  }
  return std::clamp(fraction, 0.0, 1.0);
}

std::string ProgressLine::line(const Progress& progress, Clock::time_point now) const {
  const double done = fraction_done(progress);
  const double spent = seconds(now - phase_start_);
  const double speed = progress.loop_seconds > 0.0 ? static_cast<double>(progress.totals.pair) / progress.loop_seconds : 0.0;
  std::string text = fmt::format("{}time {:.6g}  {:.0f} %  {} collisions", progress.equilibrating ? "equilibrating: " : "",
                                 progress.time, 100.0 * done, grouped(progress.totals.pair));
  if (speed > 0.0) text += fmt::format("  {}/s", rate(speed));
  // An estimate from the first instants would jump about.
  if (done > 0.0 && spent > 0.5) text += fmt::format("  {} left", duration(spent * (1.0 - done) / done));
  return text;
}

}  // namespace carom::cli
