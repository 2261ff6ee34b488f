// SPDX-License-Identifier: Apache-2.0
// Distances between scans that are known to be moved, and their statistics.
#include "pointrt/measure.hpp"
#include "tests/runtime/studies/study_scenes.h"

namespace pointrt::test {
namespace {

class Distances : public Study {
protected:
    /// A scan of the splats, moved along z by this distance in metres.
    std::string moved(const std::string& name, const std::vector<pro_splat>& splats, double distance) {
        GridPlace place;
        place.origin[2] += distance;
        writeScan(folder.file(name), splats, place);
        return folder.file(name);
    }

    std::vector<double> distancesOf(const std::string& reference, const std::string& compared, double most) {
        const TraceScene scene(device, {reference});
        const ScanPoints points = scanPoints(compared);
        std::vector<double> distances(points.radii.size());
        EXPECT_EQ(surfaceDistances(scene, points.rows(), most, distances), 2 * distances.size());
        return distances;
    }
};

TEST_F(Distances, ACopyMovedByTenMillimetres) {
    const std::vector<pro_splat> plane = planeSplats(200, 0.5f); // discs of 0.5 m, whose normals are rounded
    const std::string before = moved("before.pro", plane, 0), after = moved("after.pro", plane, 0.01);
    for (const double distance : distancesOf(before, after, 0.5)) EXPECT_NEAR(distance, 0.01, 5e-4);
    for (const double distance : distancesOf(after, before, 0.5)) EXPECT_NEAR(distance, -0.01, 5e-4);
    for (const double distance : distancesOf(before, before, 0.5)) EXPECT_NEAR(distance, 0, 5e-4);
}

TEST_F(Distances, ABallMovedUpIsOutsideAboveAndInsideBelow) {
    const std::vector<pro_splat> ball = sphereSplats(20000, 0.25f);
    const std::string before = moved("before.pro", ball, 0), after = moved("after.pro", ball, 0.5);
    const std::vector<double> distances = distancesOf(before, after, 4);
    const ScanPoints points = scanPoints(after);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const double cosine = static_cast<double>(points.normals[3 * i + 2]);
        // the shift along the normal, plus 0.5^2 / 64 = 4 mm of second order; rims of discs of 0.96 m are 14 mm off
        ASSERT_NEAR(distances[i], 0.5 * cosine, 0.02) << i;
    }
}

TEST_F(Distances, FartherThanTheLimitIsMissing) {
    const std::vector<pro_splat> plane = planeSplats(20, 0.5f);
    const std::string before = moved("before.pro", plane, 0), after = moved("after.pro", plane, 2);
    for (const double distance : distancesOf(before, after, 1.9)) EXPECT_TRUE(std::isnan(distance));
    for (const double distance : distancesOf(before, after, 2.1)) EXPECT_NEAR(distance, 2, 3e-3);
}

TEST_F(Distances, PointsNeedNormals) {
    const TraceScene scene(device, {scan("plane.pro", planeSplats(5, 0.5f))});
    const std::vector<double> positions{500064, 4500064, 165};
    std::vector<double> distances(1);
    EXPECT_THROW(surfaceDistances(scene, {positions}, 1, distances), TraceError);
    const std::vector<float> normals{0, 0, 0};
    surfaceDistances(scene, {positions, normals}, 10, distances);
    EXPECT_TRUE(std::isnan(distances[0])) << "a point without direction";
    EXPECT_THROW(surfaceDistances(scene, {positions, normals}, 0, distances), TraceError);
}

TEST(DistanceStatistics, KnownNumbers) {
    std::vector<double> distances{-4, NAN, 1, 2, 3, 8, NAN};
    const DistanceStatistics s = distanceStatistics(distances);
    EXPECT_EQ(s.count, 5u);
    EXPECT_EQ(s.missing, 2u);
    EXPECT_DOUBLE_EQ(s.mean, 2);
    EXPECT_DOUBLE_EQ(s.median, 2);
    EXPECT_DOUBLE_EQ(s.deviation, std::sqrt((36 + 1 + 0 + 1 + 36) / 5.0));
    EXPECT_DOUBLE_EQ(s.rms, std::sqrt((16 + 1 + 4 + 9 + 64) / 5.0));
    EXPECT_EQ(s.percentile_95, 8);
    EXPECT_EQ(s.low, -4);
    EXPECT_EQ(s.high, 8);
    std::vector<double> hundred;
    for (int i = 100; i > 0; --i) hundred.push_back(i % 2 == 0 ? i : -i);
    EXPECT_EQ(distanceStatistics(hundred).percentile_95, 95);
    std::vector<double> none{NAN};
    EXPECT_TRUE(std::isnan(distanceStatistics(none).mean));
}

} // namespace
} // namespace pointrt::test
