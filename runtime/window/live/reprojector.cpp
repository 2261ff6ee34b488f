// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/reprojector.h"

#include "runtime/window/live/device_reprojector.h"
#include "runtime/window/live/reprojection_renderer.h"

namespace pointrt {

std::unique_ptr<Reprojector> createReprojector(Device& device, BandTracer& tracer, Buffer& pixels, PixelSize size) {
    if (canOverlap(tracer)) return std::make_unique<DeviceReprojector>(device, tracer, pixels, size);
    return std::make_unique<ReprojectionRenderer>(device, tracer, pixels, size);
}

} // namespace pointrt
