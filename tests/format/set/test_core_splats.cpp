// SPDX-License-Identifier: Apache-2.0
#include "format/set/core_splats.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "file_bytes.h"
#include "format/base/error.h"
#include "format/set/open_tile.h"
#include "made_set.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

struct CoreSplats : testing::Test {
    test::TemporaryFolder folder;
    TileSet set = test::makeSet(folder.path);

    std::vector<pro_splat> every(const SetTile& tile, std::uint64_t first, std::uint64_t step) {
        return coreSplats(set, tile, folder.path, first, step);
    }
};

TEST_F(CoreSplats, AreThoseOfTheFileWithoutCopies) {
    for (const SetTile& tile : set.tiles) {
        const ProFile file = openTile(set, tile, folder.path, 0);
        const std::vector<pro_splat> splats = every(tile, 0, 1);
        EXPECT_EQ(splats.size(), tile.splats) << tile.file;
        std::size_t found = 0;
        for (std::size_t i = 0; i < file.info().splat_count && found < splats.size(); ++i) {
            pro_splat splat;
            pro_splat_decode(file.splats().data() + PRO_SPLAT_WORDS * i, file.info().radius_max,
                             file.info().radius_step, &splat);
            const pro_splat& next = splats[found];
            found += std::equal(splat.position, splat.position + 3, next.position) && splat.radius == next.radius;
        }
        EXPECT_EQ(found, splats.size()) << "in the file's order";
    }
}

TEST_F(CoreSplats, StepsPartitionThem) {
    const SetTile& tile = set.tiles.back();
    std::size_t all = 0;
    for (std::uint64_t first = 0; first < 7; ++first) all += every(tile, first, 7).size();
    EXPECT_EQ(all, tile.splats);
    EXPECT_TRUE(every(tile, tile.stored, 1).empty());
    EXPECT_LE(every(tile, 0, tile.stored).size(), 1u);
}

TEST_F(CoreSplats, OfAnotherFileAreRefused) {
    const SetTile& tile = set.tiles.back();
    const std::string path = tilePath(folder.path, tile);
    const auto code = [&] {
        try {
            every(tile, 0, 1);
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(path + ": ")) << error.what();
            return error.code;
        }
        return ExitCode::kDone;
    };
    std::filesystem::resize_file(path, tile.bytes - 1);
    EXPECT_EQ(code(), ExitCode::kBadInput);
    std::filesystem::remove(path);
    EXPECT_EQ(code(), ExitCode::kBadInput);
}

/// header_xxh3 matches set.json, but the header does not match its checksum.
TEST_F(CoreSplats, AreNotReadBeyondTheFile) {
    const SetTile& tile = set.tiles.back();
    const std::string path = tilePath(folder.path, tile);
    test::Bytes bytes = test::readBytes(path);
    const std::size_t record = test::recordOf(bytes, PRO_KIND_SPLT);
    for (const std::uint64_t offset : {tile.bytes - 8, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
        test::storeAt(bytes, record + PRO_SEC_OFF_OFFSET, offset);
        test::writeBytes(path, bytes);
        EXPECT_THROW(every(tile, 0, 1), Error) << offset;
    }
    test::storeAt(bytes, record + PRO_SEC_OFF_KIND, PRO_KIND_NODE);
    test::writeBytes(path, bytes);
    EXPECT_THROW(every(tile, 0, 1), Error);
}

} // namespace
} // namespace pointrt
