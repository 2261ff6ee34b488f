// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/gather_sample.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/device_scene/render_space.h"

namespace pointrt {
namespace {

/// A percent of them tells strays from the rest, and they are of no more pages of a file.
constexpr std::uint64_t kSamples = 8192;

/// sRGB to linear: IEC 61966-2-1.
float linearOf(std::uint8_t byte) {
    const float x = static_cast<float>(byte) / 255.0f;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

Vec3 turned(const Placement& placement, Vec3 input) {
    const std::array<Vec3, 3>& r = placement.rotation;
    return {dot(r[0], input), dot(r[1], input), dot(r[2], input)};
}

Vec3 placed(const Placement& placement, Vec3 input) {
    return placement.translation + placement.scale * turned(placement, input);
}

/// Reflectance by the file: its material's, times the splat's colour where there are colours.
std::array<float, 3> colorOf(const DeviceScan& file, const pro_splat& splat) {
    const std::uint32_t row = std::min<std::uint32_t>(splat.material, file.info.material_count - 1);
    const float* base = file.view.materials + std::size_t{row} * PRO_MATERIAL_FLOATS + PRO_MAT_BASE_COLOR;
    std::array<float, 3> color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = base[c] * ((file.info.flags & PRO_FLAG_COLOR) != 0 ? linearOf(splat.color[c]) : 1.0f);
    return color;
}

void addSplats(const DeviceScan& file, const Placement& placement, std::uint64_t step, SceneSample& sample) {
    const pro_info& info = file.info;
    const Vec3 origin{info.origin[0], info.origin[1], info.origin[2]};
    for (std::uint64_t i = 0; i < info.splat_count; i += step) {
        pro_splat splat;
        pro_splat_decode(file.view.splats + PRO_SPLAT_WORDS * i, info.radius_max, info.radius_step, &splat);
        const Vec3 position = origin + info.scale * Vec3{splat.position[0], splat.position[1], splat.position[2]};
        const Vec3 normal{splat.normal[0], splat.normal[1], splat.normal[2]};
        sample.splats.push_back({placed(placement, position), turned(placement, normal),
                                 placement.scale * info.scale * double{splat.radius}, colorOf(file, splat)});
    }
}

void addSensors(const DeviceScan& file, const Placement& placement, SceneSample& sample) {
    pro_world world;
    pro_get_world(file.file, &world);
    for (std::uint32_t i = 0; i < world.sensor_count; ++i) {
        const double* row = world.sensors + std::size_t{PRO_SENSOR_DOUBLES} * i;
        const Vec3 place = placed(placement, {row[0], row[1], row[2]});
        const bool known = row[3] != 0;
        if (known && std::find(sample.sensors.begin(), sample.sensors.end(), place) == sample.sensors.end())
            sample.sensors.push_back(place);
    }
}

/// Of each instance of the description; of a set those of its original tiles.
std::vector<std::uint64_t> splatCounts(const DeviceScene& scene, const std::vector<const DeviceScan*>& scans) {
    std::vector<std::uint64_t> counts;
    for (const DeviceScan* scan : scans) counts.push_back(scan->info.splat_count);
    for (const SceneSet& set : scene.sets) counts[set.number] = set.opened.set.splats;
    return counts;
}

} // namespace

SceneSample gatherSample(const DeviceScene& scene) {
    SceneSample sample;
    const std::vector<const DeviceScan*> scans = wholeScans(scene);
    const std::vector<std::uint64_t> counts = splatCounts(scene, scans);
    const std::uint64_t splats = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    const std::uint64_t step = std::max<std::uint64_t>(1, splats / kSamples);
    sample.oriented = !scans.empty();
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const DeviceScan& file = *scans[i];
        const Placement& placement = scene.description.instances[i].placement;
        sample.oriented = sample.oriented && (file.info.flags & PRO_FLAG_ORIENTED) != 0;
        // of a set the root has fewer
        const double share = static_cast<double>(file.info.splat_count) / static_cast<double>(counts[i]);
        const auto own_step = static_cast<std::uint64_t>(share * static_cast<double>(step));
        addSplats(file, placement, std::max<std::uint64_t>(1, own_step), sample);
        addSensors(file, placement, sample);
        sample.zeros.push_back(placement.translation);
    }
    sample.furnished = !scene.description.shapes.empty();
    return sample;
}

} // namespace pointrt
