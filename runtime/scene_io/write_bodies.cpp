// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "runtime/scene_io/read_parts.h"
#include "runtime/scene_io/write_parts.h"

namespace pointrt {
namespace {

/// "#rrggbb", in quotes.
std::string hexOf(const std::array<std::uint8_t, 3>& bytes) {
    char text[16];
    std::snprintf(text, sizeof text, "\"#%02x%02x%02x\"", bytes[0], bytes[1], bytes[2]);
    return text;
}

void writeOverride(SceneWriting& writing, const MaterialOverride& over) {
    begin(writing, "[[instance.override]]");
    if (const auto* row = std::get_if<MaterialOverride::Row>(&over.splats))
        put(writing, "row", tomlOf(row->row));
    else if (const auto* range = std::get_if<MaterialOverride::ColorRange>(&over.splats))
        put(writing, "colors", listOf({hexOf(range->low), hexOf(range->high)}));
    else if (const auto* numbers = std::get_if<SplatSelection>(&over.splats))
        putSelection(writing, *numbers);
    put(writing, "material", tomlOf(writing.material_names.at(over.material)));
}

void writeInstance(SceneWriting& writing, const InstanceDescription& instance) {
    const Placement& placement = instance.placement;
    begin(writing, "[[instance]]");
    put(writing, "file", tomlOf(pathFrom(writing.folder, instance.path)));
    if (placement.scale != 1) put(writing, "scale", tomlOf(placement.scale));
    if (placement.rotation != Placement{}.rotation)
        put(writing, "rotate", "{ matrix = " + tomlOf(placement.rotation) + " }");
    if (placement.translation != Vec3{}) put(writing, "translate", tomlOf(placement.translation));
    if (instance.material) put(writing, "material", tomlOf(writing.material_names.at(*instance.material)));
    if (!instance.clipped) put(writing, "clip", "false");
    if (!instance.colored) put(writing, "colored", "false");
    if (!instance.visible) put(writing, "visible", "false");
    putLayer(writing, instance.layer);
    for (const MaterialOverride& over : instance.overrides) writeOverride(writing, over);
}

/// The radius from which the reader computes exactly the shape's u and v, if any; length(u) up to rounding.
std::optional<double> radiusOfFlat(const ShapeDescription& shape) {
    constexpr int nearby = 8;
    const double step = std::numeric_limits<double>::epsilon() / 2 * length(shape.u);
    for (int i = -nearby; i <= nearby; ++i) {
        const double radius = length(shape.u) + i * step;
        ShapeDescription laid = shape;
        layFlat(laid, shape.w, radius);
        if (laid == shape && isNear(length(shape.w), 1)) return radius;
    }
    return std::nullopt;
}

// Each of these writes the shape's usual keys, and returns false if they cannot represent it exactly.

bool putPlane(SceneWriting& writing, const ShapeDescription& shape) {
    ShapeDescription laid = shape;
    layFlat(laid, shape.w, 1);
    if (laid != shape || !isNear(length(shape.w), 1)) return false;
    put(writing, "point", tomlOf(shape.center));
    put(writing, "normal", tomlOf(shape.w));
    return true;
}

bool putDisc(SceneWriting& writing, const ShapeDescription& shape) {
    const auto radius = radiusOfFlat(shape);
    if (!radius) return false;
    put(writing, "center", tomlOf(shape.center));
    put(writing, "normal", tomlOf(shape.w));
    put(writing, "radius", tomlOf(*radius));
    return true;
}

bool putQuad(SceneWriting& writing, const ShapeDescription& shape) {
    const Vec3 u = normalize(shape.u), v = normalize(shape.v);
    if (shape.w != cross(u, v) || !isNear(2 * dot(u, v), 0))
        return false; // a margin of two, so that the reader is sure to find them near too
    put(writing, "center", tomlOf(shape.center));
    put(writing, "u", tomlOf(shape.u));
    put(writing, "v", tomlOf(shape.v));
    return true;
}

bool putBox(SceneWriting& writing, const ShapeDescription& shape) {
    const Vec3 half{shape.u.x, shape.v.y, shape.w.z};
    if (shape.u != Vec3{half.x, 0, 0} || shape.v != Vec3{0, half.y, 0} || shape.w != Vec3{0, 0, half.z}) return false;
    put(writing, "center", tomlOf(shape.center));
    put(writing, "size", tomlOf(2 * half));
    return true;
}

bool putSphere(SceneWriting& writing, const ShapeDescription& shape) {
    const double r = shape.u.x;
    if (shape.u != Vec3{r, 0, 0} || shape.v != Vec3{0, r, 0} || shape.w != Vec3{0, 0, r}) return false;
    put(writing, "center", tomlOf(shape.center));
    put(writing, "radius", tomlOf(r));
    return true;
}

void writeShape(SceneWriting& writing, const ShapeDescription& shape) {
    struct Kind {
        const char* name;
        bool (*put)(SceneWriting&, const ShapeDescription&);
    };
    constexpr Kind kinds[] = {
        {"plane", putPlane}, {"disc", putDisc}, {"quad", putQuad}, {"box", putBox}, {"sphere", putSphere}};
    const Kind& kind = kinds[static_cast<std::size_t>(shape.kind)];
    begin(writing, "[[shape]]");
    put(writing, "type", std::string("\"") + kind.name + "\"");
    if (!kind.put(writing, shape)) {
        put(writing, "center", tomlOf(shape.center));
        put(writing, "axes", tomlOf({shape.u, shape.v, shape.w}));
    }
    const std::string& material = writing.material_names.at(shape.material);
    if (!material.empty()) put(writing, "material", tomlOf(material));
    if (!shape.seen_by_camera) put(writing, "seen_by_camera", "false");
    if (shape.backdrop) put(writing, "backdrop", "true");
    if (shape.of_surroundings) put(writing, "of_surroundings", "true");
    if (!shape.visible) put(writing, "visible", "false");
    putLayer(writing, shape.layer);
}

} // namespace

void writeInstances(SceneWriting& writing) {
    for (const InstanceDescription& instance : writing.scene.instances)
        if (!instance.deleted) writeInstance(writing, instance);
}

void writeShapes(SceneWriting& writing) {
    for (const ShapeDescription& shape : writing.scene.shapes) writeShape(writing, shape);
}

} // namespace pointrt
