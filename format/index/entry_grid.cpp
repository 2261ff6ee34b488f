// SPDX-License-Identifier: Apache-2.0
#include "format/index/entry_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "format/base/parallel.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt {

namespace {

/// The grid has the depth of most splats, so that rays seldom descend below it, unless that would need more words per
/// leaf than this: 6 bytes per splat for an evenly sampled scan with some 90 splats per leaf.
constexpr std::uint64_t kWordsPerLeaf = 128;
/// Brick cells keep edges of at least 32 position steps, since planes and traversal allow for 1.5 steps around
/// (kSlackSteps).
constexpr std::uint32_t kDeepest = PRO_POSITION_BITS - PRO_GRID_SHIFT_MIN;
constexpr std::uint64_t kMinWords = 1u << 15;

/// Leaves above the grid are divided into its cells, which lengthens the lists of their splats by at most kMaxLonger.
/// Brick cells with leaves below them are halved (format/index/bricks.cpp) if rays would otherwise test kMaxCrowded
/// times as many discs as usual.
constexpr double kMaxLonger = 1.6, kMaxCrowded = 1.1;

using MemberCounts = std::array<double, PRO_MAX_DEPTH + 1>; ///< members of the leaves at each depth

MemberCounts countMembers(const pro_info& info, const pro_view& view) {
    MemberCounts members{};
    forNodes({view.nodes, info.node_count}, PRO_MAX_DEPTH, [&](std::uint32_t node, const Corner&, std::uint32_t shift) {
        const std::uint32_t* leaf = view.leaves + std::size_t{node - 1} * PRO_LEAF_WORDS;
        members[PRO_POSITION_BITS - shift] += leaf[PRO_LEAF_COUNTS] & PRO_LEAF_MEMBER_MASK;
    });
    return members;
}

/// Mean over the members of value(levels), where levels is how far their leaves are below the depth of the grid
/// (negative: above).
template <typename Value>
double meanOf(const MemberCounts& members, std::uint32_t depth, const Value& value) {
    double sum = 0, count = 0;
    for (std::uint32_t d = 0; d < members.size(); ++d) {
        sum += members[d] * value(static_cast<int>(d) - static_cast<int>(depth));
        count += members[d];
    }
    return sum / count;
}

/// Number of lists of a splat in a grid at depth, relative to a grid at the depth of its leaf. A disc of radius r
/// overlaps about (1 + 1.6 r / e)^2 cells of edge e; at the depth of its leaf e is 2 r (kLeafEdgeRadii in the bake is
/// 8, and a brick is 4 cells wide).
double listShare(const MemberCounts& members, std::uint32_t depth) {
    return meanOf(members, depth, [](int levels) {
        const double side = 1 + 0.8 * std::ldexp(1.0, std::max(-levels, 0));
        return side * side / (1.8 * 1.8);
    });
}

/// The same for the number of discs that a ray tests in a cell, which is proportional to (e + 1.6 r)^2.
double testShare(const MemberCounts& members, std::uint32_t depth) {
    return meanOf(members, depth, [](int levels) {
        const double side = 1.6 + std::ldexp(2.0, std::max(levels, 0));
        return side * side / (3.6 * 3.6);
    });
}

std::uint32_t preferredDepth(const MemberCounts& members) {
    auto depth = static_cast<std::uint32_t>(std::max_element(members.begin(), members.end()) - members.begin());
    while (listShare(members, depth) > kMaxLonger) --depth; // terminates: no leaf is above depth 0
    return depth;
}

/// A grid without words over the bounds of the leaves.
EntryGrid frameGrid(std::span<const std::uint32_t> nodes, std::uint32_t depth) {
    constexpr std::uint32_t kNone = ~0u;
    Corner lo{kNone, kNone, kNone}, hi{};
    EntryGrid grid;
    grid.shift = PRO_POSITION_BITS - depth;
    forNodes(nodes, depth, [&](std::uint32_t, const Corner& corner, std::uint32_t shift) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lo[axis] = std::min(lo[axis], corner[axis]);
            hi[axis] = std::max(hi[axis], corner[axis] + (1u << shift));
        }
    });
    for (std::size_t axis = 0; axis < 3; ++axis) {
        grid.origin[axis] = lo[axis] >> grid.shift;
        grid.size[axis] = (hi[axis] - lo[axis]) >> grid.shift;
    }
    return grid;
}

