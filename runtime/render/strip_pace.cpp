// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/strip_pace.h"

#include <algorithm>

namespace pointrt {
namespace {

/// Four times the time of the largest strips of usual scans on two cores, so those are never split.
constexpr double kCpuStripSeconds = 1;
/// A GPU also draws the desktop, but not between the dispatches of a submission: this leaves it 25 frames per second.
constexpr double kGpuStripSeconds = 0.04;
/// Seconds for each pixel that shows the scan, per splat that a cell lists: twice the time on two cores with 7000
/// splats per cell. With 76 splats per cell or more, the first strip is smaller than the largest (frame_tiling.cpp).
constexpr double kCpuSecondsPerListed = 50e-9;
/// The same for the slowest GPUs: counting the instructions of the walk, 24 execution units of an Intel GPU take 0.3 ns
/// per bounce, and few paths have ten bounces.
constexpr double kGpuSecondsPerListed = 3e-9;
/// Weight of a new measurement if it is faster; a slower one replaces the old value.
constexpr double kShareOfFaster = 0.3;

double splatsPerCell(const pro_index& index) {
    const double listed = static_cast<double>(index.near_count) + index.blending_count;
    return listed / std::max(index.cell_count, 1u);
}

} // namespace

double splatsPerCell(const DeviceScene& scene) {
    double most = 0;
    for (const DeviceScan& scan : scene.files) most = std::max(most, splatsPerCell(scan.index));
    return most;
}

StripPace::StripPace(double splats_per_cell, VkPhysicalDeviceType device)
    : strip_seconds_(device == VK_PHYSICAL_DEVICE_TYPE_CPU ? kCpuStripSeconds : kGpuStripSeconds),
      least_(splats_per_cell * (device == VK_PHYSICAL_DEVICE_TYPE_CPU ? kCpuSecondsPerListed : kGpuSecondsPerListed)),
      seconds_(least_) {}

std::uint32_t StripPace::rowsFor(std::uint32_t width, std::uint32_t most) const {
    const double rows = strip_seconds_ / (std::max(seconds_, least_) * width);
    if (!(rows < most)) return most;
    return std::max(static_cast<std::uint32_t>(rows), 1u);
}

void StripPace::update(std::uint64_t pixels, double seconds) {
    const double measured = seconds / static_cast<double>(pixels);
    seconds_ += (measured > seconds_ ? 1 : kShareOfFaster) * (measured - seconds_);
}

} // namespace pointrt
