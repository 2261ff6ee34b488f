// SPDX-License-Identifier: Apache-2.0
#include "format/index/bricks.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <iterator>
#include <mutex>
#include <type_traits>
#include <utility>

#include "format/base/error.h"
#include "format/base/parallel.h"
#include "format/index/cell_overlap.h"
#include "format/index/cell_runs.h"
#include "format/index/node_walk.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt {

namespace {

/// The index may have this many list numbers per splat. Most scans have 10, very unevenly sampled ones 130; only
/// hostile files have many more, and get a coarser grid.
constexpr std::size_t kListedPerSplat = 1024, kListedMin = std::size_t{1} << 24;

/// Nodes per run, the unit of work of a thread.
constexpr std::size_t kRunNodes = 256;

/// Cells are enlarged by kSlackEdges of their edge for rounding, and by kSlackSteps position steps because rays look
/// one step ahead (shaders/trace/trace.glsl).
constexpr float kSlackEdges = 1e-3f, kSlackSteps = 1.5f;

/// If the octree has leaves below the grid, cells with more than kMaxDiscs discs are halved, at most kMaxHalvings
/// times, unless the lists of the halves together would be more than kMaxListGrowth times as long. For discs as large
/// as the cell they are at least 4 times as long.
constexpr std::size_t kMaxDiscs = 48;
constexpr std::uint32_t kMaxHalvings = PRO_INDEX_HALVINGS_MAX;
constexpr std::size_t kMaxListGrowth = 3;
/// A cell is halved only if half its edge is at least this many times its slack. Then the corners of each half,
/// enlarged by the slack, are within one edge of the half's centre, which is the range of slab heights.
constexpr float kMinHalfEdge = 16;

/// Output for a run of nodes; indices are relative to the part.
struct Part : CellWords {
    std::vector<Corner> corners;
    std::vector<std::uint32_t> words, groups;
};

/// A cell of the grid or a leaf above it.
struct Source {
    std::uint32_t node = 0;
    Corner corner{};
    std::uint32_t shift = 0; ///< log2 of its edge in position steps
};

void addIfOverlapping(const CellDisc& disc, const CellBox& box, CellLists& lists) {
    if (!mayOverlap(disc, box, disc.slab)) return;
    (overlaps(disc, box) ? lists.hittable : lists.blending).push_back(&disc);
}

/// Distance of a disc's centre from the middle of a cell, minus its radius.
float remoteness(const CellDisc& disc, const CellBox& box) {
    float squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float offset = disc.center[axis] - box.middle[axis];
        squared += offset * offset;
    }
    return std::sqrt(squared) - disc.radius;
}

/// Sorts discs that cover most of the cell first: rays that need any hit then finish sooner.
Discs likeliestFirst(const Discs& discs, const CellBox& box) {
    std::vector<std::pair<float, const CellDisc*>> keyed;
    for (const CellDisc* disc : discs) keyed.emplace_back(remoteness(*disc, box), disc);
    std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Discs sorted;
    for (const auto& [key, disc] : keyed) sorted.push_back(disc);
    return sorted;
}

std::size_t listedBy(const Part& part) { return part.listed.size() + part.blending.size(); }

/// Total length of the lists of all parts so far, and its limit.
struct ListedTotal {
    std::size_t limit;
    std::atomic<std::size_t> listed{0};
    bool isFull() const { return listed > limit; }
};

/// Lengths are in edges of a brick's cells, relative to the source's lowest corner. Stops once the total exceeds its
/// limit.
class BrickBuilder {
public:
    BrickBuilder(const pro_info& info, const pro_view& view, const EntryGrid& grid, Part& part, ListedTotal& total)
        : info_(info), view_(view), part_(part), total_(total), grid_shift_(grid.shift),
          edges_(PRO_BRICK_SIDE * std::ldexp(1.0f, static_cast<int>(PRO_POSITION_BITS - grid.shift))),
          slack_(std::max(kSlackEdges, kSlackSteps * PRO_POSITION_STEP * edges_)),
          halvings_(grid.uneven ? kMaxHalvings : 0) {}

