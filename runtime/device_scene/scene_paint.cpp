// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/scene_paint.h"

#include <algorithm>
#include <utility>

#include "format/base/error.h"
#include "runtime/device_scene/color_choice.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

constexpr std::size_t kMostRows = 256; // a splat has one byte for its row
/// Splats painted and uploaded at a time: 64 MiB, the size of the staging buffer.
constexpr std::size_t kSplatsAtOnce = std::size_t{4} << 20;

bool hasNumbers(const MaterialOverride& over) { return std::holds_alternative<MaterialOverride::Numbers>(over.splats); }

bool hasNumbers(const InstanceDescription& instance) {
    return std::any_of(instance.overrides.begin(), instance.overrides.end(),
                       [](const MaterialOverride& over) { return hasNumbers(over); });
}

bool usesHeights(const std::vector<MaterialOverride>& overrides) {
    return std::any_of(overrides.begin(), overrides.end(), [](const MaterialOverride& over) {
        const auto* numbers = std::get_if<MaterialOverride::Numbers>(&over.splats);
        return numbers && numbers->attribute == kHeight;
    });
}

bool usesHeights(const PaintRequest& request) {
    return request.color_by == kHeight ||
           std::any_of(request.overrides.begin(), request.overrides.end(),
                       [](const std::vector<MaterialOverride>& each) { return usesHeights(each); });
}

SplatOverride::OfNumbers numbersOf(const MaterialOverride& over, const MaterialOverride::Numbers& wanted,
                                   const PlacedScan& scan, Vec3 up) {
    const auto numbers = numbersFor(scan, wanted.attribute, up);
    if (!numbers) throw Error{ExitCode::kBadInput, over.place + lackText({scan}, wanted.attribute, {kHeight})};
    return {*numbers, wanted.ranges};
}

/// The row of a material for painted splats.
std::uint8_t rowOf(const std::vector<std::uint32_t>& materials, std::uint32_t material, const DeviceScan& file) {
    const auto at = std::find(materials.begin(), materials.end(), material) - materials.begin();
    return static_cast<std::uint8_t>(file.info.material_count + static_cast<std::size_t>(at));
}

std::vector<SplatOverride> overridesOf(const PlacedScan& scan, Vec3 up) {
    const std::vector<std::uint32_t> materials = paintedMaterials(*scan.instance, *scan.file);
    std::vector<SplatOverride> overrides;
    for (const MaterialOverride& over : scan.instance->overrides) {
        SplatOverride painted;
        if (const auto* row = std::get_if<MaterialOverride::Row>(&over.splats))
            painted.splats = SplatOverride::OfRow{static_cast<std::uint8_t>(row->row)};
        else if (const auto* range = std::get_if<MaterialOverride::ColorRange>(&over.splats))
            painted.splats = SplatOverride::OfColors{range->low, range->high};
        else
            painted.splats = numbersOf(over, std::get<MaterialOverride::Numbers>(over.splats), scan, up);
        painted.row = rowOf(materials, over.material, *scan.file);
        overrides.push_back(std::move(painted));
    }
    return overrides;
}

/// Whether both get the same painted splats.
bool paintsAlike(const PaintRequest& request, const PlacedScan& a, const PlacedScan& b) {
    const bool by_place =
        request.color_by == kHeight || request.color_by == kNormal || usesHeights(a.instance->overrides);
    return a.file == b.file && a.instance->overrides == b.instance->overrides &&
           (!by_place || a.instance->placement == b.instance->placement);
}

