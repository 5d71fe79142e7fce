#pragma once
// Opens HTML pages in a headless Chromium, where one is installed. A test without one skips itself:
//
//   if (!has_browser()) GTEST_SKIP() << no_browser;

#include <filesystem>
#include <string>

namespace carom::test {

inline constexpr const char* no_browser = "chromium is not installed";

bool has_browser();

enum class Screen { light, dark };  ///< which colours the page is told that its reader prefers

/// The document at `page` as HTML, after its scripts have run for what they take to be `seconds`. Nothing outside the file
/// is reached. Throws std::runtime_error where the browser fails, or does not end within two minutes and is killed.
std::string dump_dom(const std::filesystem::path& page, Screen screen = Screen::light, int seconds = 10);

/// What a page and its scripts left behind.
struct Visit {
  std::string dom;      ///< as dump_dom gives it
  std::string console;  ///< the lines of the browser's console, errors and all; empty where it stayed clean
};

/// The same with the console, with precise numbers of memory, and with gc() for the page's scripts.
Visit visit(const std::filesystem::path& page, Screen screen = Screen::light, int seconds = 10);

}  // namespace carom::test
