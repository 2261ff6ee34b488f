// SPDX-License-Identifier: Apache-2.0
// The render cache (render_cache.h) in the memory of a GPU: its buffers and programs (shaders/display), and the
// commands of a frame.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/gpu/gpu_timer.h"
#include "runtime/gpu/program.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/util/pixel_size.h"
#include "shaders/shared/reprojection_layout.h"

namespace pointrt {

/// The programs: names here and of the files in shaders/display.
#define POINTRT_CACHE_STEPS(X)                                                                                         \
    X(kReset, reset_cache)                                                                                             \
    X(kProject, project_points)                                                                                        \
    X(kChoose, choose_points)                                                                                          \
    X(kGather, gather_points)                                                                                          \
    X(kAdvanceErrors, advance_errors)                                                                                  \
    X(kPrioritise, prioritise)                                                                                         \
    X(kSumPriorities, sum_priorities)                                                                                  \
    X(kBalancePriorities, balance_priorities)                                                                          \
    X(kSelect, select_pixels)                                                                                          \
    X(kInsert, insert_points)                                                                                          \
    X(kMeanTiles, mean_tiles)                                                                                          \
    X(kFillHoles, fill_holes)                                                                                          \
    X(kResample, resample_points)                                                                                      \
    X(kReplace, replace_points)                                                                                        \
    X(kHoldHits, hold_hits)                                                                                            \
    X(kTakeColors, take_colors)                                                                                        \
    X(kOutdate, outdate_points)                                                                                        \
    X(kBlendShown, blend_shown)

enum class CacheStep : std::uint8_t {
#define POINTRT_STEP(step, file) step,
    POINTRT_CACHE_STEPS(POINTRT_STEP)
#undef POINTRT_STEP
        kEnd
};

struct DeviceCache {
    PixelSize size;
    std::array<Program, static_cast<std::size_t>(CacheStep::kEnd)> programs;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE; ///< of all programs
    Buffer params, control;
    Buffer control_read;                       ///< gpu::ReprojectionControl of each frame in flight, for the host
    Buffer points, colors, visible, projected; ///< by point
    Buffer nearest, seen, shown, new_points, new_depths; ///< by pixel
    Buffer tiles, tile_means, errors, recorded;          ///< by tile
    Buffer priorities, row_sums;                         ///< of considered pixels, and by row of tiles
    GpuTimer timer; ///< times each frame in flight: before and after the pixels are traced
};

/// pixels: the window's, which display frame's film and first hits. All arguments must outlive the cache.
DeviceCache createDeviceCache(Device& device, PixelSize size, const FrameBuffers& frame, const Buffer& pixels);
/// Binds the film after it has been reallocated.
void bindDeviceCache(Device& device, DeviceCache& cache, const FrameBuffers& frame, const Buffer& pixels);
void destroyDeviceCache(Device& device, DeviceCache& cache);
std::uint64_t deviceBytes(const DeviceCache& cache);

/// The number of places for points.
std::uint32_t pointsOf(PixelSize size);

/// Sets the parameters of the commands that follow.
void recordParams(VkCommandBuffer commands, const DeviceCache& cache, const gpu::ReprojectionParams& params);
/// Removes all points.
void recordClear(VkCommandBuffer commands, const DeviceCache& cache);
/// Projects all points into the view.
void recordReproject(VkCommandBuffer commands, const DeviceCache& cache);
/// Lists the pixels to trace.
void recordSelect(VkCommandBuffer commands, const DeviceCache& cache);
/// Inserts the listed pixels, which have been traced, fills the holes, and copies the picture to pixels.
void recordInsert(VkCommandBuffer commands, const DeviceCache& cache, std::uint32_t listed, const Buffer& pixels);
/// Stores the colours of the points that are visible in pixels.
void recordTakeColors(VkCommandBuffer commands, const DeviceCache& cache);
/// Stores the first hits of count listed pixels, from index first on, for recordReplace.
void recordHoldHits(VkCommandBuffer commands, const DeviceCache& cache, std::uint32_t first, std::uint32_t count);
/// Replaces all points by the stored first hits.
void recordReplace(VkCommandBuffer commands, const DeviceCache& cache);
/// Marks all colours as old; with shapes, also removes the points on shapes. frame: number of the last frame.
void recordOutdate(VkCommandBuffer commands, const DeviceCache& cache, std::uint32_t frame, bool shapes);
/// Blends count pixels, from first on, with weight share over the reprojected picture.
void recordBlend(VkCommandBuffer commands, const DeviceCache& cache, std::uint32_t first, std::uint32_t count,
                 float share);

} // namespace pointrt
