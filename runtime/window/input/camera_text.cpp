// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/camera_text.h"

#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/scene/camera.h"
#include "runtime/util/parse.h"
#include "runtime/util/words.h"
#include "runtime/window/input/turntable_rotation.h"

namespace pointrt {
namespace {

constexpr std::size_t kMaxText = 4096; // enough for ten numbers of at most 24 characters and much white space

using OptionWords = std::map<std::string, std::string>;

[[noreturn]] void refuseCamera(const std::string& reason) {
    throw Error{ExitCode::kBadInput, "camera text: " + reason};
}

std::string plain(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string plain(Vec3 v) { return plain(v.x) + "," + plain(v.y) + "," + plain(v.z); }

bool isSeparator(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Splits at white space, except next to a comma.
std::vector<std::string> wordsOf(const std::string& text) {
    std::vector<std::string> words;
    bool parted = true;
    for (char c : text) {
        if (isSeparator(c)) {
            parted = true;
            continue;
        }
        const bool continues = !words.empty() && (c == ',' || words.back().back() == ',');
        if (parted && !continues) words.emplace_back();
        words.back() += c;
        parted = false;
    }
    return words;
}

/// The options in text by name, each with its value.
OptionWords optionsOf(const std::string& text) {
    if (text.size() > kMaxText) refuseCamera("too long");
    OptionWords options;
    const std::vector<std::string> words = wordsOf(text);
    for (std::size_t i = 0; i < words.size(); i += 2) {
        const std::string& name = words[i];
        if (name != "--eye" && name != "--target" && name != "--up" && name != "--fov" && name != "--ortho")
            refuseCamera(quotedWord(name) + " is not one of --eye, --target, --up, --fov, --ortho");
        if (i + 1 == words.size()) refuseCamera(name + " has no value");
        if (!options.emplace(name, words[i + 1]).second) refuseCamera(name + " is given twice");
    }
    for (const char* needed : {"--eye", "--target"})
        if (!options.contains(needed)) refuseCamera(std::string(needed) + " is missing");
    if (options.contains("--fov") && options.contains("--ortho")) refuseCamera("--fov and --ortho cannot be combined");
    return options;
}

/// Parses the value of an option; fallback if it is missing.
template <typename Value, typename Parse>
Value valueOf(const OptionWords& options, const char* name, Value fallback, Parse parse) {
    const auto found = options.find(name);
    if (found == options.end()) return fallback;
    try {
        return parse(found->second);
    } catch (const std::invalid_argument&) {
        refuseCamera(std::string(name) + ": invalid value " + quotedWord(found->second));
    }
}

CameraRequest requestedBy(const OptionWords& options, const ViewCamera& view) {
    const auto height = [](const std::string& word) { return parseRealAbove(word, 0, 1e12); }; // the limits of --ortho
    CameraRequest request = requestOf(view);
    request.eye = valueOf(options, "--eye", *request.eye, parseVector);
    request.target = valueOf(options, "--target", *request.target, parseVector);
    request.up = usableAxis(valueOf(options, "--up", view.up, parseVector));
    request.fov_deg = valueOf(options, "--fov", view.fov_deg, parseAngle);
    request.ortho = !options.contains("--fov") && (options.contains("--ortho") || view.ortho_height > 0);
    request.ortho_height.reset();
    if (request.ortho) request.ortho_height = valueOf(options, "--ortho", view.ortho_height, height);
    return request;
}

/// True if the requested view is along view's up axis, where --up only rolls the picture.
bool rollsOnly(const ViewCamera& view, const CameraRequest& request) {
    ViewCamera there = view;
    there.eye = *request.eye;
    there.pivot = *request.target;
    const bool along_axis = *requestOf(there).up != there.up;
    return along_axis && length(cross(*request.up, view.up)) > 0.5 * length(*request.up) * length(view.up);
}

} // namespace

std::string cameraText(const ViewCamera& view) {
    const CameraRequest request = requestOf(view);
    return "--eye " + plain(*request.eye) + " --target " + plain(*request.target) + " --up " + plain(*request.up) +
           (request.ortho ? " --ortho " + plain(view.ortho_height) : " --fov " + plain(view.fov_deg));
}

ViewCamera withCameraText(const ViewCamera& view, const std::string& text) {
    const CameraRequest request = requestedBy(optionsOf(text), view);
    const Vec3 half = Vec3{1, 1, 1} * (view.scene_radius / std::sqrt(3.0)); // a cube inscribed in the scene's sphere
    const Vec3 low = view.scene_centre - half, high = view.scene_centre + half;
    try {
        const Camera camera = frameCamera(request, low, high, 1);
        ViewCamera after = view;
        after.eye = *request.eye;
        after.pivot = *request.target;
        const bool picture_only = rollsOnly(view, request);
        if (!picture_only) after.up = *request.up;
        after.heading = picture_only ? *request.up : camera.up;
        after.fov_deg = request.fov_deg;
        after.ortho_height = camera.ortho_height;
        return after;
    } catch (const Error& error) {
        refuseCamera(error.what());
    }
}

} // namespace pointrt
