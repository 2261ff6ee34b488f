// SPDX-License-Identifier: GPL-3.0-or-later
// Based on Kashyap et al. (I3D 2010), who keep the splats that probe rays hit first, at the cost of blending errors.
// Here, a geometric test keeps the splats that a leaf certainly needs, and probes compare the first hit and the blended
// surface with and without the others.
#include "preprocess/octree/leaf_pruner.h"

#include <algorithm>

#include "format/base/blend_weight.h"

namespace pointrt {

namespace {

/// Tolerances of probes for the pruned surface.
constexpr float kHitTolerance = 0.01f;             ///< in radii along the probe, for discs and the blended surface
constexpr float kNormalToleranceCosine = 0.99998f; ///< 0.36 degrees
constexpr float kColorTolerance = 4.0f;            ///< of 255, in any channel

/// Points tried per probe. A third of them lie in the leaf; all 8 fail only if hardly any disc area is in it.
constexpr std::uint32_t kTriesPerProbe = 8;

/// A disc that reaches into the leaf by less than this fraction of its radius is a sliver. Its area there is at most
/// 4/3 sqrt(2) 0.01^1.5 = 0.2 % of the squared radius, 1/50,000 of the surface in a typical leaf.
constexpr float kSliver = 0.01f;

/// The Newton step along the ray to the field's zero, at most one radius: newtonStep of shaders/trace/blend.glsl.
float newtonStep(const FieldSums& field, const Vec3f& direction, float radius) {
    const float slope = field.normal.dot(direction);
    const float step = slope == 0.0f ? 0.0f : -field.height / slope;
    return std::clamp(step, -radius, radius);
}

bool similarNormals(const Vec3f& a, const Vec3f& b) {
    const float cosine = a.dot(b);
    constexpr float kSquared = kNormalToleranceCosine * kNormalToleranceCosine;
    return cosine > 0.0f && cosine * cosine >= kSquared * a.squaredNorm() * b.squaredNorm();
}

/// Whether more than a sliver of the disc or ball lies in the box.
bool visiblyCrosses(const Disc& disc, const Box& box) {
    const float reach = (1.0f - kSliver) * disc.radius;
    return sectionDistanceSquared(disc, box) < reach * reach;
}

} // namespace

LeafPruner::LeafPruner(const PackedSplats& splats) : splats_(splats) {
    list_.oriented = (splats.frame.flags & PRO_FLAG_ORIENTED) != 0;
    list_.colored = !splats.colors.empty();
}

void LeafPruner::gather(const Octree& octree, const Leaf& leaf, std::span<const std::uint8_t> kept) {
    list_.clear();
    splat_of_.clear();
    members_ = leaf.member_count;
    box_ = cellBox(leaf.cell);
    for (std::uint32_t k = 0; k < leaf.member_count + leaf.ref_count; ++k) {
        const bool member = k < leaf.member_count;
        const std::uint32_t splat =
            member ? leaf.first_member + k : octree.refs[leaf.first_ref + k - leaf.member_count];
        Vec3f color = Vec3f::Zero();
        if (list_.colored)
            for (int c = 0; c < 3; ++c) color[c] = splats_.colors[splat][static_cast<std::size_t>(c)];
        list_.add(splats_.discs[splat], color, member || kept[k - leaf.member_count]);
        splat_of_.push_back(splat);
    }
    list_.pad();
}

Audit LeafPruner::run(const Octree& octree, const Leaf& leaf, float cutoff, ProbeSequence sequence,
                      std::uint32_t probes, std::span<std::uint8_t> kept) {
    gather(octree, leaf, kept);
    keepNeeded(cutoff);
    const Audit result = audit(sequence, probes);
    for (std::size_t r = 0; r < kept.size(); ++r) kept[r] = list_.kept[members_ + r] > 0.0f;
    return result;
}

/// Keeps discs that cross the leaf visibly or have a weight above cutoff somewhere in it. Balls have no weight.
void LeafPruner::keepNeeded(float cutoff) {
    for (std::size_t i = members_; i < list_.size(); ++i) {
        const Disc& disc = splats_.discs[splat_of_[i]];
        const bool needed =
            visiblyCrosses(disc, box_) ||
            (!disc.isBall() && weightAt(disc, heaviestPoint(disc, box_, kBlendSlab), kBlendSlab) > cutoff);
        if (needed) list_.kept[i] = 1.0f;
    }
}

/// Probes through random points of the leaf's discs in random directions.
Audit LeafPruner::audit(ProbeSequence& sequence, std::uint32_t probes) {
    Audit result;
    for (std::uint32_t tries = kTriesPerProbe * probes; tries > 0 && result.probes < probes; --tries) {
        const auto sample = sequence.next();
        const auto pick = static_cast<std::size_t>(sample[4] * static_cast<float>(splat_of_.size()));
        const Disc& disc = splats_.discs[splat_of_[std::min(pick, splat_of_.size() - 1)]];
        const Vec3f point = pointOnDisc(disc, sample[0], sample[1]);
        if (!contains(box_, point)) continue;
        ++result.probes;
        result.changes += !probe(chordThrough(box_, point, sphereDirection(sample[2], sample[3])));
    }
    return result;
}

/// Casts a probe ray. Compares its first hit, and the blended surface there, with and without the dropped discs, and
/// restores discs until they agree. Returns false if a disc was restored.
bool LeafPruner::probe(const Chord& chord) {
    const FirstHits hits = castRay(list_, chord.origin, chord.direction, chord.length);
    if (std::isinf(hits.any)) return true;
    const auto first = static_cast<std::size_t>(std::find(list_.distance.begin(), list_.distance.end(), hits.any) -
                                                list_.distance.begin());
    FirstHit hit{chord, first, hits.any, list_.radiusOf(first), list_.normalOf(first), 1.0f};
    if (hit.normal.dot(chord.direction) > 0.0f) hit.front = -1.0f;
    hit.normal *= hit.front;
    bool same = hits.kept - hits.any <= kHitTolerance * hit.radius;
    if (!same) list_.kept[first] = 1.0f;
    if (hit.normal.isZero(0)) return same; // a ball, which does not blend
    while (!blendsAlike(hit)) {
        same = false;
        list_.kept[heaviest_dropped_] = 1.0f;
    }
    return same;
}

/// Whether the blended surface is the same without the dropped discs. If not, heaviest_dropped_ is the disc to restore
/// first.
bool LeafPruner::blendsAlike(const FirstHit& hit) {
    heaviest_ = 0.0f;
    if (!weighDropped(hit, hit.t)) {
        const FieldSums field = fieldAround(hit, false);
        const float t = hit.t + newtonStep(field, hit.chord.direction, hit.radius);
        if (!contains(box_, hit.chord.at(t)) || !weighDropped(hit, t)) return true;
    }
    const Blended all = blend(hit, false), kept = blend(hit, true);
    if (std::abs(all.t - kept.t) > kHitTolerance * hit.radius) return false;
    if (!similarNormals(all.field.normal, kept.field.normal)) return false;
    const Vec3f color = all.field.color / all.field.weight - kept.field.color / kept.field.weight;
    return color.cwiseAbs().maxCoeff() <= kColorTolerance; // all 0 in clouds without colours
}

/// Computes the weights at t along the ray. Returns whether a dropped disc has a weight there.
bool LeafPruner::weighDropped(const FirstHit& hit, float t) {
    const float dropped = weighAt(list_, hit.chord.at(t), hit.normal, hit.front);
    if (dropped <= 0.0f) return false;
    for (std::size_t i = members_; i < list_.size(); ++i) {
        if (list_.kept[i] > 0.0f || list_.weight[i] <= heaviest_) continue;
        heaviest_ = list_.weight[i];
        heaviest_dropped_ = i;
    }
    return true;
}

/// The sums at the point of the last weighDropped, raised to the minimum weight: addFloorWeight of
/// shaders/trace/blend.glsl.
FieldSums LeafPruner::fieldAround(const FirstHit& hit, bool only_kept) const {
    FieldSums field = sumField(list_, only_kept);
    const float missing = std::max(BLEND_WEIGHT_FLOOR - field.weight, 0.0f);
    field.weight += missing;
    field.height += missing * list_.height[hit.disc];
    field.normal += missing * hit.normal;
    field.color += missing * list_.colorOf(hit.disc);
    return field;
}

/// surfaceAt of shaders/trace/blend.glsl: two Newton steps along the ray.
LeafPruner::Blended LeafPruner::blend(const FirstHit& hit, bool only_kept) {
    const Vec3f& direction = hit.chord.direction;
    weighDropped(hit, hit.t);
    FieldSums field = fieldAround(hit, only_kept);
    const float step = newtonStep(field, direction, hit.radius);
    // a hit outside is decided in the next leaf
    if (!contains(box_, hit.chord.at(hit.t + step))) return {hit.t + step, field};
    weighDropped(hit, hit.t + step);
    field = fieldAround(hit, only_kept);
    const float last = step + newtonStep(field, direction, hit.radius);
    return {hit.t + std::clamp(last, -hit.radius, hit.radius), field};
}

} // namespace pointrt
