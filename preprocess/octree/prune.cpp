// SPDX-License-Identifier: GPL-3.0-or-later
// Pruning by probe rays, after Kashyap et al. (I3D 2010). The original keeps what the probes hit first and lets
// blending suffer. Here a reference is dropped only while the blended surface that the probes see stays the same
// within a tolerance: members are kept, and for each probe the tentative splats that matter most are added back until
// hit, depth, normal and colour agree with the full list.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "preprocess/octree/blend.h"
#include "preprocess/octree/octree.h"

namespace pointrt {

namespace {

/// Tolerances between the full and the pruned surface, seen by one probe.
constexpr float kDepthToleranceRadii = 0.02f;  ///< along the normal, in radii of the disc hit
constexpr float kNormalToleranceCosine = 0.99985f; ///< 1 degree
constexpr float kColorTolerance = 4.0f;        ///< of 255, in any channel

/// Leaves are shared out in blocks this long.
constexpr std::size_t kBlockLeaves = 256;

/// A probe that starts on a part of a disc outside the leaf tries again this often.
constexpr std::uint32_t kTriesPerProbe = 4;

/// Additive recurrences with the plastic-number family: the k-th of 4 coordinates advances by phi_4^-k,
/// phi_4 = 1.16730397826 the root of x^5 = x + 1 (Roberts 2018). Low discrepancy for any prefix.
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

/// Uniform on the disc, by the square root of the area share.
Vec3f pointOnDisc(const Disc& disc, float u, float v) {
    const Vec3f helper = std::abs(disc.normal.x()) < 0.5f ? Vec3f::UnitX() : Vec3f::UnitY();
    const Vec3f a = disc.normal.cross(helper).normalized(), b = disc.normal.cross(a);
    const float radius = disc.radius * std::sqrt(u), angle = 6.28318530718f * v;
    return disc.center + radius * (std::cos(angle) * a + std::sin(angle) * b);
}

/// Uniform over the sphere: grazing directions are where pruning by first hits opens cracks.
Vec3f sphereDirection(float u, float v) {
    const float z = 1.0f - 2.0f * u, ring = std::sqrt(std::max(0.0f, 1.0f - z * z)), angle = 6.28318530718f * v;
    return {ring * std::cos(angle), ring * std::sin(angle), z};
}

bool contains(const Box& box, const Vec3f& p) {
    return (p.array() >= box.lo.array()).all() && (p.array() <= box.hi.array()).all();
}

/// Length of the ray inside the box, from a point in it backwards (sign -1) or forwards (+1).
float exitDistance(const Box& box, const Vec3f& p, const Vec3f& direction, float sign) {
    float distance = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const float d = sign * direction[axis];
        if (d != 0.0f) distance = std::min(distance, ((d > 0.0f ? box.hi : box.lo)[axis] - p[axis]) / d);
    }
    return std::max(distance, 0.0f);
}

bool agree(const SurfaceHit& full, const SurfaceHit& pruned, const Ray& ray) {
    const float along_normal = std::abs(full.t - pruned.t) * std::abs(full.normal.dot(ray.direction));
    return along_normal <= kDepthToleranceRadii * full.radius && full.normal.dot(pruned.normal) >= kNormalToleranceCosine &&
           (full.color - pruned.color).cwiseAbs().maxCoeff() <= kColorTolerance;
}

/// The tentative splat to add back: the one hit first, then by weight at the full list's first hit.
std::size_t mostMissed(const DiscList& list, const SurfaceHit& full, const Vec3f& point) {
    if (!list.kept[full.first]) return full.first;
    std::size_t best = list.discs.size();
    float best_weight = 0;
    for (std::size_t i = 0; i < list.discs.size(); ++i) {
        float height;
        const float weight = list.kept[i] ? 0.0f : blendWeight(list.discs[i], point, height);
        if (weight > best_weight) {
            best_weight = weight;
            best = i;
        }
    }
    return best;
}

void probe(DiscList& list, const Box& box, const Vec3f& point, const Vec3f& direction) {
    const float back = exitDistance(box, point, direction, -1.0f), ahead = exitDistance(box, point, direction, 1.0f);
    const Ray ray{point - back * direction, direction};
    SurfaceHit full, pruned;
    if (!intersectBlended(list, ray, 0.0f, back + ahead, false, full)) return;
    const float first_t = [&] { // the blend moved t on; weights are taken where the first disc was hit
        const Disc& first = list.discs[full.first];
        return first.normal.dot(first.center - ray.origin) / first.normal.dot(direction);
    }();
    while (!intersectBlended(list, ray, 0.0f, back + ahead, true, pruned) || !agree(full, pruned, ray)) {
        const std::size_t missed = mostMissed(list, full, ray.origin + first_t * direction);
        if (missed == list.discs.size()) return; // what differs is not a dropped splat's doing
        list.kept[missed] = 1;
    }
}

DiscList gatherList(const PackedSplats& splats, const Octree& octree, const Leaf& leaf) {
    DiscList list;
    list.oriented = (splats.frame.flags & PRO_FLAG_ORIENTED) != 0;
    const auto add = [&](std::uint32_t s, bool member) {
        list.discs.push_back(splats.discs[s]);
        list.kept.push_back(member);
        if (!splats.colors.empty())
            list.colors.emplace_back(splats.colors[s][0], splats.colors[s][1], splats.colors[s][2]);
    };
    for (std::uint32_t m = 0; m < leaf.member_count; ++m) add(leaf.first_member + m, true);
    for (std::uint32_t r = 0; r < leaf.ref_count; ++r) add(octree.refs[leaf.first_ref + r], false);
    return list;
}

void runProbes(DiscList& list, const Box& box, const PruneOptions& options, std::uint64_t leaf_code) {
    ProbeSequence sequence(options.seed, leaf_code);
    for (std::uint32_t p = 0; p < options.probe_rays; ++p) {
        const Disc& target = list.discs[p % list.discs.size()];
        for (std::uint32_t attempt = 0; attempt < kTriesPerProbe; ++attempt) {
            const auto sample = sequence.next();
            const Vec3f point = pointOnDisc(target, sample[0], sample[1]);
            if (!contains(box, point)) continue;
            probe(list, box, point, sphereDirection(sample[2], sample[3]));
            break;
        }
    }
}

} // namespace

