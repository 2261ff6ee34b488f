// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/scene_paint.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <utility>

#include "format/base/error.h"
#include "pointrt/pro_index_layout.h"
#include "runtime/device_scene/color_choice.h"
#include "runtime/device_scene/splat_selection.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

constexpr std::size_t kMostRows = 256; // a splat has one byte for its row
/// Splats painted and uploaded at a time: 64 MiB, the size of the staging buffer.
constexpr std::size_t kSplatsAtOnce = std::size_t{4} << 20;
/// The same for near splats.
constexpr std::size_t kNearAtOnce = std::size_t{8} << 20;

bool hasNumbers(const MaterialOverride& over) { return std::holds_alternative<SplatSelection>(over.splats); }

bool hasNumbers(const InstanceDescription& instance) {
    return std::any_of(instance.overrides.begin(), instance.overrides.end(),
                       [](const MaterialOverride& over) { return hasNumbers(over); });
}

bool usesHeights(const std::vector<MaterialOverride>& overrides) {
    return std::any_of(overrides.begin(), overrides.end(), [](const MaterialOverride& over) {
        const auto* numbers = std::get_if<SplatSelection>(&over.splats);
        return numbers && numbers->attribute == kHeight;
    });
}

bool usesHeights(const std::vector<FilterDescription>& filters) {
    return std::any_of(filters.begin(), filters.end(),
                       [](const FilterDescription& each) { return each.shown.attribute == kHeight; });
}

bool usesHeights(const PaintRequest& request) {
    return request.color_by == kHeight || usesHeights(request.filters) ||
           std::any_of(request.overrides.begin(), request.overrides.end(),
                       [](const std::vector<MaterialOverride>& each) { return usesHeights(each); });
}

SplatOverride::OfNumbers numbersOf(const MaterialOverride& over, const SplatSelection& wanted, const PlacedScan& scan,
                                   Vec3 up) {
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
            painted.splats = numbersOf(over, std::get<SplatSelection>(over.splats), scan, up);
        painted.row = rowOf(materials, over.material, *scan.file);
        overrides.push_back(std::move(painted));
    }
    return overrides;
}

bool holdOnlyGaussians(const std::vector<PlacedScan>& scans) {
    return !scans.empty() &&
           std::all_of(scans.begin(), scans.end(), [](const PlacedScan& scan) { return scan.file->is_gaussian; });
}

/// The scans that do not keep their own colours.
std::vector<PlacedScan> coloredScans(std::vector<PlacedScan> scans) {
    std::erase_if(scans, [](const PlacedScan& scan) { return !scan.instance->colored; });
    return scans;
}

/// Refuses filters by an attribute that no scan has.
void requireFiltered(const std::vector<PlacedScan>& scans, const PaintRequest& request) {
    for (const FilterDescription& filter : request.filters) {
        if (holdOnlyGaussians(scans))
            throw Error{ExitCode::kBadInput, filter.place + "Gaussian captures have no attributes to select by"};
        const auto has = [&](const PlacedScan& scan) {
            return numbersFor(scan, filter.shown.attribute, request.up).has_value();
        };
        if (!scans.empty() && std::none_of(scans.begin(), scans.end(), has))
            throw Error{ExitCode::kBadInput, filter.place + lackText(scans, filter.shown.attribute, {kHeight})};
    }
}

/// Whether an instance's splats are painted alike by both requests.
bool paintsAlike(const PaintRequest& request, const PlacedScan& a, const PlacedScan& b) {
    const bool by_place = usesHeights(request) || request.color_by == kNormal || usesHeights(a.instance->overrides);
    return a.file == b.file && a.instance->overrides == b.instance->overrides &&
           a.instance->colored == b.instance->colored && (!by_place || a.instance->placement == b.instance->placement);
}

