// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/turntable.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "format/base/error.h"

namespace pointrt {
namespace {

/// A %d or %0Nd in a path.
struct NumberPlace {
    std::size_t at = 0, size = 0;
    std::size_t digits = 1; ///< minimum number of digits, padded with zeros
};

/// The %d or %0Nd at a percent sign of path, if any.
std::optional<NumberPlace> numberPlaceAt(const std::string& path, std::size_t percent) {
    const std::string text = path.substr(percent, 4);
    if (text.starts_with("%d")) return NumberPlace{percent, 2, 1};
    const bool padded = text.size() == 4 && text[1] == '0' && text[2] >= '1' && text[2] <= '9' && text[3] == 'd';
    if (!padded) return std::nullopt;
    return NumberPlace{percent, 4, static_cast<std::size_t>(text[2] - '0')};
}

std::optional<NumberPlace> firstNumberPlace(const std::string& path) {
    for (std::size_t at = path.find('%'); at != std::string::npos; at = path.find('%', at + 1))
        if (const auto place = numberPlaceAt(path, at)) return place;
    return std::nullopt;
}

/// v rotated about axis, a unit vector, by Rodrigues' formula.
Vec3 turned(Vec3 v, Vec3 axis, double cosine, double sine) {
    return v * cosine + cross(axis, v) * sine + axis * (dot(axis, v) * (1 - cosine));
}

} // namespace

Camera turntableCamera(const Camera& camera, const TurntableAxis& axis, std::uint32_t frame, std::uint32_t frames) {
    if (frame == 0) return camera;
    const double angle = 2 * std::numbers::pi * frame / frames, cosine = std::cos(angle), sine = std::sin(angle);
    const auto turn = [&](Vec3 v) { return turned(v, axis.up, cosine, sine); };
    Camera moved = camera;
    moved.eye = axis.pivot + turn(camera.eye - axis.pivot);
    moved.right = turn(camera.right);
    moved.up = turn(camera.up);
    moved.forward = turn(camera.forward);
    return moved;
}

void requireFrameNames(const std::string& path, const char* option) {
    const auto place = firstNumberPlace(path);
    const auto fail = [&](const std::string& reason) { throw Error{ExitCode::kBadUsage, path + ": " + reason}; };
    if (!option) {
        if (place) fail("\"" + path.substr(place->at, place->size) + "\" needs --turntable or --path");
        return;
    }
    if (path.empty())
        throw Error{ExitCode::kBadUsage, std::string(option) + ": needs -o FILE%d.png, e.g. frames/%04d.png"};
    if (!place) fail(std::string(option) + " needs %d or %0Nd in the name, e.g. frames/%04d.png");
    if (std::count(path.begin(), path.end(), '%') != 1)
        fail(std::string(option) + " allows only one % in the name, e.g. frames/%04d.png");
}

std::string frameName(const std::string& pattern, std::uint32_t frame) {
    const NumberPlace place = firstNumberPlace(pattern).value_or(NumberPlace{pattern.size(), 0, 1});
    std::string number = std::to_string(frame);
    if (number.size() < place.digits) number.insert(0, place.digits - number.size(), '0');
    return pattern.substr(0, place.at) + number + pattern.substr(place.at + place.size);
}

} // namespace pointrt
