// carom movie RUN_DIR -o FILE: a run as a film, or one moment of it as a picture.

#include "app/movie_plan.hpp"
#include "io/partial_file.hpp"
#include "pages/clock_format.hpp"
#include "pages/playback.hpp"
#include "pages/replay.hpp"
#include "terminal/command.hpp"
#include "terminal/progress.hpp"
#include "terminal/reading_process.hpp"
#include "terminal/signals.hpp"
#include "text/numbers.hpp"

#include <carom/io/run_reader.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

namespace carom::cli {

namespace {

namespace fs = std::filesystem;

/// Whose trails are drawn.
std::optional<std::int32_t> species_of(const MovieOptions& options, const RunReader& run) {
  const std::vector<std::string>& names = run.species_names();
  if (options.trails_of.empty()) return {};
  const auto found = std::find(names.begin(), names.end(), options.trails_of);
  if (found != names.end()) return static_cast<std::int32_t>(found - names.begin());
  throw UsageError(
      fmt::format("--trails-of {}: this run has no such species; it has {}", options.trails_of, fmt::join(names, ", ")));
}

/// Returns why its collisions cannot be replayed, with an event log or without one.
std::string why_no_collisions(const RunReader& run, const Playback& playback) {
  const std::string never = why_no_replay(run.scene());
  return never.empty() ? playback.why_not() : never;
}

DrawableTimes drawable_times(const RunReader& run, const Playback& playback) {
  DrawableTimes times{.begin = playback.begin(), .end = playback.end(), .last_sample = playback.last_sample(), .words = {}};
  if (playback.exact() || run.end() <= times.end) {
    times.words = fmt::format("the run goes from time {} to {}", times.begin, times.end);
    return times;
  }
  const bool events_help = !run.has_event_log() && why_no_replay(run.scene()).empty();
  times.words =
      fmt::format("its samples go from time {} to {}, and the run to {}; to draw its end, run the scene with {}", times.begin,
                  times.end, run.end(), events_help ? "--events" : "a sample_every of which its time is a multiple");
  return times;
}

Look look_of(const MovieOptions& options, const MoviePlan& plan, const RunReader& run, const Playback& playback) {
  Look look{.dark = options.dark, .velocities = options.velocities, .caption = !options.bare};
  look.colouring = plan.colouring.value_or(run.species_names().size() > 1 ? Colouring::species : Colouring::speed);
  if (look.colouring == Colouring::collisions && !playback.exact())
    throw UsageError(fmt::format("--colour collisions: the collisions of {} are not known: {}", options.directory,
                                 why_no_collisions(run, playback)));
  return look;
}

/// False where it was interrupted.
bool draw_film(const PartialFile& file, Playback& playback, const Painter& painter, const MoviePlan& plan,
               const std::vector<double>& times, ProgressLine& progress, const StopRequest& stop) {
  const PictureSize size = painter.size();
  FilmWriter film(file, {std::get<FilmFormat>(plan.format), size.width, size.height, plan.fps}, [&stop] { return !stop.made(); });
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (!film.frame(painter.frame(playback.at(times[k])))) return false;
    progress.update(fmt::format("drawing frame {} of {}", k + 1, times.size()),
                    static_cast<double>(k + 1) / static_cast<double>(times.size()));
  }
  return film.finish();
}

std::string film_words(const MoviePlan& plan, const std::vector<double>& times) {
  const auto frames = static_cast<double>(times.size());
  return fmt::format("{} at {:g} per second, {:.3g} s, times {:g} to {:g}", counted(times.size(), "frame"), plan.fps,
                     frames / plan.fps, times.front(), times.back());
}

ExitCode draw(const MovieOptions& options) {
  const MoviePlan plan = movie_plan(options);
  const ProgressMode mode = progress_mode(options.progress, options.quiet);
  auto limit = std::make_optional<ReadingLimit>(options.directory);
  const auto run = as_usage_error([&] { return std::make_unique<RunReader>(options.directory); });
  const PlaybackOptions wanted{.trail = options.trails.value_or(0.0), .trails_of = species_of(options, *run)};
  const auto playback = as_usage_error([&] { return std::make_unique<Playback>(*run, wanted); });
  limit.reset();
  const std::vector<double> times = picture_times(options, plan, drawable_times(*run, *playback));
  const Look look = look_of(options, plan, *run, *playback);
  const StopRequest stop;
  Ranges ranges = ranges_of(*playback, run->scene(), times.front(), times.back());
  ranges.clock = clock_format(times);
  const Painter painter(run->scene(), run->disks(), run->species_names(), look, ranges,
                        size_for(plan, ranges.extent, look.caption));
  const auto file = as_usage_error([&] { return std::make_unique<PartialFile>(plan.path); });
  bool complete = true;
  if (plan.is_film()) {
    ProgressLine progress(mode, run->scene());
    complete = draw_film(*file, *playback, painter, plan, times, progress, stop);
  } else {
    file->write(painter.picture(playback->at(times.front()), std::get<PictureFormat>(plan.format)));
  }
  if (!complete) {
    fmt::print(stderr, "carom: {}: interrupted; no film was written\n", plan.path.string());
    return exit_interrupted;
  }
  file->publish();
  if (!playback->exact())
    fmt::print(stderr, "carom: between samples the disks are drawn on straight lines: {}\n", playback->why_not());
  if (options.quiet) return exit_done;
  fmt::print("{}  {}, {} x {}, {}{}\n", plan.path.string(), size(static_cast<double>(fs::file_size(plan.path))),
             painter.size().width, painter.size().height,
             plan.is_film() ? film_words(plan, times) : fmt::format("time {:g}", times.front()),
             playback->exact() ? ", exact" : ", interpolated between samples");
  return exit_done;
}

}  // namespace

ExitCode movie(const MovieOptions& options) {
  return in_reading_process(options.directory, [&] { return draw(options); });
}

}  // namespace carom::cli
