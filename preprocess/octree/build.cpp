// SPDX-License-Identifier: GPL-3.0-or-later
// Top-down construction in two layers. Coarse cells, split by their number of members, are independent tasks. Each task
// splits further by members and by the number of touching discs, so that a large cell next to a dense wall does not
// become a leaf with thousands of references.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "format/base/error.h"
#include "preprocess/cloud/morton.h"
#include "preprocess/octree/octree.h"
#include "preprocess/octree/task_progress.h"

namespace pointrt {

namespace {

/// Members per task: large enough that few discs cross its border, small enough to balance the load.
constexpr std::uint32_t kTaskMembers = 2048;

/// A leaf splits if it lists more than this many splats per allowed member; an evenly sampled surface needs about 4.
constexpr std::uint32_t kListPerMember = 8;

/// Cells with an edge below this many mean radii of their splats do not split. The factor sqrt(2) makes the halves of
/// such a cell as far below kLeafEdgeRadii as the cell is above it.
constexpr float kMinEdgeRadii = 1.41421356f * static_cast<float>(kLeafEdgeRadii);

/// Tests enlarge boxes by this: half a step for rounding, and one because a viewer may look one step ahead.
constexpr float kTouchSlack = 1.5f * PRO_POSITION_STEP;

struct Range {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t size() const { return end - begin; }
};

/// A cell with its members and the other splats whose slab overlaps it.
struct Work {
    Cell cell;
    Range members;
    std::vector<std::uint32_t> touching;
};

Range membersOf(const std::vector<std::uint64_t>& morton, const Cell& cell, Range within) {
    const auto first = morton.begin();
    const auto lo = std::lower_bound(first + within.begin, first + within.end, cell.code);
    const auto hi = std::lower_bound(lo, first + within.end, cell.code + cellSpan(cell.depth));
    return {static_cast<std::uint32_t>(lo - first), static_cast<std::uint32_t>(hi - first)};
}

Box slackBox(const Cell& cell) {
    Box box = cellBox(cell);
    box.lo.array() -= kTouchSlack;
    box.hi.array() += kTouchSlack;
    return box;
}

bool slabOverlaps(const Disc& disc, const Box& box) { return discOverlapsBox(disc, growBySlab(box, disc, kBlendSlab)); }

/// Half extents of the slab's bounding box, with the slack of slackBox.
Vec3f slabReach(const Disc& disc) {
    return (discReach(disc) + kBlendSlab * disc.radius * disc.normal.cwiseAbs()).array() + kTouchSlack;
}

/// The children, as bits, whose side of the middle a box reaches. @param offset centre of the box from the middle
/// @param reach half extents of the box
std::uint32_t slotsReached(const Vec3f& offset, const Vec3f& reach) {
    constexpr std::array<std::uint32_t, 3> kUpper{0xAA, 0xCC, 0xF0}; // slots with bit 0, 1, 2 of their number set
    std::uint32_t slots = 0xFF;
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t upper = kUpper[static_cast<std::size_t>(axis)];
        if (offset[axis] + reach[axis] < 0) slots &= ~upper;
        if (offset[axis] - reach[axis] > 0) slots &= upper;
    }
    return slots;
}

void splitCoarse(const PackedSplats& splats, const OctreeOptions& options, const Work& work, std::vector<Work>& tasks) {
    const std::uint32_t limit = std::max(kTaskMembers, options.max_leaf_splats);
    if (work.members.size() <= limit || work.cell.depth >= options.max_depth) {
        tasks.push_back(work);
        return;
    }
    for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) {
        const Cell child = childCell(work.cell, slot);
        splitCoarse(splats, options, {child, membersOf(splats.morton, child, work.members), {}}, tasks);
    }
}

/// Finds the tasks whose cells a disc's slab overlaps, by bisection: the tasks below a cell are the contiguous range.
void collectTouched(const Disc& disc, const std::vector<Work>& tasks, const Cell& cell, Range range,
                    std::vector<std::uint32_t>& touched) {
    if (!slabOverlaps(disc, slackBox(cell))) return;
    if (range.size() == 1 && tasks[range.begin].cell.depth == cell.depth) {
        touched.push_back(range.begin);
        return;
    }
    std::uint32_t begin = range.begin;
    for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) {
        const Cell child = childCell(cell, slot);
        const std::uint64_t limit = child.code + cellSpan(child.depth);
        const auto last = std::partition_point(tasks.begin() + begin, tasks.begin() + range.end,
                                               [&](const Work& task) { return task.cell.code < limit; });
        const auto end = static_cast<std::uint32_t>(last - tasks.begin());
        collectTouched(disc, tasks, child, {begin, end}, touched);
        begin = end;
    }
}

/// Adds every splat to the tasks, other than its own, that its slab overlaps.
void distribute(const PackedSplats& splats, std::vector<Work>& tasks) {
    std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> crossing(tasks.size());
    const Range all{0, static_cast<std::uint32_t>(tasks.size())};
    tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t t) {
        const Box own = cellBox(tasks[t].cell);
        std::vector<std::uint32_t> touched;
        for (std::uint32_t s = tasks[t].members.begin; s < tasks[t].members.end; ++s) {
            const Disc& disc = splats.discs[s];
            const Vec3f reach = slabReach(disc);
            const bool enclosed = ((disc.center - reach).array() >= own.lo.array()).all() &&
                                  ((disc.center + reach).array() <= own.hi.array()).all();
            if (enclosed) continue;
            touched.clear();
            collectTouched(disc, tasks, Cell{}, all, touched);
            for (const std::uint32_t other : touched)
                if (other != t) crossing[t].emplace_back(other, s);
        }
    });
    for (auto& pairs : crossing) { // in splat order, for any number of threads
        for (const auto& [task, splat] : pairs) tasks[task].touching.push_back(splat);
        pairs = {};
    }
}

