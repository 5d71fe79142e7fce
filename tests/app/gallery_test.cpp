// docs/gallery.md: every command that stands there draws a picture, and every picture that is shown there is kept.

#include "support/child_process.hpp"
#include "support/scene_files.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <sstream>

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

/// Width and height, as they stand in a PNG.
std::string pixels_of(const fs::path& file) { return text_of(file).substr(16, 8); }

class Gallery : public ::testing::TestWithParam<std::string> {};

TEST_P(Gallery, CommandDrawsThePictureThatIsShown) {
  const TemporaryDirectory directory;
  fs::create_symlink(CAROM_PROGRAM, directory.path() / "carom");
  fs::create_directory_symlink(docs, directory.path() / "docs");
  const Outcome outcome = run_program(directory.path(), {"sh", "-c", "PATH=.:$PATH; " + commands_by_picture().at(GetParam())});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(pixels_of(directory.file(GetParam() + ".png")), pixels_of(docs / "images/gallery" / (GetParam() + ".png")));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Gallery, ::testing::ValuesIn(names()), [](const auto& name) { return name.param; });

TEST(GalleryPage, ShowsThePicturesThatItsCommandsDraw) {
  const std::string page = text_of(docs / "gallery.md");
  EXPECT_GE(names().size(), 15U);
  for (const std::string& name : names()) EXPECT_NE(page.find("(images/gallery/" + name + ".png)"), std::string::npos) << name;
  const fs::path pictures = docs / "images/gallery";
  for (const std::string& name : names())
    EXPECT_EQ(pixels_of(pictures / (name + "_dark.png")), pixels_of(pictures / (name + ".png"))) << name;
  const auto kept = fs::directory_iterator(pictures);
  EXPECT_EQ(static_cast<std::size_t>(std::distance(fs::begin(kept), fs::end(kept))), 2 * names().size());
}

}  // namespace
}  // namespace carom::test