    void run(const Source& source) {
        if (total_.isFull()) return;
        gather(source);
        Discs all;
        for (const CellDisc& disc : discs_) all.push_back(&disc);
        divide(all, source, {});
    }

private:
    /// Divides a leaf above the grid into grid cells. @param offset of source.corner from the first source
    void divide(const Discs& discs, const Source& source, const Vector& offset) {
        if (total_.isFull()) return;
        if (source.shift == grid_shift_) return build(discs, source.corner, offset);
        const float half = std::ldexp(0.5f * PRO_BRICK_SIDE, static_cast<int>(source.shift - grid_shift_));
        for (std::uint32_t h = 0; h < PRO_GROUP_SIZE; ++h) {
            Source child{source.node, source.corner, source.shift - 1};
            Vector at = offset;
            CellBox box{{}, 0.5f * half, slack_};
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                child.corner[axis] += (h >> axis & 1) << child.shift;
                at[axis] += h >> axis & 1 ? half : 0.0f;
                box.middle[axis] = at[axis] + 0.5f * half;
            }
            Discs inside;
            std::copy_if(discs.begin(), discs.end(), std::back_inserter(inside),
                         [&](const CellDisc* disc) { return mayOverlap(*disc, box, disc->slab); });
            if (!inside.empty()) divide(inside, child, at);
        }
    }

    /// Adds a brick, unless all its cells are empty.
    void build(const Discs& discs, const Corner& corner, const Vector& offset) {
        for (CellLists& cell : cells_) cell.hittable.clear(), cell.blending.clear();
        for (const CellDisc* disc : discs) spread(*disc, offset);
        if (std::all_of(cells_.begin(), cells_.end(), [](const CellLists& cell) { return cell.hittable.empty(); }))
            return;
        const std::size_t before = listedBy(part_);
        listed_.clear();
        first_cell_ = part_.slabs.size();
        part_.corners.push_back(corner);
        for (std::uint32_t c = 0; c < PRO_BRICK_WORDS; ++c) {
            const std::uint32_t word = emit(cells_[c], boxOf(c, offset), 0);
            part_.words.push_back(word);
        }
        constexpr float kHalf = 0.5f * PRO_BRICK_SIDE;
        encodeCells(listed_, {{offset[0] + kHalf, offset[1] + kHalf, offset[2] + kHalf}, kHalf, slack_}, part_);
        total_.listed += listedBy(part_) - before;
    }

    CellBox boxOf(std::uint32_t cell, const Vector& offset) const {
        const auto middle = [&](std::uint32_t axis) {
            return offset[axis] + static_cast<float>(cell >> (PRO_BRICK_BITS * axis) & (PRO_BRICK_SIDE - 1)) + 0.5f;
        };
        return {{middle(0), middle(1), middle(2)}, 0.5f, slack_};
    }

    void gather(const Source& source) {
        discs_.clear();
        gatherBelow(source.node, source.corner);
        if (!(source.node & PRO_NODE_INNER)) return;
        // adjacent leaves share splats
        const auto less = [](const CellDisc& a, const CellDisc& b) { return a.splat < b.splat; };
        const auto same = [](const CellDisc& a, const CellDisc& b) { return a.splat == b.splat; };
        std::sort(discs_.begin(), discs_.end(), less);
        discs_.erase(std::unique(discs_.begin(), discs_.end(), same), discs_.end());
    }

    void gatherBelow(std::uint32_t node, const Corner& corner) {
        if (node == PRO_NODE_EMPTY) return;
        if (node & PRO_NODE_INNER) {
            const std::uint32_t* group = view_.nodes + std::size_t{node & PRO_NODE_GROUP_MASK} * PRO_GROUP_SIZE;
            for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) gatherBelow(group[slot], corner);
            return;
        }
        const std::uint32_t* leaf = view_.leaves + std::size_t{node - 1} * PRO_LEAF_WORDS;
        const std::uint32_t members = leaf[PRO_LEAF_COUNTS] & PRO_LEAF_MEMBER_MASK;
        const std::uint32_t refs = leaf[PRO_LEAF_COUNTS] >> PRO_LEAF_REF_SHIFT;
        for (std::uint32_t k = 0; k < members; ++k) add(leaf[PRO_LEAF_FIRST_MEMBER] + k, corner);
        for (std::uint32_t k = 0; k < refs; ++k) add(view_.refs[leaf[PRO_LEAF_FIRST_REF] + k], corner);
    }

    void add(std::uint32_t splat, const Corner& corner) {
        const std::uint32_t* const words = view_.splats + std::size_t{splat} * PRO_SPLAT_WORDS;
        pro_splat plain;
        pro_splat_decode(words, info_.radius_max, info_.radius_step, &plain);
        CellDisc disc;
        disc.splat = splat;
        disc.radius = plain.radius * edges_;
        for (std::size_t axis = 0; axis < 3; ++axis)
            disc.center[axis] = (plain.position[axis] - static_cast<float>(corner[axis]) * PRO_POSITION_STEP) * edges_;
        disc.reach = {disc.radius, disc.radius, disc.radius};
        if (!pro_splat_is_ball(words)) orient(disc, plain.normal);
        discs_.push_back(disc);
    }

    /// Turns a ball into a disc with this normal.
    void orient(CellDisc& disc, const float normal[3]) const {
        disc.slab = info_.blend_slab * disc.radius;
        std::copy_n(normal, 3, disc.normal.begin());
        // not from 1 - n^2, which cancels if the normal is nearly along the axis
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float a = disc.normal[(axis + 1) % 3], b = disc.normal[(axis + 2) % 3];
            disc.reach[axis] = disc.radius * std::sqrt(a * a + b * b);
        }
    }

    /// Adds a disc to the lists of the cells that it overlaps in the brick at offset.
    void spread(const CellDisc& disc, const Vector& offset) {
        const CellSets sets = overlappedCells(disc, offset, slack_);
        for (std::uint64_t rest = sets.by_disc; rest != 0; rest &= rest - 1)
            cells_[static_cast<std::size_t>(std::countr_zero(rest))].hittable.push_back(&disc);
        for (std::uint64_t rest = sets.by_slab & ~sets.by_disc; rest != 0; rest &= rest - 1)
            cells_[static_cast<std::size_t>(std::countr_zero(rest))].blending.push_back(&disc);
    }

    /// The word of a cell; kEmptyWord if no disc crosses it.
    std::uint32_t emit(const CellLists& lists, const CellBox& box, std::uint32_t halvings) {
        if (lists.hittable.empty()) return kEmptyWord; // rays cannot hit slabs without discs
        const bool divisible = halvings < halvings_ && box.half_edge >= kMinHalfEdge * box.slack;
        if (divisible && lists.hittable.size() > kMaxDiscs) {
            const std::uint32_t word = halve(lists, box, halvings);
            if (word != kEmptyWord) return word;
        }
        return emitCell(lists, box);
    }

    /// The word of a group with the halves of the cell, or kEmptyWord if their lists would be too long.
    std::uint32_t halve(const CellLists& lists, const CellBox& box, std::uint32_t halvings) {
        std::array<CellLists, PRO_GROUP_WORDS> halves;
        std::array<CellBox, PRO_GROUP_WORDS> boxes;
        std::size_t listed = 0;
        for (std::uint32_t h = 0; h < PRO_GROUP_WORDS; ++h) {
            boxes[h] = {box.middle, 0.5f * box.half_edge, box.slack};
            for (std::uint32_t axis = 0; axis < 3; ++axis)
                boxes[h].middle[axis] += (h >> axis & 1 ? 0.5f : -0.5f) * box.half_edge;
            for (const CellDisc* disc : lists.hittable) addIfOverlapping(*disc, boxes[h], halves[h]);
            for (const CellDisc* disc : lists.blending) addIfOverlapping(*disc, boxes[h], halves[h]);
            listed += halves[h].hittable.size();
        }
        if (listed > kMaxListGrowth * lists.hittable.size()) return kEmptyWord;
        std::array<std::uint32_t, PRO_GROUP_WORDS> words;
        for (std::uint32_t h = 0; h < PRO_GROUP_WORDS; ++h) words[h] = emit(halves[h], boxes[h], halvings + 1);
        const auto group = static_cast<std::uint32_t>(part_.groups.size() / PRO_GROUP_WORDS);
        part_.groups.insert(part_.groups.end(), words.begin(), words.end());
        return group << PRO_CELL_INDEX_SHIFT | PRO_CELL_INNER;
    }

    std::uint32_t emitCell(const CellLists& lists, const CellBox& box) {
        if (lists.hittable.size() + lists.blending.size() > PRO_CELL_LISTED_MAX)
            throw Error(ExitCode::kCannotRun,
                        "too many discs overlap: a cell of the tracing index would list more than 32767");
        const auto cell = static_cast<std::uint32_t>(first_cell_ + listed_.size());
        listed_.push_back({{likeliestFirst(lists.hittable, box), lists.blending}, box});
        return cell << PRO_CELL_INDEX_SHIFT;
    }

    const pro_info& info_;
    const pro_view& view_;
    Part& part_;
    ListedTotal& total_;
    std::uint32_t grid_shift_;
    float edges_; ///< cell edges per cube unit
    float slack_;
    std::uint32_t halvings_; ///< maximum
    std::vector<CellDisc> discs_;
    std::vector<ListedCell> listed_; ///< of the brick
    std::size_t first_cell_ = 0;     ///< index of the first of them
    std::array<CellLists, PRO_BRICK_WORDS> cells_;
};

