// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/section_hits.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "runtime/measure/near_points.h"

namespace pointrt {
namespace {

constexpr double kSameAlong = 0.6, kSameAcross = 1; ///< in steps: largest distance of hits to merge
/// In steps, largest distance of hits to link: rays are one step apart, those on slopes of 45 degrees meet a line every
/// 1.4 steps, and one hit may be missing.
constexpr double kLinkReach = 2.5;
constexpr double kSameDirection = 0.866; ///< cos(30 degrees)
constexpr double kLinkDirection = 0.7;   ///< cos(45 degrees): largest angle between tangents of linked hits
/// Cos(60 degrees): largest angle between a tangent and the direction to the neighbour.
constexpr double kLinkSlope = 0.5;

std::vector<Vec2> positionsOf(std::span<const SectionHit> hits) {
    std::vector<Vec2> positions;
    positions.reserve(hits.size());
    for (const SectionHit& hit : hits) positions.push_back(hit.at);
    return positions;
}

bool isSamePiece(const SectionHit& a, const SectionHit& b, double step) {
    const Vec2 d = b.at - a.at;
    return std::abs(dot(a.along, d)) <= kSameAlong * step && std::abs(cross(a.along, d)) <= kSameAcross * step &&
           std::abs(dot(a.along, b.along)) >= kSameDirection;
}

/// The sides of a hit: backwards and forwards along its tangent.
enum Side : std::uint8_t { kBack, kAhead };

struct Link {
    double distance = 0;
    std::uint32_t a = 0, b = 0;
    Side side_a = kBack, side_b = kBack;
};

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
using Neighbours = std::array<std::uint32_t, 2>; ///< by side

std::vector<Link> possibleLinks(std::span<const SectionHit> hits, double step) {
    std::vector<Link> links;
    const std::vector<Vec2> positions = positionsOf(hits);
    const NearPoints near(positions, kLinkReach * step);
    for (std::uint32_t a = 0; a < hits.size(); ++a)
        near.forNear(hits[a].at, [&](std::uint32_t b) {
            if (b <= a || std::abs(dot(hits[a].along, hits[b].along)) < kLinkDirection) return;
            const Vec2 d = hits[b].at - hits[a].at;
            const double distance = length(d), from_a = dot(hits[a].along, d), from_b = -dot(hits[b].along, d);
            if (std::min(std::abs(from_a), std::abs(from_b)) < kLinkSlope * distance) return;
            links.push_back({distance, a, b, from_a > 0 ? kAhead : kBack, from_b > 0 ? kAhead : kBack});
        });
    std::ranges::stable_sort(links, {}, &Link::distance);
    return links;
}

/// Removes the line that starts at a hit from the neighbours and returns it.
PlaneLine followed(std::uint32_t start, std::span<const SectionHit> hits, std::span<Neighbours> neighbours) {
    PlaneLine line;
    for (std::uint32_t at = start; at != kNobody;) {
        line.points.push_back(hits[at].at);
        Neighbours& here = neighbours[at];
        const std::uint32_t next = here[kAhead] != kNobody ? here[kAhead] : here[kBack];
        here = {kNobody, kNobody};
        if (next != kNobody)
            for (std::uint32_t& back : neighbours[next])
                if (back == at) back = kNobody;
        at = next;
    }
    return line;
}

} // namespace

std::vector<SectionHit> thinHits(std::span<const SectionHit> hits, double step) {
    const std::vector<Vec2> positions = positionsOf(hits);
    const NearPoints near(positions, std::hypot(kSameAlong, kSameAcross) * step);
    std::vector<bool> is_merged(hits.size());
    std::vector<SectionHit> thin;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (is_merged[i]) continue;
        SectionHit sum{{}, {}};
        double count = 0;
        near.forNear(hits[i].at, [&](std::uint32_t k) {
            if (is_merged[k] || !isSamePiece(hits[i], hits[k], step)) return;
            is_merged[k] = true;
            sum.at = sum.at + hits[k].at;
            sum.along = sum.along + (dot(hits[i].along, hits[k].along) < 0 ? -1.0 : 1.0) * hits[k].along;
            ++count;
        });
        thin.push_back({(1 / count) * sum.at, (1 / length(sum.along)) * sum.along});
    }
    return thin;
}

std::vector<PlaneLine> linkHits(std::span<const SectionHit> hits, double step) {
    std::vector<Neighbours> neighbours(hits.size(), Neighbours{kNobody, kNobody});
    for (const Link& link : possibleLinks(hits, step)) {
        std::uint32_t &of_a = neighbours[link.a][link.side_a], &of_b = neighbours[link.b][link.side_b];
        if (of_a != kNobody || of_b != kNobody) continue;
        of_a = link.b;
        of_b = link.a;
    }
    std::vector<PlaneLine> lines;
    const auto hasOne = [&](const Neighbours& n) { return (n[kBack] == kNobody) != (n[kAhead] == kNobody); };
    for (std::uint32_t i = 0; i < hits.size(); ++i)
        if (hasOne(neighbours[i])) lines.push_back(followed(i, hits, neighbours));
    for (std::uint32_t i = 0; i < hits.size(); ++i) // the remaining hits form loops
        if (neighbours[i][kAhead] != kNobody) {
            lines.push_back(followed(i, hits, neighbours));
            lines.back().closed = true;
        }
    return lines;
}

} // namespace pointrt
