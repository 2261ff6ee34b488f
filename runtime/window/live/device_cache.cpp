// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/device_cache.h"

#include <algorithm>
#include <span>

#include "runtime/util/on_error.h"
#include "runtime/window/live/reprojector.h"
#include "shaders/advance_errors.spv.h"
#include "shaders/balance_priorities.spv.h"
#include "shaders/blend_shown.spv.h"
#include "shaders/choose_points.spv.h"
#include "shaders/fill_holes.spv.h"
#include "shaders/gather_points.spv.h"
#include "shaders/hold_hits.spv.h"
#include "shaders/insert_points.spv.h"
#include "shaders/mean_tiles.spv.h"
#include "shaders/outdate_points.spv.h"
#include "shaders/prioritise.spv.h"
#include "shaders/project_points.spv.h"
#include "shaders/replace_points.spv.h"
#include "shaders/resample_points.spv.h"
#include "shaders/reset_cache.spv.h"
#include "shaders/select_pixels.spv.h"
#include "shaders/shared/params.h"
#include "shaders/sum_priorities.spv.h"
#include "shaders/take_colors.spv.h"

namespace pointrt {
namespace {

std::span<const std::uint32_t> codeOf(CacheStep step) {
    switch (step) {
#define POINTRT_CODE(name, file)                                                                                       \
    case CacheStep::name:                                                                                              \
        return file##_spv;
        POINTRT_CACHE_STEPS(POINTRT_CODE)
#undef POINTRT_CODE
    case CacheStep::kEnd:
        break;
    }
    return {};
}

constexpr const char* kNames[] = {
#define POINTRT_NAME(name, file) #file,
    POINTRT_CACHE_STEPS(POINTRT_NAME)
#undef POINTRT_NAME
};

std::uint32_t pixelsOf(const DeviceCache& cache) { return cache.size.width * cache.size.height; }
std::uint32_t tilesAlong(std::uint32_t pixels) { return (pixels + TILE_SIDE - 1) / TILE_SIDE; }
std::uint32_t tilesOf(const DeviceCache& cache) { return tilesAlong(cache.size.width) * tilesAlong(cache.size.height); }

/// The buffers in the cache's memory, with their names and sizes.
struct CacheBuffer {
    Buffer DeviceCache::*buffer;
    const char* what;
    std::uint64_t count, bytes; ///< elements, and bytes of each
    gpu::Binding slot{};
};

std::vector<CacheBuffer> buffersOf(const DeviceCache& cache) {
    constexpr std::uint64_t kWord = sizeof(std::uint32_t), kVector = sizeof(gpu::vec4);
    const std::uint64_t points = pointsOf(cache.size), pixels = pixelsOf(cache), tiles = tilesOf(cache);
    using C = DeviceCache;
    return {{&C::params, "cache parameters", 1, sizeof(gpu::ReprojectionParams), BINDING_CACHE_PARAMS},
            {&C::control, "cache counters", 1, sizeof(gpu::ReprojectionControl), BINDING_CACHE_CONTROL},
            {&C::points, "cached points", points, kVector, BINDING_CACHE_POINTS},
            {&C::colors, "cached colours", points, kWord, BINDING_CACHE_COLORS},
            {&C::visible, "visible points", points, kWord, BINDING_CACHE_VISIBLE},
            {&C::projected, "projected points", points, 2 * kWord, BINDING_CACHE_PROJECTED},
            {&C::nearest, "nearest points", pixels, 2 * kWord, BINDING_CACHE_NEAREST},
            {&C::seen, "points seen", pixels, kWord, BINDING_CACHE_SEEN},
            {&C::shown, "reprojected picture", pixels, kWord, BINDING_CACHE_SHOWN},
            {&C::tiles, "tile colours", tiles, sizeof(gpu::TileColors), BINDING_CACHE_TILES},
            {&C::tile_means, "tile means", tiles, kWord, BINDING_CACHE_TILE_MEANS},
            {&C::errors, "tile errors", tiles, kWord, BINDING_CACHE_ERRORS},
            {&C::recorded, "recorded errors", tiles, kWord, BINDING_CACHE_RECORDED},
            {&C::priorities, "priorities", tiles * CONSIDERED_OF_TILE, kWord, BINDING_CACHE_PRIORITIES},
            {&C::row_sums, "sums of priorities", tilesAlong(cache.size.height), sizeof(gpu::RowSum),
             BINDING_CACHE_ROW_SUMS},
            {&C::new_points, "new points", pixels, kVector, BINDING_CACHE_NEW_POINTS},
            {&C::new_depths, "new depths", pixels, kWord, BINDING_CACHE_NEW_DEPTHS}};
}

void createAll(Device& device, DeviceCache& cache, const FrameBuffers& frame, const Buffer& pixels) {
    for (const CacheBuffer& each : buffersOf(cache))
        cache.*each.buffer =
            createBuffer(device, each.what, each.count * each.bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    cache.control_read = createBuffer(device, "cache counters read", kFramesInFlight * sizeof(gpu::ReprojectionControl),
                                      0, MemoryHome::kReadback);
    for (std::size_t i = 0; i < cache.programs.size(); ++i)
        cache.programs[i] = createProgram(device, kNames[i], codeOf(static_cast<CacheStep>(i)));
    cache.timer = createGpuTimer(device, 2 * kFramesInFlight);
    bindDeviceCache(device, cache, frame, pixels);
}

const Program& programOf(const DeviceCache& cache, CacheStep step) {
    return cache.programs[static_cast<std::size_t>(step)];
}

void runGroups(VkCommandBuffer commands, const DeviceCache& cache, CacheStep step, std::uint32_t groups,
               const gpu::ReprojectionPush& push = {}) {
    recordDispatch(commands, programOf(cache, step), cache.set, pushBytes(push), {groups, 1, 1});
    recordBarrier(commands);
}

/// Runs a program with a lane for each of this many elements.
void run(VkCommandBuffer commands, const DeviceCache& cache, CacheStep step, std::uint32_t lanes,
         const gpu::ReprojectionPush& push = {}) {
    runGroups(commands, cache, step, (lanes + REPROJECT_GROUP - 1) / REPROJECT_GROUP, push);
}

} // namespace

std::uint32_t pointsOf(PixelSize size) {
    return static_cast<std::uint32_t>(std::uint64_t{size.width} * size.height * kPointsOf4 / 4) + REPROJECT_GROUP;
}

DeviceCache createDeviceCache(Device& device, PixelSize size, const FrameBuffers& frame, const Buffer& pixels) {
    DeviceCache cache;
    cache.size = size;
    const OnError undo([&] { destroyDeviceCache(device, cache); });
    createAll(device, cache, frame, pixels);
    return cache;
}

void bindDeviceCache(Device& device, DeviceCache& cache, const FrameBuffers& frame, const Buffer& pixels) {
    std::vector<BufferBinding> bindings;
    for (const CacheBuffer& each : buffersOf(cache)) bindings.push_back({each.slot, &(cache.*each.buffer)});
    bindings.push_back({BINDING_CACHE_PIXEL_LIST, &frame.pixel_list});
    bindings.push_back({BINDING_FILM, &frame.film});
    bindings.push_back({BINDING_FIRST_HITS, &frame.first_hits});
    bindings.push_back({BINDING_TONEMAP_PIXELS, &pixels});
    destroyDescriptorPool(device, cache.pool);
    cache.pool = createDescriptorPool(device, 1);
    cache.set = createDescriptorSet(device, cache.pool, programOf(cache, CacheStep::kInsert), bindings);
}

void destroyDeviceCache(Device& device, DeviceCache& cache) {
    destroyDescriptorPool(device, cache.pool);
    for (Program& program : cache.programs) destroyProgram(device, program);
    for (const CacheBuffer& each : buffersOf(cache)) destroyBuffer(device, cache.*each.buffer);
    destroyBuffer(device, cache.control_read);
    destroyGpuTimer(device, cache.timer);
}

std::uint64_t deviceBytes(const DeviceCache& cache) {
    std::uint64_t bytes = 0;
    for (const CacheBuffer& each : buffersOf(cache)) bytes += (cache.*each.buffer).bytes;
    return bytes;
}

void recordParams(VkCommandBuffer commands, const DeviceCache& cache, const gpu::ReprojectionParams& params) {
    vkCmdUpdateBuffer(commands, cache.params.handle, 0, sizeof params, &params);
    recordBarrier(commands);
}

void recordClear(VkCommandBuffer commands, const DeviceCache& cache) {
    run(commands, cache, CacheStep::kReset, pointsOf(cache.size), {0, 0, REPROJECT_CLEARS, 0});
}

void recordReproject(VkCommandBuffer commands, const DeviceCache& cache) {
    const std::uint32_t points = pointsOf(cache.size);
    run(commands, cache, CacheStep::kReset, points);
    run(commands, cache, CacheStep::kProject, points);
    run(commands, cache, CacheStep::kChoose, points);
    run(commands, cache, CacheStep::kGather, tilesOf(cache) * TILE_PIXELS);
}

void recordSelect(VkCommandBuffer commands, const DeviceCache& cache) {
    const std::uint32_t rows = tilesAlong(cache.size.height);
    run(commands, cache, CacheStep::kAdvanceErrors, tilesOf(cache));
    for (std::uint32_t round = 0; round < BALANCE_ROUNDS; ++round) {
        runGroups(commands, cache, round == 0 ? CacheStep::kPrioritise : CacheStep::kSumPriorities, rows);
        runGroups(commands, cache, CacheStep::kBalancePriorities, 1);
    }
    run(commands, cache, CacheStep::kSelect, tilesOf(cache) * CONSIDERED_OF_TILE);
}

void recordInsert(VkCommandBuffer commands, const DeviceCache& cache, std::uint32_t listed, const Buffer& pixels) {
    run(commands, cache, CacheStep::kInsert, listed);
    run(commands, cache, CacheStep::kMeanTiles, tilesOf(cache));
    run(commands, cache, CacheStep::kFillHoles, tilesOf(cache) * TILE_PIXELS);
    const VkBufferCopy picture{0, 0, cache.shown.bytes};
    vkCmdCopyBuffer(commands, cache.shown.handle, pixels.handle, 1, &picture);
    run(commands, cache, CacheStep::kResample, pixelsOf(cache));
    run(commands, cache, CacheStep::kReplace, pointsOf(cache.size), {0, 0, REPROJECT_IF_GAPS, 0});
}

void recordTakeColors(VkCommandBuffer commands, const DeviceCache& cache) {
    run(commands, cache, CacheStep::kTakeColors, pointsOf(cache.size));
    run(commands, cache, CacheStep::kReset, pointsOf(cache.size), {0, 0, REPROJECT_KEEPS_POINTS, 0});
    run(commands, cache, CacheStep::kGather, tilesOf(cache) * TILE_PIXELS);
}

void recordHoldHits(VkCommandBuffer commands, const DeviceCache& cache, std::uint32_t first, std::uint32_t count) {
    run(commands, cache, CacheStep::kHoldHits, count, {first, count, 0, 0});
}

void recordReplace(VkCommandBuffer commands, const DeviceCache& cache) {
    run(commands, cache, CacheStep::kReplace, pointsOf(cache.size));
}

void recordOutdate(VkCommandBuffer commands, const DeviceCache& cache, std::uint32_t frame, bool shapes) {
    run(commands, cache, CacheStep::kOutdate, pointsOf(cache.size), {frame, 0, shapes ? REPROJECT_SHAPES : 0u, 0});
}

void recordBlend(VkCommandBuffer commands, const DeviceCache& cache, std::uint32_t first, std::uint32_t count,
                 float share) {
    run(commands, cache, CacheStep::kBlendShown, count, {first, count, 0, share});
}

} // namespace pointrt