/// Appends one array of every part to `all`, and frees it in the parts.
template <typename All, typename Member>
void appendAll(All& all, std::vector<Part>& parts, Member member) {
    std::size_t size = all.size();
    for (Part& part : parts) size += (part.*member).size();
    all.reserve(size);
    for (Part& part : parts) {
        auto& own = part.*member;
        all.insert(all.end(), own.begin(), own.end());
        std::remove_reference_t<decltype(own)>().swap(own); // assigning {} would keep the memory
    }
}

/// Total sizes of the arrays of all parts before a part.
struct Offsets {
    std::size_t groups = 0, cells = 0, near = 0, blending = 0;
};

void relocate(Part& part, const Offsets& before) {
    const auto moved = [&](std::uint32_t& word) {
        if ((word & PRO_SKIP_MASK) != 0) return;
        word += static_cast<std::uint32_t>(word & PRO_CELL_INNER ? before.groups : before.cells)
                << PRO_CELL_INDEX_SHIFT;
    };
    std::for_each(part.words.begin(), part.words.end(), moved);
    std::for_each(part.groups.begin(), part.groups.end(), moved);
    for (std::size_t w = 0; w < part.cells.size(); w += PRO_CELL_WORDS) {
        part.cells[w + PRO_CELL_FIRST] += static_cast<std::uint32_t>(before.near);
        part.cells[w + PRO_CELL_BLENDING] += static_cast<std::uint32_t>(before.blending);
    }
}

