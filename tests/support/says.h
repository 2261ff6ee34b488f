// SPDX-License-Identifier: Apache-2.0
// What errors, notes and findings say: their place, key and numbers, and a word if faults must be distinguished. The
// sentences themselves are only in tests/structure/sentences.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace pointrt::test {

/// Whether a line begins with the part of a pattern before its first *, and then has the other parts in their order.
inline bool lineSays(std::string_view line, std::string_view pattern) {
    for (bool first = true;; first = false) {
        const std::size_t end = pattern.find('*');
        const std::string_view part = pattern.substr(0, end);
        const std::size_t at = line.find(part);
        if (at == std::string_view::npos || (first && at > 0)) return false;
        if (end == std::string_view::npos) return true;
        line.remove_prefix(at + part.size());
        pattern.remove_prefix(end + 1);
    }
}

/// Whether a text has as many lines as the pattern and each says what its line of the pattern does: "a.ply:3: *count".
inline testing::AssertionResult says(std::string_view text, std::string_view pattern) {
    for (std::string_view rest = text;;) {
        const std::size_t end = rest.find('\n'), pattern_end = pattern.find('\n');
        const bool last = end == std::string_view::npos, pattern_last = pattern_end == std::string_view::npos;
        if (last != pattern_last || !lineSays(rest.substr(0, end), pattern.substr(0, pattern_end)))
            return testing::AssertionFailure() << '"' << text << "\" does not say \"" << pattern << '"';
        if (last) return testing::AssertionSuccess();
        rest.remove_prefix(end + 1);
        pattern.remove_prefix(pattern_end + 1);
    }
}

/// Whether a line of a text has the parts of a pattern in their order, anywhere in it.
inline testing::AssertionResult hasLine(std::string_view text, const std::string& pattern) {
    for (std::string_view rest = text;;) {
        const std::size_t end = rest.find('\n');
        if (lineSays(rest.substr(0, end), "*" + pattern)) return testing::AssertionSuccess();
        if (end == std::string_view::npos)
            return testing::AssertionFailure() << '"' << text << "\" does not have \"" << pattern << '"';
        rest.remove_prefix(end + 1);
    }
}

} // namespace pointrt::test

#define EXPECT_SAYS(text, pattern) EXPECT_TRUE(pointrt::test::says(text, pattern))
#define EXPECT_HAS(text, pattern) EXPECT_TRUE(pointrt::test::hasLine(text, pattern))
