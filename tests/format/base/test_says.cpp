// SPDX-License-Identifier: Apache-2.0
#include "tests/support/says.h"

namespace pointrt::test {
namespace {

TEST(Says, MatchesThePartsOfALineFromItsBeginning) {
    EXPECT_SAYS("a.ply:3: not an element with a count", "a.ply:3: *count");
    EXPECT_SAYS("/tmp/a.ply:3: not an element with a count", "*a.ply:3: *element*count");
    EXPECT_FALSE(says("/tmp/a.ply:3: not an element with a count", "a.ply:3: *count"));
    EXPECT_FALSE(says("a.ply:3: count the elements", "*element*count"));
    EXPECT_FALSE(says("a.ply:3: count", "*count*count"));
    EXPECT_FALSE(says("", "a"));
}

TEST(Says, MatchesLineByLine) {
    EXPECT_SAYS("one 1\ntwo 2\n", "one\n*2\n");
    EXPECT_FALSE(says("one 1\ntwo 2\n", "one*2\n")) << "a line more";
    EXPECT_FALSE(says("one 1\n", "one\n*2\n")) << "a line less";
    EXPECT_FALSE(says("one 1", "one\n")) << "without its end";
}

TEST(Says, FindsALineAmongOthers) {
    EXPECT_HAS("one 1\ntwo 2\n", "wo*2");
    EXPECT_FALSE(hasLine("one 1\ntwo 2\n", "one*2"));
}

} // namespace
} // namespace pointrt::test