std::uint64_t wordCount(const EntryGrid& grid) { return std::uint64_t{grid.size[0]} * grid.size[1] * grid.size[2]; }

/// Largest empty cube from each cell towards one octant: 1 + the minimum over the 7 neighbours there.
std::vector<std::uint8_t> skipsTowards(const std::vector<char>& filled, const EntryGrid& grid, std::uint32_t octant) {
    // a border of empty cells around the grid saves bounds checks
    const std::array<std::size_t, 3> size{grid.size[0] + 2u, grid.size[1] + 2u, grid.size[2] + 2u};
    std::vector<std::uint8_t> padded(size[0] * size[1] * size[2], kMaxSkipped), skips(filled.size());
    const std::array<std::ptrdiff_t, 3> stride{1, static_cast<std::ptrdiff_t>(size[0]),
                                               static_cast<std::ptrdiff_t>(size[0] * size[1])};
    std::ptrdiff_t toward[3];
    for (std::uint32_t axis = 0; axis < 3; ++axis) toward[axis] = octant >> axis & 1 ? stride[axis] : -stride[axis];
    const auto from = [&](std::uint32_t axis, std::uint32_t i) { // from the octant's far corner inwards
        return octant >> axis & 1 ? grid.size[axis] - 1 - i : i;
    };
    for (std::uint32_t k = 0; k < grid.size[2]; ++k)
        for (std::uint32_t j = 0; j < grid.size[1]; ++j)
            for (std::uint32_t i = 0; i < grid.size[0]; ++i) {
                const std::size_t x = from(0, i), y = from(1, j), z = from(2, k);
                const std::size_t cell = (z * grid.size[1] + y) * grid.size[0] + x;
                std::uint8_t* at = padded.data() + ((z + 1) * size[1] + y + 1) * size[0] + x + 1;
                const std::ptrdiff_t dx = toward[0], dy = toward[1], dz = toward[2];
                const std::uint8_t nearest =
                    std::min({at[dx], at[dy], at[dz], at[dx + dy], at[dx + dz], at[dy + dz], at[dx + dy + dz]});
                *at = filled[cell] ? std::uint8_t{0} : std::min<std::uint8_t>(kMaxSkipped, nearest + 1);
                skips[cell] = *at;
            }
    return skips;
}

} // namespace

EntryGrid frameEntryGrid(const pro_info& info, const pro_view& view, std::uint32_t deepest) {
    const std::uint64_t most =
        std::clamp(kWordsPerLeaf * info.leaf_count, kMinWords, std::uint64_t{PRO_GRID_WORDS_MAX});
    const std::span<const std::uint32_t> nodes(view.nodes, info.node_count);
    const MemberCounts members = countMembers(info, view);
    std::uint32_t depth = std::min({preferredDepth(members), kDeepest, deepest});
    EntryGrid grid = frameGrid(nodes, depth);
    while (wordCount(grid) > most) grid = frameGrid(nodes, --depth); // terminates: at depth 0 there is one word
    grid.uneven = testShare(members, depth) > kMaxCrowded;
    return grid;
}

void fillEntryGrid(EntryGrid& grid, std::span<const Corner> corners, std::size_t threads) {
    std::vector<char> filled(wordCount(grid));
    grid.words.assign(filled.size(), kEmptyWord);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        std::size_t word = 0;
        for (std::size_t axis = 3; axis-- > 0;)
            word = word * grid.size[axis] + (corners[k][axis] >> grid.shift) - grid.origin[axis];
        filled[word] = 1;
        grid.words[word] = static_cast<std::uint32_t>(k) << PRO_GRID_BRICK_SHIFT;
    }
    std::array<std::vector<std::uint8_t>, 8> skips;
    const auto fillOctant = [&](std::size_t octant) {
        skips[octant] = skipsTowards(filled, grid, static_cast<std::uint32_t>(octant));
    };
    forAll(8, fillOctant, threads);
    for (std::size_t c = 0; c < filled.size(); ++c)
        writeSkips(grid.words[c], [&](std::uint32_t octant) { return static_cast<float>(skips[octant][c]); });
}

} // namespace pointrt
