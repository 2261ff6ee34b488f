// SPDX-License-Identifier: Apache-2.0
// Files written by any release must stay readable, and today's writer gives the same bytes.
#include <gtest/gtest.h>

#include "file_bytes.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"
#include "tiny_index.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

/// The output of pointrt-bake --compact of release 0.1.0: without an index, and stamped 1.0 here.
const std::string kCompact = POINTRT_GOLDEN_DIR "/tiny_compact.pro";

TEST(Golden, CompactReads) {
    const ProFile file(kCompact);
    EXPECT_EQ(file.info().version_major, 1u);
    EXPECT_EQ(file.info().splat_count, 5u);
    EXPECT_EQ(file.info().origin[2], 30.0);
    EXPECT_EQ(file.nodes()[8], 1u);
    EXPECT_EQ(file.refs()[0], 3u);
    EXPECT_EQ(file.order()[2], 7u);
    EXPECT_EQ(file.index(), nullptr);
    EXPECT_EQ(file.metadata(), R"({"tool":"tiny_scene.h"})");
    const pro_splat splat = file.splat(3);
    EXPECT_NEAR(splat.position[2], 0.45f, 3e-7f);
    EXPECT_NEAR(splat.normal[0], 0.6f, 7e-4f);
    EXPECT_NEAR(splat.radius, 0.2f, 0.005f);
    EXPECT_EQ(splat.color[0], 128);
    EXPECT_EQ(file.splat(4).material, 1);
}

TEST(Golden, CompactVerifiesClean) { EXPECT_TRUE(findingsOf(readBytes(kCompact)).empty()); }

TEST(Golden, SameContentIsWrittenAsTheSameBytes) {
    const TemporaryFolder folder;
    tinyScene().write(folder.file("from_scene.pro"));
    EXPECT_EQ(readBytes(folder.file("from_scene.pro")), readBytes(kCompact));
    const ProFile golden(kCompact);
    writePro(folder.file("from_file.pro"), golden.info(), golden.view());
    EXPECT_EQ(readBytes(folder.file("from_file.pro")), readBytes(kCompact));
}

const std::string kTinyV14 = POINTRT_GOLDEN_DIR "/tiny_v1_4.pro";

TEST(Golden, Version14Reads) {
    const ProFile file(kTinyV14);
    EXPECT_EQ(file.info().version_minor, 4u);
    ASSERT_NE(file.index(), nullptr);
    const pro_index& index = *file.index();
    EXPECT_EQ(index.shift, 20u);
    EXPECT_EQ(index.size[0], 2u);
    EXPECT_EQ(index.uneven, 1u);
    EXPECT_EQ(index.brick_count, 1u);
    EXPECT_EQ(index.group_count, 2u);
    EXPECT_EQ(index.cell_count, 4u);
    EXPECT_EQ(index.near_count, 6u);
    EXPECT_EQ(index.blending_count, 4u);
    EXPECT_EQ(index.grid[0], kNothingNear);
    EXPECT_EQ(index.bricks[1], groupWord(9));
    EXPECT_EQ(index.cells[PRO_CELL_WORDS * 3], 4u);
    EXPECT_EQ(index.slabs[3], 0x12345678u);
    EXPECT_EQ(index.near_splats[11], 0x01020304u);
    EXPECT_EQ(index.listed[4], 4u);
    EXPECT_EQ(index.blending[1], 0xFFFFFFFEu); // -2 and -1 from the first near splat of cell 2
}

TEST(Golden, Version14VerifiesClean) { EXPECT_TRUE(findingsOf(readBytes(kTinyV14)).empty()); }

TEST(Golden, SameIndexIsWrittenAsTheSameBytes) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    tinyIndex().write(scene, folder.file("from_scene.pro"));
    EXPECT_EQ(readBytes(folder.file("from_scene.pro")), readBytes(kTinyV14));
    const ProFile golden(kTinyV14);
    writePro(folder.file("from_file.pro"), golden.info(), golden.view(), golden.index());
    EXPECT_EQ(readBytes(folder.file("from_file.pro")), readBytes(kTinyV14));
    writePro(folder.file("without.pro"), golden.info(), golden.view());
    EXPECT_EQ(readBytes(folder.file("without.pro")), readBytes(kCompact));
}

TEST(Golden, TheIndexOfEarlierFormatsIsRefused) {
    Bytes bytes = readBytes(kCompact);
    storeAt(bytes, PRO_OFF_VERSION_MINOR, 1u);
    storeAt(bytes, PRO_OFF_OLD_GRID, 20u);
    fixHeaderChecksum(bytes);
    const OpenResult opened = openCopy(bytes);
    EXPECT_EQ(opened.message.finding, 1006u);
    EXPECT_SAYS(opened.message.text, "*(format 1.1)*bake");
}

} // namespace