/// The leaves of one task; first_ref counts from the refs of the task.
struct Output {
    std::vector<Leaf> leaves;
    std::vector<std::uint32_t> refs;
};

class Subdivider {
public:
    Subdivider(const PackedSplats& splats, const OctreeOptions& options, Output& output)
        : splats_(splats), options_(options), output_(output) {}

    void run(const Work& work) {
        if (work.members.size() == 0 && !crossedByDisc(work)) return;
        if (mustSplit(work))
            split(work);
        else
            emit(work);
    }

private:
    /// Whether a disc crosses the cell: rays cannot hit slabs without discs.
    bool crossedByDisc(const Work& work) const {
        const Box box = slackBox(work.cell);
        return std::any_of(work.touching.begin(), work.touching.end(),
                           [&](std::uint32_t s) { return discOverlapsBox(splats_.discs[s], box); });
    }

    bool mustSplit(const Work& work) const {
        if (work.cell.depth >= options_.max_depth) return false;
        const std::size_t listed = work.members.size() + work.touching.size();
        if (listed > PRO_LEAF_LIST_MAX) return true; // no leaf can hold them all
        const bool crowded = work.members.size() > options_.max_leaf_splats ||
                             listed > std::size_t{kListPerMember} * options_.max_leaf_splats;
        return crowded && cellEdge(work.cell.depth) > kMinEdgeRadii * meanRadius(work);
    }

    float meanRadius(const Work& work) const {
        double sum = 0;
        for (std::uint32_t s = work.members.begin; s < work.members.end; ++s) sum += splats_.discs[s].radius;
        for (const std::uint32_t s : work.touching) sum += splats_.discs[s].radius;
        return static_cast<float>(sum / static_cast<double>(work.members.size() + work.touching.size()));
    }

    void split(const Work& work) {
        std::array<Work, PRO_GROUP_SIZE> children;
        std::array<Box, PRO_GROUP_SIZE> boxes;
        for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) {
            children[slot].cell = childCell(work.cell, slot);
            children[slot].members = membersOf(splats_.morton, children[slot].cell, work.members);
            boxes[slot] = slackBox(children[slot].cell);
        }
        const Vec3f middle = cellBox(children[PRO_GROUP_SIZE - 1].cell).lo;
        const auto offer = [&](std::uint32_t s) {
            const Disc& disc = splats_.discs[s];
            const Vec3f reach = slabReach(disc);
            for (std::uint32_t slots = slotsReached(disc.center - middle, reach); slots != 0; slots &= slots - 1) {
                const auto slot = static_cast<std::uint32_t>(std::countr_zero(slots));
                const Range& own = children[slot].members;
                if (s >= own.begin && s < own.end) continue;
                if (slabOverlaps(disc, boxes[slot])) children[slot].touching.push_back(s);
            }
        };
        for (std::uint32_t s = work.members.begin; s < work.members.end; ++s) offer(s);
        for (const std::uint32_t s : work.touching) offer(s);
        for (Work& child : children) {
            run(child);
            child.touching = {};
        }
    }

    void emit(const Work& work) {
        if (work.members.size() + work.touching.size() > PRO_LEAF_LIST_MAX)
            throw Error(ExitCode::kBadUsage, "a leaf would hold more than 65535 splats: raise --max-depth, or lower "
                                             "--max-leaf-splats or --radius-scale");
        const auto first_ref = static_cast<std::uint32_t>(output_.refs.size());
        output_.leaves.push_back({work.cell, work.members.begin, work.members.size(), first_ref,
                                  static_cast<std::uint32_t>(work.touching.size())});
        output_.refs.insert(output_.refs.end(), work.touching.begin(), work.touching.end());
    }

    const PackedSplats& splats_;
    const OctreeOptions& options_;
    Output& output_;
};

Octree concatenate(std::vector<Output>& outputs) {
    Octree octree;
    std::size_t leaf_count = 0, ref_count = 0;
    for (const Output& output : outputs) {
        leaf_count += output.leaves.size();
        ref_count += output.refs.size();
    }
    if (ref_count > std::numeric_limits<std::uint32_t>::max())
        throw Error(ExitCode::kBadUsage, "more than 2^32 references: lower --radius-scale");
    octree.leaves.reserve(leaf_count);
    octree.refs.reserve(ref_count);
    for (Output& output : outputs) {
        const auto base = static_cast<std::uint32_t>(octree.refs.size());
        for (Leaf leaf : output.leaves) {
            leaf.first_ref += base;
            octree.leaves.push_back(leaf);
        }
        octree.refs.insert(octree.refs.end(), output.refs.begin(), output.refs.end());
        output = {};
    }
    return octree;
}

} // namespace

Box cellBox(const Cell& cell) {
    const Vec3f corner(static_cast<float>(collectBits(cell.code)), static_cast<float>(collectBits(cell.code >> 1)),
                       static_cast<float>(collectBits(cell.code >> 2)));
    const Vec3f lo = corner * PRO_POSITION_STEP;
    return {lo, lo + Vec3f::Constant(cellEdge(cell.depth))};
}

Octree buildOctree(const PackedSplats& splats, const OctreeOptions& options, const OctreeProgress& progress) {
    std::vector<Work> tasks;
    splitCoarse(splats, options, {Cell{}, {0, static_cast<std::uint32_t>(splats.discs.size())}, {}}, tasks);
    distribute(splats, tasks);

    std::vector<Output> outputs(tasks.size());
    TaskProgress finished(progress, tasks.size());
    tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t t) {
        Subdivider(splats, options, outputs[t]).run(tasks[t]);
        tasks[t] = {};
        finished.finishOne();
    });
    return concatenate(outputs);
}

} // namespace pointrt
