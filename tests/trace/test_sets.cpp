// SPDX-License-Identifier: Apache-2.0
// The tiles of a set are one scan: hits, light and reflections are those of the same splats in one file.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "format/base/error.h"
#include "format/set/open_tile.h"
#include "tests/support/hand_cut_set.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

constexpr std::uint32_t kSetsSide = 320; // ten pictures have a million rays
constexpr int kPictures = 10;
/// Hits in one file and in its tiles may differ by this share of a radius: cells round their discs, and tiles have
/// different cells, which moves blended surfaces.
constexpr double kSameShare = 0.02;

/// A set of eight tiles that meet at the origin, and a root, by default of the same splats.
struct CutInEight {
    explicit CutInEight(const Splats& splats) : CutInEight(splats, splats) {}
    CutInEight(const Splats& splats, const Splats& root) : radius(static_cast<double>(splats.radii[0])) {
        set = writeHandCutSet(folder, {{-1.25, -1.25, -1.25}, 1.25, 2, 1, splats.radii[0]}, splats, root);
    }
    ~CutInEight() { std::filesystem::remove_all(folder); }
    CutInEight(const CutInEight&) = delete;
    CutInEight& operator=(const CutInEight&) = delete;
    std::string whole() const { return tilePath(folder, set.tiles[0]); }
    static inline int made = 0;
    std::string folder = temporaryPath("eight" + std::to_string(++made) + ".proset");
    double radius;
    TileSet set;
};
struct SphereSet : CutInEight {
    SphereSet() : CutInEight(sphereSplats(20000, Vec3f(0, 0, 0), 1)) {}
};

/// Counts the pixels in which the picture of the tiles differs from that of the whole file. holes: only whole has a
/// hit; elsewhere: only the tiles have a hit, or at another distance.
struct SetsDifference {
    std::size_t rays = 0, hits = 0, holes = 0, elsewhere = 0;
    void add(const Film& whole, const Film& tiles, double near) {
        for (std::size_t i = 0; i < whole.depth.size(); ++i) {
            const bool hit = std::isfinite(whole.depth[i]), too = std::isfinite(tiles.depth[i]);
            ++rays;
            hits += hit;
            holes += hit && !too;
            elsewhere += too && (!hit || std::abs(double{tiles.depth[i]} - double{whole.depth[i]}) > near);
        }
    }
};

/// Cameras on a spiral.
RenderSettings lookFrom(int picture, double distance) {
    RenderSettings settings = square(kSetsSide);
    settings.integrator = Integrator::kNormal;
    const double z = 1 - (2 * picture + 1.0) / kPictures, turn = 2.4 * picture, ring = std::sqrt(1 - z * z);
    const Vec3 side{ring * std::cos(turn), ring * std::sin(turn), z};
    settings.camera.eye = distance * side;
    settings.camera.target = distance * side - side;
    settings.camera.fov_deg = distance > 1 ? 40 : 100;
    return settings;
}

SetsDifference differenceFrom(const CutInEight& sphere, double distance) {
    SetsDifference difference;
    for (int picture = 0; picture < kPictures; ++picture) {
        const RenderSettings settings = lookFrom(picture, distance);
        const Rendered whole = renderFile(sphere.whole(), settings), tiles = renderFile(sphere.folder, settings);
        difference.add(whole.film, tiles.film, kSameShare * sphere.radius);
    }
    std::printf("from %.1f: %zu rays, %zu hits, %zu holes, %zu elsewhere\n", distance, difference.rays, difference.hits,
                difference.holes, difference.elsewhere);
    return difference;
}

