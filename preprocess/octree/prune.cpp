// SPDX-License-Identifier: GPL-3.0-or-later
// Pruning in rounds. A round keeps splats with a weight above a cutoff and probes every leaf; if the probes together
// show more harm than allowed, the next round has a lower cutoff.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "preprocess/cloud/per_thread.h"
#include "preprocess/octree/leaf_pruner.h"
#include "preprocess/octree/task_progress.h"

namespace pointrt {

namespace {

/// Leaves per block, the unit of work of a thread.
constexpr std::size_t kBlockLeaves = 64;

/// First cutoff relative to the allowed harm. Dropping a splat of weight w moves a surface, whose weights sum to at
/// least 1/2, by at most 2 w times its distance from the splat, which is
/// at most half a radius. Measured on 5 scans: at a cutoff of 0.001 fewer than 7 of 100,000 probes see a change.
constexpr double kCutoffPerHarm = 10.0;
constexpr double kFirstCutoffMax = 0.5;
constexpr double kCutoffStep = 0.25; ///< from one round to the next
/// The last cutoff is then 1/1000 of the first, which drops only slivers.
constexpr std::uint32_t kMaxRounds = 6;

/// Probes as a multiple of 1 / harm: with one change among them the bound still holds.
constexpr double kProbesPerBound = 5.0;

/// Upper end of the one-sided 95 % confidence interval of a fraction observed in this many trials (Wilson score).
double upperBound(double share, double trials) {
    if (trials == 0) return 1.0;
    constexpr double z = 1.6449;
    const double z2 = z * z / trials;
    return (share + z2 / 2 + z * std::sqrt((share * (1 - share) + z2 / 4) / trials)) / (1 + z2);
}

/// Sums what body(pruner, leaf) returns over all leaves, on all threads.
template <typename Body>
Audit auditLeaves(const PackedSplats& splats, const Octree& octree, const OctreeProgress& progress, const Body& body) {
    const std::size_t blocks = (octree.leaves.size() + kBlockLeaves - 1) / kBlockLeaves;
    tbb::enumerable_thread_specific<LeafPruner> pruners([&] { return LeafPruner(splats); });
    TaskProgress finished(progress, blocks);
    std::atomic<std::uint64_t> probes{0}, changes{0};
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        LeafPruner& pruner = pruners.local();
        const std::size_t end = std::min(octree.leaves.size(), (block + 1) * kBlockLeaves);
        for (std::size_t l = block * kBlockLeaves; l < end; ++l) {
            const Audit audit = body(pruner, octree.leaves[l]);
            probes += audit.probes;
            changes += audit.changes;
        }
        finished.finishOne();
    });
    return {probes, changes};
}

/// Removes the dropped references, and border leaves without references.
void rebuild(const std::vector<std::uint8_t>& kept, Octree& octree) {
    std::uint32_t next = 0;
    for (Leaf& leaf : octree.leaves) {
        const std::uint32_t first = next;
        for (std::uint32_t r = leaf.first_ref; r < leaf.first_ref + leaf.ref_count; ++r)
            if (kept[r]) octree.refs[next++] = octree.refs[r];
        leaf.first_ref = first;
        leaf.ref_count = next - first;
    }
    octree.refs.resize(next);
    octree.refs.shrink_to_fit();
    std::erase_if(octree.leaves, [](const Leaf& leaf) { return leaf.member_count == 0 && leaf.ref_count == 0; });
}

} // namespace

PruneReport pruneOctree(const PackedSplats& splats, const PruneOptions& options, Octree& octree,
                        const OctreeProgress& progress) {
    const auto leaf_count = static_cast<double>(octree.leaves.size());
    const auto enough = static_cast<std::uint32_t>(std::ceil(kProbesPerBound / options.harm / leaf_count));
    const std::uint32_t probes_per_leaf = std::max(options.probe_rays, enough);
    std::vector<std::uint8_t> kept(octree.refs.size(), 0);
    PruneReport report;
    report.cutoff = std::min(kCutoffPerHarm * options.harm, kFirstCutoffMax);
    while (true) {
        const std::uint64_t seed = options.seed + ++report.rounds;
        const Audit audit = auditLeaves(splats, octree, progress, [&](LeafPruner& pruner, const Leaf& leaf) {
            return pruner.run(octree, leaf, static_cast<float>(report.cutoff), ProbeSequence(seed, leaf.cell.code),
                              probes_per_leaf, std::span(kept).subspan(leaf.first_ref, leaf.ref_count));
        });
        const auto probes = static_cast<double>(audit.probes);
        report.probes = audit.probes;
        report.harm = audit.probes == 0 ? 0.0 : static_cast<double>(audit.changes) / probes;
        report.harm_bound = upperBound(report.harm, probes);
        if (report.harm_bound <= options.harm || report.rounds == kMaxRounds) break;
        report.cutoff *= kCutoffStep;
    }
    rebuild(kept, octree);
    return report;
}

} // namespace pointrt
