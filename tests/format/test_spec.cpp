// SPDX-License-Identifier: Apache-2.0
// SPEC.md and findings.h list the same findings.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "file_bytes.h"

namespace {

std::set<std::string> numbersIn(const std::string& path, const char* pattern) {
    const auto bytes = pointrt::test::readBytes(path);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::set<std::string> numbers;
    const std::regex expression(pattern);
    for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
        numbers.insert((*match)[1]);
    return numbers;
}

TEST(Spec, ListsEveryFinding) {
    const auto in_code = numbersIn(POINTRT_FORMAT_DIR "/src/findings.h", " = ([1-9][0-9]{3}),");
    EXPECT_GT(in_code.size(), 40u);
    EXPECT_EQ(in_code, numbersIn(POINTRT_FORMAT_DIR "/SPEC.md", "\\n\\| ([1-9][0-9]{3}) \\|"));
}

} // namespace
