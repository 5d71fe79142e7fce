#pragma once
// What tests of pages in a browser share: scripts that ask a page, and the answers that it leaves as data of its document.

#include "support/browser.hpp"
#include "support/temporary_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace carom::test {

/// A script of tests/pages.
inline std::string script(const std::string& name) {
  return text_of(std::filesystem::path(CAROM_SOURCE_DIR) / "tests/pages" / name);
}

/// data-NAME of the document
inline std::string data(const Visit& visit, const std::string& name) {
  const std::string root = visit.dom.substr(0, visit.dom.find('>', visit.dom.find("<html")));
  const std::string key = "data-" + name + "=\"";
  const std::size_t from = root.find(key);
  if (from == std::string::npos) return "there is no data-" + name;
  return root.substr(from + key.size(), root.find('"', from + key.size()) - from - key.size());
}

inline void expect_clean(const Visit& visit) {
  EXPECT_THAT(visit.console, ::testing::IsEmpty());
  EXPECT_EQ(data(visit, "errors"), "");
}

}  // namespace carom::test
