// SPDX-License-Identifier: Apache-2.0
// Hourly shadows of a tower on level ground, checked against the gnomon formula.
#include "tests/runtime/studies/study_scenes.h"

namespace pointrt::test {
namespace {

constexpr double kGround = 0.25, kShadowSpacing = 0.8 / 160, kShadowHeight = 0.15; // cube units: 0.64 m and 19.2 m
constexpr double kLow = 0.48, kHigh = 0.52;                                        // edges of the tower: 5.12 m

/// Whether a place on the ground is in the tower's shadow: the ray to the sun crosses the tower's footprint below its
/// top.
bool isShaded(double x, double y, const double* sun) {
    const double dx = sun[0] / sun[2] * kShadowHeight, dy = sun[1] / sun[2] * kShadowHeight;
    double from = 0, to = 1;
    const auto cut = [&](double at, double step) {
        if (step == 0) {
            if (at < kLow || at > kHigh) to = -1;
            return;
        }
        const double a = (kLow - at) / step, b = (kHigh - at) / step;
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    };
    cut(x, dx);
    cut(y, dy);
    return from <= to;
}

/// 1 in shadow, 0 lit, or -1 if this changes within the point spacing.
int surely(double x, double y, const double* sun) {
    const bool here = isShaded(x, y, sun);
    for (int k = 0; k < 16; ++k) {
        const double angle = k * std::numbers::pi / 8;
        if (isShaded(x + kShadowSpacing * std::cos(angle), y + kShadowSpacing * std::sin(angle), sun) != here)
            return -1;
    }
    return here;
}

class Shadow : public Study {
protected:
    Shadow() {
        std::vector<pro_splat> splats;
        addSheet(splats, {{0.1, 0.1, kGround}, {0.8, 0, 0}, {0, 0.8, 0}, {0, 0, 1}}, kShadowSpacing,
                 0.8 * kShadowSpacing);
        // discs of the walls extend beyond the edges by a fifth of the spacing
        addBox(splats, {kLow, kLow, kGround}, {kHigh - kLow, kHigh - kLow, kShadowHeight}, kShadowSpacing / 2,
               0.36 * kShadowSpacing);
        path = scan("tower.pro", splats);
        points = scanPoints(path);
    }

    /// The coordinate of a point in cube units.
    double cube(std::size_t point, std::size_t axis) const {
        const GridPlace place;
        return (points.positions[3 * point + axis] - place.origin[axis]) / place.edge;
    }
    /// Whether the point is on the ground outside the tower.
    bool isGround(std::size_t i) const {
        const bool inside = cube(i, 0) > kLow - kShadowSpacing && cube(i, 0) < kHigh + kShadowSpacing &&
                            cube(i, 1) > kLow - kShadowSpacing && cube(i, 1) < kHigh + kShadowSpacing;
        return cube(i, 2) < kGround + 1e-4 && !inside;
    }

    std::string path;
    ScanPoints points;
};

TEST_F(Shadow, FollowsTheGnomonFormulaOverTheDay) {
    const TraceScene scene(device, {path});
    const GeoPlace place{47, 15}; // the central meridian of UTM zone 33
    const StudyFrame frame = studyFrame(path, place);
    const Lights sun = sunLights({place, {2026, 3, 20}, {2026, 3, 20}, 60, {}}, frame);
    ASSERT_EQ(sun.weights.size(), 12u);
    std::size_t shaded = 0, checked = 0, near = 0;
    for (std::size_t k = 0; k < sun.weights.size(); ++k) {
        const double* light = sun.directions.data() + 3 * k;
        std::vector<double> lit(points.radii.size());
        sumLights(scene, points.rows(), lightFrom({light[0], light[1], light[2]}), {}, lit);
        for (std::size_t i = 0; i < lit.size(); ++i) {
            if (!isGround(i)) continue;
            const int expected = surely(cube(i, 0), cube(i, 1), light);
            near += expected < 0;
            if (expected < 0) continue;
            ASSERT_EQ(lit[i], 1 - expected) << "instant " << k << ", " << cube(i, 0) << " " << cube(i, 1);
            shaded += expected == 1;
            ++checked;
        }
    }
    EXPECT_GT(checked, 250000u);
    EXPECT_GT(shaded, 5000u);
    EXPECT_LT(near, checked / 20);
}

TEST_F(Shadow, HoursAreTheSumOfTheInstants) {
    const TraceScene scene(device, {path});
    const StudyFrame frame = studyFrame(path, {47, 15});
    const Lights sun = sunLights({{47, 15}, {2026, 6, 21}, {2026, 6, 22}, 90, {}}, frame);
    std::vector<double> hours(points.radii.size());
    const std::uint64_t rays = sumLights(scene, points.rows(), sun, {}, hours);
    EXPECT_GE(rays, hours.size());
    for (std::size_t i = 0; i < hours.size(); i += 7) {
        if (!isGround(i)) continue;
        double least = 0, most = 0;
        for (std::size_t k = 0; k < sun.weights.size(); ++k) {
            const int shaded = surely(cube(i, 0), cube(i, 1), sun.directions.data() + 3 * k);
            least += shaded == 0 ? sun.weights[k] : 0;
            most += shaded != 1 ? sun.weights[k] : 0;
        }
        ASSERT_GE(hours[i], least - 1e-9) << i;
        ASSERT_LE(hours[i], most + 1e-9) << i;
    }
}

TEST_F(Shadow, WallsAreLitOnTheirSunnySideOnly) {
    const TraceScene scene(device, {path});
    std::vector<double> lit(points.radii.size());
    sumLights(scene, points.rows(), lightFrom(towards(30, 180)), {}, lit); // from the south
    std::size_t sunny = 0, dark = 0;
    for (std::size_t i = 0; i < lit.size(); ++i) {
        const float* n = points.normals.data() + 3 * i;
        if (n[2] > 0.5f) continue;
        const bool south = n[1] < -0.5f;
        ASSERT_EQ(lit[i], south ? 1 : 0) << cube(i, 0) << " " << cube(i, 1) << " " << cube(i, 2);
        (south ? sunny : dark) += 1;
    }
    EXPECT_EQ(dark, 3 * sunny);
}

} // namespace
} // namespace pointrt::test