TEST(TileSets, FirstHitsMatchOneFile) {
    const SphereSet sphere;
    ASSERT_EQ(sphere.set.tiles.size(), 9u);
    const SetsDifference difference = differenceFrom(sphere, 3);
    EXPECT_EQ(difference.rays, std::size_t{kPictures} * kSetsSide * kSetsSide);
    EXPECT_GT(difference.hits, difference.rays / 2);
    // positions are rounded to steps of the tile's cube, which moves outlines
    EXPECT_LE(difference.holes + difference.elsewhere, difference.rays / 100'000);
}

TEST(TileSets, NoRayPassesBetweenTiles) {
    const SphereSet sphere;
    const SetsDifference difference = differenceFrom(sphere, 0.3); // from inside, all rays hit the sphere
    EXPECT_EQ(difference.hits, difference.rays);
    EXPECT_EQ(difference.holes, 0u);
    EXPECT_LE(difference.elsewhere, difference.rays / 100'000);
}

/// A square grid of discs just large enough to leave no gaps: they overlap little, so a missing part of a disc is
/// rarely hidden by another disc.
TEST(TileSets, DiscsAreNotCutAtBorders) {
    const CutInEight plane(
        squareSplats(200, Vec3f(0, 0, 0), Vec3f(0.9f, 0.1f, 0.2f), Vec3f(-0.05f, 0.9f, 0.3f), 0.75f));
    SetsDifference difference;
    for (int picture = 0; picture < kPictures; ++picture) {
        RenderSettings settings = lookFrom(picture, 0.5);
        settings.camera.target = Vec3{}; // where the tiles meet; the plane fills the picture
        settings.camera.fov_deg = 20;
        difference.add(renderFile(plane.whole(), settings).film, renderFile(plane.folder, settings).film,
                       kSameShare * plane.radius);
    }
    std::printf("%zu rays, %zu hits, %zu holes, %zu elsewhere\n", difference.rays, difference.hits, difference.holes,
                difference.elsewhere);
    EXPECT_GT(difference.hits, difference.rays / 2);
    EXPECT_LE(difference.holes + difference.elsewhere, difference.rays / 100'000);
}

Splats sphereOfBalls() {
    Splats splats = sphereSplats(20000, Vec3f(0, 0, 0), 1, 0.8f);
    makeBalls(splats);
    return splats;
}

/// Where balls overlap, rounding decides which one of them a ray hits, and whether it passes between two of them.
TEST(TileSets, BallsAreNotCutAtBorders) {
    const CutInEight sphere(sphereOfBalls());
    for (const double distance : {3.0, 0.3}) {
        const SetsDifference difference = differenceFrom(sphere, distance);
        EXPECT_GT(difference.hits, difference.rays / 2);
        EXPECT_LE(difference.holes, difference.rays / 100'000);
        EXPECT_LE(difference.elsewhere, difference.rays / 10'000);
    }
}

/// Hits are in their tile's core or within two radii of it, because discs extend out of the core.
TEST(TileSets, FirstHitsNameTheirTiles) {
    const SphereSet sphere;
    std::vector<std::size_t> hits(sphere.set.tiles.size());
    std::size_t away = 0, nameless = 0;
    for (int picture = 0; picture < kPictures; ++picture) {
        const Film film = renderFile(sphere.folder, lookFrom(picture, 3)).film;
        for (std::size_t i = 0; i < film.depth.size(); ++i) {
            const bool hit = std::isfinite(film.depth[i]), named = film.tile_id[i] < hits.size();
            nameless += hit != named;
            if (!hit || !named) continue;
            const SetTile& tile = sphere.set.tiles[film.tile_id[i]];
            const TileBox core = coreOf(sphere.set, tile);
            ++hits[film.tile_id[i]];
            bool inside = film.splat_id[i] < tile.stored;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double at = film.position[3 * i + axis], slack = 2 * sphere.radius;
                inside &= at > core.low[axis] - slack && at < core.high[axis] + slack;
            }
            away += !inside;
        }
    }
    EXPECT_EQ(nameless, 0u);
    // if a ray grazes a disc at a core's border, rounding moves the hit far along the ray
    EXPECT_LE(away, std::size_t{kPictures} * kSetsSide * kSetsSide / 100'000);
    EXPECT_EQ(hits[0], 0u); // the root is replaced by its children
    for (std::size_t tile = 1; tile < hits.size(); ++tile) EXPECT_GT(hits[tile], 10'000u) << tile;
    const Film whole = renderFile(sphere.whole(), lookFrom(0, 3)).film;
    for (const std::uint32_t tile : whole.tile_id) ASSERT_EQ(tile, NO_INDEX);
}

double meanDifference(const Film& a, const Film& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::abs(double{a.rgba[i]} - double{b.rgba[i]});
    return sum / static_cast<double>(a.rgba.size());
}

/// Secondary rays neither hit the same surface in the next tile nor pass below it.
TEST(TileSets, LightMatchesOneFile) {
    const SphereSet sphere;
    for (const Room room : {Room::kMatte, Room::kMirror})
        for (const Integrator integrator : {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath}) {
            RenderSettings settings = square(64);
            settings.room = room;
            settings.integrator = integrator;
            settings.spp = 4;
            settings.reflectivity = 0.3f;
            settings.caustics = false; // the number of photons depends on the number of instances
            const Film whole = renderFile(sphere.whole(), settings).film,
                       tiles = renderFile(sphere.folder, settings).film;
            EXPECT_LT(meanDifference(whole, tiles), 2e-4) << static_cast<int>(integrator);
        }
}

/// A ball and a sparser one beside it. The root of the second set has only the first ball.
TEST(TileSets, FramingMatchesOneFile) {
    Splats both = sphereSplats(20000, Vec3f(-0.5f, 0, 0), 0.6f);
    const Splats ball = both, sparse = sphereSplats(4000, Vec3f(0.7f, 0.2f, 0.3f), 0.4f);
    both.positions.insert(both.positions.end(), sparse.positions.begin(), sparse.positions.end());
    both.normals.insert(both.normals.end(), sparse.normals.begin(), sparse.normals.end());
    both.radii.assign(both.positions.size(), both.radii[0]);
    const CutInEight same_root(both), other_root(both, ball);
    const Camera of_file = renderFile(same_root.whole(), square(64)).camera;
    const double distance = length(of_file.eye);
    EXPECT_GT(length(of_file.eye - renderFile(other_root.whole(), square(64)).camera.eye), 0.1 * distance);
    for (const CutInEight* set : {&same_root, &other_root}) {
        const Camera of_set = renderFile(set->folder, square(64)).camera;
        EXPECT_LT(length(of_set.eye - of_file.eye), 0.005 * distance);
        EXPECT_GT(dot(of_set.forward, of_file.forward), 0.99999);
    }
}

/// Ground, and two radii above it a roof 0.6 wide that faces up like the ground; the sun is at 45 degrees.
TEST(TileSets, LowRoofsShadeTheGroundOfMergedTiles) {
    const double radius = 2.0 / 60, height = 2 * radius;
    Splats site = squareSplats(60, Vec3f(0, 0, 0.05f), Vec3f(1, 0, 0), Vec3f(0, 1, 0));
    const Splats roof =
        squareSplats(18, Vec3f(0, 0, 0.05f + static_cast<float>(height)), Vec3f(0.3f, 0, 0), Vec3f(0, 0.3f, 0));
    site.positions.insert(site.positions.end(), roof.positions.begin(), roof.positions.end());
    site.normals.insert(site.normals.end(), roof.normals.begin(), roof.normals.end());
    site.radii.assign(site.positions.size(), static_cast<float>(radius));
    const CutInEight set(site);
    RenderSettings settings = square(200);
    settings.camera.eye = Vec3{0, 0, 2};
    settings.camera.target = Vec3{};
    settings.camera.up = Vec3{0, 1, 0};
    settings.camera.ortho_height = 1;
    const auto darkShare = [&](float detail) {
        settings.detail = detail;
        SceneDescription scene;
        scene.instances.push_back({set.folder, {}, {}, {}});
        scene.lights.push_back(SunLight{normalize(Vec3{1, 0, 1}), 0, {3, 3, 3}});
        const Film film = renderScene(scene, settings).film;
        double dark = 0;
        for (std::uint32_t y = 0; y < 200; ++y)
            for (std::uint32_t x = 0; x < 200; ++x) dark += pixel(film, x, y, 1) < 0.3f ? 1 : 0;
        return dark / (200.0 * 200.0);
    };
    // a strip as wide as the roof is high; the roof's discs extend a radius beyond their centres
    EXPECT_NEAR(darkShare(16384), height * 0.6, 0.4 * height * 0.6);
    EXPECT_LT(darkShare(0), 0.01) << "surfaces of one scan may be that far apart";
}

TEST(TileSets, UnreadableTilesAreReplacedByParents) {
    const SphereSet sphere;
    const RenderSettings settings = lookFrom(0, 3);
    std::filesystem::resize_file(tilePath(sphere.folder, sphere.set.tiles[3]), 5000);
    testing::internal::CaptureStderr();
    const Rendered tiles = renderFile(sphere.folder, settings);
    const std::string warning = testing::internal::GetCapturedStderr();
    EXPECT_NE(warning.find(sphere.set.tiles[3].file), std::string::npos) << warning;
    EXPECT_EQ(std::count(warning.begin(), warning.end(), '\n'), 1) << warning;
    SetsDifference difference;
    difference.add(renderFile(sphere.whole(), settings).film, tiles.film, kSameShare * sphere.radius);
    EXPECT_EQ(difference.holes, 0u);
    EXPECT_LE(difference.elsewhere, 1u);
}

TEST(TileSets, SetsWithoutRootAreRefused) {
    const SphereSet sphere;
    std::filesystem::remove(sphere.whole());
    EXPECT_THROW(renderFile(sphere.folder, lookFrom(0, 3)), Error);
    std::filesystem::remove(setFileOf(sphere.folder));
    EXPECT_THROW(renderFile(sphere.folder, lookFrom(0, 3)), Error);
}

} // namespace
} // namespace pointrt::test
