// Text in HTML.

#include "pages/html_parts.hpp"

#include <gtest/gtest.h>

namespace carom::detail {
namespace {

TEST(HtmlText, NothingInItIsMarkup) {
  EXPECT_EQ(html_text("</script><b a=\"1\" c='2'>&amp;"), "&lt;/script&gt;&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;amp;");
}

TEST(HtmlText, OtherCharactersStayWhatTheyAre) {
  const std::string text = "\u03c3 = 0.03, C:\\scenes\\box.toml `code`\n\tand $x$ %{y}";
  EXPECT_EQ(html_text(text), text);
}

TEST(HtmlText, ControlCharactersAreReplaced) {
  EXPECT_EQ(html_text(std::string("a\0b\x1b", 4)),
            "a\uFFFD"
            "b\uFFFD");
}

TEST(HtmlProse, BackquotesMakeCode) {
  EXPECT_EQ(html_prose("run `carom <scene>` & `check`"), "run <code>carom &lt;scene&gt;</code> &amp; <code>check</code>");
}

TEST(HtmlProse, AnOddBackquoteStays) { EXPECT_EQ(html_prose("`a` and `b"), "<code>a</code> and `b"); }

}  // namespace
}  // namespace carom::detail
