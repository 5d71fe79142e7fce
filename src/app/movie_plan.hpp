#pragma once
// The plan of carom movie, read from its options before the run is opened.

#include "app/commands.hpp"
#include "pages/film_writer.hpp"
#include "pages/painter.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace carom::cli {

struct MoviePlan {
  std::filesystem::path path;
  std::variant<FilmFormat, PictureFormat> format;
  double fps = 30.0;
  std::variant<int, PictureSize> size;  ///< the longer side, or both
  std::optional<Colouring> colouring = {};

  [[nodiscard]] bool is_film() const { return std::holds_alternative<FilmFormat>(format); }
};

/// What --colour can be.
inline constexpr std::array<std::pair<std::string_view, Colouring>, 8> colourings = {{{"speed", Colouring::speed},
                                                                                      {"species", Colouring::species},
                                                                                      {"collisions", Colouring::collisions},
                                                                                      {"id", Colouring::id},
                                                                                      {"psi6", Colouring::psi6},
                                                                                      {"psi6_angle", Colouring::psi6_angle},
                                                                                      {"neighbours", Colouring::neighbours},
                                                                                      {"plain", Colouring::plain}}};

/// Throws UsageError where the options are wrong by themselves, or a file is in the way.
[[nodiscard]] MoviePlan movie_plan(const MovieOptions& options);

/// Returns the size in pixels for a box of this extent.
[[nodiscard]] PictureSize size_for(const MoviePlan& plan, const std::array<double, 4>& extent, bool caption);

/// The times that can be drawn.
struct DrawableTimes {
  double begin = 0.0, end = 0.0, last_sample = 0.0;
  std::string words;  ///< a sentence about them without its stop, for what asks for others
};

/// Returns the times of the pictures: one, or those of all frames. Throws UsageError where they cannot be drawn, or are too many.
[[nodiscard]] std::vector<double> picture_times(const MovieOptions& options, const MoviePlan& plan,
                                                const DrawableTimes& drawable);

}  // namespace carom::cli
