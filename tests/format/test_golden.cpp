// SPDX-License-Identifier: Apache-2.0
// Files of every version ever shipped: they open for ever, and the newest is what is written today.
#include <gtest/gtest.h>

#include "file_bytes.h"
#include "tests/support/temporary_folder.h"
#include "tiny_index.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

const std::string kTinyV10 = POINTRT_GOLDEN_DIR "/tiny_v1_0.pro";

TEST(Golden, Version10Reads) {
    const ProFile file(kTinyV10);
    EXPECT_EQ(file.info().version_major, 1u);
    EXPECT_EQ(file.info().version_minor, 0u);
    EXPECT_EQ(file.info().splat_count, 5u);
    EXPECT_EQ(file.info().origin[2], 30.0);
    EXPECT_EQ(file.nodes()[8], 1u);
    EXPECT_EQ(file.refs()[0], 3u);
    EXPECT_EQ(file.order()[2], 7u);
    EXPECT_EQ(file.metadata(), R"({"tool":"tiny_scene.h"})");
    const pro_splat splat = file.splat(3);
    EXPECT_NEAR(splat.position[2], 0.45f, 3e-7f);
    EXPECT_NEAR(splat.normal[0], 0.6f, 7e-4f);
    EXPECT_NEAR(splat.radius, 0.2f, 0.005f);
    EXPECT_EQ(splat.color[0], 128);
    EXPECT_EQ(file.splat(4).material, 1);
}

TEST(Golden, Version10VerifiesClean) { EXPECT_TRUE(findingsOf(readBytes(kTinyV10)).empty()); }

TEST(Golden, SameContentIsWrittenAsTheSameBytes) {
    const TemporaryFolder folder;
    tinyScene().write(folder.file("from_scene.pro"));
    EXPECT_EQ(readBytes(folder.file("from_scene.pro")), readBytes(kTinyV10));
    const ProFile golden(kTinyV10);
    writePro(folder.file("from_file.pro"), golden.info(), golden.view());
    EXPECT_EQ(readBytes(folder.file("from_file.pro")), readBytes(kTinyV10));
}

const std::string kTinyV11 = POINTRT_GOLDEN_DIR "/tiny_v1_1.pro";

/// Its index is of a kind that is no longer read: what opens it makes one anew.
TEST(Golden, Version11Reads) {
    const ProFile file(kTinyV11);
    EXPECT_EQ(file.info().version_minor, 1u);
    EXPECT_EQ(file.nodes()[8], 1u);
    EXPECT_EQ(file.index(), nullptr);
    const ProFile traced(kTinyV11, PRO_OPEN_TRACE);
    EXPECT_EQ(traced.nodes()[8], 1u);
}

TEST(Golden, Version11VerifiesClean) { EXPECT_TRUE(findingsOf(readBytes(kTinyV11)).empty()); }

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
    EXPECT_EQ(index.blending[1], 0xFFFFFFFEu); // two and one before the first of cell 2
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
    EXPECT_EQ(readBytes(folder.file("without.pro")), readBytes(kTinyV10)) << "without an index it is still version 1.0";
}

} // namespace
