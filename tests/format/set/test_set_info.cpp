// SPDX-License-Identifier: Apache-2.0
// pointrt-info on tile sets, end to end.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "file_bytes.h"
#include "made_set.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

struct Outcome {
    int code;
    std::string out, err;
};

struct SetInfo : testing::Test {
    test::TemporaryFolder folder;
    std::string name = folder.file("a.proset");
    TileSet set;

    void SetUp() override {
        std::filesystem::create_directory(name);
        set = test::makeSet(name);
    }

    Outcome run(const std::string& arguments) {
        const auto text = [](const std::string& path) {
            const test::Bytes bytes = test::readBytes(path);
            return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        };
        const std::string out = folder.file("out.txt"), err = folder.file("err.txt");
        const std::string command = std::string(POINTRT_INFO) + " " + name + " " + arguments + " >" + out + " 2>" + err;
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out), text(err)};
    }
};

TEST_F(SetInfo, TextHasALineForEachLevel) {
    const Outcome result = run("");
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(result.out.starts_with(name + ": tile set version 1\n")) << result.out;
    EXPECT_NE(result.out.find("splats          256, and 64 merged; "), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("tiles           5, 4 of them with original splats\n"), std::string::npos);
    EXPECT_NE(result.out.find("\n    0            4        4        0           256 "), std::string::npos);
    EXPECT_NE(result.out.find("\n    1            8        1        1            64 "), std::string::npos);
}

TEST_F(SetInfo, Json) {
    const Outcome result = run("--json");
    ASSERT_EQ(result.code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["splats"], 256);
    EXPECT_EQ(json["merged_splats"], 64);
    EXPECT_EQ(json["tiles"], 5);
    EXPECT_EQ(json["damaged_tiles"], 0);
    EXPECT_EQ(json["edge"], 4);
    EXPECT_EQ(json["levels"].size(), 2u);
    EXPECT_EQ(json["levels"][0]["spacing"], 0.5);
    EXPECT_EQ(json["levels"][0]["radius_max"], 0.5);
    EXPECT_EQ(json["levels"][1]["error"], 0.25);
    std::uint64_t bytes = 0, stored = 0;
    for (const SetTile& tile : set.tiles) {
        bytes += std::filesystem::file_size(tilePath(name, tile));
        stored += tile.stored;
    }
    EXPECT_EQ(json["file_bytes"], bytes);
    EXPECT_EQ(json["stored_splats"], stored);
}

TEST_F(SetInfo, VerifyChecksEveryTile) {
    EXPECT_SAYS(run("--verify").out, name + ": 5 *no findings\n");
    EXPECT_EQ(run("--verify -q").out, "");
    std::filesystem::remove(tilePath(name, set.tiles[2]));
    std::filesystem::resize_file(tilePath(name, set.tiles[4]), 5000);
    const Outcome result = run("--verify");
    EXPECT_EQ(result.code, 1);
    EXPECT_SAYS(result.out, name + "/tiles/0-1-0-0.pro: finding: No such file or directory\n" + name +
                                "/tiles/0-1-1-0.pro: finding: *(5000 bytes*" + std::to_string(set.tiles[4].bytes) +
                                ")\n");
    EXPECT_SAYS(result.err, "pointrt-info: error: " + name + ": 2 findings\n");
    const auto json = nlohmann::json::parse(run("--verify --json").out);
    EXPECT_EQ(json["findings"].size(), 2u);
    EXPECT_EQ(json["findings"][1]["tile"], "tiles/0-1-1-0.pro");
    EXPECT_NE(run("").out.find("; 2 missing"), std::string::npos);
}

TEST_F(SetInfo, ExportHasEveryOriginalSplatOnce) {
    const std::string ply = folder.file("a.ply");
    ASSERT_EQ(run("--export " + ply).code, 0);
    const test::Bytes bytes = test::readBytes(ply);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    EXPECT_NE(text.find("\nelement vertex 256\n"), std::string::npos);
    const std::size_t begin = text.find("end_header\n") + 11, record = 3 * 8 + 4 * 4 + 3;
    ASSERT_EQ(text.size(), begin + 256 * record);
    std::vector<std::array<double, 3>> is, wanted;
    for (std::size_t i = 0; i < 256; ++i) is.push_back(test::loadAt<std::array<double, 3>>(bytes, begin + i * record));
    for (const test::LatticeSplat& each : test::sheet(16, 2, 0.01f)) {
        std::array<double, 3>& place = wanted.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis)
            place[axis] =
                set.lattice_origin[axis] + (static_cast<double>(each.code[axis]) + 0.5) * set.edge / (1 << 20);
    }
    std::sort(is.begin(), is.end());
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(is, wanted);
    EXPECT_EQ(run("--export " + ply).code, 4) << "it is kept";
}

TEST_F(SetInfo, ExportsLas) {
    ASSERT_EQ(run("--export " + folder.file("a.las")).code, 0);
    const test::Bytes bytes = test::readBytes(folder.file("a.las"));
    EXPECT_EQ(test::loadAt(bytes, 107), 256u) << "points";
    EXPECT_NEAR(test::loadAt<double>(bytes, 179), 1007.75, 1e-5) << "highest x";
    EXPECT_NEAR(test::loadAt<double>(bytes, 187), 1000.25, 1e-5) << "lowest";
    EXPECT_NEAR(test::loadAt<double>(bytes, 203), 2000.25, 1e-5) << "lowest y";
    std::filesystem::remove(tilePath(name, set.tiles[3]));
    const Outcome result = run("--export " + folder.file("b.las"));
    EXPECT_EQ(result.code, 1);
    EXPECT_EQ(result.err, "pointrt-info: error: " + name + "/tiles/0-0-1-0.pro: No such file or directory\n");
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.las")));
}

TEST_F(SetInfo, ABrokenSetIsOneLine) {
    folder.write("a.proset/set.json", "{\"version\": 7}");
    for (const char* options : {"", "--json", "--verify"}) {
        const Outcome result = run(options);
        EXPECT_EQ(result.code, 1);
        EXPECT_EQ(result.out, "");
        EXPECT_SAYS(result.err, "pointrt-info: error: " + name + "/set.json: version 7, *1\n");
    }
}

} // namespace
} // namespace pointrt
