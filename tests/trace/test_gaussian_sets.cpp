// SPDX-License-Identifier: Apache-2.0
// A tile set of Gaussians is one capture: its pictures equal those of brute force over all of them.
#include <gtest/gtest.h>

#include "format/base/error.h"
#include "tests/gaussians/nasty_gaussians.h"
#include "tests/support/gaussian_set.h"
#include "tests/support/temporary_folder.h"
#include "tests/trace/gaussian_file.h"
#include "tests/trace/gaussian_picture.h"

namespace pointrt::test {
namespace {

/// The eye is among the Gaussians or beside them; rays meet the tiles in any order.
constexpr Vec3 kEyes[] = {{0.3, 0.2, 4}, {-2, 1.5, -1}, {0.05, 0.02, 0.1}};

class GaussianSets : public testing::TestWithParam<std::string> {};

TEST_P(GaussianSets, EqualBruteForce) {
    const TemporaryFolder folder;
    const std::vector<OracleGaussian> made = makeGaussians(GetParam(), 1200);
    const TileSet set = bakeGaussianSet(folder.path.string(), made, 200);
    EXPECT_GT(set.tiles.size(), 8u);
    const OracleScene truth = oracleScene(made);
    for (const Vec3& eye : kEyes) {
        RenderSettings settings = lookingFrom(eye, {0, 0, 0}, 40);
        settings.detail = 0; // original tiles
        const Rendered rendered = renderFile(folder.file("capture.proset"), settings);
        EXPECT_EQ(rendered.rays.cut, 0u);
        EXPECT_GT(
            psnrAgainst(rendered, settings,
                        [&](Vec3 direction) { return lightOf(compositeAlong(truth, rendered.camera.eye, direction)); }),
            45)
            << eye.x; // of the input: tiles round parameters
    }
}

INSTANTIATE_TEST_SUITE_P(Each, GaussianSets, testing::Values("random", "giants", "borders"),
                         [](const auto& kind) { return kind.param; });

TEST(GaussianSets, CoarserTilesLookAlike) {
    const TemporaryFolder folder;
    const std::vector<OracleGaussian> made = makeGaussians("random", 4000);
    bakeGaussianSet(folder.path.string(), made, 500);
    const OracleScene truth = oracleScene(made);
    RenderSettings settings = lookingFrom({0.3, 0.2, 40}, {0, 0, 0}, 40);
    settings.camera.fov_deg = 6;
    settings.detail = 16384; // the root alone
    const Rendered rendered = renderFile(folder.file("capture.proset"), settings);
    EXPECT_GT(
        psnrAgainst(rendered, settings,
                    [&](Vec3 direction) { return lightOf(compositeAlong(truth, rendered.camera.eye, direction)); }),
        20);
}

} // namespace
} // namespace pointrt::test
