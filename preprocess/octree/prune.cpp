// SPDX-License-Identifier: GPL-3.0-or-later
// Pruning by probe rays, after Kashyap et al. (I3D 2010). The original keeps what the probes hit first and lets
// blending suffer. Here a reference is dropped only while the blended surface that the probes see stays the same
// within a tolerance at every probe: members are kept, probes aim at the splats about to be dropped, and where the
// pruned surface differs the missing splats that weigh most are put back until it does not.
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "preprocess/octree/blend.h"
#include "preprocess/octree/octree.h"
#include "preprocess/octree/task_progress.h"

namespace pointrt {

namespace {

/// How far the pruned surface may be off where a probe looks.
constexpr float kFirstHitTolerance = 0.25f;        ///< radii along the normal, half a slab: the same field blends there
constexpr float kHeightTolerance = 0.02f;          ///< radii, of the blended surface
constexpr float kNormalToleranceCosine = 0.99998f; ///< 0.36 degrees
constexpr float kColorTolerance = 4.0f;            ///< of 255, in any channel

/// Leaves are shared out in blocks this long.
constexpr std::size_t kBlockLeaves = 256;

/// Probes that a splat must pass at least to be dropped.
constexpr std::size_t kProbesPerSplat = 2;

/// Points tried on a disc before its part inside the leaf counts as a sliver, which is aimed at by projections.
constexpr int kTriesPerProbe = 4;
/// Alternating projections converge by about half a turn; 16 reach a ten-thousandth of the leaf.
constexpr int kProjections = 16;

/// Additive recurrences: the k-th of 4 coordinates advances by phi_4^-k, phi_4 = 1.1673039782614187 the root of
/// x^5 = x + 1 (Roberts 2018). Low discrepancy for any prefix.
constexpr std::array<double, 4> kProbeSteps{0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                            0.5385972572236101};

/// SplitMix64: decorrelates the sequences of neighbouring leaves.
std::uint64_t mix(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
    x = (x ^ x >> 27) * 0x94D049BB133111EBu;
    return x ^ x >> 31;
}

class ProbeSequence {
public:
    ProbeSequence(std::uint64_t seed, std::uint64_t leaf) {
        std::uint64_t state = mix(seed ^ mix(leaf));
        for (double& offset : offsets_) {
            state = mix(state);
            offset = static_cast<double>(state >> 11) * 0x1p-53;
        }
    }
    std::array<float, 4> next() {
        std::array<float, 4> sample;
        for (std::size_t k = 0; k < 4; ++k) {
            offsets_[k] += kProbeSteps[k];
            offsets_[k] -= std::floor(offsets_[k]);
            sample[k] = static_cast<float>(offsets_[k]);
        }
        return sample;
    }

private:
    std::array<double, 4> offsets_{};
};

constexpr float kFullTurn = 6.28318530718f;

/// Uniform on the disc, by the square root of the area share.
Vec3f pointOnDisc(const Disc& disc, float u, float v) {
    const Vec3f helper = std::abs(disc.normal.x()) < 0.5f ? Vec3f::UnitX() : Vec3f::UnitY();
    const Vec3f a = disc.normal.cross(helper).normalized(), b = disc.normal.cross(a);
    const float radius = disc.radius * std::sqrt(u), angle = kFullTurn * v;
    return disc.center + radius * (std::cos(angle) * a + std::sin(angle) * b);
}

/// A point of the disc inside the box, by projecting start on either in turn (von Neumann); it ends on the disc.
Vec3f pointOnSliver(const Disc& disc, const Box& box, const Vec3f& start) {
    Vec3f point = start;
    for (int turn = 0; turn < kProjections; ++turn) {
        point = point.cwiseMax(box.lo).cwiseMin(box.hi);
        point -= disc.normal.dot(point - disc.center) * disc.normal;
        const Vec3f offset = point - disc.center;
        const float length = offset.norm();
        if (length > disc.radius) point = disc.center + offset * (disc.radius / length);
    }
    return point;
}

/// Uniform over the sphere: grazing directions are where pruning by first hits opens cracks.
Vec3f sphereDirection(float u, float v) {
    const float z = 1.0f - 2.0f * u, ring = std::sqrt(std::max(0.0f, 1.0f - z * z)), angle = kFullTurn * v;
    return {ring * std::cos(angle), ring * std::sin(angle), z};
}

bool contains(const Box& box, const Vec3f& p) {
    return (p.array() >= box.lo.array()).all() && (p.array() <= box.hi.array()).all();
}

/// Length of the ray inside the box, from a point in it.
float exitDistance(const Box& box, const Vec3f& p, const Vec3f& direction) {
    float distance = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const float d = direction[axis];
        if (d != 0.0f) distance = std::min(distance, ((d > 0.0f ? box.hi : box.lo)[axis] - p[axis]) / d);
    }
    return std::max(distance, 0.0f);
}

/// Weighted sums of the field over some of the discs.
struct FieldSums {
    float weight = 0, height = 0;
    Vec3f normal = Vec3f::Zero(), color = Vec3f::Zero();

