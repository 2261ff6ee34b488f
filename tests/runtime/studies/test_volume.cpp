// SPDX-License-Identifier: Apache-2.0
// Volumes of a made heap over level and tilted bases, and refusals.
#include "pointrt/measure.hpp"
#include "runtime/measure/clip_polygon.h"
#include "tests/runtime/studies/study_scenes.h"

namespace pointrt::test {
namespace {

/// A block of 0.2 x 0.2 x 0.1 cube edges on the ground at 0.25, of which its roof and ground are scanned.
constexpr double kGroundZ = 0.25, kRoofZ = 0.35, kBlock = 0.2;
/// The share of the roof's area by which its discs reach beyond its edges: up to a spacing of 1/80 of a side.
constexpr double kRims = 0.02;

class VolumeStudy : public Study {
protected:
    VolumeStudy() {
        std::vector<pro_splat> splats;
        constexpr double kStep = 0.2 / 40;
        addSheet(splats, {{0.1, 0.1, kGroundZ}, {0.8, 0, 0}, {0, 0.8, 0}, {0, 0, 1}}, kStep, kStep);
        addSheet(splats, {{0.4, 0.4, kRoofZ}, {kBlock, 0, 0}, {0, kBlock, 0}, {0, 0, 1}}, kStep / 2, 0.75 * kStep / 2);
        scene.emplace(device, std::vector{scan("block.pro", splats)});
    }

    Position at(double x, double y, double z) const {
        return {place.origin[0] + place.edge * x, place.origin[1] + place.edge * y, place.origin[2] + place.edge * z};
    }
    /// A square rim, its height given by heightAt(x, y) in cube units.
    template <typename HeightAt>
    std::vector<Position> rim(double low, double high, const HeightAt& heightAt) const {
        std::vector<Position> points;
        for (const auto& [x, y] : {std::pair(low, low), {high, low}, {high, high}, {low, high}})
            points.push_back(at(x, y, heightAt(x, y)));
        return points;
    }
    std::vector<Position> levelRim() const {
        return rim(0.3, 0.7, [](double, double) { return kGroundZ; });
    }

