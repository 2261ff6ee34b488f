// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "file_bytes.h"
#include "format/base/error.h"
#include "made_set.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

struct OpenTile : testing::Test {
    test::TemporaryFolder folder;
    TileSet set = test::makeSet(folder.path);
    SetTile& tile = set.tiles.back();
    std::string path = folder.file("tiles/0-1-1-0.pro");

    /// The error that requireTile and openTile give, which must be the same.
    std::string fault() {
        const auto said = [](const auto& body) -> std::string {
            try {
                body();
                return "";
            } catch (const Error& error) {
                EXPECT_EQ(error.code, ExitCode::kBadInput);
                return error.what();
            }
        };
        const std::string opened = said([&] { openTile(set, tile, folder.path, 0); });
        EXPECT_EQ(said([&] { requireTile(set, tile, folder.path); }), opened);
        return opened;
    }
};

TEST_F(OpenTile, OpensEveryTileOfASet) {
    for (const SetTile& each : set.tiles) {
        requireTile(set, each, folder.path);
        EXPECT_EQ(openTile(set, each, folder.file(""), 0).info().splat_count, each.stored);
    }
    EXPECT_GT(tile.stored, tile.splats);
    EXPECT_EQ(tile.splats, 64u);
}

TEST_F(OpenTile, RefusesTheFileOfAnotherTile) {
    fs::copy_file(folder.file("tiles/0-0-0-0.pro"), path, fs::copy_options::overwrite_existing);
    EXPECT_SAYS(fault(), path + ": *set.json*(checksum ");
}

TEST_F(OpenTile, RefusesTruncatedAndExtendedFiles) {
    const std::string whole = std::to_string(tile.bytes);
    fs::resize_file(path, tile.bytes - 1);
    EXPECT_SAYS(fault(), path + ": *set.json*(" + std::to_string(tile.bytes - 1) + " bytes*" + whole + ")");
    fs::resize_file(path, 100);
    EXPECT_SAYS(fault(), path + ": *100 bytes*header");
    fs::resize_file(path, 0);
    EXPECT_SAYS(fault(), path + ": *0 bytes*header");
}

TEST_F(OpenTile, RefusesMissingFilesAndOtherTypes) {
    fs::remove(path);
    EXPECT_EQ(fault(), path + ": No such file or directory");
    mkfifo(path.c_str(), 0600);
    EXPECT_SAYS(fault(), path + ": *regular");
    fs::remove(path);
    folder.write("tiles/0-1-1-0.pro", std::string(tile.bytes, 'x'));
    EXPECT_SAYS(fault(), path + ": *.pro file");
}

TEST_F(OpenTile, RefusesATileWithAnotherCube) {
    const std::string is_not = path + ": *set.json*(";
    --tile.stored;
    EXPECT_SAYS(fault(), is_not + std::to_string(tile.stored + 1) + " splats*" + std::to_string(tile.stored) + ")");
    ++tile.stored;
    tile.cell[0] = 7;
    EXPECT_SAYS(fault(), is_not + "*cube*around");
    tile.cell[0] = 1;
    set.levels[0].radius_max = 0.03125;
    EXPECT_SAYS(fault(), is_not + "*radius_max");
    set.levels[0].radius_max = 0.0625;
    set.levels[0].radius_step = 0.5;
    EXPECT_SAYS(fault(), is_not + "*radius_step");
    tile.level = 1;
    EXPECT_SAYS(fault(), is_not + "*cube*wide");
}

TEST_F(OpenTile, RefusesDamagedSections) {
    test::Bytes bytes = test::readBytes(path);
    test::storeAt(bytes, bytes.size() - 4096, std::uint32_t{0x12345678}); // in the last section
    test::writeBytes(path, bytes);
    requireTile(set, tile, folder.path); // reads only the header
    EXPECT_THROW(openTile(set, tile, folder.path, 0), Error);
}

TEST_F(OpenTile, RefusesATileOfAnotherSet) {
    set.attributes = {{"intensity", PRO_TYPE_U16, 1, 0, 1}};
    EXPECT_THROW(openTile(set, tile, folder.path, 0), Error);
    set.attributes.clear();
    set.oriented = false;
    EXPECT_THROW(openTile(set, tile, folder.path, 0), Error);
    set.oriented = true;
    openTile(set, tile, folder.path, 0);
    set.gaussians = true;
    EXPECT_THROW(openTile(set, tile, folder.path, 0), Error);
}

} // namespace
} // namespace pointrt
