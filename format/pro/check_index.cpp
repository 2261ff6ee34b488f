// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "format/base/parallel.h"
#include "format/pro/checks.h"
#include "format/pro/sections.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt::format {

namespace {

constexpr std::uint64_t kMaxNumbers = std::uint64_t{1} << (32 - PRO_CELL_INDEX_SHIFT);
constexpr std::uint32_t kHalfInfinity = 0x7C00; ///< larger half floats are NaN or negative

/// Words of DSPL in a block, the unit of work of a thread.
constexpr std::size_t kRunWords = std::size_t{1} << 20;

/// All bits but the reserved one above the offsets.
constexpr std::uint32_t kBlendingKnown = 0x7FFFFFFFu;
static_assert(PRO_CELL_OFFSET_SHIFT + 3 * PRO_CELL_OFFSET_BITS == 31);

bool isEmpty(std::uint32_t word) { return (word & PRO_SKIP_MASK) != 0; }

/// Detects the borrow when 1 is subtracted from each nibble (Mycroft 1987).
bool hasZeroNibble(std::uint32_t word) { return ((word - 0x11111111u) & ~word & 0x88888888u) != 0; }

/// The findings of each check. Checks write to different members, so they can run in parallel.
struct IndexTallies {
    Tally grid_brick, grid_skip, brick_skip, brick_word, group_depth, cell_run, cell_codes, cell_reserved,
        cell_blending, listed_splat;
    bool bricks_missing = false, words_missing = false, blending_missing = false;
};

void checkGrid(const pro_index& index, IndexTallies& tallies) {
    std::vector<char> named(index.brick_count);
    std::uint64_t filled = 0;
    const std::uint64_t count = gridWords(index);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint32_t word = index.grid[i], brick = word >> PRO_GRID_BRICK_SHIFT;
        if (isEmpty(word)) {
            if (hasZeroNibble(word)) tallies.grid_skip.hit(i);
            continue;
        }
        if (brick >= index.brick_count || named[brick])
            tallies.grid_brick.hit(i);
        else
            named[brick] = 1;
        ++filled;
    }
    tallies.bricks_missing = filled < index.brick_count;
}

/// Each word of a brick is the root of a tree of groups. A depth-first walk over the words in order visits cells in
/// increasing order and finishes groups in increasing order, so no cell or group is named twice and the walk ends.
class BrickWalk {
public:
    BrickWalk(const pro_index& index, IndexTallies& tallies)
        : index_(index), tallies_(tallies), first_group_(std::uint64_t{index.brick_count} * kBrickGroups) {}

    void run() {
        const std::uint64_t count = std::uint64_t{index_.brick_count} * PRO_BRICK_WORDS;
        for (std::uint64_t i = 0; i < count; ++i)
            if (!pass(i, 0)) return;
        tallies_.words_missing = next_cell_ != index_.cell_count || next_group_ != index_.group_count;
    }

private:
    /// False on the first error: later words cannot be judged.
    bool pass(std::uint64_t i, std::uint32_t halvings) {
        const std::uint32_t word = index_.bricks[i];
        if (isEmpty(word)) {
            if (hasZeroNibble(word)) tallies_.brick_skip.hit(i);
            return true;
        }
        if (word & PRO_CELL_INNER) return passGroup(i, word >> PRO_CELL_INDEX_SHIFT, halvings + 1);
        if (word >> PRO_CELL_INDEX_SHIFT != next_cell_ || next_cell_ >= index_.cell_count)
            return fail(tallies_.brick_word, i);
        ++next_cell_;
        return true;
    }

    bool passGroup(std::uint64_t i, std::uint64_t group, std::uint32_t halvings) {
        if (halvings > PRO_INDEX_HALVINGS_MAX) return fail(tallies_.group_depth, i);
        if (group < first_group_ || group - first_group_ >= index_.group_count) return fail(tallies_.brick_word, i);
        for (std::uint32_t half = 0; half < PRO_GROUP_WORDS; ++half)
            if (!pass(group * PRO_GROUP_WORDS + half, halvings)) return false;
        if (group - first_group_ != next_group_) return fail(tallies_.brick_word, i);
        ++next_group_;
        return true;
    }