    const GridPlace place;
    std::optional<TraceScene> scene;
};

TEST_F(VolumeStudy, ABlockHasItsVolume) {
    const Volume volume = measureVolume(*scene, levelRim(), {});
    const double edge3 = std::pow(place.edge, 3), block = kBlock * kBlock * (kRoofZ - kGroundZ) * edge3;
    EXPECT_NEAR(volume.cut, block, kRims * block);
    EXPECT_NEAR(volume.fill, 0, 1e-4 * block); // rounding of normals: 3e-4 of a radius
    EXPECT_NEAR(volume.area, 0.16 * place.edge * place.edge, 1e-6);
    EXPECT_NEAR(volume.covered, volume.area, 1e-6 * volume.area);
}

TEST_F(VolumeStudy, AHeapIsRightToATenthOfAPercent) {
    // a paraboloid of tangent discs; its volume is half of its cylinder's
    constexpr double kRadius = 0.3, kHeight = 0.1, kSpacing = 0.0025;
    std::vector<pro_splat> splats;
    addSheet(splats, {{0.1, 0.1, kGroundZ}, {0.8, 0, 0}, {0, 0.8, 0}, {0, 0, 1}}, 0.01, 0.01);
    for (double x = -kRadius; x < kRadius; x += kSpacing)
        for (double y = -kRadius; y < kRadius; y += kSpacing) {
            const double share = (x * x + y * y) / (kRadius * kRadius);
            if (share >= 1) continue;
            const double slope = -2 * kHeight / (kRadius * kRadius), size = std::hypot(slope * x, slope * y, 1);
            const auto n = [](double v) { return static_cast<float>(v); };
            splats.push_back({{n(0.5 + x), n(0.5 + y), n(kGroundZ + kHeight * (1 - share))},
                              {n(-slope * x / size), n(-slope * y / size), n(1 / size)},
                              n(kSpacing),
                              {},
                              0});
        }
    const TraceScene heap(device, {scan("heap.pro", splats)});
    const Volume volume = measureVolume(heap, rim(0.15, 0.85, [](double, double) { return kGroundZ; }), {});
    const double expected = std::numbers::pi * kRadius * kRadius * kHeight / 2 * std::pow(place.edge, 3);
    EXPECT_NEAR(volume.cut, expected, 1e-3 * expected);
}

TEST_F(VolumeStudy, ABaseAboveTheGroundHasToBeFilled) {
    const double height = place.origin[2] + place.edge * 0.3;
    const Volume volume = measureVolume(*scene, levelRim(), {.base_height = height, .cell = 0.1});
    const double edge3 = std::pow(place.edge, 3);
    const double cut = kBlock * kBlock * 0.05 * edge3, fill = (0.16 - kBlock * kBlock) * 0.05 * edge3;
    EXPECT_NEAR(volume.cut, cut, kRims * cut);
    EXPECT_NEAR(volume.fill, fill, kRims * cut);
    EXPECT_NEAR(volume.net(), cut - fill, 2 * kRims * cut);
    EXPECT_EQ(volume.cell, 0.1);
}

TEST_F(VolumeStudy, APlaneOverATiltedRimIsExactToRounding) {
    // beside the block, level ground below a base that rises by 0.1 along x: a wedge, exact since rays go through
    // centroids; the rim is not aligned with the raster
    const std::vector<Position> wedge = {at(0.12, 0.7, kGroundZ), at(0.37, 0.73, kGroundZ + 0.1 * 0.25),
                                         at(0.22, 0.88, kGroundZ + 0.1 * 0.10)};
    const Volume volume = measureVolume(*scene, wedge, {.cell = 0.37});
    const double plan = areaOf({{0.12, 0.7}, {0.37, 0.73}, {0.22, 0.88}}).area;
    const double mean_depth = 0.1 * ((0.12 + 0.37 + 0.22) / 3 - 0.12);
    const double expected = plan * mean_depth * std::pow(place.edge, 3);
    EXPECT_NEAR(volume.fill, expected, 1e-4 * expected);
    EXPECT_NEAR(volume.cut, 0, 1e-4 * expected);
}

TEST_F(VolumeStudy, HolesDoNotCount) {
    const Volume volume =
        measureVolume(*scene, rim(0.05, 0.35, [](double, double) { return kGroundZ - 0.1; }), {.cell = 0.1});
    // the ground begins at 0.1 and reaches a disc's radius, 0.005, beyond
    EXPECT_NEAR(volume.covered / volume.area, std::pow(0.25 / 0.3, 2), 0.03);
    EXPECT_NEAR(volume.cut, volume.covered * 0.1 * place.edge, 1e-4 * volume.cut);
}

TEST_F(VolumeStudy, AnotherUpIsPossible) {
    // seen along +X, the level ground is an edge: the rim's plane must not be along the rays
    EXPECT_THROW(measureVolume(*scene, levelRim(), {.up = {1, 0, 0}}), TraceError);
    const Volume below = measureVolume(*scene, levelRim(), {.up = {0, 0, -1}});
    EXPECT_NEAR(below.cut, 0, 1) << "from below the ground hides the block, whose volume is 8389";
}

TEST_F(VolumeStudy, BadRimsAreRefused) {
    const auto refusal = [&](const std::vector<Position>& points, const VolumeRules& rules) {
        try {
            measureVolume(*scene, points, rules);
        } catch (const TraceError& error) {
            EXPECT_EQ(error.kind, TraceError::Kind::kBadUsage);
            return std::string(error.what());
        }
        return std::string();
    };
    const std::vector<Position> level = levelRim();
    EXPECT_NE(refusal({level[0], level[1]}, {}).find("3 points"), std::string::npos);
    EXPECT_NE(refusal({level[0], level[2], level[1], level[3]}, {}).find("crosses"), std::string::npos);
    EXPECT_NE(refusal(level, {.cell = 1e-9}).find("cell"), std::string::npos);
    EXPECT_NE(refusal(level, {.up = {0, 0, 2}}).find("unit"), std::string::npos);
    EXPECT_NE(refusal(level, {.base_height = NAN}).find("finite"), std::string::npos);
}

} // namespace
} // namespace pointrt::test
