// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/transforms_write.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/util/output_file.h"

namespace pointrt {
namespace {

using OrderedJson = nlohmann::ordered_json; // keeps the few keys in a readable order

/// At this magnitude neighbouring floats are 2^-10 apart.
constexpr double kCoarseFloats = 1 << 13;

OrderedJson matrixOf(Vec3 x, Vec3 y, Vec3 z, Vec3 place) {
    return {{x.x, y.x, z.x, place.x}, {x.y, y.y, z.y, place.y}, {x.z, y.z, z.z, place.z}};
}

void putLens(const CameraShot& shot, OrderedJson& to) {
    to["w"] = shot.size.width;
    to["h"] = shot.size.height;
    to["fl_x"] = shot.lens.fx;
    to["fl_y"] = shot.lens.fy;
    to["cx"] = shot.lens.cx;
    to["cy"] = shot.lens.cy;
    for (const char* key : {"k1", "k2", "p1", "p2"}) to[key] = 0;
}

bool areAlike(const std::vector<RenderedShot>& shots) {
    return std::all_of(shots.begin(), shots.end(), [&](const RenderedShot& each) {
        return each.shot.lens == shots.front().shot.lens && each.shot.size == shots.front().shot.size;
    });
}

OrderedJson frameOf(const RenderedShot& rendered, Vec3 offset, bool with_lens) {
    OrderedJson frame = OrderedJson::object();
    for (const auto& [key, path] : rendered.files) frame[key] = path;
    if (with_lens) putLens(rendered.shot, frame);
    const CameraPose& pose = rendered.shot.pose;
    // 0 - v avoids the -0 of -v
    const Vec3 none;
    OrderedJson matrix = matrixOf(pose.right, none - pose.down, none - pose.forward, pose.eye - offset);
    matrix.push_back({0, 0, 0, 1});
    frame["transform_matrix"] = matrix;
    return frame;
}

} // namespace

void writeTransforms(const std::string& path, const TransformsFile& file) {
    OrderedJson json = OrderedJson::object();
    json["camera_model"] = "OPENCV"; // its distortion coefficients of 0 make it a pinhole
    const bool alike = areAlike(file.shots);
    if (alike && !file.shots.empty()) putLens(file.shots.front().shot, json);
    if (file.depth_unit > 0) json["depth_unit_scale_factor"] = file.depth_unit;
    json["applied_transform"] = matrixOf({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, Vec3{} - file.offset);
    OrderedJson frames = OrderedJson::array();
    for (const RenderedShot& each : file.shots) frames.push_back(frameOf(each, file.offset, !alike));
    json["frames"] = frames;
    const std::string text = json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
    writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Vec3 offsetFor(Vec3 bounds_min, Vec3 bounds_max) {
    const Vec3 low = absolute(bounds_min), high = absolute(bounds_max);
    const double farthest = std::max({low.x, low.y, low.z, high.x, high.y, high.z});
    if (farthest < kCoarseFloats) return {};
    const Vec3 middle = 0.5 * (bounds_min + bounds_max);
    return {std::round(middle.x), std::round(middle.y), std::round(middle.z)};
}

} // namespace pointrt