    static bool fail(Tally& tally, std::uint64_t i) {
        tally.hit(i);
        return false;
    }

    const pro_index& index_;
    IndexTallies& tallies_;
    std::uint64_t first_group_, next_cell_ = 0, next_group_ = 0;
};

std::uint32_t countOf(const std::uint32_t* cell) { return cell[PRO_CELL_COUNT] & PRO_CELL_COUNT_MASK; }
std::uint32_t blendingOf(const std::uint32_t* cell) { return cell[PRO_CELL_BLENDING_COUNT] & PRO_CELL_BLENDING_MASK; }

/// Whether a cell's numbers in BLDS, from the first on, refer to near splats in range.
bool blendingInRange(const pro_index& index, const std::uint32_t* cell, std::uint64_t first) {
    std::int32_t least = 0, most = 0;
    for (std::uint64_t i = first; i < first + blendingOf(cell); ++i) {
        const auto number = static_cast<std::int16_t>(index.blending[i / 2] >> (i % 2 * 16));
        least = std::min<std::int32_t>(least, number);
        most = std::max<std::int32_t>(most, number);
    }
    return std::int64_t{cell[PRO_CELL_FIRST]} + least >= 0 &&
           std::int64_t{cell[PRO_CELL_FIRST]} + most < index.near_count;
}

/// Cells do not share numbers in BLDS, so the work is linear in the size of BLDS.
void checkCells(const pro_index& index, IndexTallies& tallies) {
    std::uint64_t numbers = 0;
    for (std::uint64_t i = 0; i < index.cell_count; ++i) {
        const std::uint32_t* cell = index.cells + i * PRO_CELL_WORDS;
        const std::uint32_t codes = cell[PRO_CELL_COUNT] >> PRO_CELL_CODES_SHIFT;
        if (countOf(cell) == 0 || std::uint64_t{cell[PRO_CELL_FIRST]} + countOf(cell) > index.near_count)
            tallies.cell_run.hit(i);
        if (codes == 0 || codes >= kHalfInfinity) tallies.cell_codes.hit(i);
        if (cell[PRO_CELL_BLENDING_COUNT] & ~kBlendingKnown) tallies.cell_reserved.hit(i);
        const std::uint64_t first = cell[PRO_CELL_BLENDING], end = first + blendingOf(cell);
        numbers += (std::uint64_t{blendingOf(cell)} + 1) / 2 * 2;
        if (first % 2 != 0 || end > index.blending_count || numbers > index.blending_count)
            tallies.cell_blending.hit(i);
        else if (!blendingInRange(index, cell, first))
            tallies.cell_blending.hit(i);
    }
    tallies.blending_missing = std::max<std::uint64_t>(numbers, 2) != index.blending_count;
}

/// Checks at most kRunWords words of DSPL, from the first on.
Tally checkListed(const pro_info& info, const pro_index& index, std::size_t first) {
    Tally tally;
    const std::size_t end = std::min<std::size_t>(index.near_count, first + kRunWords);
    for (std::size_t i = first; i < end; ++i)
        if (index.listed[i] >= info.splat_count) tally.hit(i);
    return tally;
}

