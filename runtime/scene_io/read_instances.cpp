// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "runtime/scene_io/read_parts.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {
namespace {

using Matrix = std::array<Vec3, 3>; // rows

constexpr std::size_t kMaxInstances = 254;

Vec3 times(const Matrix& matrix, Vec3 v) { return {dot(matrix[0], v), dot(matrix[1], v), dot(matrix[2], v)}; }

/// The product second * first.
Matrix chained(const Matrix& second, const Matrix& first) {
    const Vec3 x = times(second, {first[0].x, first[1].x, first[2].x});
    const Vec3 y = times(second, {first[0].y, first[1].y, first[2].y});
    const Vec3 z = times(second, {first[0].z, first[1].z, first[2].z});
    return {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
}

/// The rotation about axis (unit length), counterclockwise if the axis points at the viewer: Rodrigues' formula.
Matrix turn(Vec3 axis, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle);
    auto row = [&](double along, Vec3 unit) { return axis * (along * (1 - c)) + unit * c + cross(unit, axis) * s; };
    return {row(axis.x, {1, 0, 0}), row(axis.y, {0, 1, 0}), row(axis.z, {0, 0, 1})};
}

Matrix matrixOf(const SceneValue& matrix) {
    const Matrix rows = rowsOf(matrix);
    for (const Vec3& row : rows)
        if (std::abs(length(row) - 1) > kAxesError) refuse(matrix, "must have rows of length 1");
    if (!areRightAngled(rows)) refuse(matrix, "must have perpendicular, right-handed rows");
    return rows;
}

Matrix turnOf(const SceneValue& table) {
    requireTable(table);
    requireKnownKeys(table, "a rotation", {"axis", "degrees", "matrix"});
    if (const auto matrix = find(table, "matrix")) {
        forbid(table, {"axis", "degrees"}, "cannot be combined with \"matrix\"");
        return matrixOf(*matrix);
    }
    return turn(directionOf(require(table, "axis")), numberOf(require(table, "degrees"), kCoordinates));
}

Placement placementOf(const SceneValue& table) {
    Placement placement;
    if (const auto rotate = find(table, "rotate")) placement.rotation = rotationOf(*rotate);
    if (const auto scale = find(table, "scale")) {
        if (scale->node->is_array()) refuse(*scale, "must be one number for all axes: discs have to stay round");
        placement.scale = numberOf(*scale, kLengths);
    }
    if (const auto translate = find(table, "translate")) placement.translation = vectorOf(*translate);
    return placement;
}

MaterialOverride::ColorRange colorRangeOf(const SceneValue& value) {
    if (!value.node->is_array() || value.node->as_array()->size() != 2)
        refuse(value, "must be the lowest and the highest colour, such as [\"#000000\", \"#ffffff\"]");
    const std::vector<SceneValue> ends = elementsOf(value);
    const MaterialOverride::ColorRange range{bytesOf(ends[0]), bytesOf(ends[1])};
    for (std::size_t i = 0; i < range.low.size(); ++i)
        if (range.low[i] > range.high[i])
            refuse(value, "empty range: the first colour must not exceed the second in red, green or blue");
    return range;
}

constexpr std::size_t kMaxNumbers = 256; // as many as there are classes

/// Each number as a range.
std::vector<ValueRange> numbersOf(const SceneValue& value) {
    if (!value.node->is_array() || value.node->as_array()->empty()) refuse(value, "must be a list of numbers");
    if (value.node->as_array()->size() > kMaxNumbers) refuse(value, "has more than 256 numbers");
    std::vector<ValueRange> ranges;
    for (const SceneValue& each : elementsOf(value)) {
        const double number = numberOf(each, kNumbers);
        ranges.push_back({number, number});
    }
    return ranges;
}

/// The key that selects the splats of an override; refuses several.
SceneValue chosenKeyOf(const SceneValue& table) {
    if (const auto attribute = find(table, "attribute")) {
        forbid(table, {"row", "colors"}, "cannot be combined with \"attribute\"");
        return *attribute;
    }
    forbid(table, {"values", "range"}, "has no effect without \"attribute\"");
    if (!find(table, "row") && !find(table, "colors")) refuse(table, "\"row\", \"colors\" or \"attribute\" is missing");
    return hasFirst(table, "row", "colors") ? *find(table, "row") : *find(table, "colors");
}

MaterialOverride overrideOf(const SceneValue& table, const SceneReading& reading) {
    requireKnownKeys(table, "an override", {"row", "colors", "attribute", "values", "range", "material"});
    MaterialOverride over;
    const SceneValue key = chosenKeyOf(table);
    if (find(table, "row"))
        over.splats = MaterialOverride::Row{wholeNumberOf(key, 0, 255)}; // as many as a .pro can have
    else if (find(table, "colors"))
        over.splats = colorRangeOf(key);
    else
        over.splats = selectionOf(table, key);
    over.material = materialOf(require(table, "material"), reading);
    over.place = placeOf(key);
    return over;
}

InstanceDescription instanceOf(const SceneValue& table, const SceneReading& reading) {
    requireKnownKeys(table, "an instance",
                     {"file", "name", "visible", "locked", "translate", "rotate", "scale", "material", "clip",
                      "colored", "override"});
    InstanceDescription instance;
    instance.path = fileOf(require(table, "file"), reading);
    instance.placement = placementOf(table);
    if (const auto material = find(table, "material")) instance.material = materialOf(*material, reading);
    takeFlag(table, "clip", instance.clipped);
    takeFlag(table, "colored", instance.colored);
    takeFlag(table, "visible", instance.visible);
    takeLayer(table, instance.layer);
    std::size_t ranges = 0;
    for (const SceneValue& each : findTables(table, "override")) {
        instance.overrides.push_back(overrideOf(each, reading));
        if (std::holds_alternative<MaterialOverride::ColorRange>(instance.overrides.back().splats)) ++ranges;
        if (ranges > MAX_COLOR_RANGES) refuse(each, "more than 8 colour ranges in one instance");
    }
    return instance;
}

} // namespace

SplatSelection selectionOf(const SceneValue& table, const SceneValue& attribute) {
    const std::string name = textOf(attribute);
    if (hasFirst(table, "values", "range")) return {name, numbersOf(*find(table, "values"))};
    return {name, {rangeOf(*find(table, "range"))}};
}

std::array<Vec3, 3> rowsOf(const SceneValue& value) {
    if (!value.node->is_array() || value.node->as_array()->size() != 3) refuse(value, "must be a list of 3 vectors");
    const std::vector<SceneValue> rows = elementsOf(value);
    return {vectorOf(rows[0]), vectorOf(rows[1]), vectorOf(rows[2])};
}

bool areRightAngled(const std::array<Vec3, 3>& axes) {
    return length(cross(axes[0], axes[1]) - axes[2]) <= 2 * kAxesError && std::abs(dot(axes[0], axes[1])) <= kAxesError;
}

std::array<Vec3, 3> rotationOf(const SceneValue& value) {
    if (!value.node->is_array()) return turnOf(value);
    Matrix rotation = Placement{}.rotation;
    for (const SceneValue& each : elementsOf(value)) rotation = chained(turnOf(each), rotation);
    return rotation;
}

void readInstances(const SceneValue& file, SceneReading& reading) {
    for (const SceneValue& table : findTables(file, "instance")) {
        if (reading.scene.instances.size() == kMaxInstances) refuse(table, "more than 254 instances");
        reading.scene.instances.push_back(instanceOf(table, reading));
    }
}

} // namespace pointrt
