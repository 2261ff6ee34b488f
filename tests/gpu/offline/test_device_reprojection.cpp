// SPDX-License-Identifier: Apache-2.0
// Reprojection on a pretended GPU against the host's, which has known answers
// (tests/runtime/window/test_render_cache.cpp).
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <vector>

#include "tests/gpu/offline/pretended.h"
#include "tests/gpu/offline/pretended_window.h"

namespace pointrt::test {
namespace {

/// Too short for a full frame: the view is reprojected.
constexpr double kNoTime_s = 1e-9;
/// Number of samples of pictures at rest.
constexpr std::uint32_t kAtRest = 16;

/// Mean difference of channels, in steps of 255.
double difference(const Image8& a, const Image8& b) {
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(int(a.pixels[i]) - int(b.pixels[i]));
    return sum / static_cast<double>(a.pixels.size());
}

using Motion = std::function<void(Viewport&)>;

/// Frames of a moving view, and the last view at rest.
struct MovedPicture {
    Image8 moving, still;
};

/// Starts from a picture at rest and renders this many frames of a motion, each with this much time for its pixels.
MovedPicture moved(const SphereFile& ball, int frames, double seconds, const Motion& motion,
                   ViewChange change = ViewChange::kCamera) {
    WindowPicture window(ball, kAtRest, kNoTime_s);
    window.refine();
    for (int i = 0; i < frames; ++i) {
        motion(window.view);
        window.live->setView(window.view, true, change);
        window.frame(seconds);
        EXPECT_GT(window.live->progress().traced, 0u) << "reprojected";
    }
    MovedPicture picture;
    picture.moving = window.shown();
    window.refine();
    picture.still = window.shown();
    return picture;
}

class DeviceReprojection : public testing::Test {
protected:
    /// The device's picture must be about as close to the picture at rest as the host's.
    void expectAsGoodAsOnTheHost(int frames, double seconds, const Motion& motion,
                                 ViewChange change = ViewChange::kCamera) {
        const MovedPicture host = moved(ball, frames, seconds, motion, change);
        const Environment environment(layered(kDiscrete));
        const MovedPicture device = moved(ball, frames, seconds, motion, change);
        ASSERT_EQ(difference(device.still, host.still), 0);
        const double of_host = difference(host.moving, host.still), of_device = difference(device.moving, host.still);
        EXPECT_GT(of_host, 0.1) << "frames while moving have few samples";
        EXPECT_LT(of_device, 1.1 * of_host + 0.1) << "host: " << of_host;
        EXPECT_GT(of_device, 0.9 * of_host - 0.1) << "host: " << of_host;
    }

    SphereFile ball{3000};
};

/// With a fifth of the pixels traced in each frame.
TEST_F(DeviceReprojection, OfASidewaysMotion_IsAsOnTheHost) {
    expectAsGoodAsOnTheHost(6, kNoTime_s, [](Viewport& view) { view.camera.eye.x += 0.03; });
}

TEST_F(DeviceReprojection, WithAllPixelsTraced_IsAsOnTheHost) {
    expectAsGoodAsOnTheHost(3, kFrame_s, [](Viewport& view) { view.camera.eye.x += 0.03; });
}

/// Gaps open between the points until these are resampled.
TEST_F(DeviceReprojection, OfAnApproach_IsAsOnTheHost) {
    expectAsGoodAsOnTheHost(4, kNoTime_s, [](Viewport& view) {
        view.camera.eye = {0.85 * view.camera.eye.x, 0.85 * view.camera.eye.y, 0.85 * view.camera.eye.z};
    });
}

/// Colours become old and are traced again.
TEST_F(DeviceReprojection, OfOldLight_IsAsOnTheHost) {
    expectAsGoodAsOnTheHost(
        4, kNoTime_s, [](Viewport&) {}, ViewChange::kScene);
}

TEST_F(DeviceReprojection, TakesASubmissionAWaitAndNoMemory) {
    const Environment environment(layered(kDiscrete));
    WindowPicture window(ball, 2, kNoTime_s);
    window.refine();
    for (int i = 0; i < 8; ++i) {
        SCOPED_TRACE(i);
        const Counts counts;
        window.moveBy(0.01);
        EXPECT_GT(window.live->progress().traced, 0u) << "reprojected";
        if (i < 4) continue; // the first frames make what later ones use again
        EXPECT_EQ(counts.of("submits"), 1u);
        EXPECT_LE(counts.of("waits"), 1u);
        EXPECT_EQ(counts.of("allocations"), 0u);
    }
}

} // namespace
} // namespace pointrt::test
