// SPDX-License-Identifier: Apache-2.0
// Files of every version ever shipped: they open for ever, and the newest is what is written today.
#include <gtest/gtest.h>

#include "file_bytes.h"
#include "tiny_scene.h"

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
    const TempFolder folder;
    tinyScene().write(folder / "from_scene.pro");
    EXPECT_EQ(readBytes(folder / "from_scene.pro"), readBytes(kTinyV10));
    const ProFile golden(kTinyV10);
    writePro(folder / "from_file.pro", golden.info(), golden.view());
    EXPECT_EQ(readBytes(folder / "from_file.pro"), readBytes(kTinyV10));
}

} // namespace
