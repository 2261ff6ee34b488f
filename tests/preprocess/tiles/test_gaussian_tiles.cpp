// SPDX-License-Identifier: Apache-2.0
// Tile sets of Gaussians: each is in one original tile, and coarser levels have the moments of their groups.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "format/set/open_tile.h"
#include "format/set/verify_tile.h"
#include "preprocess/tiles/merge_gaussians.h"
#include "tests/gaussians/gaussian_ply.h"
#include "tests/gaussians/gaussian_pro.h"
#include "tests/gaussians/nasty_gaussians.h"
#include "tests/preprocess/tiles/set_fixture.h"
#include "tests/support/gaussian_set.h"

namespace pointrt::test {
namespace {

GaussianMoments ball(const Vec3d& mean, double deviation, double opacity) {
    return {mean, Eigen::Matrix3d::Identity() * deviation * deviation, opacity};
}

GaussianMoments merged(const std::vector<GaussianMoments>& members) {
    return mergeMoments(members, mergeShares(members));
}

TEST(MergeMoments, ShadowOfABallIsItsDisc) {
    EXPECT_NEAR(meanShadow(Eigen::Matrix3d::Identity() * 4), 4 * EIGEN_PI, 1e-9);
}

TEST(MergeMoments, ShadowOfADiscIsHalfOfItOnAverage) {
    const Eigen::Matrix3d flat = Vec3d(1, 1, 1e-6).asDiagonal();
    EXPECT_NEAR(meanShadow(flat), EIGEN_PI / 2, 0.011 * EIGEN_PI / 2); // within the error of Thomsen's formula
}

TEST(MergeMoments, TwinsHideAsMuchAsOneBehindTheOther) {
    const GaussianMoments both = merged({ball({1, 2, 3}, 0.1, 0.5), ball({1, 2, 3}, 0.1, 0.5)});
    EXPECT_NEAR(both.opacity, 0.75, 1e-12);
    EXPECT_TRUE(both.mean.isApprox(Vec3d(1, 2, 3)));
    EXPECT_TRUE(both.covariance.isApprox(ball({}, 0.1, 0).covariance));
}

TEST(MergeMoments, NeighboursBecomeTheirMeanAndCovariance) {
    // shares 3 : 1, as the shadows are equal
    const GaussianMoments both = merged({ball({0, 0, 0}, 0.1, 0.6), ball({4, 0, 0}, 0.1, 0.2)});
    EXPECT_TRUE(both.mean.isApprox(Vec3d(1, 0, 0)));
    EXPECT_NEAR(both.covariance(0, 0), 0.01 + 0.75 * 1 + 0.25 * 9, 1e-12);
    EXPECT_NEAR(both.covariance(1, 1), 0.01, 1e-12);
    EXPECT_NEAR(both.covariance(0, 1), 0, 1e-12);
    // the part hidden by both, spread over the shadow of their common ellipsoid
    EXPECT_NEAR(both.opacity * meanShadow(both.covariance), 0.8 * EIGEN_PI * 0.01, 1e-12);
}

TEST(MergeMoments, OneStaysAsItIs) {
    const GaussianMoments one = merged({ball({1, 2, 3}, 0.1, 0.3)});
    EXPECT_EQ(one.mean, Vec3d(1, 2, 3));
    EXPECT_EQ(one.opacity, 0.3);
}

class GaussianTiles : public SetTest {
protected:
    std::string setFolder() const { return folder.file("capture.proset"); }
    TileSet bake(const std::vector<OracleGaussian>& gaussians, std::uint64_t per_tile = 300) {
        return bakeGaussianSet(folder.path.string(), gaussians, per_tile);
    }
};

/// A Gaussian of a tile, whose positions have steps of this length.
struct StoredGaussian {
    OracleGaussian gaussian;
    double step;
};

/// The Gaussian whose mean is nearest.
const StoredGaussian& nearestTo(const Double3& mean, const std::vector<StoredGaussian>& stored) {
    const auto distance = [&](const StoredGaussian& each) { return length(minus(each.gaussian.mean, mean)); };
    return *std::min_element(stored.begin(), stored.end(),
                             [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
}

TEST_F(GaussianTiles, HoldEachInOneOriginalTile) {
    const std::vector<OracleGaussian> made = makeGaussians("giants", 1000);
    const TileSet set = bake(made);
    EXPECT_TRUE(set.gaussians);
    EXPECT_EQ(set.splats, made.size());
    EXPECT_TRUE(set.attributes.empty());
    EXPECT_GT(set.tiles.size(), 8u);
    std::vector<StoredGaussian> stored;
    for (const SetTile& tile : set.tiles) {
        EXPECT_EQ(tile.stored, tile.splats);
        if (!tile.isOriginal()) continue;
        const double step = edgeOf(set, tile.level) / kCoreSteps;
        for (const OracleGaussian& each : readGaussianPro(tilePath(setFolder(), tile))) stored.push_back({each, step});
    }
    ASSERT_EQ(stored.size(), made.size());
    for (const OracleGaussian& each : made) {
        const auto& [found, step] = nearestTo(each.mean, stored);
        ASSERT_LT(length(minus(found.mean, each.mean)), 0.2 * step); // points are floats from the core's corner
        for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_NEAR(found.deviation[axis] / each.deviation[axis], 1, 0.01);
        ASSERT_NEAR(found.opacity, each.opacity, 1e-3);
        ASSERT_EQ(found.harmonics.size(), each.harmonics.size());
    }
}

TEST_F(GaussianTiles, AreVerifiedAsSuch) {
    const TileSet set = bake(makeGaussians("random", 1500));
    for (std::size_t i = 0; i < set.tiles.size(); ++i)
        for (const TileFinding& finding : verifyTile(set, setFolder(), i)) ADD_FAILURE() << finding.text;
    const TileSet read = readTileSet(setFolder());
    EXPECT_TRUE(read.gaussians);
    TileSet of_discs = read;
    of_discs.gaussians = false;
    EXPECT_FALSE(verifyTile(of_discs, setFolder(), 0).empty()) << "discs in place of Gaussians";
}

TEST_F(GaussianTiles, CoarserLevelsHoldFewerThatHideAsMuch) {
    const std::vector<OracleGaussian> made = makeGaussians("random", 4000);
    const TileSet set = bake(made);
    const auto hidden = [](const std::vector<OracleGaussian>& all) {
        double sum = 0;
        for (const OracleGaussian& each : all) {
            const Vec3d axes = Eigen::Map<const Vec3d>(each.deviation.data());
            sum += each.opacity * meanShadow(axes.cwiseAbs2().asDiagonal());
        }
        return sum;
    };
    const std::vector<OracleGaussian> root = readGaussianPro(tilePath(setFolder(), set.tiles[0]));
    EXPECT_LT(root.size(), made.size() / 4);
    // hides no more than all of them side by side, and less where they were one behind another
    EXPECT_LT(hidden(root), 1.05 * hidden(made));
    EXPECT_GT(hidden(root), 0.4 * hidden(made));
    EXPECT_GT(set.tiles[0].error, 0);
}

TEST_F(GaussianTiles, AreNotMixedWithPoints) {
    writeGaussianPly(folder.file("capture.ply"), makeGaussians("random", 100));
    const SetRequest request = requestOf({writeHill("hill.csv", 500), folder.file("capture.ply")});
    EXPECT_NE(reasonOf([&] { makePlan(request); }, ExitCode::kBadInput).find("--splat disc"), std::string::npos);
}

} // namespace
} // namespace pointrt::test
