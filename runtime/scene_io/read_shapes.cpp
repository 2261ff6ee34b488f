// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "runtime/scene/material_fields.h"
#include "runtime/scene_io/read_parts.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

/// Any unit vector perpendicular to normal, a unit vector.
Vec3 besides(Vec3 normal) {
    const Vec3 axis = std::abs(normal.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return normalize(axis - normal * dot(axis, normal));
}

void readPlane(const SceneValue& table, ShapeDescription& shape) {
    forbid(table, {"center"}, "has no effect without \"axes\"; a plane has a \"point\"");
    shape.center = vectorOf(require(table, "point"));
    layFlat(shape, directionOf(require(table, "normal")), 1);
}

void readDisc(const SceneValue& table, ShapeDescription& shape) {
    shape.center = vectorOf(require(table, "center"));
    layFlat(shape, directionOf(require(table, "normal")), numberOf(require(table, "radius"), kLengths));
}

void readQuad(const SceneValue& table, ShapeDescription& shape) {
    shape.center = vectorOf(require(table, "center"));
    const HalfEdges edges = halfEdgesOf(table);
    shape.u = edges.u;
    shape.v = edges.v;
    shape.w = cross(normalize(edges.u), normalize(edges.v));
}

/// Half of each edge length.
Vec3 halfSizeOf(const SceneValue& table, ShapeDescription& shape) {
    if (find(table, "center")) {
        forbid(table, {"min", "max"}, "cannot be combined with \"center\"");
        shape.center = vectorOf(require(table, "center"));
        return vectorOf(require(table, "size"), kLengths) * 0.5;
    }
    forbid(table, {"size"}, "has no effect without \"center\"");
    const Vec3 low = vectorOf(require(table, "min"));
    const Vec3 high = vectorOf(require(table, "max")), half = (high - low) * 0.5;
    if (std::min({half.x, half.y, half.z}) < kSmallest / 2)
        refuse(*find(table, "max"), "must be above \"min\" in x, y and z");
    shape.center = low + half;
    return half;
}

void readBox(const SceneValue& table, ShapeDescription& shape) {
    const Vec3 half = halfSizeOf(table, shape);
    std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    if (const auto rotate = find(table, "rotate")) rows = rotationOf(*rotate);
    shape.u = Vec3{rows[0].x, rows[1].x, rows[2].x} * half.x;
    shape.v = Vec3{rows[0].y, rows[1].y, rows[2].y} * half.y;
    shape.w = Vec3{rows[0].z, rows[1].z, rows[2].z} * half.z;
}

void readSphere(const SceneValue& table, ShapeDescription& shape) {
    shape.center = vectorOf(require(table, "center"));
    const double radius = numberOf(require(table, "radius"), kLengths);
    shape.u = Vec3{radius, 0, 0};
    shape.v = Vec3{0, radius, 0};
    shape.w = Vec3{0, 0, radius};
}

bool areAlike(double a, double b) { return std::abs(a - b) <= kAxesError * std::max(a, b); }

/// Reads u, v and w unchanged, if they suit the shape (scene_description.h): orthogonal and right-handed; for planes,
/// discs and quads, w of unit length; for planes and discs, u and v of equal length; for spheres, all of equal length.
void readAxes(const SceneValue& table, const SceneValue& axes, ShapeDescription& shape) {
    forbid(table, {"point", "normal", "radius", "u", "v", "min", "max", "size", "rotate"},
           "cannot be combined with \"axes\"");
    shape.center = vectorOf(require(table, "center"));
    const std::array<Vec3, 3> rows = rowsOf(axes);
    shape.u = rows[0];
    shape.v = rows[1];
    shape.w = rows[2];
    const double u = length(shape.u), v = length(shape.v), w = length(shape.w);
    if (std::min({u, v, w}) < kSmallest) refuse(axes, "an axis of length zero has no direction");
    const bool flat = shape.kind != ShapeKind::kBox && shape.kind != ShapeKind::kSphere;
    const bool round = shape.kind != ShapeKind::kBox && shape.kind != ShapeKind::kQuad;
    if (!areRightAngled({shape.u * (1 / u), shape.v * (1 / v), shape.w * (1 / w)}))
        refuse(axes, "must be perpendicular and right-handed");
    if (flat && !areAlike(w, 1)) refuse(axes, "the third is the normal, and must have length 1");
    if (round && !areAlike(u, v)) refuse(axes, "the first two must have the same length");
    if (shape.kind == ShapeKind::kSphere && !areAlike(u, w)) refuse(axes, "must have the same length, the radius");
}

struct ShapeRow {
    ShapeKind kind;
    std::string_view name;
    std::vector<std::string_view> keys;
    void (*read)(const SceneValue&, ShapeDescription&);
};

const std::vector<ShapeRow>& kinds() {
    static const std::vector<ShapeRow> all = {
        {ShapeKind::kPlane, "plane", {"point", "normal"}, readPlane},
        {ShapeKind::kDisc, "disc", {"normal", "radius"}, readDisc},
        {ShapeKind::kQuad, "quad", {"u", "v"}, readQuad},
        {ShapeKind::kBox, "box", {"min", "max", "size", "rotate"}, readBox},
        {ShapeKind::kSphere, "sphere", {"radius"}, readSphere},
    };
    return all;
}

/// The number of the default material for shapes, which is created on first use.
std::uint32_t defaultMaterial(const SceneValue& table, SceneReading& reading) {
    auto& materials = reading.scene.materials;
    const auto [found, is_new] = reading.material_of_name.try_emplace("", static_cast<std::uint32_t>(materials.size()));
    if (is_new && materials.size() == kMaxMaterials)
        refuse(table, "\"material\" is missing, and the scene already has 256 materials, so no default can be added");
    if (is_new) materials.emplace_back();
    return found->second;
}

std::uint32_t shapeMaterial(const SceneValue& table, SceneReading& reading) {
    const auto value = find(table, "material");
    if (!value) return defaultMaterial(table, reading);
    const std::uint32_t material = materialOf(*value, reading);
    if (reading.uncolored_materials.count(material))
        refuse(*value, "needs a \"color\": shapes have no splats to take colours from");
    return material;
}

ShapeDescription shapeOf(const SceneValue& table, SceneReading& reading) {
    std::vector<std::string_view> names;
    for (const ShapeRow& each : kinds()) names.push_back(each.name);
    const ShapeRow& kind = kinds()[choiceOf(require(table, "type"), names)];
    std::vector<std::string_view> keys = {"type", "material", "seen_by_camera", "backdrop", "of_surroundings",
                                          "name", "visible",  "locked",         "center",   "axes"};
    keys.insert(keys.end(), kind.keys.begin(), kind.keys.end());
    requireKnownKeys(table, "a " + std::string(kind.name), keys);

    ShapeDescription shape;
    shape.kind = kind.kind;
    if (const auto axes = find(table, "axes"))
        readAxes(table, *axes, shape);
    else
        kind.read(table, shape);
    shape.material = shapeMaterial(table, reading);
    takeFlag(table, "seen_by_camera", shape.seen_by_camera);
    takeFlag(table, "backdrop", shape.backdrop);
    takeFlag(table, "of_surroundings", shape.of_surroundings);
    takeFlag(table, "visible", shape.visible);
    takeLayer(table, shape.layer);
    return shape;
}

/// "sphere and quad lights": the lights with a surface.
std::string lampsInWords() {
    std::vector<std::string_view> types;
    for (std::size_t kind = 0; kind < kLightKinds; ++kind)
        if (hasSurface(kind)) types.push_back(namesOf(kind).type);
    const std::string last(types.back());
    types.pop_back();
    return joined(types) + " and " + last + " lights";
}

} // namespace

