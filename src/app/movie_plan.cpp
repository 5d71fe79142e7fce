#include "app/movie_plan.hpp"
#include "text/number_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

constexpr int fewest_pixels = 16, most_pixels = 8192;  // pixels: one disk can be seen, and a film's frame stays below 270 MB
constexpr double usual_seconds = 10.0;
constexpr double most_frames = 100'000.0;  // an hour

std::variant<FilmFormat, PictureFormat> format_of(const fs::path& path) {
  constexpr std::array films = {std::pair{".mp4", FilmFormat::mp4}, std::pair{".webm", FilmFormat::webm},
                                std::pair{".gif", FilmFormat::gif}};
  constexpr std::array pictures = {std::pair{".png", PictureFormat::png}, std::pair{".svg", PictureFormat::svg},
                                   std::pair{".pdf", PictureFormat::pdf}};
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [name, format] : films)
    if (ending == name) return format;
  for (const auto& [name, format] : pictures)
    if (ending == name) return format;
  throw UsageError(fmt::format("-o {}: the name must end in .mp4, .webm or .gif for a film, in .png, .svg or .pdf for a picture",
                               path.string()));
}

int pixels_of(std::string_view text, const std::string& whole) {
  const std::optional<int> pixels = number_in<int>(text);
  if (pixels && *pixels >= fewest_pixels && *pixels <= most_pixels) return *pixels;
  throw UsageError(
      fmt::format("--size {}: it can be the longer side or WIDTHxHEIGHT in pixels, from {} to {}, such as 1080 or 1920x1080",
                  whole, fewest_pixels, most_pixels));
}

std::variant<int, PictureSize> size_of(const std::string& text, int usual) {
  if (text.empty()) return usual;
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return pixels_of(text, text);
  const std::string_view view = text;
  return PictureSize{pixels_of(view.substr(0, cross), text), pixels_of(view.substr(cross + 1), text)};
}

std::optional<Colouring> colouring_of(const std::string& name) {
  if (name.empty()) return {};
  for (const auto& [word, colouring] : colourings)
    if (name == word) return colouring;
  throw UsageError(
      fmt::format("--colour {}: it can be speed, species, collisions, id, psi6, psi6_angle, neighbours or plain", name));
}

void require_positive(const char* option, const std::optional<double>& value, const char* what) {
  if (value && !(*value > 0.0 && std::isfinite(*value)))
    throw UsageError(fmt::format("{} {}: it must be {}", option, *value, what));
}

/// Options that say nothing about what is asked for are mistakes.
void require_fitting(const MovieOptions& options, bool is_film) {
  const auto refuse = [](const char* option, const char* sentence) { throw UsageError(fmt::format("{}: {}", option, sentence)); };
  if (is_film && options.at) refuse("--at", "this is the time of a picture; give --from and --to, or a picture's name with -o");
  constexpr auto only_films = "a picture shows one time; give --at, or a film's name with -o";
  if (!options.trails_of.empty() && !options.trails)
    refuse("--trails-of", "give --trails TIME too, which says how long they are");
  if (!is_film && options.fps) refuse("--fps", only_films);
  if (!is_film && options.speed) refuse("--speed", only_films);
  if (!is_film && options.from) refuse("--from", only_films);
  if (!is_film && options.to) refuse("--to", only_films);
}

void require_free_place(const fs::path& path, bool force) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw UsageError(fmt::format("-o {}: this is a directory; name a file in it", path.string()));
  if (!force && fs::exists(path, error))
    throw UsageError(
        fmt::format("{}: this file is there already; replace it with --force, or name another one with -o", path.string()));
}

double within(const char* option, const std::optional<double>& time, double usual, const DrawableTimes& drawable) {
  if (time && !(*time >= drawable.begin && *time <= drawable.end))
    throw UsageError(fmt::format("{} {}: {}", option, *time, drawable.words));
  return time.value_or(usual);
}

/// Returns the file to write: by default one in the run's directory.
std::string output_of(const MovieOptions& options) {
  if (!options.output.empty()) return options.output;
  return (std::filesystem::path(options.directory) / (options.at ? "picture.png" : "movie.mp4")).string();
}

}  // namespace

MoviePlan movie_plan(const MovieOptions& options) {
  const std::string output = output_of(options);
  MoviePlan plan{.path = output, .format = format_of(output), .size = 0};
  const bool is_gif = plan.is_film() && std::get<FilmFormat>(plan.format) == FilmFormat::gif;
  require_fitting(options, plan.is_film());
  plan.fps = options.fps.value_or(plan.fps);
  // The time of a GIF's frame is a whole number of hundredths of a second, and browsers slow down what shows less than two.
  const double most_fps = is_gif ? 50.0 : 240.0;
  if (!(plan.fps >= 0.1 && plan.fps <= most_fps))
    throw UsageError(fmt::format("--fps {}: it must be from 0.1 to {}{}", plan.fps, most_fps, is_gif ? " in a GIF" : ""));
  require_positive("--speed", options.speed, "a simulated time above zero, per second of the film");
  require_positive("--trails", options.trails, "a simulated time above zero");
  if (options.from && options.to && *options.from > *options.to)
    throw UsageError(fmt::format("--from {} is after --to {}; give the earlier time to --from", *options.from, *options.to));
  plan.size = size_of(options.size, is_gif ? 480 : 1080);
  plan.colouring = colouring_of(options.colour);
  require_free_place(plan.path, options.force);
  if (plan.is_film() && !find_program("ffmpeg"))
    throw UsageError(
        fmt::format("-o {}: films are made with the program ffmpeg, which is not on PATH; install the package ffmpeg "
                    "(apt-get install ffmpeg), or draw a picture (.png, .svg, .pdf)",
                    output));
  return plan;
}

PictureSize size_for(const MoviePlan& plan, const std::array<double, 4>& extent, bool caption) {
  PictureSize size = std::holds_alternative<int>(plan.size) ? fitted_size(extent, std::get<int>(plan.size), caption)
                                                            : std::get<PictureSize>(plan.size);
  if (plan.is_film() && std::get<FilmFormat>(plan.format) != FilmFormat::gif) {  // colours are shared by squares of four pixels
    size.width += size.width % 2;
    size.height += size.height % 2;
  }
  return size;
}

std::vector<double> picture_times(const MovieOptions& options, const MoviePlan& plan, const DrawableTimes& drawable) {
  if (!plan.is_film()) return {within("--at", options.at, drawable.last_sample, drawable)};
  const double from = within("--from", options.from, drawable.begin, drawable);
  const double to = within("--to", options.to, drawable.end, drawable);
  if (from > to) throw UsageError(fmt::format("--from {}: this is after the end of the film, {}", from, to));
  const double step = options.speed.value_or((to - from) / usual_seconds) / plan.fps;
  if (!(to > from) || !(step > 0.0)) return {from};
  const double frames = std::floor((to - from) / step * (1.0 + 1e-12)) + 1.0;  // the last one too, whatever division made of it
  if (frames > most_frames)
    throw UsageError(
        fmt::format("--speed {}: the film would have {:.6g} frames, and {:.0f} are the most; give a larger --speed, a "
                    "smaller --fps, or less between --from and --to",
                    step * plan.fps, frames, most_frames));
  std::vector<double> times;
  for (int k = 0; k < static_cast<int>(frames); ++k) times.push_back(std::min(to, from + k * step));
  return times;
}

}  // namespace carom::cli
