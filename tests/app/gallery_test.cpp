// docs/gallery.md: every command that stands there draws a picture, and every picture that is shown there is kept.

#include "support/child_process.hpp"
#include "support/scene_files.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <regex>
#include <sstream>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

namespace fs = std::filesystem;

/// By the name of the picture.
std::map<std::string, std::string> commands_by_picture() {
  std::map<std::string, std::string> found;
  std::istringstream page(text_of(docs / "gallery.md"));
  const std::regex command("carom run docs/scenes/.* && carom movie .* -o (\\w+)\\.png .*");
  std::smatch match;
  for (std::string line; std::getline(page, line);)
    if (std::regex_match(line, match, command)) found[match[1]] = line;
  return found;
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, command] : commands_by_picture()) all.push_back(name);
  return all;
}

/// A picture, decoded: a pixel has 32 bits, red, green and blue in the lower ones.
struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint32_t> colours;
};
Pixels pixels_of(const fs::path& file) {
  cairo_surface_t* const surface = cairo_image_surface_create_from_png(file.c_str());
  Pixels pixels{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  for (int y = 0; y < pixels.height; ++y) {
    const unsigned char* const row = cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface);
    for (int x = 0; x < pixels.width; ++x) std::memcpy(&pixels.colours.emplace_back(), row + 4 * x, 4);
  }
  cairo_surface_destroy(surface);
  return pixels;
}

std::pair<int, int> size_of(const fs::path& file) {
  const Pixels pixels = pixels_of(file);
  return {pixels.width, pixels.height};
}

/// The part of the pixels that have clearly another colour: in the pictures that are shown, colours are rounded to 256.
double different_part(const Pixels& one, const Pixels& other) {
  std::size_t different = 0;
  for (std::size_t k = 0; k < one.colours.size(); ++k) {
    int most = 0;
    for (const int shift : {0, 8, 16}) {
      const auto channel = [shift](std::uint32_t colour) { return static_cast<int>(colour >> shift & 255U); };
      most = std::max(most, std::abs(channel(one.colours[k]) - channel(other.colours[k])));
    }
    different += most > 48 ? 1 : 0;
  }
  return static_cast<double>(different) / static_cast<double>(one.colours.size());
}

class Gallery : public ::testing::TestWithParam<std::string> {};

TEST_P(Gallery, CommandDrawsThePictureThatIsShown) {
  const TemporaryDirectory directory;
  fs::create_symlink(CAROM_PROGRAM, directory.path() / "carom");
  fs::create_directory_symlink(docs, directory.path() / "docs");
  const Outcome outcome = run_program(directory.path(), {"sh", "-c", "PATH=.:$PATH; " + commands_by_picture().at(GetParam())});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Pixels drawn = pixels_of(directory.file(GetParam() + ".png"));
  const Pixels shown = pixels_of(docs / "images/gallery" / (GetParam() + ".png"));
  ASSERT_GT(drawn.colours.size(), 1000U);
  ASSERT_EQ(std::pair(drawn.width, drawn.height), std::pair(shown.width, shown.height));
  EXPECT_LT(different_part(drawn, shown), 0.01) << "docs/images/gallery.py draws it anew";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Gallery, ::testing::ValuesIn(names()), [](const auto& name) { return name.param; });

TEST(GalleryPage, ShowsThePicturesThatItsCommandsDraw) {
  const std::string page = text_of(docs / "gallery.md");
  EXPECT_GE(names().size(), 15U);
  for (const std::string& name : names()) EXPECT_NE(page.find("(images/gallery/" + name + ".png)"), std::string::npos) << name;
  const fs::path pictures = docs / "images/gallery";
  for (const std::string& name : names())
    EXPECT_EQ(size_of(pictures / (name + "_dark.png")), size_of(pictures / (name + ".png"))) << name;
  const auto kept = fs::directory_iterator(pictures);
  EXPECT_EQ(static_cast<std::size_t>(std::distance(fs::begin(kept), fs::end(kept))), 2 * names().size());
}

}  // namespace
}  // namespace carom::test
