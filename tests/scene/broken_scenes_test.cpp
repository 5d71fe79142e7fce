// Every scene in tests/scene/broken is refused with the sentence in its first line: "# expect: file:line:column: ...".
// The sentences are written by hand; file names in them are relative to that directory.

#include "support/refusal.hpp"

#include <carom/scene.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

const std::filesystem::path directory = std::filesystem::path(CAROM_SOURCE_DIR) / "tests" / "scene" / "broken";

std::vector<std::string> broken_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string expected_sentence(const std::filesystem::path& scene) {
  std::ifstream file(scene);
  std::string line;
  std::getline(file, line);
  const std::string mark = "# expect: ";
  return line.starts_with(mark) ? line.substr(mark.size()) : "(the first line does not say what to expect)";
}

std::string without_directory(std::string text) {
  const std::string prefix = directory.string() + "/";
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) text.erase(at, prefix.size());
  return text;
}

class BrokenScene : public testing::TestWithParam<std::string> {};

TEST_P(BrokenScene, IsRefusedWithItsSentence) {
  const std::filesystem::path path = directory / (GetParam() + ".toml");
  EXPECT_EQ(without_directory(refusal<SceneError>([&] { return load_scene(path.string()); })), expected_sentence(path));
}

std::string test_name(const testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, BrokenScene, testing::ValuesIn(broken_scenes()), test_name);

}  // namespace
}  // namespace carom::test
