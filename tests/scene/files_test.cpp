// What is given as a scene may be anything: garbage, a directory, nothing at all. The refusal is clean and located.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene_texts.hpp"
#include "support/refusal.hpp"
#include "support/temporary_directory.hpp"

#include <cstdint>

namespace carom::test {
namespace {

using testing::HasSubstr;

constexpr std::size_t ten_megabytes = 10'000'000;

/// Two megabytes: as many nested tables of a few bytes each would need more than any stack.
std::string repeated(std::string_view piece) {
  std::string text;
  while (text.size() < 2'000'000) text += piece;
  return text;
}

TEST(SceneFiles, MissingDirectoryAndEmptyAreNamed) {
  const TemporaryDirectory folder;
  const std::string there = folder.path().string();
  EXPECT_EQ(refusal<SceneError>([&] { load_scene(there + "/none.toml"); }),
            there + "/none.toml: there is no such file; check the path");
  EXPECT_EQ(refusal<SceneError>([&] { load_scene(there); }), there + ": this is a directory; give the path of a file in it");
  const std::string empty = folder.file("empty.toml");
  write_text(empty, "");
  EXPECT_EQ(refusal<SceneError>([&] { load_scene(empty); }),
            empty + ":1:1: the scene has no [box] table; give limits x and y, and the boundary");
  EXPECT_EQ(refusal<SceneError>([&] { load_scene(""); }), "there is no such file; check the path");
}

TEST(SceneFiles, UnreadableFilesAreNamed) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TemporaryDirectory folder;
  const std::string path = folder.file("secret.toml");
  write_text(path, "x");
  std::filesystem::permissions(path, std::filesystem::perms::none);
  EXPECT_THAT(refusal<SceneError>([&] { load_scene(path); }), HasSubstr("the file cannot be opened (Permission denied)"));
}

TEST(SceneFiles, TenMegabytesOfGarbageAreRefused) {
  std::string bytes;
  std::uint32_t x = 1;
  while (bytes.size() < ten_megabytes) {
    x = x * 1664525U + 1013904223U;
    bytes += static_cast<char>(x >> 24U);
  }
  const TemporaryDirectory folder;
  const std::string path = folder.file("garbage.toml");
  write_text(path, bytes);
  EXPECT_THAT(refusal<SceneError>([&] { load_scene(path); }), HasSubstr("this is not TOML: "));
}

TEST(SceneFiles, MegabytesOfAnyOnePatternAreRefused) {
  // Among them the ones that nest: their parse trees must not exhaust the stack.
  for (const char* piece :
       {"a", "[", "{", "[[a]]\n", "a = [[", "x={a=", "a.b.", "\"a\".'b' . c.", "[a.b.c.d.", "\"", "'''", "=", "\n", "\xff"}) {
    EXPECT_THAT(refusal<SceneError>([&] { parse_scene(repeated(piece), "s.toml"); }), HasSubstr("s.toml:")) << piece;
  }
  EXPECT_THAT(refusal<SceneError>([&] { parse_scene(std::string(ten_megabytes, '\0'), "s.toml"); }),
              HasSubstr("s.toml:1:1: this is not TOML"));
}

TEST(SceneFiles, DeepKeysAreRefusedWhereTheyStand) {
  const std::string deep = repeated("a.") + "a = 1\n";
  EXPECT_EQ(refusal<SceneError>(
                [&] { parse_scene("title = \"\"\"two\nlines....\"\"\"\n# ......................\n" + deep, "s.toml"); }),
            "s.toml:4:1: a key here has more than 16 dotted parts; a scene's longest key has 3");
}

TEST(SceneFiles, DotsInStringsAndCommentsAreNotKeys) {
  const std::string dots(100, '.');
  const std::string text = "# " + dots + "\ntitle = \"" + dots + "\\\"" + dots + "\" # " + dots + "\n" + std::string(small_scene);
  EXPECT_EQ(parse_scene(text).title, dots + "\"" + dots);
}

TEST(SceneFiles, DevicesAreRefused) {
  EXPECT_EQ(refusal<SceneError>([] { load_scene("/dev/zero"); }), "/dev/zero: this is a device; give the path of a file");
}

}  // namespace
}  // namespace carom::test