void layFlat(ShapeDescription& shape, Vec3 normal, double half) {
    shape.w = normal;
    shape.u = besides(normal) * half;
    shape.v = cross(normal, shape.u);
}

HalfEdges halfEdgesOf(const SceneValue& table) {
    const SceneValue u_value = require(table, "u"), v_value = require(table, "v");
    const Vec3 along_u = directionOf(u_value), along_v = directionOf(v_value);
    // three digits in the file are enough; v is then made exactly perpendicular
    constexpr double most_cosine = 1e-3;
    const double cosine = dot(along_u, along_v);
    if (std::abs(cosine) > most_cosine) refuse(v_value, "must be at right angles to \"u\"");
    const Vec3 u = vectorOf(u_value), v = vectorOf(v_value);
    return {u, isNear(cosine, 0) ? v : normalize(along_v - along_u * cosine) * length(v)};
}

void requireRoomForShape(const SceneValue& value, const SceneReading& reading) {
    const std::size_t shapes = reading.scene.shapes.size() + countSurfaces(reading.scene.lights);
    if (shapes >= MAX_SHAPES) refuse(value, "more than 64 shapes, counting " + lampsInWords());
}

void readShapes(const SceneValue& file, SceneReading& reading) {
    for (const SceneValue& table : findTables(file, "shape")) {
        requireRoomForShape(table, reading);
        reading.scene.shapes.push_back(shapeOf(table, reading));
    }
}

} // namespace pointrt
