// SPDX-License-Identifier: Apache-2.0
#include "format/index/cell_runs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "pointrt/pro_index_layout.h"

namespace pointrt {

namespace {

/// Minimum number of position codes per radius, for the mean and for the smallest disc: rounding of positions moves the
/// rims of discs. In bricks of evenly sampled scans a code is 1/60 of a radius; smaller discs may be somewhat coarser.
constexpr float kCodesToMean = 56, kCodesToSmallest = 20;

/// The smallest cell relative to its block whose distance from the middle of the block fits the offset codes.
constexpr float kSmallestCell = 1.0f / (PRO_CELL_OFFSET_MAX + 1);

/// Blocks with more cells keep the order of their cells; the search for the best order is quadratic.
constexpr std::size_t kMaxSortedCells = 64;

/// Number of following cells considered when the splats of a cell are sorted.
constexpr std::size_t kLookAheadCells = 5;

using Cells = std::vector<const ListedCell*>;

/// The discs of the cells without duplicates, in order of first use; sets their place.
Discs splatsOf(const Cells& cells) {
    Discs all;
    const auto take = [&](const CellDisc* disc) {
        if (disc->place < all.size() && all[disc->place] == disc) return;
        disc->place = static_cast<std::uint32_t>(all.size());
        all.push_back(disc);
    };
    for (const ListedCell* cell : cells) {
        std::for_each(cell->lists.hittable.begin(), cell->lists.hittable.end(), take);
        std::for_each(cell->lists.blending.begin(), cell->lists.blending.end(), take);
    }
    return all;
}

/// Whether position codes relative to the block's middle are fine enough for all of its discs.
bool isFine(const Discs& discs, const CellBox& block) {
    float reach = 0, smallest = discs[0]->radius, sum = 0;
    for (const CellDisc* disc : discs) {
        smallest = std::min(smallest, disc->radius);
        sum += disc->radius;
        reach = std::max(reach, disc->radius);
        for (std::size_t axis = 0; axis < 3; ++axis)
            reach = std::max(reach, std::fabs(disc->center[axis] - block.middle[axis]));
    }
    const float code = reach / PRO_NEAR_POSITION_MAX;
    return kCodesToSmallest * code <= smallest && kCodesToMean * code <= sum / static_cast<float>(discs.size());
}

/// Whether the cells can share one row, in which offsets from a cell's first near splat must fit.
bool sharesRow(const Cells& cells, const Discs& discs, const CellBox& block) {
    if (cells.size() == 1) return true;
    std::size_t row_length = discs.size();
    for (const ListedCell* cell : cells) {
        row_length += cell->lists.hittable.size();
        if (cell->box.half_edge < kSmallestCell * block.half_edge) return false;
    }
    return row_length <= PRO_CELL_LISTED_MAX && isFine(discs, block);
}

std::uint32_t offsetBits(const CellBox& block, const CellBox& box) {
    std::uint32_t bits = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const auto code =
            static_cast<std::int32_t>(std::lround((block.middle[axis] - box.middle[axis]) / box.half_edge));
        bits |= (static_cast<std::uint32_t>(code) & ((1u << PRO_CELL_OFFSET_BITS) - 1))
                << (PRO_CELL_OFFSET_SHIFT + axis * PRO_CELL_OFFSET_BITS);
    }
    return bits;
}

/// The hittable discs of each cell of a block, by place: as lists and as bit sets.
class Memberships {
public:
    Memberships(const Cells& cells, std::size_t discs)
        : words_((discs + 63) / 64), bits_(words_ * cells.size()), lists_(cells.size()) {
        for (std::size_t c = 0; c < cells.size(); ++c)
            for (const CellDisc* disc : cells[c]->lists.hittable) {
                const std::uint32_t at = disc->place;
                lists_[c].push_back(at);
                bits_[c * words_ + at / 64] |= std::uint64_t{1} << (at % 64);
            }
    }