/// Copies the near splats of a scan, except those that filters hide, with their radii multiplied by size.
/// @param shown empty: all
PagedBuffer shownNear(Device& device, const DeviceScan& file, const std::vector<std::uint64_t>& shown, float size) {
    const pro_index& index = file.index;
    constexpr std::size_t kNearBytes = PRO_NEAR_WORDS * sizeof(std::uint32_t);
    PagedBuffer buffer = createEmptyPagedBuffer(device, "shown near splat buffer", index.near_count * kNearBytes,
                                                VK_FORMAT_R32G32B32A32_UINT);
    const OnError undo([&] { destroyPagedBuffer(device, buffer); });
    std::vector<std::uint32_t> words;
    for (std::size_t first = 0; first < index.near_count; first += kNearAtOnce) {
        const std::size_t count = std::min<std::size_t>(kNearAtOnce, index.near_count - first);
        words.resize(count * PRO_NEAR_WORDS);
        const std::span<const std::uint32_t> near{index.near_splats + first * PRO_NEAR_WORDS, words.size()};
        if (shown.empty())
            std::ranges::copy(near, words.begin());
        else
            copyShownNear(shown, near, {index.listed + first, count}, words);
        if (size != 1) resizeNear(size, words);
        uploadPages(device, buffer, words.data(), words.size() * sizeof(std::uint32_t), first * kNearBytes);
    }
    return buffer;
}

/// @param shown empty: all
PagedBuffer paintedBuffer(Device& device, const DeviceScan& file, const SplatPaint& paint,
                          const std::vector<std::uint64_t>& shown) {
    const std::size_t count = file.info.splat_count;
    constexpr std::size_t kSplatBytes = PRO_SPLAT_WORDS * sizeof(std::uint32_t);
    PagedBuffer buffer =
        createEmptyPagedBuffer(device, "painted splat buffer", count * kSplatBytes, VK_FORMAT_R32G32B32A32_UINT);
    const OnError undo([&] { destroyPagedBuffer(device, buffer); });
    std::vector<std::uint32_t> words;
    for (std::size_t first = 0; first < count; first += kSplatsAtOnce) {
        words.resize(std::min(kSplatsAtOnce, count - first) * PRO_SPLAT_WORDS);
        paintSplats(paint, file.view.splats, first, words);
        if (!shown.empty()) moveHiddenAway(shown, first, words);
        uploadPages(device, buffer, words.data(), words.size() * sizeof(std::uint32_t), first * kSplatBytes);
    }
    return buffer;
}

} // namespace

bool isColored(const InstanceDescription& instance, const RenderSettings& settings) {
    return settings.color_by != kOwnColors && instance.colored;
}

bool isPainted(const InstanceDescription& instance, const RenderSettings& settings) {
    return isColored(instance, settings) || settings.splat_size != 1 || hasNumbers(instance);
}

bool paintsScans(const SceneDescription& scene, const RenderSettings& settings) {
    return hidesSplats(scene.filters) ||
           std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const InstanceDescription& each) { return isPainted(each, settings); });
}

PaintRequest paintRequest(const SceneDescription& scene, const RenderSettings& settings) {
    PaintRequest request;
    if (settings.color_by != kOwnColors) {
        for (const InstanceDescription& instance : scene.instances) request.colored.push_back(instance.colored);
        request.color_by = settings.color_by;
        request.color_map = settings.color_map;
        request.color_range = settings.color_range;
    }
    std::copy_if(scene.filters.begin(), scene.filters.end(), std::back_inserter(request.filters),
                 [](const FilterDescription& each) { return hidesSplats(each); });
    const auto painted = [&](const InstanceDescription& instance) {
        return !request.filters.empty() || isPainted(instance, settings);
    };
    if (paintsScans(scene, settings))
        for (const InstanceDescription& instance : scene.instances)
            request.overrides.push_back(painted(instance) ? instance.overrides : std::vector<MaterialOverride>());
    request.splat_size = settings.splat_size;
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
    if (colored && holdOnlyGaussians(scans))
        throw Error{ExitCode::kBadUsage, "--color-by: Gaussian captures have no colours but their own"};
    ColorChoice choice;
    const std::vector<PlacedScan> painted = coloredScans(scans);
    if (colored && (scans.empty() || !painted.empty())) choice = chooseColors(painted, request);
    requireFiltered(scans, request);
    plan.legend = std::move(choice.legend);
    std::size_t next = 0; // index in choice.colors
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const bool resized = request.splat_size != 1;
        const bool is_colored = colored && scans[i].instance->colored;
        const std::size_t choice_of_this = next;
        next += is_colored ? 1 : 0;
        if (!is_colored && !resized && !hasNumbers(*scans[i].instance) && request.filters.empty()) continue;
        if (scans[i].file->is_gaussian) continue; // has other buffers and no attributes
        SplatPaint& paint = plan.paints[i].emplace();
        if (is_colored) paint.colors = std::move(choice.colors[choice_of_this]);
        paint.overrides = overridesOf(scans[i], request.up);
        paint.selections = selectionsOf(scans[i], request.filters, request.up);
        paint.size = request.splat_size;
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
        painted.splats.push_back(paintScan(device, *scans[i].file, *plan.paints[i]));
        painted.of[i] = painted.splats.size() - 1;
    }
    return painted;
}