PagedBuffer paintedBuffer(Device& device, const DeviceScan& file, const SplatPaint& paint) {
    const std::size_t count = file.info.splat_count;
    constexpr std::size_t kSplatBytes = PRO_SPLAT_WORDS * sizeof(std::uint32_t);
    PagedBuffer buffer =
        createEmptyPagedBuffer(device, "painted splat buffer", count * kSplatBytes, VK_FORMAT_R32G32B32A32_UINT);
    const OnError undo([&] { destroyPagedBuffer(device, buffer); });
    std::vector<std::uint32_t> words;
    for (std::size_t first = 0; first < count; first += kSplatsAtOnce) {
        words.resize(std::min(kSplatsAtOnce, count - first) * PRO_SPLAT_WORDS);
        paintSplats(paint, file.view.splats, first, words);
        uploadPages(device, buffer, words.data(), words.size() * sizeof(std::uint32_t), first * kSplatBytes);
    }
    return buffer;
}

} // namespace

bool isColored(const RenderSettings& settings) { return settings.color_by != kOwnColors; }

bool isPainted(const InstanceDescription& instance, const RenderSettings& settings) {
    return isColored(settings) || hasNumbers(instance);
}

PaintRequest paintRequest(const SceneDescription& scene, const RenderSettings& settings) {
    PaintRequest request;
    if (isColored(settings)) {
        request.color_by = settings.color_by;
        request.color_map = settings.color_map;
        request.color_range = settings.color_range;
    }
    const auto painted = [&](const InstanceDescription& instance) { return isPainted(instance, settings); };
    if (std::any_of(scene.instances.begin(), scene.instances.end(), painted))
        for (const InstanceDescription& instance : scene.instances)
            request.overrides.push_back(painted(instance) ? instance.overrides : std::vector<MaterialOverride>());
    if (usesHeights(request)) request.up = sceneUp(scene, settings);
    return request;
}

std::vector<std::uint32_t> paintedMaterials(const InstanceDescription& instance, const DeviceScan& file) {
    std::vector<std::uint32_t> materials;
    for (const MaterialOverride& over : instance.overrides) {
        if (std::holds_alternative<MaterialOverride::Row>(over.splats)) continue;
        if (std::find(materials.begin(), materials.end(), over.material) != materials.end()) continue;
        materials.push_back(over.material);
        if (file.info.material_count + materials.size() > kMostRows)
            throw Error{ExitCode::kBadInput,
                        over.place + file.path + " has more than 256 materials, counting those of overrides"};
    }
    return materials;
}

PaintPlan planPaint(const std::vector<PlacedScan>& scans, const PaintRequest& request) {
    PaintPlan plan;
    plan.request = request;
    plan.paints.resize(scans.size());
    const bool colored = request.color_by != kOwnColors;
    ColorChoice choice;
    if (colored) choice = chooseColors(scans, request);
    plan.legend = std::move(choice.legend);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        if (!colored && !hasNumbers(*scans[i].instance)) continue;
        SplatPaint& paint = plan.paints[i].emplace();
        if (colored) paint.colors = std::move(choice.colors[i]);
        paint.overrides = overridesOf(scans[i], request.up);
    }
    return plan;
}

ScenePaint paintScene(Device& device, const std::vector<PlacedScan>& scans, PaintPlan plan) {
    ScenePaint painted{std::move(plan.request), std::move(plan.legend), {}, {}};
    const OnError undo([&] { destroyScenePaint(device, painted); });
    for (std::size_t i = 0; i < scans.size(); ++i) {
        painted.of.emplace_back();
        for (std::size_t k = 0; k < i && plan.paints[i]; ++k)
            if (paintsAlike(painted.request, scans[i], scans[k])) painted.of[i] = painted.of[k];
        if (!plan.paints[i] || painted.of[i]) continue;
        painted.splats.push_back(paintedBuffer(device, *scans[i].file, *plan.paints[i]));
        painted.of[i] = painted.splats.size() - 1;
    }
    return painted;
}

void destroyScenePaint(Device& device, ScenePaint& paint) {
    for (PagedBuffer& each : paint.splats) destroyPagedBuffer(device, each);
    paint = {};
}

std::uint64_t deviceBytes(const ScenePaint& paint) {
    std::uint64_t bytes = 0;
    for (const PagedBuffer& each : paint.splats)
        for (const Buffer& page : each.pages) bytes += page.bytes;
    return bytes;
}

} // namespace pointrt
