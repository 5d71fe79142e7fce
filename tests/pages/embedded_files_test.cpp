// The library holds the files of src/show as they are.

#include "pages/html_parts.hpp"

#include "support/child_process.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace carom::test {
namespace {

using detail::embedded_files;
using detail::embedded_text;

TEST(EmbeddedFiles, AreTheFilesOfTheSourceTreeByteForByte) {
  for (const detail::EmbeddedFile& file : embedded_files()) {
    const std::string text = text_of(std::string(CAROM_SOURCE_DIR "/src/pages/") + std::string(file.name));
    EXPECT_FALSE(text.empty()) << file.name;
    EXPECT_TRUE(embedded_text(file.name) == text) << file.name;  // not EXPECT_EQ, which would print a megabyte
  }
}

TEST(EmbeddedFiles, TheLibraryCanStandInsideAScriptElement) {
  for (const detail::EmbeddedFile& file : embedded_files()) {
    const std::string text = embedded_text(file.name);
    for (const char* const end : {"</script", "</style", "<!--"})
      EXPECT_EQ(text.find(end), std::string::npos) << file.name << ": " << end;
  }
}

TEST(EmbeddedFiles, AnUnknownNameIsRefused) { EXPECT_THROW(embedded_text("page/nothing.js"), std::invalid_argument); }

}  // namespace
}  // namespace carom::test