bool hidesAllSplats(const ScenePaint& paint) {
    return !paint.of.empty() && std::all_of(paint.of.begin(), paint.of.end(), [&](std::optional<std::size_t> painted) {
        return painted && paint.splats[*painted].shown == 0;
    });
}

PaintedSplats paintScan(Device& device, const DeviceScan& file, const SplatPaint& paint) {
    PaintedSplats painted{{}, file.info.splat_count, std::nullopt};
    const OnError undo([&] { destroyPaintedSplats(device, painted); });
    std::vector<std::uint64_t> shown;
    if (!paint.selections.empty()) shown = shownSplats(paint.selections, file.info.splat_count);
    painted.splats = paintedBuffer(device, file, paint, shown);
    if (!shown.empty() || paint.size != 1) painted.near = shownNear(device, file, shown, paint.size);
    if (shown.empty()) return painted;
    painted.shown =
        std::accumulate(shown.begin(), shown.end(), std::uint64_t{0}, [](std::uint64_t sum, std::uint64_t word) {
            return sum + static_cast<std::uint64_t>(std::popcount(word));
        });
    return painted;
}

void destroyPaintedSplats(Device& device, PaintedSplats& painted) {
    destroyPagedBuffer(device, painted.splats);
    if (painted.near) destroyPagedBuffer(device, *painted.near);
    painted = {};
}

std::vector<BufferBinding> paintedBindings(const DeviceScan& file, const PaintedSplats& painted) {
    std::vector<BufferBinding> bindings = scanBindings(file);
    const auto rebind = [&](gpu::Binding texels, gpu::Binding stored, const PagedBuffer& buffer) {
        for (BufferBinding& each : bindings)
            if (each.slot == texels || (each.slot == stored && file.reads_storage)) each.buffer = &buffer.pages[0];
    };
    rebind(BINDING_SPLATS, BINDING_SPLAT_STORED, painted.splats);
    if (painted.near) rebind(BINDING_NEAR, BINDING_NEAR_STORED, *painted.near);
    return bindings;
}

PagedBuffers paintedPages(const DeviceScan& file, const PaintedSplats& painted) {
    PagedBuffers buffers = pagedBuffers(file);
    for (std::size_t k = 0; k < buffers.size(); ++k) {
        if (kPagedPlaces[k].further == BINDING_SPLAT_PAGES) buffers[k] = &painted.splats;
        if (kPagedPlaces[k].further == BINDING_NEAR_PAGES && painted.near) buffers[k] = &*painted.near;
    }
    return buffers;
}

void destroyScenePaint(Device& device, ScenePaint& paint) {
    for (PaintedSplats& each : paint.splats) destroyPaintedSplats(device, each);
    paint = {};
}

std::uint64_t deviceBytes(const ScenePaint& paint) {
    const auto bytesOf = [](const PagedBuffer& buffer) {
        return std::accumulate(buffer.pages.begin(), buffer.pages.end(), std::uint64_t{0},
                               [](std::uint64_t sum, const Buffer& page) { return sum + page.bytes; });
    };
    std::uint64_t bytes = 0;
    for (const PaintedSplats& each : paint.splats)
        bytes += bytesOf(each.splats) + (each.near ? bytesOf(*each.near) : 0);
    return bytes;
}

} // namespace pointrt
