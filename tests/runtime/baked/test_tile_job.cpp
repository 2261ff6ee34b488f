// SPDX-License-Identifier: Apache-2.0
// A window that closes while tiles are loading.
#include "runtime/window/edit/tile_job.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/hand_cut_set.h"
#include "tests/support/splat_scenes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/validated_device.h"

namespace pointrt::test {
namespace {

/// A sphere in eight tiles; only the root is resident.
class TileJobTest : public DeviceFixture {
protected:
    TileJobTest() {
        const std::string path = folder_.file("sphere.proset");
        const Splats sphere = sphereSplats(4000, Vec3f(0, 0, 0), 1);
        writeHandCutSet(path, {{-1.25, -1.25, -1.25}, 1.25, 2, 1, sphere.radii[0]}, sphere, sphere);
        SceneDescription description;
        description.instances.push_back({path, {}, {}, {}});
        scene_ = openScene(device, description, false);
        request_.cameras = {{{-3, 0, 0}, {0, -1, 0}, {0, 0, 1}, {1, 0, 0}, 60, 0}};
        request_.size = {64, 64};
        request_.detail = 0;
        updateTiles(device, scene_, request_); // without a memory limit
        request_.memory = std::uint64_t{1} << 30;
    }
    ~TileJobTest() override { destroyDeviceScene(device, scene_); }

    const TemporaryFolder folder_;
    DeviceScene scene_;
    TileRequest request_;
};

TEST_F(TileJobTest, DroppedJob_DestroysItsTiles) {
    { TileJob job(device, makeTileLoadRequest(scene_, request_)); } // still loading
    // the validation layer reports leaks
}

TEST_F(TileJobTest, UntakenTiles_AreDestroyed) {
    TileJob job(device, makeTileLoadRequest(scene_, request_));
    while (!job.job().ended()) std::this_thread::yield();
    EXPECT_EQ(job.job().state(), JobState::kDone);
    EXPECT_GT(job.targetTiles(), 1u);
}

} // namespace
} // namespace pointrt::test
