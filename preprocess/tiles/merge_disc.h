// SPDX-License-Identifier: GPL-3.0-or-later
// Several discs as one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Discs to be merged; any unit of length.
struct MergeDiscs {
    std::vector<Vec3f> positions, normals; ///< unit length
    std::vector<float> radii;
};

struct MergedDisc {
    Vec3f position, normal;
    float radius = 0;
    float error = 0; ///< Hausdorff distance between this disc and its members, by their rims
};

/// Members on different sides of a surface, or of a sharp edge, are not merged: the cosine of 60 degrees.
constexpr float kSameSide = 0.5f;

/// Groups members by the side that their normals face: each joins the group whose mean is nearest, if that is within
/// kSameSide, or begins a new one. [members] the group of each, from 0, in order of their first members.
/// @param oriented else a normal and its opposite are the same side
std::vector<std::uint32_t> groupBySide(const MergeDiscs& discs, std::span<const std::uint32_t> members, bool oriented);

/// Splits a group where its members' discs reach more than twice as far along their line as across it, and the halves
/// again: a disc that covers all of a stick sticks out on both sides. Appends the groups' sizes; members are put in
/// order of the groups.
void splitLong(const MergeDiscs& discs, std::span<std::uint32_t> members, std::vector<std::uint32_t>& sizes);

/// Position and normal are the means by area. Where the members lie in a plane, side by side, the disc covers what
/// of theirs closes the surface, so that it stays closed. Elsewhere, as in a tree, its area is the sum of theirs but
/// for what they hide of each other, as far as they reach: a ray of any direction then meets it as often as it met
/// them.
MergedDisc mergeDiscs(const MergeDiscs& discs, std::span<const std::uint32_t> members, bool oriented);

} // namespace pointrt
