// SPDX-License-Identifier: Apache-2.0
// The host records a frame while the device, a pretended GPU, traces the last one. Tests the time of a frame, and that
// pictures are the same as without overlap.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/gpu/offline/pretended.h"
#include "tests/gpu/offline/pretended_window.h"

namespace pointrt::test {
namespace {

class FramesInFlight : public testing::Test {
protected:
    SphereFile ball{3000};
};

TEST_F(FramesInFlight, TakeASubmissionAWaitAndNoMemory) {
    const Environment environment(layered(kDiscrete));
    WindowPicture window(ball, 2);
    for (int i = 0; i < 4; ++i) window.moveBy(0.01);
    for (int i = 0; i < 8; ++i) {
        SCOPED_TRACE(i);
        const Counts counts;
        window.moveBy(0.01);
        EXPECT_EQ(counts.of("submits"), 1u) << "the picture and its presentation together";
        EXPECT_LE(counts.of("waits"), 1u);
        EXPECT_EQ(counts.of("allocations"), 0u);
    }
}

/// On CPUs, the megakernel traces everything in one piece, without overlap.
TEST_F(FramesInFlight, ShowTheSamePictures) {
    constexpr std::uint32_t kSamples = 5;
    std::vector<Film> films;
    std::vector<Image8> shown;
    for (const auto& variables : {std::map<std::string, std::string>(), layered(kDiscrete), layered(kIntegrated)}) {
        const Environment environment(variables);
        WindowPicture window(ball, kSamples);
        for (int i = 0; i < 5; ++i) window.moveBy(0.02);
        shown.push_back(window.shown());
        films.push_back(window.refine());
        shown.push_back(window.shown());
    }
    for (const std::size_t device : {1u, 2u}) {
        SCOPED_TRACE(device);
        EXPECT_EQ(films[device].rgba, films[0].rgba);
        EXPECT_EQ(films[device].variance, films[0].variance);
        EXPECT_EQ(shown[2 * device].pixels, shown[0].pixels);
        EXPECT_EQ(shown[2 * device + 1].pixels, shown[1].pixels);
    }
    EXPECT_NE(shown[0].pixels, shown[1].pixels) << "a preview and a finished picture";
}

/// Frames of two sizes alternate, so that buffers are replaced while the last frame still uses them.
TEST_F(FramesInFlight, OutliveWhatTheyReplace) {
    const Environment environment(layered(kDiscrete));
    WindowPicture window(ball, 2);
    for (int i = 0; i < 6; ++i) {
        const std::uint32_t side = i % 2 ? kWindowSide : kWindowSide / 2 + 8 * static_cast<std::uint32_t>(i);
        window.view.settings.width = window.view.settings.height = side;
        resizeCanvas(window.validated.device, window.presenter, side, side);
        window.moveBy(0.01);
    }
    EXPECT_EQ(window.live->progress().size, (PixelSize{kWindowSide, kWindowSide}));
}

} // namespace
} // namespace pointrt::test