void pruneOctree(const PackedSplats& splats, const PruneOptions& options, Octree& octree, const OctreeProgress& progress) {
    const std::size_t blocks = (octree.leaves.size() + kBlockLeaves - 1) / kBlockLeaves;
    std::vector<std::vector<std::uint32_t>> kept_refs(blocks);
    std::size_t done = 0;
    std::mutex progress_mutex;
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        const std::size_t end = std::min(octree.leaves.size(), (block + 1) * kBlockLeaves);
        for (std::size_t l = block * kBlockLeaves; l < end; ++l) {
            Leaf& leaf = octree.leaves[l];
            DiscList list = gatherList(splats, octree, leaf);
            runProbes(list, cellBox(leaf.cell), options, leaf.cell.code);
            std::uint32_t kept = 0;
            for (std::uint32_t r = 0; r < leaf.ref_count; ++r) {
                if (!list.kept[leaf.member_count + r]) continue;
                kept_refs[block].push_back(octree.refs[leaf.first_ref + r]);
                ++kept;
            }
            leaf.ref_count = kept;
        }
        if (!progress) return;
        const std::lock_guard lock(progress_mutex);
        progress(static_cast<double>(++done) / static_cast<double>(blocks));
    });
    octree.refs.clear();
    for (auto& refs : kept_refs) octree.refs.insert(octree.refs.end(), refs.begin(), refs.end());
    std::uint32_t first_ref = 0;
    for (Leaf& leaf : octree.leaves) {
        leaf.first_ref = first_ref;
        first_ref += leaf.ref_count;
    }
    std::erase_if(octree.leaves, [](const Leaf& leaf) { return leaf.member_count == 0 && leaf.ref_count == 0; });
}

} // namespace pointrt
