// SPDX-License-Identifier: Apache-2.0
// Bricks list every ball in every cell that it meets.
#include "tests/format/index/brick_scene.h"

namespace pointrt {
namespace {

using namespace test;
using namespace test::bricks;

/// Loads a scene of balls and its bricks.
Loaded loadBalls(std::vector<pro_splat> splats) {
    std::transform(splats.begin(), splats.end(), splats.begin(), settled);
    test::TreeOptions options = kOptions;
    options.blend_slab = 1; // the boxes of slabs of this thickness contain the balls
    Scene scene = sceneOf(std::move(splats), options);
    for (std::size_t at = 0; at < scene.splats.size(); at += PRO_SPLAT_WORDS) pro_splat_set_ball(&scene.splats[at]);
    scene.info.flags |= PRO_FLAG_BALLS;
    return load(std::move(scene));
}

double distanceTo(const Cube& cube, Vec3 point) {
    const auto outside = [&](double at, double low) { return std::max({low - at, at - low - cube.edge, 0.0}); };
    return length({outside(point.x, cube.low.x), outside(point.y, cube.low.y), outside(point.z, cube.low.z)});
}

/// The number of a half float above 0.
double halfNumber(std::uint32_t half) {
    const int exponent = static_cast<int>(half >> 10);
    return exponent == 0 ? std::ldexp(half & 0x3FFu, -24) : std::ldexp(1024 + (half & 0x3FFu), exponent - 25);
}

/// Near splats of a cell are balls, to a position code and to the rounding of radii.
void expectNearBalls(const Loaded& loaded, std::uint32_t cell, const Cube& cube) {
    const std::uint32_t* words = &loaded.bricks.cells[std::size_t{cell} * PRO_CELL_WORDS];
    const double code = cube.edge / halfNumber(words[PRO_CELL_COUNT] >> PRO_CELL_CODES_SHIFT);
    const auto offset = [&](int axis) {
        return signedField(words[PRO_CELL_BLENDING_COUNT], PRO_CELL_OFFSET_SHIFT + axis * PRO_CELL_OFFSET_BITS,
                           PRO_CELL_OFFSET_BITS);
    };
    const Vec3 steps{1.0 + offset(0), 1.0 + offset(1), 1.0 + offset(2)};
    const Vec3 middle = cube.low + steps * (0.5 * cube.edge);
    for (std::uint32_t k = 0; k < countOf(loaded, cell); ++k) {
        const PlainDisc& ball = loaded.discs.at(loaded.bricks.listed[firstOf(loaded, cell) + k]);
        const std::uint32_t* near = &loaded.bricks.near[std::size_t{firstOf(loaded, cell) + k} * PRO_NEAR_WORDS];
        EXPECT_EQ(near[1] >> PRO_NEAR_RADIUS_LOW_BITS, 0u); // the normal
        const Vec3 center = Vec3{double(signedField(near[0], 22, 10)), double(signedField(near[0], 12, 10)),
                                 double(signedField(near[0], 2, 10))} *
                                code +
                            middle;
        EXPECT_LE(length(center - ball.center), 0.87 * code);
        const std::uint32_t radius =
            (near[0] & PRO_NEAR_RADIUS_HIGH_MASK) << PRO_NEAR_RADIUS_LOW_BITS | (near[1] & PRO_NEAR_RADIUS_LOW_MASK);
        const float squared = std::bit_cast<float>((radius << PRO_NEAR_RADIUS_SHIFT) + PRO_NEAR_RADIUS_BIAS);
        EXPECT_NEAR(std::sqrt(double{squared}) * code / ball.radius, 1, 1.0 / 120);
    }
}

/// Number of points of the ball's surface in the cube that lie outside the planes.
std::size_t outsidePlanes(std::uint32_t slab, const PlainDisc& ball, const Cube& cube) {
    Polygon points;
    for (int k = 0; k < 200; ++k) { // a Fibonacci lattice
        const double z = 1 - (2 * k + 1) / 200.0, ring = std::sqrt(1 - z * z), angle = 2.4 * k;
        const Vec3 point = ball.center + Vec3{ring * std::cos(angle), ring * std::sin(angle), z} * ball.radius;
        if (distanceTo(cube, point) == 0) points.push_back(point);
    }
    PlainDisc all = ball;
    all.radius *= 2; // beyondPlanes leaves out points beyond it
    return beyondPlanes(slab, points, all, cube) > 1e-4;
}

/// Cells list the balls that they meet, enlarged by the slack, and no others, and no ball only blends.
void expectSoundBalls(const Loaded& loaded) {
    expectStructure(loaded);
    expectRanges(loaded);
    std::size_t meetings = 0, unlisted = 0, too_far = 0, outside = 0;
    const auto visit = [&](std::uint32_t word, const Cube& cube) {
        const std::uint32_t cell = word >> PRO_CELL_INDEX_SHIFT;
        const std::vector<std::uint32_t> list = isFilled(word) ? listOf(loaded, cell) : std::vector<std::uint32_t>();
        for (std::uint32_t splat = 0; splat < loaded.discs.size(); ++splat) {
            const PlainDisc& ball = loaded.discs[splat];
            const double distance = distanceTo(cube, ball.center) - ball.radius;
            const bool meets = distance < 0, listed = contains(list, splat);
            meetings += meets;
            unlisted += meets && !listed;
            too_far += listed && distance > 1.8 * std::max(1e-3 * cube.edge, 1.5 * kStep);
            if (meets && listed) outside += outsidePlanes(loaded.bricks.slabs[cell], ball, cube);
        }
        if (!isFilled(word)) return;
        EXPECT_TRUE(blendingOf(loaded, cell).empty());
        expectNearBalls(loaded, cell, cube);
        expectDistinct(loaded, cell);
    };
    for (std::size_t at = 0; at < loaded.grid.words.size(); ++at)
        descendGrid(
            loaded, at, [](const Cube&) { return true; }, visit);
    EXPECT_GT(meetings, loaded.discs.size());
    EXPECT_EQ(unlisted, 0u) << "of " << meetings;
    EXPECT_EQ(too_far, 0u) << "of " << meetings;
    EXPECT_EQ(outside, 0u) << "of " << meetings;
}

TEST(Bricks, ListBallsWhereTheyMeetCells) {
    expectSoundBalls(loadBalls(sheet(16, 0.7, {0.5, 0.5, 0.5}, 0.5)));
    expectSoundBalls(loadBalls(heap(150, 4, {0.2, 0.2, 0.2}, 0.6, 0.06)));
    expectSoundBalls(loadBalls({disc({0.5, 0.5, 0.5}, {0, 0, 1}, 0.24), disc({0.1, 0.1, 0.1}, {0, 0, 1}, 1e-4)}));
}

TEST(Bricks, BallsDoNotChangeTheListsOfDiscs) {
    const std::vector<pro_splat> discs = sheet(20, 0.7, {0.5, 0.5, 0.5}, 0.8);
    const Loaded alone = loadSplats(discs);
    std::vector<pro_splat> both = discs;
    both.push_back(disc({0.5, 0.5, 0.5}, {0, 0, 1}, 0.01));
    std::transform(both.begin(), both.end(), both.begin(), settled);
    Scene scene = sceneOf(both, kOptions);
    const auto last = std::find(scene.order.begin(), scene.order.end(), std::uint32_t(discs.size()));
    const auto ball = static_cast<std::uint32_t>(last - scene.order.begin());
    pro_splat_set_ball(&scene.splats[std::size_t{ball} * PRO_SPLAT_WORDS]);
    scene.info.flags |= PRO_FLAG_BALLS;
    const Loaded mixed = load(std::move(scene));
    const auto without = [&](std::vector<std::uint32_t> list) {
        std::erase(list, ball);
        for (std::uint32_t& splat : list) splat -= splat > ball;
        std::sort(list.begin(), list.end());
        return list;
    };
    std::size_t with_ball = 0;
    ASSERT_EQ(mixed.grid.shift, alone.grid.shift);
    forListedCells(mixed, [&](std::uint32_t cell, const Cube& cube) {
        with_ball += contains(listOf(mixed, cell), ball);
        EXPECT_FALSE(contains(blendingOf(mixed, cell), ball));
        const auto same = cellAt(alone, cube.low + Vec3{0.5, 0.5, 0.5} * cube.edge);
        if (!same) return;
        std::vector<std::uint32_t> list = listOf(alone, *same);
        std::sort(list.begin(), list.end());
        EXPECT_EQ(without(listOf(mixed, cell)), list);
    });
    EXPECT_GT(with_ball, 0u);
}

} // namespace
} // namespace pointrt
