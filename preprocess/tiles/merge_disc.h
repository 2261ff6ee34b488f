// SPDX-License-Identifier: GPL-3.0-or-later
// Merges several discs into one, and several balls.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Discs to be merged; any unit of length.
struct MergeDiscs {
    std::vector<Vec3f> positions, normals; ///< normals have unit length; 0 for balls
    std::vector<float> radii;
};

struct MergedDisc {
    Vec3f position, normal; ///< as in MergeDiscs
    float radius = 0;
    float error = 0; ///< Hausdorff distance between this disc and its members, from their rims
};

/// Cosine of 60 degrees: members on different sides of a surface or a sharp edge are not merged.
constexpr float kSameSide = 0.5f;

/// Groups members by the direction of their normals: each joins the group with the nearest mean, if that is within
/// kSameSide, or starts a new one. Balls have a group of their own. Returns [members] the group of each, numbered from
/// 0 by their first members.
/// @param oriented false: a normal and its opposite are the same side
std::vector<std::uint32_t> groupBySide(const MergeDiscs& discs, std::span<const std::uint32_t> members, bool oriented);

/// Splits a group whose discs extend more than twice as far along their main axis as across it, recursively: a disc
/// that covers a stick would protrude on both sides. Appends the groups' sizes and sorts members by group.
void splitLong(const MergeDiscs& discs, std::span<std::uint32_t> members, std::vector<std::uint32_t>& sizes);

/// Position and normal are area-weighted means. If the members lie side by side in a plane, the disc covers the parts
/// of theirs that close the surface, so that it stays closed. Otherwise, as in a tree, its area is the sum of theirs
/// minus their mutual occlusion, limited to their extent: a ray of any direction then hits it as often as it hit them.
/// The latter also holds for balls, which become a ball.
MergedDisc mergeDiscs(const MergeDiscs& discs, std::span<const std::uint32_t> members, bool oriented);

} // namespace pointrt