    void add(const DiscList& list, std::size_t i) {
        const float w = list.weight[i];
        weight += w;
        height += w * list.height[i];
        normal += w * list.turn[i] * list.normalOf(i);
        color += w * Vec3f(list.color[0][i], list.color[1][i], list.color[2][i]);
    }
};

bool agree(const FieldSums& full, const FieldSums& pruned, float radius) {
    if (full.weight <= 0.0f) return true; // a rim: the first disc alone decides, and it is kept
    if (pruned.weight <= 0.0f) return false;
    const float height = full.height / full.weight - pruned.height / pruned.weight;
    const float cosine = full.normal.dot(pruned.normal) / (full.normal.norm() * pruned.normal.norm());
    const Vec3f color = full.color / full.weight - pruned.color / pruned.weight;
    return std::abs(height) <= kHeightTolerance * radius && cosine >= kNormalToleranceCosine &&
           color.cwiseAbs().maxCoeff() <= kColorTolerance;
}

class LeafPruner {
public:
    LeafPruner(const PackedSplats& splats, const PruneOptions& options) : splats_(splats), options_(options) {
        list_.oriented = (splats.frame.flags & PRO_FLAG_ORIENTED) != 0;
    }

    /// Appends the references of leaf that are needed to kept.
    void run(const Octree& octree, const Leaf& leaf, std::vector<std::uint32_t>& kept) {
        gather(octree, leaf);
        box_ = cellBox(leaf.cell);
        members_ = leaf.member_count;
        ProbeSequence sequence(options_.seed, leaf.cell.code);
        std::size_t target = members_;
        // no splat goes untested, however many a leaf lists
        const std::size_t probes = std::max<std::size_t>(options_.probe_rays, kProbesPerSplat * leaf.ref_count);
        for (std::size_t p = 0; p < probes; ++p) {
            target = nextDropped(target);
            if (target == list_.size()) break; // all are kept already
            probeDisc(target, sequence);
            ++target;
        }
        for (std::size_t i = members_; i < list_.size(); ++i)
            if (list_.kept[i]) kept.push_back(splat_of_[i]);
    }

private:
    void gather(const Octree& octree, const Leaf& leaf) {
        list_.clear();
        splat_of_.clear();
        for (std::uint32_t m = 0; m < leaf.member_count; ++m) add(leaf.first_member + m, true);
        for (std::uint32_t r = 0; r < leaf.ref_count; ++r) add(octree.refs[leaf.first_ref + r], false);
    }

    void add(std::uint32_t splat, bool keep) {
        const Vec3f color = splats_.colors.empty()
                                ? Vec3f(Vec3f::Zero())
                                : Vec3f(splats_.colors[splat][0], splats_.colors[splat][1], splats_.colors[splat][2]);
        list_.add(splats_.discs[splat], color, keep);
        splat_of_.push_back(splat);
    }

    /// The first reference from start on, round the list once, that is not kept; the list's size when there is none.
    std::size_t nextDropped(std::size_t start) const {
        const std::size_t refs = list_.size() - members_;
        for (std::size_t k = 0; k < refs; ++k) {
            const std::size_t i = members_ + (start - members_ + k) % refs;
            if (!list_.kept[i]) return i;
        }
        return list_.size();
    }

    void probeDisc(std::size_t target, ProbeSequence& sequence) {
        const Disc& disc = splats_.discs[splat_of_[target]];
        for (int attempt = 0; attempt < kTriesPerProbe; ++attempt) {
            const auto sample = sequence.next();
            const Vec3f point = pointOnDisc(disc, sample[0], sample[1]);
            if (!contains(box_, point)) continue;
            probe(point, sphereDirection(sample[2], sample[3]));
            return;
        }
        if (!discMeetsBox(disc, box_)) return; // only its slab reaches in: it blends, but nothing hits it here
        const auto sample = sequence.next(), turn = sequence.next();
        const Vec3f start = box_.lo + Vec3f(sample[0], sample[1], turn[0]).cwiseProduct(box_.hi - box_.lo);
        probe(pointOnSliver(disc, box_, start).cwiseMax(box_.lo).cwiseMin(box_.hi),
              sphereDirection(sample[2], sample[3]));
    }

