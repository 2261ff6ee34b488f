// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/gather_sample.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "format/base/error.h"
#include "format/base/parallel.h"
#include "format/set/core_splats.h"
#include "runtime/device_scene/clip_planes.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/device_scene/representative_tiles.h"
#include "runtime/scene/kept.h"

namespace pointrt {
namespace {

/// Size of the sample. With it, the extent of a scan in the picture differs by 0.2% from that of all splats; with an
/// eighth of it, by 0.8%.
constexpr std::uint64_t kSamples = 65536;
/// Most splats to read from a set: 64 MiB, which takes 0.2 seconds if the file is in memory and a second from a slow
/// disk.
constexpr std::uint64_t kSplatsOfSet = std::uint64_t{4} << 20;

/// sRGB to linear: IEC 61966-2-1.
float linearOf(std::uint8_t byte) {
    const float x = static_cast<float>(byte) / 255.0f;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

/// Reflectance according to the file: that of the material, times the splat's colour if there are colours.
std::array<float, 3> colorOf(const DeviceScan& file, const pro_splat& splat) {
    const std::uint32_t row = std::min<std::uint32_t>(splat.material, file.info.material_count - 1);
    const float* base = file.view.materials + std::size_t{row} * PRO_MATERIAL_FLOATS + PRO_MAT_BASE_COLOR;
    std::array<float, 3> color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = base[c] * ((file.info.flags & PRO_FLAG_COLOR) != 0 ? linearOf(splat.color[c]) : 1.0f);
    return color;
}

/// Places a splat. A ball has the normal 0.
/// @param cube frame of the splat
/// @param file has its material
SampledSplat sampledSplat(const pro_splat& splat, const TileCube& cube, const Placement& placement,
                          const DeviceScan& file) {
    const Vec3 origin{cube.origin[0], cube.origin[1], cube.origin[2]};
    const Vec3 position = origin + cube.scale * Vec3{splat.position[0], splat.position[1], splat.position[2]};
    const Vec3 normal{splat.normal[0], splat.normal[1], splat.normal[2]};
    return {placed(placement, position), turned(placement, normal), placement.scale * cube.scale * double{splat.radius},
            colorOf(file, splat)};
}

/// An instance, and the half-spaces that clips keep of it.
struct SampledInstance {
    Placement placement;
    std::vector<HalfSpace> kept;
};

void addIfKept(const SampledInstance& instance, const SampledSplat& splat, SceneSample& sample) {
    if (isKept(instance.kept, splat.position)) sample.splats.push_back(splat);
}

void addSplats(const DeviceScan& file, const SampledInstance& instance, std::uint64_t step, SceneSample& sample) {
    const pro_info& info = file.info;
    const TileCube cube{{info.origin[0], info.origin[1], info.origin[2]}, info.scale};
    for (std::uint64_t i = 0; i < info.splat_count; i += step) {
        pro_splat splat;
        const std::uint32_t* const words = file.view.splats + PRO_SPLAT_WORDS * i;
        pro_splat_decode(words, info.radius_max, info.radius_step, &splat);
        if (pro_splat_is_ball(words)) std::fill(std::begin(splat.normal), std::end(splat.normal), 0.0f);
        addIfKept(instance, sampledSplat(splat, cube, instance.placement, file), sample);
    }
}

/// The n for taking every n-th splat of a tile, such that the tile's part of the sample is in proportion to the
/// original splats that it represents.
std::uint64_t stepThrough(const SetTile& tile, std::uint64_t originals, std::uint64_t step) {
    const double kept = static_cast<double>(tile.splats) / static_cast<double>(std::max<std::uint64_t>(1, originals));
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(kept * static_cast<double>(step)));
}

/// The first splat to take from a tile: different for each, because always starting at 0 would give more weight to the
/// low corners of tiles.
std::uint64_t firstOf(std::size_t tile, std::uint64_t step) {
    constexpr double kGolden = 0.6180339887498949;
    const double turns = kGolden * static_cast<double>(tile);
    return static_cast<std::uint64_t>((turns - std::floor(turns)) * static_cast<double>(step));
}

/// Throws Error kBadInput if a tile cannot be read; sample is unchanged then.
void addTiles(const SceneSet& set, const SampledInstance& instance, std::uint64_t step, SceneSample& sample) {
    const TileSet& tiles = set.opened.set;
    const std::vector<TileShare> shares = representativeTiles(tiles, set.opened.children, kSplatsOfSet);
    std::vector<std::vector<pro_splat>> splats(shares.size());
    forAll(shares.size(), [&](std::size_t i) {
        const SetTile& tile = tiles.tiles[shares[i].tile];
        const std::uint64_t own_step = stepThrough(tile, shares[i].originals, step);
        splats[i] = coreSplats(tiles, tile, set.opened.folder, firstOf(i, own_step), own_step);
    });
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const TileCube cube = cubeOf(tiles, tiles.tiles[shares[i].tile]);
        for (const pro_splat& splat : splats[i])
            addIfKept(instance, sampledSplat(splat, cube, instance.placement, set.root), sample);
    }
}

/// Samples the root alone if a tile cannot be read. The error is reported later, when the tile is loaded.
void addSet(const SceneSet& set, const SampledInstance& instance, std::uint64_t step, SceneSample& sample) {
    try {
        addTiles(set, instance, step, sample);
    } catch (const Error& error) {
        if (error.code != ExitCode::kBadInput) throw;
        const TileSet& tiles = set.opened.set;
        addSplats(set.root, instance, stepThrough(tiles.tiles[0], tiles.splats, step), sample);
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

/// The number of splats of each instance of the description; for sets, of original splats.
std::vector<std::uint64_t> splatCounts(const DeviceScene& scene, const std::vector<const DeviceScan*>& scans) {
    std::vector<std::uint64_t> counts;
    for (const DeviceScan* scan : scans) counts.push_back(scan->info.splat_count);
    for (const SceneSet& set : scene.sets) counts[set.number] = set.opened.set.splats;
    return counts;
}

/// The splats of all instances that are sampled.
std::uint64_t splatsOf(const DeviceScene& scene) {
    const std::vector<std::uint64_t> counts = splatCounts(scene, representativeScans(scene));
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// Takes every step-th splat. clips: take only splats that the scene's clips keep.
SceneSample gather(const DeviceScene& scene, std::uint64_t step, bool clips) {
    SceneSample sample;
    const std::vector<const DeviceScan*> scans = representativeScans(scene);
    sample.oriented = !scans.empty();
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const DeviceScan& file = *scans[i];
        const InstanceDescription& described = scene.description.instances[i];
        SampledInstance instance{described.placement, {}};
        if (clips) instance.kept = keptOf(scene.description.clips, described);
        sample.oriented = sample.oriented && (file.info.flags & PRO_FLAG_ORIENTED) != 0;
        const auto set =
            std::find_if(scene.sets.begin(), scene.sets.end(), [&](const SceneSet& each) { return each.number == i; });
        if (set == scene.sets.end())
            addSplats(file, instance, step, sample);
        else
            addSet(*set, instance, step, sample);
        addSensors(file, instance.placement, sample);
        sample.zeros.push_back(instance.placement.translation);
    }
    sample.has_shapes = !scene.description.shapes.empty();
    return sample;
}

std::uint64_t stepFor(std::uint64_t splats, std::uint64_t samples) {
    return std::max<std::uint64_t>(1, splats / samples);
}

} // namespace

SceneSample gatherSample(const DeviceScene& scene) { return gather(scene, stepFor(splatsOf(scene), kSamples), false); }

SceneSample gatherKeptSample(const DeviceScene& scene) {
    const std::uint64_t splats = splatsOf(scene), step = stepFor(splats, kSamples);
    SceneSample sample = gather(scene, step, true);
    const std::uint64_t wanted = std::max(step * sample.splats.size() / kSamples, stepFor(splats, kSplatsOfSet));
    return wanted < step ? gather(scene, wanted, true) : sample;
}

} // namespace pointrt
