// SPDX-License-Identifier: Apache-2.0
// Tiles that take long to come: those that are there wait for the others, and nothing is loaded twice.
#include <gtest/gtest.h>

#include <filesystem>

#include "runtime/device_scene/scene_tiles.h"
#include "runtime/render/picture_tiles.h"
#include "tests/support/hand_cut_set.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {
namespace {

/// A sphere in eight tiles, of which the root alone is on a device.
class SetLoading : public testing::Test {
protected:
    SetLoading() : device_(createDevice({})) {
        const Splats sphere = sphereSplats(4000, Vec3f(0, 0, 0), 1);
        writeHandCutSet(folder_, {{-1.25, -1.25, -1.25}, 1.25, 2, 1, sphere.radii[0]}, sphere, sphere);
        SceneDescription description;
        description.instances.push_back({folder_, {}, {}, {}});
        scene_ = openScene(device_, description, false);
        request_.cameras = {{{-3, 0, 0}, {0, -1, 0}, {0, 0, 1}, {1, 0, 0}, 60, 0}};
        request_.size = {64, 64};
        request_.detail = 0;
        standTiles(device_, scene_, request_); // without memory
        request_.memory = std::uint64_t{1} << 30;
    }
    ~SetLoading() override {
        destroyDeviceScene(device_, scene_);
        destroyDevice(device_);
        std::filesystem::remove_all(folder_);
    }

    /// One delivery, in no time. True where other tiles stand then.
    bool load(bool& whole, std::size_t files) {
        TileOrder order = orderTiles(scene_, request_);
        chooseTiles(order);
        order.on_all_cores = false;
        order.seconds = 0;
        TileDelivery tiles = loadTiles(device_, std::move(order));
        EXPECT_EQ(tiles.files.size(), files);
        whole = tiles.whole;
        return standTiles(device_, scene_, std::move(tiles));
    }

    std::string folder_ = temporaryPath("loading.proset");
    Device device_;
    DeviceScene scene_;
    TileRequest request_;
};

TEST_F(SetLoading, TheRootStandsUntilAllTilesAreThere) {
    bool whole = false;
    for (std::size_t there = 1; there < 8; ++there) {
        EXPECT_FALSE(load(whole, 1));
        EXPECT_FALSE(whole);
        EXPECT_EQ(scene_.files.size(), 1 + there) << "with no room but for what is in use: the wanted ones are";
        ASSERT_EQ(scene_.instances.size(), 1u);
        EXPECT_EQ(scene_.instances[0].tile, 0u);
    }
    EXPECT_TRUE(load(whole, 1));
    EXPECT_TRUE(whole);
    EXPECT_EQ(scene_.instances.size(), 8u);
    EXPECT_EQ(scene_.files.size(), 8u);
    EXPECT_FALSE(load(whole, 0));
}

TEST_F(SetLoading, TilesThatAreWantedNoMoreGo) {
    bool whole = false;
    for (int k = 0; k < 3; ++k) load(whole, 1);
    EXPECT_EQ(scene_.files.size(), 4u);
    request_.memory = 0;
    EXPECT_FALSE(load(whole, 0));
    EXPECT_TRUE(whole);
    EXPECT_EQ(scene_.files.size(), 1u);
}

/// Of 1280x720 pixels the filter takes 216 bytes each, all else 305 MB.
TEST_F(SetLoading, WhatElseAPictureTakesComesOffTheMemory) {
    if (!device_.unified_memory) GTEST_SKIP() << "the device has memory of its own";
    constexpr std::uint64_t kOthers = 305'000'000 + std::uint64_t{216} * 1280 * 720, kAsked = 2'000'000'000;
    RenderSettings settings;
    settings.width = 1280, settings.height = 720;
    EXPECT_EQ(pictureTileMemory(device_, settings, kAsked), kAsked - kOthers);
    EXPECT_EQ(pictureTileMemory(device_, settings, 2 * kOthers - 2), kOthers - 1) << "half of it at least";
    EXPECT_EQ(pictureTileMemory(device_, settings, 0), 0u);
    settings.width = settings.height = 16384;
    EXPECT_GT(pictureTileMemory(device_, settings, 2 * kAsked), kAsked) << "large pictures are filtered in parts";
    EXPECT_EQ(tileMemory(device_, kAsked), kAsked) << "rays have no picture";
}

} // namespace
} // namespace pointrt::test
