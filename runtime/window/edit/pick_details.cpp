// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/pick_details.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "runtime/device_scene/color_choice.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/scene/layers.h"
#include "runtime/scene/point_classes.h"
#include "runtime/scene_io/scene_file.h"

namespace pointrt {
namespace {

/// The number with as many digits as the attribute's type resolves.
std::string shortText(double number, const pro_attribute& attribute) {
    constexpr int kFloatDigits = 7, kDoubleDigits = 15, kHeightDigits = 9; // heights are stored in 21 bits
    const int digits = !attribute.values                ? kHeightDigits
                       : attribute.type == PRO_TYPE_F32 ? kFloatDigits
                                                        : kDoubleDigits;
    char text[40];
    std::snprintf(text, sizeof text, "%.*g", digits, number);
    return text;
}

/// "classification 6, building": the value that the splat is coloured by.
std::string numberText(const DeviceScene& scene, const Pick& pick, std::size_t place) {
    const std::string& word = scene.paint.request.color_by;
    const auto numbers = numbersFor(placedScans(scene, scene.description).at(place), word, scene.paint.request.up);
    if (!numbers) return "";
    double number = 0;
    readNumbers(*numbers, pick.splat, {&number, 1});
    const std::string name = attributeWord(word);
    const bool is_class = name == "classification" && number >= 0 && number < 256;
    return name + " " + shortText(number, numbers->attribute) +
           (is_class ? ", " + className(static_cast<std::uint8_t>(number)) : "");
}

pro_splat splatOf(const DeviceScan& file, std::uint32_t number) {
    pro_splat splat{};
    pro_splat_decode(file.view.splats + std::size_t{PRO_SPLAT_WORDS} * number, file.info.radius_max,
                     file.info.radius_step, &splat);
    return splat;
}

/// The picked instance, which still exists. All tiles of a set have the same number.
const Instance& pickedInstance(const DeviceScene& scene, const Pick& pick) {
    return *std::find_if(scene.instances.begin(), scene.instances.end(),
                         [&](const Instance& each) { return each.number == pick.owner && each.tile == pick.tile; });
}

/// The name by which users know a scan.
std::string sourceName(const SceneDescription& scene, const std::string& path) {
    const bool is_scan = scene.instances.size() == 1 && !isSceneOrSet(scene.path);
    return std::filesystem::path(is_scan ? scene.path : path).filename().string();
}

/// row: of the shape on the device.
std::string shapeName(const SceneDescription& scene, std::uint32_t row) {
    const std::vector<std::size_t> shown = shownShapes(scene);
    return row < shown.size() ? layerName(scene, {LayerKind::kShape, shown[row]}) : "shape"; // the surface of a lamp
}

void describeSplat(const DeviceScene& scene, const Pick& pick, PickedPoint& point) {
    const Placement& placement = scene.description.instances.at(pick.owner).placement;
    const Vec3 input = unplaced(placement, pick.position);
    const Instance& instance = pickedInstance(scene, pick);
    const DeviceScan& file = scene.files.at(instance.file);
    const pro_splat splat = splatOf(file, pick.splat);
    point.source = sourceName(scene.description, file.path);
    point.position = input;
    point.normal = unrotated(placement, pick.normal);
    point.radius = double{splat.radius} * file.info.scale;
    point.value = numberText(scene, pick, instance.place);
    if (file.info.flags & PRO_FLAG_COLOR) point.color = {splat.color[0], splat.color[1], splat.color[2]};
}

} // namespace

PickedPoint describePick(const DeviceScene& scene, const Pick& pick) {
    PickedPoint point;
    point.splat = pick.splat;
    point.position = pick.position;
    point.normal = pick.normal;
    point.distance = pick.distance;
    if (pick.owner == OWNER_SHAPES)
        point.source = shapeName(scene.description, pick.splat);
    else
        describeSplat(scene, pick, point);
    return point;
}

} // namespace pointrt
