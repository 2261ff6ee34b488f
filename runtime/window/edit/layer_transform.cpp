// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/layer_transform.h"

#include <numbers>
#include <variant>

#include "runtime/util/overloaded.h"
#include "runtime/window/edit/placement_edit.h"
#include "runtime/window/input/turntable_rotation.h"

namespace pointrt {
namespace {

Vec3 middleOf(const ClipDescription& clip) {
    if (const auto* plane = std::get_if<ClipPlane>(&clip.form)) return plane->point;
    const ClipBox& box = std::get<ClipBox>(clip.form);
    return 0.5 * (box.low + box.high);
}

/// Calls move(position) if the light has a position: suns have none.
template <typename Move>
void visitPosition(LightDescription& light, const Move& move) {
    const auto visit = Overloaded{[&](PositionField field) { move(field.value); }, [](const auto&) {}};
    std::visit([&](auto& each) { each.eachField(visit); }, light);
}

std::optional<Vec3> positionOf(LightDescription light) {
    std::optional<Vec3> found;
    visitPosition(light, [&](Vec3 position) { found = position; });
    return found;
}

/// Calls turn(v) for each direction of a light.
template <typename Turn>
void visitDirections(LightDescription& light, const Turn& turn) {
    const auto visit =
        Overloaded{[&](AimField field) { turn(field.value); }, [&](SunwardField field) { turn(field.value); },
                   [&](HalfEdgesField field) {
                       turn(field.u);
                       turn(field.v);
                   },
                   [](const auto&) {}};
    std::visit([&](auto& each) { each.eachField(visit); }, light);
}

bool hasDirections(LightDescription light) {
    bool found = false;
    visitDirections(light, [&](Vec3&) { found = true; });
    return found;
}

/// Calls turn(v) for each direction of the clip.
template <typename Turn>
void turnClip(ClipDescription& clip, const Turn& turn) {
    if (auto* plane = std::get_if<ClipPlane>(&clip.form)) return turn(plane->normal);
    ClipBox& box = std::get<ClipBox>(clip.form);
    box.rotation = turnedColumns(box.rotation, turn);
}

} // namespace

std::optional<Vec3> layerMiddle(const SceneDescription& scene, LayerId id, std::span<const Vec3> scan_centres) {
    switch (id.kind) {
    case LayerKind::kScan:
        if (id.number >= scan_centres.size()) return std::nullopt;
        return placed(scene.instances.at(id.number).placement, scan_centres[id.number]);
    case LayerKind::kShape:
        return scene.shapes.at(id.number).center;
    case LayerKind::kClip:
        return middleOf(scene.clips.at(id.number));
    case LayerKind::kLight:
        return positionOf(scene.lights.at(id.number));
    case LayerKind::kMeasure:
        return std::nullopt;
    }
    return std::nullopt;
}

void moveLayer(SceneDescription& scene, LayerId id, Vec3 by) {
    const auto move = [&](Vec3& place) { place = place + by; };
    switch (id.kind) {
    case LayerKind::kScan:
        return move(scene.instances.at(id.number).placement.translation);
    case LayerKind::kShape:
        return move(scene.shapes.at(id.number).center);
    case LayerKind::kClip:
        return std::visit(Overloaded{[&](ClipPlane& plane) { move(plane.point); },
                                     [&](ClipBox& box) {
                                         move(box.low);
                                         move(box.high);
                                     }},
                          scene.clips.at(id.number).form);
    case LayerKind::kLight:
        return visitPosition(scene.lights.at(id.number), move);
    case LayerKind::kMeasure:
        return;
    }
}

bool mayTurn(const SceneDescription& scene, LayerId id) {
    switch (id.kind) {
    case LayerKind::kScan:
    case LayerKind::kClip:
        return true;
    case LayerKind::kShape:
        return scene.shapes.at(id.number).kind != ShapeKind::kSphere;
    case LayerKind::kLight:
        return hasDirections(scene.lights.at(id.number));
    case LayerKind::kMeasure:
        return false;
    }
    return false;
}

void turnLayer(SceneDescription& scene, LayerId id, Vec3 axis, double degrees, std::span<const Vec3> scan_centres) {
    const auto turn = [&](Vec3& v) { v = rotated(v, axis, degrees * std::numbers::pi / 180); };
    switch (id.kind) {
    case LayerKind::kScan: {
        Placement& placement = scene.instances.at(id.number).placement;
        placement = turned(placement, scan_centres[id.number], axis, degrees);
        return;
    }
    case LayerKind::kShape: {
        ShapeDescription& shape = scene.shapes.at(id.number);
        for (Vec3* edge : {&shape.u, &shape.v, &shape.w}) turn(*edge);
        return;
    }
    case LayerKind::kClip:
        return turnClip(scene.clips.at(id.number), turn);
    case LayerKind::kLight:
        return visitDirections(scene.lights.at(id.number), turn);
    case LayerKind::kMeasure:
        return;
    }
}

} // namespace pointrt
