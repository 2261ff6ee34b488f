// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/clip.h"

#include <algorithm>

#include "format/base/error.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

constexpr std::size_t kBoxSides = 6;

/// The two sides of a box that are perpendicular to an axis, a unit vector, at a distance from its centre.
void addSides(Vec3 center, Vec3 axis, double distance, std::vector<HalfSpace>& kept) {
    kept.push_back({center - distance * axis, axis});
    kept.push_back({center + distance * axis, -1.0 * axis});
}

void addForm(const ClipBox& box, std::vector<HalfSpace>& kept) {
    const Vec3 center = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
    const std::array<Vec3, 3>& rows = box.rotation;
    addSides(center, {rows[0].x, rows[1].x, rows[2].x}, half.x, kept);
    addSides(center, {rows[0].y, rows[1].y, rows[2].y}, half.y, kept);
    addSides(center, {rows[0].z, rows[1].z, rows[2].z}, half.z, kept);
}

void addForm(const ClipPlane& plane, std::vector<HalfSpace>& kept) { kept.push_back({plane.point, plane.normal}); }

} // namespace

ClipDescription clipBox(const std::array<double, 6>& ends) {
    return {ClipBox{{ends[0], ends[1], ends[2]}, {ends[3], ends[4], ends[5]}}};
}

std::vector<HalfSpace> keptHalfSpaces(std::span<const ClipDescription> clips) {
    std::vector<HalfSpace> kept;
    for (const ClipDescription& clip : clips)
        if (clip.enabled) std::visit([&](const auto& form) { addForm(form, kept); }, clip.form);
    return kept;
}

std::size_t countHalfSpaces(std::span<const ClipDescription> clips) {
    std::size_t count = 0;
    for (const ClipDescription& clip : clips) count += std::holds_alternative<ClipBox>(clip.form) ? kBoxSides : 1;
    return count;
}

void requireFewHalfSpaces(std::span<const ClipDescription> clips) {
    if (countHalfSpaces(clips) > MAX_CLIP_PLANES)
        throw Error{ExitCode::kBadUsage, "more than 32 clip planes in all; a box counts as six"};
}

HalfSpace nothingKept() {
    constexpr double beyond = 1e13; // ten times the largest coordinate that scene files allow
    return {{beyond, 0, 0}, {1, 0, 0}};
}

bool isKept(std::span<const HalfSpace> kept, Vec3 point) {
    return std::all_of(kept.begin(), kept.end(),
                       [&](const HalfSpace& each) { return dot(each.normal, point - each.point) >= 0; });
}

} // namespace pointrt