void report(const IndexTallies& tallies, const pro_index& index, Findings& findings) {
    tallies.grid_brick.addTo(findings, Finding::kGridBrick, "grid word", "its brick is out of range or named before");
    if (tallies.bricks_missing)
        findings.add(Finding::kGridBrick, "the grid does not name all %u bricks", index.brick_count);
    tallies.grid_skip.addTo(findings, Finding::kEmptySkip, "grid word", "empty, but a skip is 0");
    tallies.brick_skip.addTo(findings, Finding::kEmptySkip, "brick word", "empty, but a skip is 0");
    tallies.brick_word.addTo(findings, Finding::kBrickWord, "brick word", "does not name the next cell or group");
    if (tallies.words_missing)
        findings.add(Finding::kBrickWord, "bricks do not name all %u cells and %u groups", index.cell_count,
                     index.group_count);
    tallies.group_depth.addTo(findings, Finding::kGroupDepth, "brick word", "its group is too deep");
    tallies.cell_run.addTo(findings, Finding::kCellRun, "cell", "no near splats, or near splats out of range");
    tallies.cell_codes.addTo(findings, Finding::kCellCodes, "cell",
                             "its step of position codes is not a positive number");
    tallies.cell_reserved.addTo(findings, Finding::kCellReserved, "cell", "its reserved bit is not 0");
    tallies.cell_blending.addTo(findings, Finding::kCellBlending, "cell", "its blending splats are out of range");
    if (tallies.blending_missing)
        findings.add(Finding::kCellBlending, "blending splats of the cells do not add up to %u", index.blending_count);
    tallies.listed_splat.addTo(findings, Finding::kListSplat, "listed splat", "out of range");
}

void checkCounts(const pro_index& index, Findings& findings) {
    const std::uint64_t groups = std::uint64_t{index.brick_count} * kBrickGroups + index.group_count;
    if (index.brick_count == 0 || groups > kMaxNumbers || (index.uneven == 0 && index.group_count > 0))
        findings.add(Finding::kSectionCount, "invalid index of %u bricks and %u groups", index.brick_count,
                     index.group_count);
    if (index.cell_count == 0 || index.cell_count > kMaxNumbers)
        findings.add(Finding::kSectionCount, "index of %u cells, not 1 to 2^27", index.cell_count);
    if (index.near_count == 0 || index.near_count % 2 != 0 || index.near_count > PRO_INDEX_LISTED_MAX ||
        index.blending_count % 2 != 0 || index.blending_count > PRO_INDEX_LISTED_MAX)
        findings.add(Finding::kSectionCount, "invalid index of %u near splats and %u blending splats", index.near_count,
                     index.blending_count);
}

} // namespace

bool checkIndexFrame(const pro_index& index, Findings& findings) {
    const std::size_t before = findings.count();
    bool inside = index.shift >= PRO_GRID_SHIFT_MIN && index.shift <= PRO_POSITION_BITS && index.uneven <= 1;
    for (std::size_t axis = 0; axis < 3 && inside; ++axis)
        inside = index.size[axis] > 0 &&
                 std::uint64_t{index.origin[axis]} + index.size[axis] <= 1u << (PRO_POSITION_BITS - index.shift);
    if (!inside || gridWords(index) > PRO_GRID_WORDS_MAX)
        findings.add(Finding::kGridFrame,
                     "entry grid of %u x %u x %u cells with edge 2^%u is too large or not inside the cube",
                     index.size[0], index.size[1], index.size[2], index.shift);
    checkCounts(index, findings);
    return findings.count() == before;
}

void checkIndex(const pro_info& info, const pro_index& index, Findings& findings) {
    IndexTallies tallies;
    std::vector<Tally> listed((std::size_t{index.near_count} + kRunWords - 1) / kRunWords);
    const std::array<std::function<void()>, 3> checks = {[&] { BrickWalk(index, tallies).run(); },
                                                         [&] { checkGrid(index, tallies); },
                                                         [&] { checkCells(index, tallies); }};
    forAll(
        checks.size() + listed.size(),
        [&](std::size_t k) {
            if (k < checks.size())
                checks[k]();
            else
                listed[k - checks.size()] = checkListed(info, index, (k - checks.size()) * kRunWords);
        },
        index.near_count < kRunWords ? 1 : 0);
    for (const Tally& run : listed) tallies.listed_splat.join(run);
    report(tallies, index, findings);
}

} // namespace pointrt::format
