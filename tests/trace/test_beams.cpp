// SPDX-License-Identifier: Apache-2.0
// Camera rays that start at the end of their tile's beam have the same hits as rays that start at the camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "shaders/shared/params.h"
#include "tests/support/ray_caster.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

namespace {

constexpr std::uint32_t kSize = 128; // pixels a side

/// A scene in a temporary file.
struct SceneFile {
    std::string path = temporaryPath("beams.pro");
    explicit SceneFile(const Splats& scene) { writeScene(path, scene, {}); }
    ~SceneFile() { std::remove(path.c_str()); }
    SceneFile(const SceneFile&) = delete;
    SceneFile& operator=(const SceneFile&) = delete;
};

struct View {
    CameraRequest camera;
    std::size_t hits_least = 0, hits_most = kSize * kSize;
};

View view(Vec3 eye, Vec3 target, double fov_deg, std::size_t hits_least, std::size_t hits_most = kSize * kSize) {
    return {{eye, target, {}, fov_deg}, hits_least, hits_most};
}

/// The same for a parallel projection.
View orthoView(Vec3 eye, Vec3 target, double height, std::size_t hits_least, std::size_t hits_most = kSize * kSize) {
    View view{{eye, target, {}}, hits_least, hits_most};
    view.camera.ortho_height = height;
    return view;
}

struct Difference {
    std::size_t hits = 0;          ///< hits of rays cast one by one
    std::size_t hit_or_miss = 0;   ///< hits that a beam loses or adds
    std::size_t other_hit = 0;     ///< another splat at a different distance
    std::size_t dropped_tiles = 0; ///< tiles with hits in which nothing is hit
};

Difference compare(RayCaster& caster, const CameraRequest& camera) {
    const std::vector<Ray> rays = caster.cameraRays(kSize, camera);
    caster.traceCamera();
    const std::vector<CastHit> beams = caster.cameraHits();
    caster.load(rays);
    caster.traceLoaded();
    const std::vector<CastHit> single = caster.loadedHits();
    Difference result;
    for (std::size_t tile = 0; tile < rays.size(); tile += TILE_PIXELS) {
        std::size_t in_beam = 0, one_by_one = 0;
        for (std::size_t i = tile; i < tile + TILE_PIXELS; ++i) {
            in_beam += beams[i].hit();
            one_by_one += single[i].hit();
            result.hit_or_miss += beams[i].hit() != single[i].hit();
            // rays start elsewhere on the same line: distances differ by a few roundings of 2^-24
            const double apart = std::abs(beams[i].t_flat - single[i].t_flat);
            result.other_hit += beams[i].splat != single[i].splat && apart > 0x1p-20 * (1 + single[i].t_flat);
        }
        result.hits += one_by_one;
        result.dropped_tiles += in_beam == 0 && one_by_one > 0;
    }
    return result;
}

/// Number of rays for which the rounding of their start decides on a rim or on the order of two discs: up to two of
/// 16384 were observed in each view.
constexpr std::size_t kRoundedMost = 4;

void expectSameHits(const Splats& splats, const std::vector<View>& views) {
    const SceneFile scene(splats);
    RayCaster caster(scene.path);
    for (const View& each : views) {
        const Difference result = compare(caster, each.camera);
        std::printf("%zu hits, differ: %zu hit or miss, %zu another hit, %zu tiles dropped\n", result.hits,
                    result.hit_or_miss, result.other_hit, result.dropped_tiles);
        EXPECT_GE(result.hits, each.hits_least);
        EXPECT_LE(result.hits, each.hits_most);
        EXPECT_LE(result.hit_or_miss, kRoundedMost);
        EXPECT_LE(result.other_hit, kRoundedMost);
        EXPECT_EQ(result.dropped_tiles, 0u);
    }
    EXPECT_EQ(validationMessages(), 0u);
}

TEST(Beams, HitTheSameOnASphere) {
    // the whole sphere is a disc with a radius of 45.4 pixels, 6475 pixels in all; from afar 42.2 and 5588
    expectSameHits(sphereSplats(20000, Vec3f(1, 2, 3), 1.0f),
                   {view({1, 2, 7}, {1, 2, 3}, 40, 6430, 6530),      // the whole sphere
                    view({1, 60, 3}, {1, 2, 3}, 3, 5540, 5640),      // from afar
                    view({5, 2, 3}, {1, 3.03, 3}, 0.5, 2000, 14000), // thin beams past the edge
                    view({3, 3, 4}, {1, 2, 3}, 120, 500, 8000),      // a wide one
                    view({1, 2, 3}, {2, 2, 3}, 90, 16384),           // from the middle
                    view({1, 2.9, 3.9}, {1, 3, 3.2}, 60, 1000)});    // in a corner of the bounds
}

/// Discs with a radius of 32, 96 and 1.3 pixels: 3217 pixels, all but the corners, and 5 pixels.
TEST(Beams, HitTheSameInParallelProjection) {
    expectSameHits(sphereSplats(20000, Vec3f(1, 2, 3), 1.0f),
                   {orthoView({1, 2, 7}, {1, 2, 3}, 4, 3190, 3240),            // along an axis
                    orthoView({40, 50, 30}, {1, 2, 3}, 4, 3190, 3240),         // from afar
                    orthoView({2, 3, 4.5}, {1, 2, 3}, 1.333, 16000),           // a part of it
                    orthoView({2, 3, 4.5}, {1, 2, 3}, 0.01, 16384),            // beams thinner than cells
                    orthoView({2, 5, 4}, {1, 2, 3}, 100, 1, 12),               // and thicker than the scene
                    orthoView({1, 2, 3}, {2, 2, 3}, 4, 3100, 3300),            // a window through the middle
                    orthoView({1, 2.9, 3.9}, {1, 3, 3.2}, 0.5, 1000, 16000)}); // and in a corner of the bounds
}

TEST(Beams, HitTheSameInParallelProjectionOfASparseCloud) {
    expectSameHits(randomSplats(300, 3, 0.002f, 0.01f), {orthoView({0.5, 0.5, 3}, {0.5, 0.5, 0.5}, 1.3, 50, 2000),
                                                         orthoView({0.4, 0.6, 0.5}, {1, 0.5, 0.4}, 1.5, 20, 4000),
                                                         orthoView({-1, 0.2, 0.4}, {0.6, 0.5, 0.5}, 0.2, 50, 4000),
                                                         orthoView({30, 40, 20}, {0.5, 0.5, 0.5}, 3, 10, 4000)});
}

/// Thin objects with much sky between them, which beams are most likely to miss.
TEST(Beams, HitTheSameInASparseCloud) {
    expectSameHits(randomSplats(300, 3, 0.002f, 0.01f), {view({0.5, 0.5, 3}, {0.5, 0.5, 0.5}, 30, 50, 2000),
                                                         view({0.4, 0.6, 0.5}, {1, 0.5, 0.4}, 70, 20, 4000),
                                                         view({-1, 0.2, 0.4}, {0.6, 0.5, 0.5}, 5, 50, 4000),
                                                         view({30, 40, 20}, {0.5, 0.5, 0.5}, 1.5, 20, 4000)});
}

TEST(Beams, HitTheSameOnOneSplat) {
    Splats one = sphereSplats(1, Vec3f(0, 0, 0), 1.0f, 0.05f); // a disc at (1, 0, 0) facing +x
    expectSameHits(one, {view({3, 0.01, 0.02}, {1, 0, 0}, 10, 4000), view({1.3, 0.1, 0}, {1, 0, 0.1}, 100, 50, 8000),
                         view({2, 0.5, 0.4}, {1, 0.1, 0.1}, 0.5, 0, 16384), view({0, 3, 0.3}, {1, 0, 0}, 20, 0, 4000)});
}

/// Small objects between the centre rays of wide tiles: only the width of beams finds them.
TEST(Beams, HitTheSameInWideTiles) {
    Splats balls = sphereSplats(1500, Vec3f(0, 0, 0), 0.03f);
    for (const Vec3f& at : {Vec3f(1, 1, 1), Vec3f(0.2f, 0.5f, 0.9f), Vec3f(0.8f, 0.3f, 0.6f), Vec3f(0.4f, 0.9f, 0.3f),
                            Vec3f(0.1f, 0.8f, 0.7f), Vec3f(0.9f, 0.6f, 0.1f), Vec3f(0.6f, 0.1f, 0.4f)})
        balls = joinSplats(balls, sphereSplats(1500, at, 0.03f));
    expectSameHits(balls, {view({0.5, 0.5, 0.5}, {1, 0.5, 0.4}, 140, 10, 4000),
                           view({0.5, 0.5, 0.5}, {0, 0.6, 0.5}, 150, 10, 4000),
                           view({0.5, 0.5, 1.8}, {0.3, 0.5, 0.5}, 130, 10, 4000),
                           view({1.5, 1.2, 0.2}, {0.5, 0.5, 0.5}, 140, 10, 4000)});
}

/// A wide view of one tile, with the largest angles at the middles of its edges: the ray of pixel (7, 3) hits the only
/// disc, whose cell is as small as the disc.
TEST(Beams, FindADiscAtTheEdgeOfAWideTile) {
    const SceneFile scene(sphereSplats(1, Vec3f(0, 0, 0), 1.0f, 0.05f)); // a disc at (1, 0, 0) facing +x
    RayCaster caster(scene.path);
    const double wide = std::tan(std::numbers::pi / 4); // half of 90 degrees
    for (const double distance : {2.0, 5.0, 10.0, 20.0}) {
        // looking along -x, z to the left, y up
        const Vec3 to_disc{-1, 0.125 * wide, -0.875 * wide};
        const Vec3 eye = Vec3{1, 0, 0} - distance * to_disc;
        const std::vector<Ray> rays = caster.cameraRays(8, CameraRequest{eye, eye + Vec3{-1, 0, 0}, {}, 90});
        caster.traceCamera();
        const std::vector<CastHit> beams = caster.cameraHits();
        EXPECT_EQ(std::count_if(beams.begin(), beams.end(), [](const CastHit& hit) { return hit.hit(); }), 1)
            << distance;
    }
}

/// A dense patch in a wide sparse sheet: cells are subdivided, and beams end in the grid above them.
TEST(Beams, HitTheSameInAnUnevenScene) {
    const Splats sheet = squareSplats(40, Vec3f(0, 0, 0), Vec3f(10, 0, 0), Vec3f(0, 10, 0), 0.9f);
    const Splats patch = squareSplats(100, Vec3f(1, 2, 0.5f), Vec3f(0.1f, 0, 0), Vec3f(0, 0.1f, 0.02f), 0.9f);
    expectSameHits(joinSplats(sheet, patch),
                   {view({0, 0, 30}, {0, 0, 0}, 40, 4000, 16000), view({1, 2, 1.5}, {1, 2, 0}, 20, 8000),
                    view({1.05, 2.4, 0.6}, {1, 2, 0.5}, 2, 100), view({9, 9, 0.2}, {-5, -5, 1}, 90, 2000, 14000)});
}

} // namespace

} // namespace pointrt::test
