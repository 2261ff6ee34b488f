// SPDX-License-Identifier: Apache-2.0
// SPEC.md lists all findings, and its examples are the bytes of the golden files.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "file_bytes.h"

namespace {

std::string textOf(const std::string& path) {
    const auto bytes = pointrt::test::readBytes(path);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::set<std::string> numbersIn(const std::string& path, const char* pattern) {
    const std::string text = textOf(path);
    std::set<std::string> numbers;
    const std::regex expression(pattern);
    for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
        numbers.insert((*match)[1]);
    return numbers;
}

TEST(Spec, ListsEveryFinding) {
    const auto in_code = numbersIn(POINTRT_FORMAT_DIR "/pro/findings.h", " = ([1-9][0-9]{3}),");
    EXPECT_GT(in_code.size(), 40u);
    EXPECT_EQ(in_code, numbersIn(POINTRT_FORMAT_DIR "/SPEC.md", "\\n\\| ([1-9][0-9]{3}) \\|"));
}

/// Compares the words in the example that follows the name of a golden file with its bytes; returns their number.
int wordsShown(const std::string& name) {
    const std::string spec = textOf(POINTRT_FORMAT_DIR "/SPEC.md"), golden = textOf(POINTRT_GOLDEN_DIR "/" + name);
    const std::size_t begin = spec.find("```\n", spec.find(name + "`")) + 4;
    const std::string block = spec.substr(begin, spec.find("```", begin) - begin);
    const std::regex run("\\b([0-9a-f]{4,5})((?: [0-9a-f]{8})+)"), word("[0-9a-f]{8}");
    int words = 0;
    for (std::sregex_iterator match(block.begin(), block.end(), run), end; match != end; ++match) {
        std::size_t at = std::stoul((*match)[1], nullptr, 16);
        const std::string shown = (*match)[2];
        for (std::sregex_iterator each(shown.begin(), shown.end(), word); each != end; ++each, ++words)
            for (std::size_t digit = 0; digit < 8; digit += 2, ++at)
                EXPECT_EQ(std::stoul(each->str().substr(digit, 2), nullptr, 16),
                          static_cast<unsigned char>(golden.at(at)))
                    << name << ", byte " << std::hex << at;
    }
    return words;
}

TEST(Spec, ShowsTheGoldenFilesBytes) {
    EXPECT_GT(wordsShown("tiny_v1_4.pro"), 110);
    EXPECT_GT(wordsShown("tiny_v1_4_scan.pro"), 35);
    EXPECT_GT(wordsShown("tiny_v1_5.pro"), 45);
}

TEST(Spec, ShowsTheGoldenSet) {
    const std::string spec = textOf(POINTRT_FORMAT_DIR "/SPEC.md"), name = "small.proset/set.json";
    const std::size_t begin = spec.find("```\n", spec.find(name + "`")) + 4;
    EXPECT_EQ(spec.substr(begin, spec.find("```", begin) - begin), textOf(POINTRT_GOLDEN_DIR "/" + name));
}

} // namespace
