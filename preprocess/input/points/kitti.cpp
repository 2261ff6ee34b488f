// SPDX-License-Identifier: GPL-3.0-or-later
// Frames of driving datasets as bare floats: x y z intensity of KITTI, and with a ring of nuScenes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "preprocess/ingest/formats.h"

namespace pointrt {
namespace {

constexpr std::size_t kKittiFloats = 4, kNuScenesFloats = 5;

/// Whether numbers are those of a point: within the range of lidars in metres, with an intensity in [0, 1] or of a byte
/// and, as the fifth, the number of one of 128 lasers. Bytes of other files are mostly tiny or huge as floats.
bool isFramePoint(const std::array<float, kNuScenesFloats>& point, std::size_t floats) {
    constexpr float kFarthest = 1000, kSmallest = 1e-6f;
    for (std::size_t i = 0; i < 3; ++i) {
        const float size = std::abs(point[i]);
        if (!(size <= kFarthest) || (size > 0 && size < kSmallest)) return false;
    }
    if (!(point[3] >= 0 && point[3] <= 255) || (point[3] > 0 && point[3] < kSmallest)) return false;
    return floats == kKittiFloats || (point[4] >= 0 && point[4] < 128 && point[4] == std::trunc(point[4]));
}

std::array<float, kNuScenesFloats> framePoint(std::string_view bytes, std::size_t index, std::size_t floats) {
    std::array<float, kNuScenesFloats> point{};
    std::memcpy(point.data(), bytes.data() + index * floats * sizeof(float), floats * sizeof(float));
    return point;
}

bool isFrame(std::string_view bytes, std::size_t floats) {
    constexpr std::size_t kFewest = 16, kTested = 4096;
    const std::size_t size = floats * sizeof(float), points = bytes.size() / size;
    if (bytes.size() % size != 0 || points < kFewest) return false;
    std::size_t away = 0; // from the scanner
    for (std::size_t i = 0; i < std::min(points, kTested); ++i) {
        const auto point = framePoint(bytes, i, floats);
        if (!isFramePoint(point, floats)) return false;
        away += point[0] != 0 || point[1] != 0 || point[2] != 0;
    }
    return 2 * away > std::min(points, kTested) && isFramePoint(framePoint(bytes, points - 1, floats), floats);
}

/// Number of floats of a point; 0 if the bytes are not a frame.
std::size_t floatsOf(std::string_view bytes) {
    for (const std::size_t floats : {kKittiFloats, kNuScenesFloats})
        if (isFrame(bytes, floats)) return floats;
    return 0;
}

bool isKittiStart(std::string_view bytes) { return floatsOf(bytes) > 0; }

void readKitti(const InputFile& input, Sink& sink) {
    const std::size_t floats = floatsOf(input.bytes);
    if (floats == 0)
        refuse(input,
               fmt::format("is not a frame of 4 or 5 floats a point (x, y, z, intensity, ring): it has {} bytes, or "
                           "implausible numbers",
                           input.bytes.size()));
    ScanTraits traits;
    traits.faces = false;
    traits.vertices = input.bytes.size() / (floats * sizeof(float));
    traits.columns.push_back({"intensity", Scalar::kF32});
    if (floats == kNuScenesFloats) traits.columns.push_back({"ring", Scalar::kF32, 1, true});
    sink.beginScan(input, traits);
    sink.setScanSensor(Vec3d::Zero());
    Row row{};
    for (std::size_t i = 0; i < traits.vertices; ++i) {
        const auto point = framePoint(input.bytes, i, floats);
        for (std::size_t axis = 0; axis < 3; ++axis) row[kX + axis] = double(point[axis]);
        sink.addVertex(row, reinterpret_cast<const char*>(&point[3]));
    }
    sink.finishScan(input);
    WorldFrame frame;
    frame.up = Vec3d::UnitZ();
    frame.metres_per_unit = 1;
    sink.setWorldFrame(input, frame);
}

} // namespace

const FormatReader readers::kKitti{.isStart = isKittiStart, .read = readKitti, .readsInBatches = alwaysInBatches};

} // namespace pointrt