    const std::vector<std::uint32_t>& listOf(std::size_t cell) const { return lists_[cell]; }
    bool has(std::size_t cell, std::size_t disc) const { return bits_[cell * words_ + disc / 64] >> (disc % 64) & 1; }

    std::size_t shared(std::size_t a, std::size_t b) const {
        std::size_t count = 0;
        for (std::size_t w = 0; w < words_; ++w)
            count += static_cast<std::size_t>(std::popcount(bits_[a * words_ + w] & bits_[b * words_ + w]));
        return count;
    }

private:
    std::size_t words_;
    std::vector<std::uint64_t> bits_;
    std::vector<std::vector<std::uint32_t>> lists_;
};

/// Orders the cells greedily: each is followed by the one that shares the most discs with it.
std::vector<std::size_t> greedyOrder(std::size_t count, const Memberships& members) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (count > kMaxSortedCells) return order;
    for (std::size_t k = 1; k + 1 < count; ++k) {
        std::size_t best = k, most = 0;
        for (std::size_t i = k; i < count; ++i) {
            const std::size_t shared = members.shared(order[k - 1], order[i]);
            if (shared > most || (shared == most && order[i] < order[best])) best = i, most = shared;
        }
        std::swap(order[k], order[best]);
    }
    return order;
}

/// The near splats of a block, as indices of its discs, and the first one of each cell.
struct Row {
    std::vector<std::uint32_t> discs;
    std::vector<std::size_t> firsts;
};

/// The discs of cell order[k] that are not in its part of the row yet; those that most following cells share come last.
std::vector<std::uint32_t> missingDiscs(std::size_t k, const std::vector<std::size_t>& order,
                                        const Memberships& members, const std::vector<std::uint32_t>& discs,
                                        const std::vector<char>& in_row) {
    std::vector<std::pair<std::size_t, std::uint32_t>> others;
    for (const std::uint32_t at : discs) {
        if (in_row[at]) continue;
        std::size_t ahead = 0;
        while (ahead < kLookAheadCells && k + ahead + 1 < order.size() && members.has(order[k + ahead + 1], at))
            ++ahead;
        others.emplace_back(ahead, at);
    }
    std::stable_sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::uint32_t> sorted;
    for (const auto& [ahead, at] : others) sorted.push_back(at);
    return sorted;
}

/// The range of each cell starts with those of its discs that end the row so far; its other discs are appended.
Row rowOf(const Cells& cells, const Discs& discs) {
    const Memberships members(cells, discs.size());
    const std::vector<std::size_t> order = greedyOrder(cells.size(), members);
    Row row{{}, std::vector<std::size_t>(cells.size())};
    std::vector<char> in_row(discs.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t cell = order[k], end = row.discs.size();
        std::size_t first = end;
        while (first > 0 && members.has(cell, row.discs[first - 1]) && !in_row[row.discs[first - 1]])
            in_row[row.discs[--first]] = 1;
        row.firsts[cell] = first;
        const auto others = missingDiscs(k, order, members, members.listOf(cell), in_row);
        for (std::size_t i = first; i < end; ++i) in_row[row.discs[i]] = 0;
        row.discs.insert(row.discs.end(), others.begin(), others.end());
    }
    return row;
}

class RowWriter {
public:
    RowWriter(std::span<const ListedCell> cells, CellWords& out)
        : first_(cells.data()), first_word_(out.cells.size()), out_(out) {
        out.cells.resize(out.cells.size() + cells.size() * PRO_CELL_WORDS);
        for (const ListedCell& cell : cells) out.slabs.push_back(slabWord(cell.lists.hittable, cell.box));
    }

