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

TEST(Golden, Version11Reads) {
    const ProFile file(kTinyV11);
    EXPECT_EQ(file.info().version_minor, 1u);
    EXPECT_EQ(file.nodes()[8], 1u);
    ASSERT_NE(file.index(), nullptr);
    const pro_index& index = *file.index();
    EXPECT_EQ(index.shift, 20u);
    EXPECT_EQ(index.size[0], 2u);
    EXPECT_EQ(index.uneven, 1u);
    EXPECT_EQ(index.brick_count, 1u);
    EXPECT_EQ(index.group_count, 2u);
    EXPECT_EQ(index.cell_count, 4u);
    EXPECT_EQ(index.near_count, 10u);
    EXPECT_EQ(index.list_count, 16u);
    EXPECT_EQ(index.grid[0], kNothingNear);
    EXPECT_EQ(index.bricks[1], groupWord(9));
    EXPECT_EQ(index.cells[2 * 3], 8u);
    EXPECT_EQ(index.slabs[3], 0x12345678u);
    EXPECT_EQ(index.near_splats[19], 0x01020304u);
    EXPECT_EQ(index.lists[12], 4u);
    EXPECT_EQ(index.blend_ranges[5], 2u);
}

TEST(Golden, Version11VerifiesClean) { EXPECT_TRUE(findingsOf(readBytes(kTinyV11)).empty()); }

TEST(Golden, SameIndexIsWrittenAsTheSameBytes) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    tinyIndex().write(scene, folder.file("from_scene.pro"));
    EXPECT_EQ(readBytes(folder.file("from_scene.pro")), readBytes(kTinyV11));
    const ProFile golden(kTinyV11);
    writePro(folder.file("from_file.pro"), golden.info(), golden.view(), golden.index());
    EXPECT_EQ(readBytes(folder.file("from_file.pro")), readBytes(kTinyV11));
    writePro(folder.file("without.pro"), golden.info(), golden.view());
    EXPECT_EQ(readBytes(folder.file("without.pro")), readBytes(kTinyV10)) << "without an index it is still version 1.0";
}

} // namespace
