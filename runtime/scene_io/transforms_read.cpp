// SPDX-License-Identifier: Apache-2.0
// transforms.json of nerfstudio (docs.nerf.studio, Data conventions), Instant-NGP and the original NeRF scenes.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/scene_io/list_readers.h"
#include "runtime/util/input_file.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

/// Not ordered_json, which takes quadratic time in the number of an object's keys.
using Json = nlohmann::json;

/// Values of nerfstudio's camera_model for pinholes, and keys of Instant-NGP for other lenses.
constexpr const char* kPinholeModels[] = {"OPENCV",        "PINHOLE", "SIMPLE_PINHOLE",
                                          "SIMPLE_RADIAL", "RADIAL",  "PERSPECTIVE"};
constexpr const char* kOtherLenses[] = {"is_fisheye", "ftheta_lens", "latlong"};
constexpr const char* kOtherLensTerm = "ftheta_p0"; // a polynomial coefficient
constexpr const char* kDistortion[] = {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"};
/// Tolerance of applied_transform, as in pinholeCamera.
constexpr double kRotationError = 1e-3;

[[noreturn]] void refuse(const std::string& reason) { throw std::invalid_argument(reason); }

/// Looks up values in a frame, or in the file if the frame does not have them.
class FrameValues {
public:
    FrameValues(const Json& file, const Json& frame) : file_(file), frame_(frame) {}

    const Json* find(const char* key) const {
        for (const Json* each : {&frame_, &file_})
            if (const auto found = each->find(key); found != each->end() && !found->is_null()) return &*found;
        return nullptr;
    }
    std::optional<double> number(const char* key) const {
        const Json* value = find(key);
        if (!value) return std::nullopt;
        if (!value->is_number()) refuse(std::string(key) + " is not a number");
        return value->get<double>();
    }
    std::string text(const char* key) const {
        const Json* value = find(key);
        if (value && !value->is_string()) refuse(std::string(key) + " is not a string");
        return value ? value->get<std::string>() : "";
    }
    bool flag(const char* key) const {
        const Json* value = find(key);
        if (value && !value->is_boolean()) refuse(std::string(key) + " is neither true nor false");
        return value && value->get<bool>();
    }

private:
    const Json &file_, &frame_;
};

/// A 3x4 or 4x4 matrix.
struct FrameMatrix {
    double at[4][4] = {};
    Vec3 column(int c) const { return {at[0][c], at[1][c], at[2][c]}; }
};

FrameMatrix frameMatrixOf(const Json& value, const char* key) {
    const auto fail = [&] { refuse(std::string(key) + " is not 3 or 4 rows of 4 numbers"); };
    if (!value.is_array() || value.size() < 3 || value.size() > 4) fail();
    FrameMatrix matrix;
    for (std::size_t row = 0; row < value.size(); ++row) {
        if (!value[row].is_array() || value[row].size() != 4) fail();
        for (std::size_t c = 0; c < 4; ++c) {
            if (!value[row][c].is_number()) fail();
            matrix.at[row][c] = value[row][c].get<double>();
        }
    }
    const double* const last = matrix.at[3];
    if (value.size() == 4 && (last[0] != 0 || last[1] != 0 || last[2] != 0 || last[3] != 1))
        refuse(std::string("the last row of ") + key + " is not 0 0 0 1");
    return matrix;
}

void requireRotation(const FrameMatrix& matrix, const char* key) {
    double error = 0;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            error = std::max(error, std::abs(dot(matrix.column(a), matrix.column(b)) - (a == b ? 1 : 0)));
    if (!(error <= kRotationError)) refuse(std::string(key) + " is not a rotation and a translation");
}

/// A number of pixels, possibly written as 1920.0.
std::uint32_t sideOf(double pixels, const char* key) {
    if (!(pixels >= 1 && pixels <= kMaxPixelSide && std::floor(pixels) == pixels))
        refuse(std::string(key) + " is not an integer from 1 to " + std::to_string(kMaxPixelSide));
    return static_cast<std::uint32_t>(pixels);
}

PixelSize sizeOf(const FrameValues& values, const CameraFileRequest& request) {
    const auto w = values.number("w"), h = values.number("h");
    if (w && h) return {sideOf(*w, "w"), sideOf(*h, "h")};
    if (!request.size) refuse("w and h are missing; set the picture size with --size WxH");
    return *request.size;
}

/// The focal length in pixels: from key length, or from key angle, which is the field of view along a side.
std::optional<double> focalLength(const FrameValues& values, const char* length, const char* angle,
                                  std::uint32_t side) {
    if (const auto pixels = values.number(length)) return pixels;
    const auto radians = values.number(angle);
    return radians ? std::optional(side / (2 * std::tan(*radians / 2))) : std::nullopt;
}

PinholeLens lensOf(const FrameValues& values, PixelSize size) {
    const auto fx = focalLength(values, "fl_x", "camera_angle_x", size.width);
    const auto fy = focalLength(values, "fl_y", "camera_angle_y", size.height);
    if (!fx && !fy) refuse("fl_x or camera_angle_x is missing");
    PinholeLens lens;
    lens.fx = fx ? *fx : *fy;
    lens.fy = fy ? *fy : *fx;
    lens.cx = values.number("cx").value_or(size.width / 2.0);
    lens.cy = values.number("cy").value_or(size.height / 2.0);
    return lens;
}

void requirePinhole(const FrameValues& values) {
    const std::string model = values.text("camera_model");
    const bool is_known = model.empty() || std::find(std::begin(kPinholeModels), std::end(kPinholeModels), model) !=
                                               std::end(kPinholeModels);
    if (!is_known) refuse("camera_model " + printable(model) + " is not a pinhole; undistort the images first");
    const auto isOther = [](const char* key) {
        refuse(std::string(key) + ": not a pinhole camera; undistort the images first");
    };
    for (const char* key : kOtherLenses)
        if (values.flag(key)) isOther(key);
    if (values.find(kOtherLensTerm)) isOther(kOtherLensTerm);
}

std::string distortionOf(const FrameValues& values) {
    std::string text;
    for (const char* key : kDistortion)
        if (const double value = values.number(key).value_or(0); value != 0)
            text += (text.empty() ? "" : ", ") + std::string(key) + " " + plainText(value);
    return text;
}

/// Converts from axes x right, y up, z backward to OpenCV's.
CameraPose poseOf(const FrameMatrix& matrix) {
    return {matrix.column(0), -1.0 * matrix.column(1), -1.0 * matrix.column(2), matrix.column(3)};
}

/// Undoes applied_transform; the inverse of its rotation is the transpose.
CameraPose withoutApplied(const CameraPose& pose, const FrameMatrix& applied) {
    const auto back = [&](Vec3 v) {
        return Vec3{dot(applied.column(0), v), dot(applied.column(1), v), dot(applied.column(2), v)};
    };
    return {back(pose.right), back(pose.down), back(pose.forward), back(pose.eye - applied.column(3))};
}

CameraShot shotOf(const Json& file, const Json& frame, const CameraFileRequest& request) {
    if (!frame.is_object()) refuse("it is not an object");
    const FrameValues values(file, frame);
    CameraShot shot;
    shot.name = values.text("file_path");
    if (shot.name.empty()) refuse("file_path is missing");
    requirePinhole(values);
    shot.size = sizeOf(values, request);
    shot.lens = lensOf(values, shot.size);
    shot.distortion = distortionOf(values);
    const auto matrix = frame.find("transform_matrix");
    if (matrix == frame.end()) refuse("transform_matrix is missing");
    shot.pose = poseOf(frameMatrixOf(*matrix, "transform_matrix"));
    if (const double scale = values.number("applied_scale").value_or(1); scale != 1)
        refuse("applied_scale " + plainText(scale) + " is not 1: cameras and scan must have the same scale");
    if (const auto applied = file.find("applied_transform"); applied != file.end()) {
        const FrameMatrix transform = frameMatrixOf(*applied, "applied_transform");
        requireRotation(transform, "applied_transform");
        shot.pose = withoutApplied(shot.pose, transform);
    }
    return shot;
}

Json parsed(const std::string& path) {
    const std::vector<std::uint8_t> bytes = readFileBytes(path);
    try {
        return Json::parse(bytes.begin(), bytes.end());
    } catch (const Json::parse_error& error) {
        throw Error{ExitCode::kBadInput, path + ": byte " + std::to_string(error.byte) + ": invalid JSON"};
    } catch (const Json::out_of_range&) {
        throw Error{ExitCode::kBadInput, path + ": has a number out of range"};
    }
}

} // namespace

std::vector<CameraShot> readTransforms(const std::string& path, const std::string&, const CameraFileRequest& request) {
    const Json file = parsed(path);
    const auto frames = file.is_object() ? file.find("frames") : file.end();
    if (frames == file.end() || !frames->is_array())
        throw Error{ExitCode::kBadInput, path + ": the list \"frames\" is missing"};
    std::vector<CameraShot> shots;
    for (const Json& frame : *frames) {
        const std::string place = path + ": frame " + std::to_string(shots.size()) + ": ";
        try {
            shots.push_back(shotOf(file, frame, request));
            shots.back().place = place;
        } catch (const std::invalid_argument& error) {
            throw Error{ExitCode::kBadInput, place + error.what()};
        }
    }
    return shots;
}

} // namespace pointrt
