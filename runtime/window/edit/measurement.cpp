// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/measurement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace pointrt {
namespace {

std::string decimalText(double value, int decimals) {
    std::array<char, 400> text{}; // a double has up to 309 digits before the point
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

double angleBetween(Vec3 a, Vec3 b) {
    return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi; // exact for small angles, too
}

/// Half the sum of cross products (Newell). Relative to the first point: national coordinates have seven digits.
Vec3 vectorArea(std::span<const Vec3> points) {
    Vec3 sum;
    for (std::size_t i = 2; i < points.size(); ++i) sum = sum + cross(points[i - 1] - points[0], points[i] - points[0]);
    return 0.5 * sum;
}

std::string jsonPosition(Vec3 point, int decimals) {
    return "[" + decimalText(point.x, decimals) + "," + decimalText(point.y, decimals) + "," +
           decimalText(point.z, decimals) + "]";
}

std::string jsonPositions(const MeasuredPath& path) {
    std::string text;
    for (const Vec3& point : path.points) text += (text.empty() ? "" : ",") + jsonPosition(point, path.decimals);
    return text;
}

std::string jsonFeature(const std::string& kind, const std::string& coordinates, const std::string& properties) {
    return "{\"type\":\"Feature\",\"properties\":{" + properties + "},\"geometry\":{\"type\":\"" + kind +
           "\",\"coordinates\":[" + coordinates + "]}}";
}

std::string dxfPoint(Vec3 point, int decimals) {
    return "10\n" + decimalText(point.x, decimals) + "\n20\n" + decimalText(point.y, decimals) + "\n30\n" +
           decimalText(point.z, decimals) + "\n";
}

} // namespace

PathMeasures measurePath(std::span<const Vec3> points, Vec3 up) {
    PathMeasures measures;
    for (std::size_t i = 1; i < points.size(); ++i) measures.length += length(points[i] - points[i - 1]);
    const Vec3 last = points.back();
    measures.difference = last - points[points.size() - 2];
    measures.last_leg = length(measures.difference);
    measures.height = dot(measures.difference, up);
    measures.horizontal = length(measures.difference - measures.height * up);
    if (points.size() < 3) return measures;
    measures.angle_deg = angleBetween(points[points.size() - 3] - points[points.size() - 2], measures.difference);
    const Vec3 area = vectorArea(points);
    measures.area = length(area);
    measures.plan_area = std::abs(dot(area, up));
    return measures;
}

std::vector<Vec3> pickedPositions(const std::vector<PickedPoint>& picks) {
    std::vector<Vec3> points;
    for (const PickedPoint& pick : picks) points.push_back(pick.position);
    return points;
}

std::string csvText(const MeasuredPath& path) {
    std::string text = "point,x,y,z,length\n";
    double so_far = 0;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
        const Vec3 point = path.points[i];
        if (i > 0) so_far += length(point - path.points[i - 1]);
        text += std::to_string(i + 1);
        for (const double value : {point.x, point.y, point.z, so_far}) text += "," + decimalText(value, path.decimals);
        text += "\n";
    }
    return text;
}

std::string geoJsonText(const MeasuredPath& path) {
    const PathMeasures& measures = path.measures;
    std::string features = jsonFeature("LineString", jsonPositions(path),
                                       "\"length\":" + decimalText(measures.length, path.decimals) +
                                           ",\"height\":" + decimalText(measures.height, path.decimals) +
                                           ",\"horizontal\":" + decimalText(measures.horizontal, path.decimals));
    if (measures.area)
        features +=
            "," + jsonFeature("Polygon",
                              "[" + jsonPositions(path) + "," + jsonPosition(path.points.front(), path.decimals) + "]",
                              "\"area\":" + decimalText(*measures.area, path.decimals) +
                                  ",\"plan_area\":" + decimalText(*measures.plan_area, path.decimals));
    return "{\"type\":\"FeatureCollection\",\"features\":[" + features + "]}\n";
}

std::string dxfText(const MeasuredPath& path) {
    constexpr const char* kOpen3d = "70\n8\n"; // POLYLINE: bit 8, a 3D polyline; VERTEX: 32, a vertex of one
    std::string text =
        std::string("0\nSECTION\n2\nENTITIES\n0\nPOLYLINE\n8\nmeasurements\n66\n1\n") + dxfPoint({}, 1) + kOpen3d;
    for (const Vec3& point : path.points)
        text += "0\nVERTEX\n8\nmeasurements\n" + dxfPoint(point, path.decimals) + "70\n32\n";
    return text + "0\nSEQEND\n8\nmeasurements\n0\nENDSEC\n0\nEOF\n";
}

} // namespace pointrt