/// Offsets of the first part; groups start after all bricks.
Offsets firstOffsets(const std::vector<Part>& parts) {
    Offsets at;
    for (const Part& part : parts) at.groups += part.words.size() / PRO_GROUP_WORDS;
    return at;
}

void advance(Offsets& at, const Part& part) {
    at.groups += part.groups.size() / PRO_GROUP_WORDS;
    at.cells += part.slabs.size();
    at.near += part.listed.size();
    at.blending += part.blending.size();
}

bool fits(const std::vector<Part>& parts, const BrickLimits& limits) {
    Offsets end = firstOffsets(parts);
    for (const Part& part : parts) advance(end, part);
    return end.near + end.blending <= limits.listed && std::max(end.cells, end.groups) <= limits.cells;
}

/// Packs two numbers per word. An empty list becomes one word, because Vulkan buffers cannot be empty.
void appendNumbers(Words& all, std::vector<Part>& parts) {
    for (Part& part : parts) {
        for (std::size_t i = 0; i < part.blending.size(); i += 2)
            all.push_back(static_cast<std::uint16_t>(part.blending[i]) |
                          static_cast<std::uint32_t>(static_cast<std::uint16_t>(part.blending[i + 1])) << 16);
        std::vector<std::int16_t>().swap(part.blending);
    }
    if (all.empty()) all.push_back(0);
}

