// SPDX-License-Identifier: Apache-2.0
// Tiles that load slowly: a cut is displayed once it is complete, no tile is loaded twice, and unused tiles are
// evicted.
#include <gtest/gtest.h>

#include <filesystem>

#include "runtime/device_scene/scene_tiles.h"
#include "runtime/render/picture_tiles.h"
#include "tests/support/hand_cut_set.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {
namespace {

/// A sphere in eight tiles; only the root is resident.
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
        updateTiles(device_, scene_, request_); // without a memory limit
        request_.memory = std::uint64_t{1} << 30;
    }
    ~SetLoading() override {
        destroyDeviceScene(device_, scene_);
        destroyDevice(device_);
        std::filesystem::remove_all(folder_);
    }

    /// Loads with a time limit of zero, which loads one tile, and applies it. True if the cut has changed.
    bool loadStep(bool& complete, std::size_t files) {
        TileLoadRequest load = makeTileLoadRequest(scene_, request_);
        chooseTiles(load);
        load.on_all_cores = false;
        load.time_limit_s = 0;
        LoadedTiles tiles = loadTiles(device_, std::move(load));
        EXPECT_EQ(tiles.files.size(), files);
        complete = tiles.complete;
        return applyTiles(device_, scene_, std::move(tiles));
    }

    std::string folder_ = temporaryPath("loading.proset");
    Device device_;
    DeviceScene scene_;
    TileRequest request_;
};

TEST_F(SetLoading, Root_IsShownUntilAllTilesAreLoaded) {
    bool complete = false;
    for (std::size_t resident = 1; resident < 8; ++resident) {
        EXPECT_FALSE(loadStep(complete, 1));
        EXPECT_FALSE(complete);
        EXPECT_EQ(scene_.files.size(), 1 + resident) << "coming tiles are in use, whatever the size of the cache";
        ASSERT_EQ(scene_.instances.size(), 1u);
        EXPECT_EQ(scene_.instances[0].tile, 0u);
    }
    EXPECT_TRUE(loadStep(complete, 1));
    EXPECT_TRUE(complete);
    EXPECT_EQ(scene_.instances.size(), 8u);
    EXPECT_EQ(scene_.files.size(), 8u);
    EXPECT_FALSE(loadStep(complete, 0));
}

TEST_F(SetLoading, TilesNoLongerNeeded_AreEvicted) {
    bool complete = false;
    for (int k = 0; k < 3; ++k) loadStep(complete, 1);
    EXPECT_EQ(scene_.files.size(), 4u);
    request_.memory = 0;
    EXPECT_FALSE(loadStep(complete, 0));
    EXPECT_TRUE(complete);
    EXPECT_EQ(scene_.files.size(), 1u);
}

/// Eviction must not move files, because instances refer to them by slot.
TEST_F(SetLoading, Eviction_LeavesInstancesTheirFiles) {
    scene_.tile_cache_bytes = std::uint64_t{1} << 30;
    updateTiles(device_, scene_, request_);
    ASSERT_EQ(scene_.instances.size(), 8u);
    ASSERT_EQ(scene_.files.size(), 9u) << "the root stays in the cache, before all tiles";
    scene_.tile_cache_bytes = 0;
    bool complete = false;
    EXPECT_FALSE(loadStep(complete, 0)) << "the same tiles: instances are not rebuilt";
    EXPECT_EQ(scene_.files.size(), 8u) << "the root was evicted";
    for (const Instance& instance : scene_.instances)
        EXPECT_EQ(scene_.files.at(instance.file).path, tilePath(scene_.sets[0].opened, *instance.tile));
}

/// The filter takes 224 bytes for each of 1280x720 pixels, everything else 305 MB.
TEST_F(SetLoading, TileMemory_ExcludesTheRestOfThePicture) {
    if (!device_.unified_memory) GTEST_SKIP() << "the device has memory of its own";
    constexpr std::uint64_t kOthers = 305'000'000 + std::uint64_t{224} * 1280 * 720, kAsked = 2'000'000'000;
    RenderSettings settings;
    settings.width = 1280, settings.height = 720;
    EXPECT_EQ(pictureTileMemory(device_, settings, kAsked), kAsked - kOthers);
    EXPECT_EQ(pictureTileMemory(device_, settings, 2 * kOthers - 2), kOthers - 1) << "at least half of it";
    EXPECT_EQ(pictureTileMemory(device_, settings, 0), 0u);
    settings.width = settings.height = 16384;
    EXPECT_GT(pictureTileMemory(device_, settings, 2 * kAsked), kAsked) << "large pictures are filtered in parts";
    EXPECT_EQ(tileMemory(device_, kAsked), kAsked) << "rays have no picture";
}

} // namespace
} // namespace pointrt::test
