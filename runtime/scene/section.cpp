// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/section.h"

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "format/base/printable.h"
#include "runtime/scene/default_view.h"
#include "runtime/scene/upright.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr double kMostSection = 1e12; // the limit of coordinates in scene files
constexpr std::string_view kAxisNames = "xyz";

[[noreturn]] void refuseSection(const std::string& text) {
    throw std::invalid_argument("\"" + printable(text) +
                                "\" is not a section such as x=12.5, z=1.2:0.5 (with a thickness) or X0,Y0,X1,Y1");
}

double coordinateOf(const std::string& word, const std::string& text) {
    double value = 0;
    if (parseNumber(word, value) && std::abs(value) <= kMostSection) return value;
    refuseSection(text);
}

AxisSection axisOf(const std::string& words, const std::string& text) {
    const std::size_t begin = words.starts_with('-') ? 1 : 0;
    const std::size_t axis = words.size() > begin ? kAxisNames.find(words[begin]) : std::string_view::npos;
    if (axis == std::string_view::npos || words.find('=') != begin + 1) refuseSection(text);
    return {axis, coordinateOf(words.substr(begin + 2), text), begin == 1};
}

LineSection lineOf(const std::string& words, const std::string& text) {
    std::array<double, 4> numbers{};
    std::size_t start = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t comma = words.find(',', start);
        if ((comma == std::string::npos) != (i + 1 == numbers.size())) refuseSection(text);
        numbers[i] = coordinateOf(words.substr(start, comma - start), text);
        start = comma + 1;
    }
    const LineSection line{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
    if (line.from == line.to) throw std::invalid_argument("the two points of the section are the same");
    return line;
}

double& component(Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vec3 unitAlong(std::size_t axis) {
    Vec3 unit;
    component(unit, axis) = 1;
    return unit;
}

/// The axis nearest to up, in its direction.
struct Vertical {
    std::size_t axis = 0;
    Vec3 up;
};
Vertical verticalOf(Vec3 up) {
    const Vec3 nearest = nearestAxis(up).value();
    const std::size_t axis = nearest.z != 0 ? 2 : nearest.y != 0 ? 1 : 0;
    return {axis, nearest};
}

/// A point of the cut, and the view direction, unit length.
struct Cut {
    Vec3 point, forward;
};

/// The two axes of the plan.
std::array<std::size_t, 2> planAxes(const Vertical& vertical) {
    return {vertical.axis == 0 ? std::size_t{1} : 0, vertical.axis == 2 ? std::size_t{1} : 2};
}

Cut cutOf(const AxisSection& plane, const Vertical& vertical) {
    const auto [first, second] = planAxes(vertical);
    const Vec3 to_right = unitAlong(plane.axis == first ? second : first);
    const Vec3 forward = plane.axis == vertical.axis ? -1.0 * vertical.up : cross(vertical.up, to_right);
    return {plane.at * unitAlong(plane.axis), plane.reversed ? -1.0 * forward : forward};
}

Cut cutOf(const LineSection& line, const Vertical& vertical) {
    const auto [first, second] = planAxes(vertical);
    Vec3 from, along;
    component(from, first) = line.from[0];
    component(from, second) = line.from[1];
    component(along, first) = line.to[0] - line.from[0];
    component(along, second) = line.to[1] - line.from[1];
    return {from, normalize(cross(vertical.up, along))};
}

} // namespace

SectionRequest parseSection(const std::string& text) {
    SectionRequest request;
    const std::size_t colon = text.find(':');
    const std::string plane = text.substr(0, colon);
    if (plane.find('=') != std::string::npos)
        request.plane = axisOf(plane, text);
    else
        request.plane = lineOf(plane, text);
    if (colon != std::string::npos) request.thickness = parseRealAbove(text.substr(colon + 1), 0, kMostSection);
    return request;
}

Section makeSection(const SectionRequest& request, Vec3 up) {
    const Vertical vertical = verticalOf(up);
    const Cut cut = std::visit([&](const auto& plane) { return cutOf(plane, vertical); }, request.plane);
    const Vec3 to_face = (request.thickness.value_or(0) / 2) * cut.forward;
    Section section{{}, -1.0 * cut.forward, up};
    section.clips.push_back({ClipPlane{cut.point - to_face, cut.forward}});
    if (request.thickness) section.clips.push_back({ClipPlane{cut.point + to_face, -1.0 * cut.forward}});
    if (std::abs(dot(cut.forward, vertical.up)) > 0.5) section.up = upIn(StandardView::kTop, up);
    return section;
}

} // namespace pointrt