    void probe(const Vec3f& through, const Vec3f& direction) {
        const float back = exitDistance(box_, through, -direction), ahead = exitDistance(box_, through, direction);
        const Vec3f origin = through - back * direction;
        castRay(list_, origin, direction, back + ahead);
        const std::size_t first = nearest(false);
        if (first == list_.size()) return;
        const Vec3f normal = list_.normalOf(first);
        const float radius = std::sqrt(list_.radius_squared[first]);
        const std::size_t first_kept = nearest(true);
        const float slope = std::abs(normal.dot(direction));
        if (first_kept == list_.size() ||
            (list_.distance[first_kept] - list_.distance[first]) * slope > kFirstHitTolerance * radius)
            list_.kept[first] = 1;
        const float front = normal.dot(direction) > 0.0f ? -1.0f : 1.0f;
        weighAt(list_, origin + list_.distance[first] * direction, front * normal, front);
        restoreField(radius);
    }

    std::size_t nearest(bool only_kept) const {
        std::size_t best = list_.size();
        float t = std::numeric_limits<float>::infinity();
        for (std::size_t i = 0; i < list_.size(); ++i) {
            if (list_.distance[i] >= t || (only_kept && !list_.kept[i])) continue;
            t = list_.distance[i];
            best = i;
        }
        return best;
    }

    /// Puts the heaviest dropped splats back until the field at the weighed point is the full one's.
    void restoreField(float radius) {
        FieldSums full, pruned;
        for (std::size_t i = 0; i < list_.size(); ++i) {
            if (list_.weight[i] == 0.0f) continue;
            full.add(list_, i);
            if (list_.kept[i]) pruned.add(list_, i);
        }
        if (agree(full, pruned, radius)) return;
        dropped_.clear();
        for (std::size_t i = members_; i < list_.size(); ++i)
            if (!list_.kept[i] && list_.weight[i] > 0.0f) dropped_.push_back(i);
        std::stable_sort(dropped_.begin(), dropped_.end(),
                         [&](std::size_t a, std::size_t b) { return list_.weight[a] > list_.weight[b]; });
        for (const std::size_t i : dropped_) {
            list_.kept[i] = 1;
            pruned.add(list_, i);
            if (agree(full, pruned, radius)) return;
        }
    }

    const PackedSplats& splats_;
    const PruneOptions& options_;
    DiscList list_;
    std::vector<std::uint32_t> splat_of_;
    std::vector<std::size_t> dropped_; ///< scratch of restoreField
    std::size_t members_ = 0;
    Box box_;
};

/// Strings the leaves' kept references together and drops border leaves that have none left.
void rebuild(std::vector<std::vector<std::uint32_t>>& kept_refs, Octree& octree) {
    octree.refs.clear();
    for (auto& refs : kept_refs) octree.refs.insert(octree.refs.end(), refs.begin(), refs.end());
    std::uint32_t first_ref = 0;
    for (Leaf& leaf : octree.leaves) {
        leaf.first_ref = first_ref;
        first_ref += leaf.ref_count;
    }
    std::erase_if(octree.leaves, [](const Leaf& leaf) { return leaf.member_count == 0 && leaf.ref_count == 0; });
}

} // namespace

void pruneOctree(const PackedSplats& splats, const PruneOptions& options, Octree& octree,
                 const OctreeProgress& progress) {
    const std::size_t blocks = (octree.leaves.size() + kBlockLeaves - 1) / kBlockLeaves;
    std::vector<std::vector<std::uint32_t>> kept_refs(blocks);
    tbb::enumerable_thread_specific<LeafPruner> pruners([&] { return LeafPruner(splats, options); });
    TaskProgress finished(progress, blocks);
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        LeafPruner& pruner = pruners.local();
        const std::size_t end = std::min(octree.leaves.size(), (block + 1) * kBlockLeaves);
        for (std::size_t l = block * kBlockLeaves; l < end; ++l) {
            const std::size_t before = kept_refs[block].size();
            pruner.run(octree, octree.leaves[l], kept_refs[block]);
            octree.leaves[l].ref_count = static_cast<std::uint32_t>(kept_refs[block].size() - before);
        }
        finished.finishOne();
    });
    rebuild(kept_refs, octree);
}

} // namespace pointrt
