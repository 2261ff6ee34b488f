// SPDX-License-Identifier: Apache-2.0
// Cells as the shaders decode them (as in shaders/trace/trace.glsl) against the encoded discs.
#include "format/index/cell_codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "pointrt/pro_index_layout.h"
#include "runtime/util/vec.h"
#include "tests/format/index/random_vectors.h"
#include "tests/support/index_values.h"

namespace pointrt {
namespace {

using namespace test;

/// In cell edges, relative to the middle of the cell.
struct NearDisc {
    Vec3 center, normal;
    double radius = 0;
};

struct CellAsRead {
    double codes = 0; ///< per edge
    std::vector<NearDisc> discs;
    Vec3 slab_normal;
    double slab_low = 0, slab_high = 0; ///< along slab_normal, in edges
};

double halfToDouble(std::uint32_t half) {
    const int exponent = static_cast<int>(half >> 10 & 31), fraction = static_cast<int>(half & 1023);
    const double size = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    return half & 0x8000u ? -size : size;
}

NearDisc readNear(std::uint32_t position, std::uint32_t normal, double codes) {
    NearDisc disc;
    disc.center =
        Vec3{static_cast<double>(signedField(position, 22, 10)), static_cast<double>(signedField(position, 12, 10)),
             static_cast<double>(signedField(position, 2, 10))} *
        (1 / codes);
    disc.normal = {static_cast<double>(signedField(normal, 24, 8)), static_cast<double>(signedField(normal, 16, 8)),
                   static_cast<double>(signedField(normal, 8, 8))};
    const std::uint32_t code = (position & 3u) << 8 | (normal & 255u);
    disc.radius = std::sqrt(std::bit_cast<float>((code << PRO_NEAR_RADIUS_SHIFT) + PRO_NEAR_RADIUS_BIAS)) / codes;
    return disc;
}

/// A single cell.
struct CodecWords {
    std::uint32_t codes = 0, slab = 0;
    std::vector<std::uint32_t> near;
};

CellAsRead readCell(const CodecWords& words) {
    CellAsRead cell;
    cell.codes = halfToDouble(words.codes);
    for (std::size_t k = 0; k < words.near.size(); k += PRO_NEAR_WORDS)
        cell.discs.push_back(readNear(words.near[k], words.near[k + 1], cell.codes));
    const std::uint32_t slab = words.slab;
    cell.slab_normal = Vec3{static_cast<double>(signedField(slab, 0, 6)), static_cast<double>(signedField(slab, 6, 6)),
                            static_cast<double>(signedField(slab, 12, 6))} *
                       (1.0 / PRO_SLAB_NORMAL_MAX);
    cell.slab_low = signedField(slab, 18, 7) / static_cast<double>(PRO_SLAB_STEPS);
    cell.slab_high = signedField(slab, 25, 7) / static_cast<double>(PRO_SLAB_STEPS);
    return cell;
}

CellDisc makeDisc(Vec3 center, Vec3 normal, double radius) {
    CellDisc disc;
    disc.center = toVector(center);
    disc.normal = toVector(normalize(normal));
    disc.radius = static_cast<float>(radius);
    for (std::size_t axis = 0; axis < 3; ++axis)
        disc.reach[axis] = disc.radius * std::sqrt(std::max(0.0f, 1 - disc.normal[axis] * disc.normal[axis]));
    disc.slab = 0.5f * disc.radius;
    return disc;
}

CodecWords encode(const std::vector<CellDisc>& discs, const CellBox& box) {
    std::vector<const CellDisc*> pointers;
    for (const CellDisc& disc : discs) pointers.push_back(&disc);
    CodecWords words;
    words.codes = toHalf(encodeNear(pointers, box, words.near));
    words.slab = slabWord(pointers, box);
    return words;
}

/// Edges are 2 units long: lengths must be scaled.
const CellBox kBox{{3, -5, 7}, 1, 2e-3f};
constexpr double kEdge = 2;

Vec3 inEdges(Vec3 point) { return (point - toVec3(kBox.middle)) * (1 / kEdge); }
Vec3 fromEdges(Vec3 local) { return toVec3(kBox.middle) + local * kEdge; }
double largestPart(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

class RandomDiscs : public test::RandomVectors {
public:
    using RandomVectors::RandomVectors;

    /// A disc through a random point of the cell; radius in edges.
    CellDisc through(Vec3 normal, double radius) {
        const Vec3 across = normalize(cross(normal, direction()));
        const double distance = radius * std::sqrt(uniform(0, 0.99));
        return makeDisc(fromEdges(point() + across * distance), normal, radius * kEdge);
    }
};

/// The largest component of the normal is 127 codes; the others are rounded to integers.
void expectNormal(Vec3 read, Vec3 written) {
    EXPECT_EQ(largestPart(read), PRO_NEAR_NORMAL_MAX);
    const Vec3 scaled = written * (PRO_NEAR_NORMAL_MAX / largestPart(written));
    EXPECT_LE(largestPart(read - scaled), 0.5 + 1e-4);
}

void expectRadius(double read, double written) {
    EXPECT_NEAR(read * read, written * written, std::ldexp(1.0, -6) * written * written); // 5 bits of fraction, rounded
}

/// Off by at most one code per axis, and by less across their planes.
TEST(CellCodec, KeepsDiscsWithinOneCode) {
    RandomDiscs random(1);
    for (int round = 0; round < 2000; ++round) {
        std::vector<CellDisc> discs;
        const int count = 1 + round % 6;
        for (int k = 0; k < count; ++k)
            discs.push_back(random.through(random.direction(), std::pow(10.0, random.uniform(-1.5, 0.9))));
        const CellAsRead cell = readCell(encode(discs, kBox));
        ASSERT_EQ(cell.discs.size(), discs.size());
        double reach = 0, largest = 0;
        for (std::size_t k = 0; k < discs.size(); ++k) {
            const Vec3 center = inEdges(toVec3(discs[k].center));
            largest = std::max(largest, discs[k].radius / kEdge);
            reach = std::max({reach, largestPart(center), largest});
            EXPECT_LE(largestPart(cell.discs[k].center - center) * cell.codes, 1 + 1e-3);
            EXPECT_LE(std::abs(dot(cell.discs[k].center - center, toVec3(discs[k].normal))) * cell.codes, 0.5 + 1e-3);
            expectNormal(cell.discs[k].normal, toVec3(discs[k].normal));
            expectRadius(cell.discs[k].radius, discs[k].radius / kEdge);
        }
        EXPECT_LE(cell.codes * reach, PRO_NEAR_POSITION_MAX * (1 + 1e-6));
        // from half an edge, slack and the largest radius, rounded down by up to 1/16 of a power of two
        EXPECT_GE(cell.codes * (0.501 + largest), PRO_NEAR_POSITION_MAX * (16.0 / 17 - 1e-6));
    }
}

TEST(CellCodec, KeepsNormalsAlongAxes) {
    for (const Vec3 normal :
         {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}}) {
        const CellAsRead cell = readCell(encode({makeDisc(fromEdges({0.25, -0.5, 0.125}), normal, kEdge)}, kBox));
        EXPECT_EQ(largestPart(cell.discs[0].normal - normal * PRO_NEAR_NORMAL_MAX), 0);
        EXPECT_EQ(largestPart(cell.slab_normal - normal), 0);
        EXPECT_NEAR(cell.discs[0].center.x, 0.25, 1.0 / 511);
        EXPECT_NEAR(cell.discs[0].center.y, -0.5, 1.0 / 511);
        EXPECT_NEAR(cell.discs[0].center.z, 0.125, 1.0 / 511);
        expectRadius(cell.discs[0].radius, 1);
    }
    const Vec3 falling{-0.6, 0, -0.8};
    expectNormal(readCell(encode({makeDisc(fromEdges({}), falling, 1)}, kBox)).discs[0].normal, falling);
}

TEST(CellCodec, KeepsTinyDiscs) {
    for (const Vec3 center : {Vec3{0.4, 0.3, -0.2}, Vec3{0.02, -0.01, 0.005}}) {
        const CellAsRead cell = readCell(encode({makeDisc(fromEdges(center), {1, 2, 3}, 1e-3 * kEdge)}, kBox));
        EXPECT_LE(largestPart(cell.discs[0].center - center) * cell.codes, 1.01);
        expectRadius(cell.discs[0].radius, 1e-3);
    }
}

/// A half float holds at most 65504 codes per edge.
TEST(CellCodec, KeepsTinyDiscsInTheMiddle) {
    for (const double radius : {7e-3, 1e-3, 1e-4}) {
        const Vec3 center{0.2 * radius, 0, -0.1 * radius};
        const CellAsRead cell = readCell(encode({makeDisc(fromEdges(center), {1, 2, 3}, radius * kEdge)}, kBox));
        ASSERT_TRUE(std::isfinite(cell.codes));
        EXPECT_GT(cell.codes, 511);
        EXPECT_LE(cell.codes, 65504);
        EXPECT_LE(largestPart(cell.discs[0].center - center) * cell.codes, 1.01);
        expectRadius(cell.discs[0].radius, radius);
    }
}

/// Huge discs are replaced by discs of 8 edges. In the cell, at most sqrt(3)/2 edges to the side, rims that touch
/// differ by 3/4 / (2 * 8) edges; the test looks up to half an edge inside of them. Position codes are (8 + 0.87) / 511
/// edges wide, and positions are off by at most one per axis.
TEST(CellCodec, KeepsPlaneAndRimOfHugeDiscs) {
    RandomDiscs random(3);
    constexpr double kLargest = 8, kCode = 8.87 / 511, kPositionOff = kCode * 1.7320508;
    constexpr double kTilt = 0.5 * 1.4142136 / PRO_NEAR_NORMAL_MAX; // tilt of a rounded normal
    for (int round = 0; round < 500; ++round) {
        const double radius = std::pow(10.0, random.uniform(1, 3));
        const Vec3 normal = random.direction();
        const CellDisc disc = random.through(normal, radius);
        const NearDisc near = readCell(encode({disc}, kBox)).discs[0];
        const Vec3 center = inEdges(toVec3(disc.center)), unit = normalize(near.normal);
        expectRadius(near.radius, kLargest);
        for (int k = 0; k < 50; ++k) {
            const Vec3 inside = random.point();
            const Vec3 point = inside - normal * dot(normal, inside - center); // in the disc's plane
            if (largestPart(point) > 0.5) continue;
            EXPECT_LE(std::abs(dot(unit, point - near.center)), kTilt * (kLargest + 0.87) + kPositionOff);
            const double beyond = length(point - center) - radius, beyond_near = length(point - near.center) - kLargest;
            EXPECT_NEAR(std::max(beyond_near, -0.5), std::max(beyond, -0.5),
                        0.75 / (2 * (kLargest - 0.5)) + kPositionOff);
        }
    }
}

/// The largest distance, in edges, by which random points of a disc in the enlarged cell lie outside the planes.
double beyondSlab(const CellAsRead& cell, const CellDisc& disc, RandomDiscs& random) {
    const Vec3 normal = normalize(toVec3(disc.normal)), center = inEdges(toVec3(disc.center));
    const double radius = disc.radius / kEdge, side = 0.5 + kBox.slack / kEdge;
    double beyond = 0;
    for (int k = 0; k < 60; ++k) {
        const Vec3 start = random.point() * (k % 3 ? 1 : 2); // to reach corners from outside
        Vec3 point = start - normal * dot(normal, start - center);
        const Vec3 off = point - center;
        if (length(off) > radius) point = center + off * (radius / length(off)); // on its rim
        if (largestPart(point) > side) continue;
        const double height = dot(cell.slab_normal, point);
        beyond = std::max({beyond, height - cell.slab_high, cell.slab_low - height});
    }
    return beyond;
}

TEST(CellSlabs, EncloseAllDiscs) {
    RandomDiscs random(4);
    for (int round = 0; round < 3000; ++round) {
        std::vector<CellDisc> discs;
        const Vec3 main_normal = random.direction();
        const double spread = round % 3; // a sheet, a bent sheet, or any directions
        for (int k = 0; k < 1 + round % 5; ++k) {
            const Vec3 normal = normalize(main_normal + random.direction() * (0.3 * spread * spread));
            discs.push_back(random.through(k % 2 ? normal * -1 : normal, std::pow(10.0, random.uniform(-2, 1))));
        }
        const CellAsRead cell = readCell(encode(discs, kBox));
        for (const CellDisc& disc : discs) ASSERT_LE(beyondSlab(cell, disc, random), 1e-6) << round;
    }
}

/// The height of a huge disc depends on the sine of the angle to the planes' normal, which is small here: normals in
/// files come within 2.4e-4 of an axis.
TEST(CellSlabs, EncloseHugeDiscsNearlyParallelToThem) {
    RandomDiscs random(5);
    for (int round = 0; round < 3000; ++round) {
        const double tilt = std::pow(10.0, random.uniform(-3.6, -2)), radius = std::pow(10.0, random.uniform(0, 3));
        const Vec3 axis = round % 2 ? Vec3{0, 0, -1} : Vec3{1, -1, 0};
        const CellDisc disc = random.through(normalize(axis + random.direction() * tilt), radius);
        const CellAsRead cell = readCell(encode({disc}, kBox));
        ASSERT_LE(beyondSlab(cell, disc, random), 1e-6) << "radius " << radius << " edges, tilt " << tilt;
    }
}

TEST(CellSlabs, AreTightAroundASheet) {
    RandomDiscs random(6);
    for (int round = 0; round < 500; ++round) {
        const Vec3 normal = random.direction(), start = random.point() * 0.5;
        std::vector<CellDisc> discs;
        for (int k = 0; k < 8; ++k) {
            const Vec3 inside = random.point();
            const Vec3 center = inside - normal * dot(normal, inside - start); // in one plane
            discs.push_back(makeDisc(fromEdges(center), k % 2 ? normal : normal * -1, 0.4 * kEdge));
        }
        const CellAsRead cell = readCell(encode(discs, kBox));
        EXPECT_LT((cell.slab_high - cell.slab_low) / length(cell.slab_normal), 0.15);
        EXPECT_GT(std::abs(dot(normalize(cell.slab_normal), normal)), 0.999);
    }
}

TEST(CellSlabs, OfOneFlatDiscHaveKnownHeights) {
    // a quarter edge up, slack 1e-3 edges: heights of 15.75 -+ 0.063 in 63 steps per edge
    const CellAsRead cell = readCell(encode({makeDisc(fromEdges({0, 0, 0.25}), {0, 0, 1}, kEdge)}, kBox));
    EXPECT_DOUBLE_EQ(cell.slab_low * 63, 15);
    EXPECT_DOUBLE_EQ(cell.slab_high * 63, 16);
}

} // namespace
} // namespace pointrt
