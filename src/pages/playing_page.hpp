#pragma once
// A page with a clock, put together from the files of src/show: markup, style, scripts, and the numbers that they play. The
// player and the page of two runs side by side are such pages.

#include <span>
#include <string>
#include <string_view>

namespace carom {

struct PlayingPage {
  std::string_view mark;                      ///< mark near the beginning, by which this kind of page is told from other files
  std::string_view body;                      ///< a file below src/show; {NAME.html} in it stands for player/NAME.html
  std::span<const std::string_view> styles;   ///< files
  std::span<const std::string_view> scripts;  ///< files, in the order in which they run
  std::string_view otherwise;                 ///< the page's title, where the description has none
};

/// `description` is JSON with a key `title`, and `columns` what it says where to find: see player_data.hpp.
[[nodiscard]] std::string playing_page(const PlayingPage& page, const std::string& description, const std::string& columns);

}  // namespace carom
