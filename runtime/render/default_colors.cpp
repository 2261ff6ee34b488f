// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/default_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "format/base/error.h"
#include "runtime/device_scene/color_choice.h"
#include "runtime/scene/framing.h"

namespace pointrt {
namespace {

constexpr const char* kIntensity = "intensity";

/// Appends a sample of a scan's intensities; nothing if it has no intensity, or one of several components.
void addIntensities(const DeviceScan& scan, std::vector<double>& values) {
    const std::optional<SplatNumbers> source = attributeNumbers(scan.file, kIntensity);
    if (!source || source->attribute.components != 1) return;
    constexpr std::size_t kRead = 4096;
    const std::size_t count = scan.info.splat_count, step = std::max<std::size_t>(1, count / kRead);
    for (std::size_t i = 0; i < count; i += step) {
        double value = 0;
        readNumbers(*source, i, {&value, 1});
        if (std::isfinite(value)) values.push_back(value);
    }
}

/// The inner 96% of the intensities; the rest are glints. None if the inner nine tenths are equal, as in files of
/// programs that write one value for all points.
std::optional<ValueRange> intensityRange(const std::vector<const DeviceScan*>& scans) {
    std::vector<double> values;
    for (const DeviceScan* scan : scans) addIntensities(*scan, values);
    if (values.empty()) return std::nullopt;
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    if (!(at(0.05) < at(0.95))) return std::nullopt;
    return ValueRange{at(0.02), at(0.98)};
}

bool hasAttribute(const DeviceScan& scan, const char* name) {
    pro_attribute attribute;
    return pro_find_attribute(scan.file, name, &attribute) == 1;
}

/// Attributes that only surveying instruments and their programs write. Intensity is not among them: Stanford's merged
/// range scans have it too, besides a confidence.
bool isSurvey(const DeviceScan& scan) {
    static constexpr std::array kNames = {"return_number", "number_of_returns", "classification", "gps_time", "ring"};
    return std::any_of(kNames.begin(), kNames.end(), [&](const char* name) { return hasAttribute(scan, name); }) ||
           (hasAttribute(scan, kIntensity) && !hasAttribute(scan, "confidence"));
}

bool hasColor(const DeviceScan& scan) { return (scan.info.flags & PRO_FLAG_COLOR) != 0; }

/// Whether all scans come from surveying instruments.
bool areSurveys(const std::vector<const DeviceScan*>& scans) {
    return std::all_of(scans.begin(), scans.end(), [](const DeviceScan* scan) { return isSurvey(*scan); });
}

} // namespace

PlaceKind placeKindOf(const DeviceScene& scene, const SceneSample& sample, Vec3 up) {
    const std::vector<const DeviceScan*> scans = representativeScans(scene);
    if (scans.empty() || sample.splats.empty()) return PlaceKind::kObject;
    return kindOfPlace(sample, up, areSurveys(scans));
}

std::optional<DefaultColors> defaultColors(const DeviceScene& scene, const SceneSample& sample, Vec3 up) {
    const std::vector<const DeviceScan*> scans = representativeScans(scene);
    if (scans.empty() || sample.splats.empty()) return std::nullopt;
    for (const DeviceScan* scan : scans)
        if (hasColor(*scan) || scan->is_gaussian) return std::nullopt;
    const PlaceKind kind = placeKindOf(scene, sample, up);
    if (kind == PlaceKind::kSite) return DefaultColors{kHeight, {}};
    if (kind == PlaceKind::kObject && !areSurveys(scans)) return std::nullopt;
    if (const auto range = intensityRange(scans)) return DefaultColors{kIntensity, *range};
    return DefaultColors{kHeight, {}};
}

void requireColored(const char* option, const std::string& color_by) {
    if (option && color_by == kOwnColors)
        throw Error{ExitCode::kBadUsage,
                    std::string(option) + ": needs --color-by NAME: scans are shown in their own colours"};
    if (option && color_by == kNormal)
        throw Error{ExitCode::kBadUsage, std::string(option) + ": has no effect with --color-by normal"};
}

} // namespace pointrt
