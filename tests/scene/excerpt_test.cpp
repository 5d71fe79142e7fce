// Foreign text in messages stays short, valid and on one line.

#include "scene/excerpt.hpp"

#include <gtest/gtest.h>

namespace carom::detail {
namespace {

TEST(Excerpt, PlainTextIsKept) {
  EXPECT_EQ(excerpt("radius", 10), "radius");
  EXPECT_EQ(excerpt("r\xC3\xA9sum\xC3\xA9 \xF0\x9F\x8E\xB1", 20), "r\xC3\xA9sum\xC3\xA9 \xF0\x9F\x8E\xB1");
}

TEST(Excerpt, LongTextIsCutBetweenCharacters) {
  EXPECT_EQ(excerpt("abcdef", 3), "abc...");
  EXPECT_EQ(excerpt("ab\xC3\xA9z", 3), "ab...");
}

TEST(Excerpt, WhatATerminalShouldNotSeeBecomesAQuestionMark) {
  EXPECT_EQ(excerpt("a\nb\x1b[2J\x7f", 20), "a?b?[2J?");
  EXPECT_EQ(excerpt(std::string_view("\0x", 2), 20), "?x");
}

TEST(Excerpt, BytesThatAreNoUtf8BecomeQuestionMarks) {
  EXPECT_EQ(excerpt("\xff\xfe", 20), "??");
  EXPECT_EQ(excerpt("\xC3", 20), "?");                 // cut short
  EXPECT_EQ(excerpt("\xC0\xAF", 20), "??");            // overlong
  EXPECT_EQ(excerpt("\xED\xA0\x80", 20), "???");       // a surrogate
  EXPECT_EQ(excerpt("\xF4\x90\x80\x80", 20), "????");  // beyond the last code point
  EXPECT_EQ(excerpt("\xC2\x9B", 20), "??");            // a control character of the terminal
}

}  // namespace
}  // namespace carom::detail
