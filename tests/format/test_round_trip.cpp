// SPDX-License-Identifier: Apache-2.0
// Files read back as they were written.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "file_bytes.h"
#include "scene_builder.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace pointrt;
using namespace pointrt::test;

std::vector<pro_splat> randomSplats(std::size_t count, float radius) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 0.9999f);
    std::normal_distribution<float> gauss;
    std::vector<pro_splat> splats(count);
    for (pro_splat& splat : splats)
        splat = {{unit(random), unit(random), unit(random)},
                 {gauss(random), gauss(random), gauss(random)},
                 radius,
                 {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), 9},
                 0};
    return splats;
}

template <typename T, typename U>
void expectSame(std::span<const T> read, const std::vector<U>& written) {
    EXPECT_TRUE(std::equal(read.begin(), read.end(), written.begin(), written.end()));
}

void expectSameContent(const ProFile& file, const Scene& scene) {
    expectSame(file.nodes(), scene.nodes);
    expectSame(file.leaves(), scene.leaves);
    expectSame(file.refs(), scene.refs);
    expectSame(file.splats(), scene.splats);
    expectSame(file.materials(), scene.materials);
    expectSame(file.order(), scene.order);
    EXPECT_EQ(file.metadata(), scene.metadata);
}

TEST(RoundTrip, TinyScene) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    scene.write(folder.file("a.pro"));
    const ProFile file(folder.file("a.pro"));
    expectSameContent(file, scene);
    const pro_info& info = file.info();
    EXPECT_EQ(info.version_major, 1u);
    EXPECT_EQ(info.file_bytes, std::filesystem::file_size(folder.file("a.pro")));
    EXPECT_EQ(info.flags, scene.info.flags);
    EXPECT_EQ(info.max_depth, 2u);
    EXPECT_EQ(info.radius_step, 0.03125f);
    EXPECT_EQ(info.scale, 2.0);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(info.origin[axis], scene.info.origin[axis]);
        EXPECT_EQ(info.bounds_max[axis], scene.info.bounds_max[axis]);
    }
    EXPECT_EQ(file.bytes().size(), info.file_bytes);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(file.bytes().data()) % 4096, 0u);
    EXPECT_NEAR(file.splat(1).position[0], 0.4f, 1e-6f);
}

TEST(RoundTrip, OriginInANationalGridIsExact) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    const double origin[3] = {500000.123456789, 4500000.987654321, -12.5};
    for (int axis = 0; axis < 3; ++axis) {
        scene.info.bounds_min[axis] += origin[axis] - scene.info.origin[axis];
        scene.info.bounds_max[axis] += origin[axis] - scene.info.origin[axis];
        scene.info.origin[axis] = origin[axis];
    }
    scene.write(folder.file("a.pro"));
    EXPECT_EQ(ProFile(folder.file("a.pro")).info().origin[1], 4500000.987654321);
    EXPECT_TRUE(findingsOf(readBytes(folder.file("a.pro"))).empty());
}

TEST(RoundTrip, OptionalSectionsMayBeMissing) {
    const TemporaryFolder folder;
    Scene scene = tinyScene();
    scene.order.clear();
    scene.metadata.clear();
    scene.write(folder.file("a.pro"));
    const ProFile file(folder.file("a.pro"));
    EXPECT_TRUE(file.order().empty());
    EXPECT_EQ(file.view().order, nullptr);
    EXPECT_TRUE(file.metadata().empty());
}

TEST(RoundTrip, NoReferencesAndARootLeaf) {
    const TemporaryFolder folder;
    Scene scene = sceneOf(randomSplats(3, 0.01f));
    ASSERT_TRUE(scene.refs.empty());
    ASSERT_EQ(scene.nodes.size(), 8u);
    scene.write(folder.file("a.pro"));
    EXPECT_EQ(ProFile(folder.file("a.pro")).info().max_depth, 0u);
    EXPECT_TRUE(findingsOf(readBytes(folder.file("a.pro"))).empty());
}

TEST(RoundTrip, BuiltSceneHasNoFindings) {
    const TemporaryFolder folder;
    Scene scene = sceneOf(randomSplats(3000, 0.02f));
    ASSERT_GT(scene.refs.size(), 3000u);
    scene.write(folder.file("a.pro"));
    EXPECT_TRUE(findingsOf(readBytes(folder.file("a.pro"))).empty());
    expectSameContent(ProFile(folder.file("a.pro")), scene);
}

TEST(RoundTrip, SameContentSameBytes) {
    const TemporaryFolder folder;
    sceneOf(randomSplats(500, 0.02f)).write(folder.file("a.pro"));
    sceneOf(randomSplats(500, 0.02f)).write(folder.file("b.pro"));
    EXPECT_EQ(readBytes(folder.file("a.pro")), readBytes(folder.file("b.pro")));
}

TEST(RoundTrip, DepthTwentyOneOpens) {
    const TemporaryFolder folder;
    std::vector<pro_splat> splats = randomSplats(2, 1e-6f);
    for (int axis = 0; axis < 3; ++axis) { // neighbouring positions at the finest step
        splats[0].position[axis] = 1000.5f * PRO_POSITION_STEP;
        splats[1].position[axis] = 1001.5f * PRO_POSITION_STEP;
    }
    TreeOptions options;
    options.members_max = 1;
    options.max_depth = PRO_MAX_DEPTH;
    options.radius_step = 0.125f;
    Scene scene = sceneOf(splats, options);
    scene.write(folder.file("a.pro"));
    EXPECT_EQ(ProFile(folder.file("a.pro")).info().max_depth, 21u);
    EXPECT_TRUE(findingsOf(readBytes(folder.file("a.pro"))).empty());
}

TEST(RoundTrip, MillionSplats) {
    const TemporaryFolder folder;
    Scene scene = sceneOf(randomSplats(1000000, 0.003f));
    scene.write(folder.file("a.pro"));
    const ProFile file(folder.file("a.pro"));
    EXPECT_EQ(file.info().splat_count, scene.info.splat_count);
    EXPECT_EQ(file.info().ref_count, scene.info.ref_count);
    EXPECT_TRUE(std::equal(file.splats().begin(), file.splats().end(), scene.view().splats));
}

} // namespace
