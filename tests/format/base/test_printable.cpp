// SPDX-License-Identifier: Apache-2.0
// Untrusted text in messages has no effect on a terminal and hides nothing.
#include "format/base/printable.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

TEST(Printable, KeepsPrintableText) {
    EXPECT_EQ(printable("a plain name \\ \"with\" 'marks'.pro"), "a plain name \\ \"with\" 'marks'.pro");
    EXPECT_EQ(printable("Größe 点群 😀"), "Größe 点群 😀");
    EXPECT_EQ(printable(""), "");
}

TEST(Printable, EscapesControlCharacters) {
    EXPECT_EQ(printable("\x1b[31mred"), "\\x1b[31mred");
    EXPECT_EQ(printable("two\nlines\ttab\rback"), "two\\nlines\\ttab\\rback");
    EXPECT_EQ(printable(std::string_view("\0\x07\x7f", 3)), "\\x00\\x07\\x7f");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "\\xc2\\x9b31m")
        << "the control sequence introducer of Latin-1";
}

TEST(Printable, EscapesInvisibleAndDirectionCharacters) {
    EXPECT_EQ(printable("\xe2\x80\xae"
                        "orp.exe"),
              "\\xe2\\x80\\xaeorp.exe")
        << "right-to-left override";
    EXPECT_EQ(printable("a\xe2\x80\x8b"
                        "b"),
              "a\\xe2\\x80\\x8bb")
        << "zero-width space";
    EXPECT_EQ(printable("\xef\xbb\xbf"), "\\xef\\xbb\\xbf");
    EXPECT_EQ(printable("\xf3\xa0\x81\x81"), "\\xf3\\xa0\\x81\\x81") << "a tag";
}

TEST(Printable, EscapesBytesThatAreNotUtf8) {
    EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
    EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "overlong";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "above U+10FFFF";
    EXPECT_EQ(printable("\xe7\x82"), "\\xe7\\x82") << "truncated";
    EXPECT_EQ(printable("\xe7z\x82"), "\\xe7z\\x82");
}

TEST(Printable, TruncatesBetweenCharacters) {
    EXPECT_EQ(printable("abcdef", 6), "abcdef");
    EXPECT_EQ(printable("abcdefg", 6), "abcdef...");
    EXPECT_EQ(printable("ab\xe7\x82\xb9", 4), "ab...");
    EXPECT_EQ(printable(std::string(1000, 'a')).size(), kLongestShown + 3);
}

TEST(Printable, IsIdempotent) {
    std::string all;
    for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
    const std::string once = printable(all, std::string::npos);
    EXPECT_EQ(printable(once, std::string::npos), once);
}

} // namespace
} // namespace pointrt
