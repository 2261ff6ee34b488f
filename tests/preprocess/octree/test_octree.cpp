// SPDX-License-Identifier: Apache-2.0
// The octree against its definition, by brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "preprocess/cloud/morton.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

namespace {

struct Found {
    Cell cell;
    std::uint32_t word;
};

/// All leaves of the NODE words, including empty ones, in depth-first order; counts the inner nodes.
void listLeaves(const std::vector<std::uint32_t>& nodes, std::uint32_t index, Cell cell, std::vector<Found>& found,
                std::size_t& inner) {
    const std::uint32_t word = nodes.at(index);
    if (!(word & PRO_NODE_INNER)) {
        found.push_back({cell, word});
        return;
    }
    ++inner;
    for (std::uint32_t slot = 0; slot < 8; ++slot)
        listLeaves(nodes, (word & PRO_NODE_GROUP_MASK) * 8 + slot, childCell(cell, slot), found, inner);
}

Box grown(Box box, float by) { return {box.lo.array() - by, box.hi.array() + by}; }

bool holds(const Box& box, const Vec3f& p) {
    return (p.array() >= box.lo.array()).all() && (p.array() < box.hi.array()).all();
}

struct Case {
    std::size_t count;
    float radius_min, radius_max;
    std::uint32_t max_leaf;
};

class OctreeInvariants : public testing::TestWithParam<Case> {};

TEST_P(OctreeInvariants, HoldByBruteForce) {
    const Case& c = GetParam();
    BuildOptions options;
    options.octree.max_leaf_splats = c.max_leaf;
    const Built built = buildSplats(randomSplats(c.count, 11, c.radius_min, c.radius_max), options);
    const auto& discs = built.packed.discs;
    std::uint32_t max_depth = 0;
    const auto nodes = encodeNodes(built.octree.leaves, max_depth);

    std::vector<Found> found;
    std::size_t inner = 0;
    listLeaves(nodes, 0, Cell{}, found, inner);
    EXPECT_EQ(nodes.size(), 8 * (inner + 1)); // children are in groups of 8
    EXPECT_EQ(found.size(), 7 * inner + 1);   // a full tree: every inner node has exactly 8 children

    std::set<std::uint32_t> members;
    std::size_t filled = 0;
    for (const Found& leaf : found) {
        const Box box = cellBox(leaf.cell);
        std::set<std::uint32_t> listed;
        if (leaf.word != PRO_NODE_EMPTY) {
            const Leaf& record = built.octree.leaves.at(leaf.word - 1);
            EXPECT_EQ(leaf.word, ++filled); // Morton order
            EXPECT_EQ(record.cell.code, leaf.cell.code);
            EXPECT_EQ(record.cell.depth, leaf.cell.depth);
            for (std::uint32_t m = 0; m < record.member_count; ++m) {
                EXPECT_TRUE(holds(box, discs[record.first_member + m].center));
                EXPECT_TRUE(members.insert(record.first_member + m).second);
                listed.insert(record.first_member + m);
            }
            for (std::uint32_t r = 0; r < record.ref_count; ++r) {
                const std::uint32_t splat = built.octree.refs[record.first_ref + r];
                EXPECT_FALSE(holds(box, discs[splat].center)); // tentative: the centre lies outside
                EXPECT_TRUE(listed.insert(splat).second);
            }
        }
        for (std::uint32_t s = 0; s < discs.size(); ++s) {
            const bool in_list = listed.contains(s);
            // for discs that touch within rounding both answers are right
            if (leaf.word == PRO_NODE_EMPTY) {
                EXPECT_FALSE(discOverlapsBox(discs[s], grown(box, -1e-6f))) << "a disc crosses an empty leaf";
            } else if (discOverlapsBox(discs[s], growBySlab(grown(box, -1e-6f), discs[s], kBlendSlab))) {
                EXPECT_TRUE(in_list);
            } else if (!discOverlapsBox(discs[s], growBySlab(grown(box, 1e-6f), discs[s], kBlendSlab))) {
                EXPECT_FALSE(in_list);
            }
        }
    }
    EXPECT_EQ(members.size(), discs.size()); // every splat is a member of exactly one leaf
    EXPECT_EQ(filled, built.octree.leaves.size());
}

INSTANTIATE_TEST_SUITE_P(Clouds, OctreeInvariants,
                         testing::Values(Case{1, 0.1f, 0.1f, 8}, Case{40, 0.01f, 0.3f, 4}, Case{600, 0.01f, 0.08f, 8},
                                         Case{600, 0.001f, 0.3f, 2}, Case{3000, 0.005f, 0.03f, 8}));

TEST(Octree, SplitsByMembers) {
    BuildOptions options;
    options.octree.max_leaf_splats = 5;
    // radii far below the leaf edges, so that leaves split by members alone
    const Built built = buildSplats(sphereSplats(20000, Vec3f(1, 2, 3), 0.5f, 0.2f), options);
    for (const Leaf& leaf : built.octree.leaves) EXPECT_LE(leaf.member_count, 5u);
}

TEST(Octree, MaxDepthIsRespected) {
    BuildOptions options;
    options.octree.max_depth = 3;
    const Built built = buildSplats(sphereSplats(5000, Vec3f(0, 0, 0), 1.0f), options);
    for (const Leaf& leaf : built.octree.leaves) EXPECT_LE(leaf.cell.depth, 3u);
}

TEST(Octree, CellsBesideADenseWallAreSplit) {
    // the wall lies just below the cube's middle plane, so its discs reach into the empty upper half
    Splats splats = squareSplats(150, Vec3f(0, 0, -0.0005f), Vec3f(1, 0, 0), Vec3f(0, 1, 0));
    for (std::size_t i = 0; i < splats.normals.size(); ++i)
        splats.normals[i] = Vec3f(0.05f * static_cast<float>(i % 3), 0, 1).normalized();
    splats = joinSplats(splats, squareSplats(2, Vec3f(0, 0, 1), Vec3f(0.1f, 0, 0), Vec3f(0, 0.1f, 0)));
    splats = joinSplats(splats, squareSplats(2, Vec3f(0, 0, -1), Vec3f(0.1f, 0, 0), Vec3f(0, 0.1f, 0)));
    const Built built = buildSplats(splats, {});
    for (const Leaf& leaf : built.octree.leaves) EXPECT_LE(leaf.member_count + leaf.ref_count, 100u);
}

TEST(Quantize, KeepsPositionsNormalsAndRadii) {
    Splats splats = randomSplats(5000, 3, 0.001f, 0.05f);
    splats.origin = Vec3d(512000, 5403000, 100);
    const Splats given = splats;
    const PackedSplats packed = quantizeSplats(std::move(splats));
    const double half_step = 0.5 * packed.frame.scale * PRO_POSITION_STEP;
    for (std::size_t k = 0; k < packed.discs.size(); ++k) {
        const std::uint32_t i = packed.input_index[k];
        for (int axis = 0; axis < 3; ++axis) {
            const double at = packed.frame.origin[axis] + packed.frame.scale * packed.discs[k].center[axis];
            EXPECT_NEAR(at, given.origin[axis] + given.positions[i][axis], 1.01 * half_step + 1e-9);
        }
        EXPECT_GT(packed.discs[k].normal.dot(given.normals[i]), 0.999999f); // 0.08 degrees
        const double radius = packed.discs[k].radius * packed.frame.scale;
        EXPECT_GE(radius, given.radii[i] * 0.99999);
        EXPECT_LE(radius, given.radii[i] * std::exp2(packed.frame.radius_step) * 1.00001);
    }
    EXPECT_TRUE(std::is_sorted(packed.morton.begin(), packed.morton.end()));
}

/// A radius as readers decode it, with these as smallest and largest radii.
float codedRadius(float radius, float least, float most) {
    const RadiusCoding coding = radiusCoding(least, most);
    const pro_splat splat{{0.5f, 0.5f, 0.5f}, {0, 0, 1}, radius, {0, 0, 0}, 0};
    std::array<std::uint32_t, PRO_SPLAT_WORDS> words;
    pro_splat_encode(&splat, coding.max, coding.step, words.data());
    pro_splat decoded;
    pro_splat_decode(words.data(), coding.max, coding.step, &decoded);
    return decoded.radius;
}

TEST(Quantize, RadiiBelongToOneSeriesForAnyLargest) {
    // 6.6 to 7.9 octaves, with 32 codes each
    for (const float most : {0.99f, 1.0f, 1.3f, 2.4f})
        for (const float radius : {0.0102f, 0.1f, 0.3333f, 0.98f}) {
            const float coded = codedRadius(radius, 0.0101f, most);
            EXPECT_FLOAT_EQ(coded, codedRadius(radius, 0.0101f, 1.1f)) << radius << " of " << most;
            EXPECT_GE(coded, radius * 0.999999f);
            EXPECT_LE(coded, radius * std::exp2(1 / 32.0f) * 1.000001f);
        }
}

TEST(Quantize, RadiusCodesAreAsFineAsTheRangeAllows) {
    EXPECT_EQ(radiusCoding(0.3f, 0.3f).step, 0); // exact
    EXPECT_EQ(codedRadius(0.3f, 0.3f, 0.3f), 0.3f);
    EXPECT_EQ(radiusCoding(0.3f, 0.3001f).step, std::ldexp(1.0f, -12));
    EXPECT_EQ(radiusCoding(1, 1.9f).step, 1 / 256.0f); // 0.93 octaves are 238 codes
    EXPECT_EQ(radiusCoding(1e-9f, 1).step, 1 / 16.0f);
    EXPECT_FLOAT_EQ(codedRadius(1e-9f, 1e-9f, 1), std::exp2(-255 / 16.0f)); // raised to the smallest
}

TEST(Quantize, PointsPrecedeSplatsThatFillGaps) {
    Splats splats = squareSplats(4, Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0));
    const float radius = splats.radii[0];
    splats.input_count = 100;
    for (std::uint32_t i = 0; i < 16; ++i) splats.input_index[i] = i;
    splats.input_index[2] = 100; // fills a gap at the position of point 5
    splats.positions[2] = splats.positions[5];
    splats.input_index[9] = 101;
    splats.filled_from = {40, 41};
    splats.noise.assign(16, 0.5f * radius);
    splats.noise[2] = 7 * radius;
    splats.noise[9] = 100 * radius;
    const PackedSplats packed = quantizeSplats(std::move(splats));
    ASSERT_EQ(packed.input_index.size(), 15u);
    EXPECT_EQ(packed.merged, 1u);
    EXPECT_EQ(packed.filled, 1u);
    ASSERT_EQ(packed.noise.size(), 15u);
    for (std::size_t k = 0; k < 15; ++k) {
        EXPECT_NE(packed.input_index[k], 100u);
        EXPECT_EQ(packed.noise[k], packed.input_index[k] == 101 ? PRO_NOISE_CODE_MAX : 16) << packed.input_index[k];
    }
}

TEST(Quantize, NoiseBelowHalfAStepIsDropped) {
    Splats splats = squareSplats(4, Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0));
    splats.noise.assign(16, 0.4f / PRO_NOISE_STEPS * splats.radii[0]);
    EXPECT_TRUE(quantizeSplats(std::move(splats)).noise.empty());
}

TEST(Quantize, MortonBitsRoundTrip) {
    for (const std::uint32_t v : {0u, 1u, 2u, 0x15555u, 0x1FFFFFu, 0x123456u}) EXPECT_EQ(collectBits(spreadBits(v)), v);
    EXPECT_EQ(spreadBits(3), 9u);
}

} // namespace

} // namespace pointrt::test
