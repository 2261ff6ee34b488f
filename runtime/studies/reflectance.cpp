// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "pointrt/pro.h"
#include "shaders/shared/luminance.h"

namespace pointrt {
namespace {

constexpr const char* kIntensity = "intensity"; // the name in SPEC.md for measured intensities

std::optional<SceneAttribute> find(const TraceScene& scene, const std::string& name) {
    for (const SceneAttribute& each : scene.attributes())
        if (each.name == name) return each;
    return {};
}

[[noreturn]] void refuse(const TraceScene& scene, const std::string& name) {
    std::string names;
    for (const SceneAttribute& each : scene.attributes()) names += (names.empty() ? "" : ", ") + each.name;
    throw TraceError(TraceError::Kind::kBadUsage, "the sensor's reflectance needs the attribute " + name +
                                                      ", but the scene has " + (names.empty() ? "none" : names));
}

/// Linear light for each sRGB byte (IEC 61966-2-1).
std::array<float, 256> linearOfBytes() {
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const double encoded = static_cast<double>(i) / 255;
        linear[i] = static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return linear;
}

} // namespace

ReflectanceLookup::ReflectanceLookup(const TraceScene& scene, const LidarReflectance& reflectance)
    : scene_(scene), reflectance_(reflectance) {
    if (reflectance_.source == LidarReflectance::Source::kScan) {
        reflectance_.source =
            find(scene, kIntensity) ? LidarReflectance::Source::kAttribute : LidarReflectance::Source::kColor;
        reflectance_.attribute = kIntensity;
    }
    if (reflectance_.source != LidarReflectance::Source::kAttribute) return;
    const auto found = find(scene, reflectance_.attribute);
    if (!found) refuse(scene, reflectance_.attribute);
    attribute_ = *found;
    if (reflectance_.white == 0) reflectance_.white = attribute_.high > 0 ? attribute_.high : 1;
}

void ReflectanceLookup::lookUp(const HitIds& hits, std::span<float> reflectances) {
    const auto value = static_cast<float>(reflectance_.value);
    if (reflectance_.source == LidarReflectance::Source::kConstant)
        return std::fill(reflectances.begin(), reflectances.end(), value);
    if (reflectance_.source == LidarReflectance::Source::kAttribute) {
        buffer_.resize(reflectances.size() * attribute_.bytes);
        scene_.readAttribute(attribute_.name, hits.splats, hits.instances, hits.tiles, buffer_);
        fromAttribute(reflectances);
    } else {
        buffer_.resize(reflectances.size() * 3);
        scene_.readColors(hits.splats, hits.instances, hits.tiles,
                          {reinterpret_cast<std::uint8_t*>(buffer_.data()), buffer_.size()});
        fromColors(reflectances);
    }
    for (std::size_t i = 0; i < reflectances.size(); ++i)
        if (hits.instances[i] == kShapesInstance) reflectances[i] = value;
}

void ReflectanceLookup::fromColors(std::span<float> reflectances) const {
    static const std::array<float, 256> kLinear = linearOfBytes();
    const auto light = [&](std::size_t i) { return kLinear[std::to_integer<std::size_t>(buffer_[i])]; };
    for (std::size_t i = 0; i < reflectances.size(); ++i)
        reflectances[i] = luminance<float>(light(3 * i), light(3 * i + 1), light(3 * i + 2));
}

/// Uses the first component. NaN and negative numbers are black.
void ReflectanceLookup::fromAttribute(std::span<float> reflectances) const {
    pro_attribute numbers{};
    numbers.type = attribute_.type;
    numbers.components = attribute_.components;
    numbers.values = buffer_.data();
    for (std::size_t i = 0; i < reflectances.size(); ++i) {
        const double share = pro_attribute_value(&numbers, i * attribute_.components) / reflectance_.white;
        reflectances[i] = share > 0 ? static_cast<float>(std::min(share, 1.0)) : 0.0f;
    }
}

} // namespace pointrt