/// Concatenates the parts.
Bricks join(std::vector<Part>& parts) {
    Offsets at = firstOffsets(parts);
    for (Part& part : parts) {
        relocate(part, at);
        advance(at, part);
    }
    Bricks all;
    appendAll(all.corners, parts, &Part::corners);
    appendAll(all.words, parts, &Part::words);
    appendAll(all.words, parts, &Part::groups);
    appendAll(all.cells, parts, &Part::cells);
    appendAll(all.slabs, parts, &Part::slabs);
    appendAll(all.near, parts, &Part::near);
    appendAll(all.listed, parts, &Part::listed);
    all.blending.reserve(at.blending / 2 + 1);
    appendNumbers(all.blending, parts);
    return all;
}

/// The parts are incomplete if the limit of list lengths was exceeded.
std::vector<Part> buildParts(const pro_info& info, const pro_view& view, const EntryGrid& grid,
                             const IndexOptions& options) {
    std::vector<Source> sources;
    forNodes({view.nodes, info.node_count}, PRO_POSITION_BITS - grid.shift,
             [&](std::uint32_t node, const Corner& corner, std::uint32_t shift) {
                 sources.push_back({node, corner, shift});
             });
    std::vector<Part> parts((sources.size() + kRunNodes - 1) / kRunNodes);
    std::mutex progress_mutex;
    std::size_t done = 0;
    ListedTotal total{options.limits.listed};
    const auto buildPart = [&](std::size_t k) {
        BrickBuilder builder(info, view, grid, parts[k], total);
        const std::size_t end = std::min(sources.size(), (k + 1) * kRunNodes);
        for (std::size_t s = k * kRunNodes; s < end; ++s) builder.run(sources[s]);
        if (!options.progress) return;
        const std::lock_guard lock(progress_mutex);
        options.progress(static_cast<double>(++done) / static_cast<double>(parts.size()));
    };
    forAll(parts.size(), buildPart, options.threads);
    return parts;
}

} // namespace

Bricks buildBricks(const pro_info& info, const pro_view& view, EntryGrid& grid, const IndexOptions& given) {
    IndexOptions options = given;
    options.limits.listed = std::min(given.limits.listed, kListedMin + kListedPerSplat * info.splat_count);
    double reported = 0; // progress must not go back when the work starts over with another grid
    if (given.progress) options.progress = [&](double share) { given.progress(reported = std::max(reported, share)); };
    std::vector<Part> parts = buildParts(info, view, grid, options);
    while (!fits(parts, options.limits)) {
        const std::uint32_t depth = PRO_POSITION_BITS - grid.shift;
        if (depth == 0)
            throw Error(ExitCode::kCannotRun, "the splats need more cells and lists than a tracing index can hold");
        parts.clear(); // frees their memory before the next ones
        grid = frameEntryGrid(info, view, depth - 1);
        parts = buildParts(info, view, grid, options);
    }
    return join(parts);
}

} // namespace pointrt
