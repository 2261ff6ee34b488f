// SPDX-License-Identifier: Apache-2.0
// The list of formats, the readers and the table of docs/FORMATS.md agree.
#include "preprocess/input/input_formats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

namespace pointrt {
namespace {

namespace fs = std::filesystem;

const fs::path kTree = POINTRT_SOURCE_DIR;

std::string textOf(const fs::path& path) {
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The capitalised words before the second bar in each row of the table of inputs.
std::vector<std::string> suffixesInDocs() {
    std::istringstream rest(textOf(kTree / "docs/FORMATS.md"));
    std::string line;
    while (std::getline(rest, line) && !line.starts_with("| in |")) {
    }
    std::getline(rest, line); // the line of dashes
    std::vector<std::string> suffixes;
    while (std::getline(rest, line) && line.starts_with("|")) {
        std::istringstream words(line.substr(1, line.find('|', 1) - 1));
        for (std::string word; words >> word;) {
            std::erase(word, ',');
            for (char& letter : word) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
            suffixes.push_back(word);
        }
    }
    return suffixes;
}

TEST(Formats, FormatsDocListsEverySuffix) {
    const std::vector<std::string> listed = suffixesInDocs();
    std::set<std::string> known;
    for (const InputFormat& format : inputFormats())
        forSuffixes(format, [&](std::string_view suffix) {
            EXPECT_TRUE(known.emplace(suffix).second) << suffix << " belongs to two formats";
        });
    EXPECT_EQ(std::set(listed.begin(), listed.end()), known);
    EXPECT_EQ(listed.size(), known.size());
}

TEST(Formats, NamesDifferAndEachIsComplete) {
    std::set<std::string_view> names;
    int columns = 0;
    for (const InputFormat& format : inputFormats()) {
        EXPECT_TRUE(names.insert(format.name).second) << format.name;
        EXPECT_FALSE(format.title.empty()) << format.name;
        EXPECT_NE(format.reader.read, nullptr) << format.name;
        // only columns of numbers have no signature
        EXPECT_EQ(!format.reader.isStart && !format.reader.isLine, format.content == Content::kColumns) << format.name;
        columns += format.content == Content::kColumns;
    }
    EXPECT_EQ(columns, 1);
}

TEST(Formats, MessagesNameAll) {
    EXPECT_EQ(
        readableFormats(),
        "PLY, PCD, LAS/LAZ, E57, PTX, XYZ/PTS/ASC/TXT/CSV, OBJ, OFF, STL, VTK, Draco, glTF/GLB, SPLAT, SPZ, SOG, EPT, "
        "Potree 2, 3D Tiles, MCAP, ROS bag, COLMAP, NumPy, GeoTIFF, ESRI grid, KITTI and Stanford .conf");
}

} // namespace
} // namespace pointrt