    /// Writes one row for the cells of block, or one for each half of it.
    void write(const Cells& cells, const CellBox& block) {
        const Discs discs = splatsOf(cells);
        if (sharesRow(cells, discs, block)) return writeRow(cells, discs, cells.size() == 1 ? cells[0]->box : block);
        std::array<Cells, PRO_GROUP_WORDS> halves;
        for (const ListedCell* cell : cells) halves[halfOf(cell->box, block)].push_back(cell);
        for (std::uint32_t h = 0; h < PRO_GROUP_WORDS; ++h) {
            if (halves[h].empty()) continue;
            CellBox half{block.middle, 0.5f * block.half_edge, block.slack};
            for (std::uint32_t axis = 0; axis < 3; ++axis)
                half.middle[axis] += (h >> axis & 1 ? 1.0f : -1.0f) * half.half_edge;
            write(halves[h], half);
        }
    }

private:
    static std::uint32_t halfOf(const CellBox& box, const CellBox& block) {
        std::uint32_t half = 0;
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            half |= (box.middle[axis] > block.middle[axis] ? 1u : 0u) << axis;
        return half;
    }

    void writeRow(const Cells& cells, const Discs& discs, const CellBox& block) {
        Row row = rowOf(cells, discs);
        assignPlaces(discs.size(), row);
        Discs in_row;
        for (const std::uint32_t at : row.discs) in_row.push_back(discs[at]);
        const auto base = static_cast<std::uint32_t>(out_.listed.size());
        const float codes = encodeNear(in_row, block, out_.near);
        for (const CellDisc* disc : in_row) out_.listed.push_back(disc->splat);
        if (out_.listed.size() % 2) { // fills up with a normal of 0, which is never hit
            out_.listed.push_back(0);
            out_.near.insert(out_.near.end(), PRO_NEAR_WORDS, 0u);
        }
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const CellLists& lists = cells[c]->lists;
            const CellBox& box = cells[c]->box;
            std::uint32_t* words =
                &out_.cells[first_word_ + static_cast<std::size_t>(cells[c] - first_) * PRO_CELL_WORDS];
            words[PRO_CELL_FIRST] = base + static_cast<std::uint32_t>(row.firsts[c]);
            words[PRO_CELL_COUNT] = static_cast<std::uint32_t>(lists.hittable.size()) |
                                    toHalf(codes * (box.half_edge / block.half_edge)) << PRO_CELL_CODES_SHIFT;
            words[PRO_CELL_BLENDING] = static_cast<std::uint32_t>(out_.blending.size());
            words[PRO_CELL_BLENDING_COUNT] = static_cast<std::uint32_t>(lists.blending.size()) | offsetBits(block, box);
            writeBlending(lists.blending, row.firsts[c]);
        }
    }

    /// Writes offsets from near splat first of the row.
    void writeBlending(const Discs& blending, std::size_t first) {
        for (const CellDisc* disc : blending)
            out_.blending.push_back(static_cast<std::int16_t>(static_cast<std::ptrdiff_t>(place_[disc->place]) -
                                                              static_cast<std::ptrdiff_t>(first)));
        if (out_.blending.size() % 2) out_.blending.push_back(0);
    }

    /// Sets place_, the position of each disc in the row. Appends discs that only blend, never in an element with a
    /// disc that is tested: their centres may be out of the range of positions.
    void assignPlaces(std::size_t discs, Row& row) {
        constexpr std::size_t kUnplaced = ~std::size_t{0};
        place_.assign(discs, kUnplaced);
        for (std::size_t i = 0; i < row.discs.size(); ++i) place_[row.discs[i]] = i;
        if (row.discs.size() % 2) row.discs.push_back(row.discs.back());
        for (std::uint32_t at = 0; at < discs; ++at) {
            if (place_[at] != kUnplaced) continue;
            place_[at] = row.discs.size();
            row.discs.push_back(at);
        }
    }

    const ListedCell* first_;
    std::size_t first_word_;
    CellWords& out_;
    std::vector<std::size_t> place_;
};

} // namespace

void encodeCells(std::span<const ListedCell> cells, const CellBox& block, CellWords& out) {
    Cells all;
    for (const ListedCell& cell : cells) all.push_back(&cell);
    if (!all.empty()) RowWriter(cells, out).write(all, block);
}

} // namespace pointrt
