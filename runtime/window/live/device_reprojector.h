// SPDX-License-Identifier: Apache-2.0
// Reprojection on a GPU. Its frames overlap with the host's work, and need no submission of their own.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "runtime/window/live/device_cache.h"
#include "runtime/window/live/reprojector.h"
#include "runtime/window/live/trace_speed.h"

namespace pointrt {

class DeviceReprojector final : public Reprojector {
public:
    DeviceReprojector(Device& device, BandTracer& tracer, Buffer& pixels, PixelSize size);
    ~DeviceReprojector() override;

    void clear() override;
    void invalidateLighting() override;
    void readBackColors() override;
    ReprojectedFrame renderFrame(const ReprojectionView& view, double seconds) override;
    void finish() override;
    bool fillCache(const ReprojectionView& view) override;
    bool isFilled() const override { return filled_rows_ >= cache_.size.height; }
    bool isValidFor(const Camera& camera) const override { return camera_ == camera; }
    void blendWithReprojection(std::uint32_t first, std::uint32_t count, float share) override;
    void bindFilm() override;
    std::uint64_t bytes() const override { return deviceBytes(cache_); }

private:
    /// A frame that the device may still be working on.
    struct FrameInFlight {
        std::optional<PassesInFlight> passes; ///< none: the pixels have been traced already
        std::uint64_t submission = 0;
        std::uint32_t place = 0; ///< where its counters and times are
        std::uint32_t traced = 0;
        double traced_s = 0; ///< seconds that tracing took, if already known
    };

    gpu::ReprojectionParams paramsFor(const ReprojectionView& view) const;
    void record(const char* name, const std::function<void(VkCommandBuffer)>& commands);
    void traceListed(const ReprojectionView& view, FrameInFlight& frame);
    void recordTraced(VkCommandBuffer commands, const FrameInFlight& frame) const;
    void finishOldest();

    Device& device_;
    BandTracer& tracer_;
    Buffer& pixels_;
    DeviceCache cache_;
    std::optional<Camera> camera_;   ///< of the cached picture; none: the cache is empty
    std::vector<gpu::Shape> shapes_; ///< of the cached picture
    std::uint32_t frame_ = 0, filled_rows_ = 0;
    ListCost cost_;
    std::deque<FrameInFlight> in_flight_; ///< oldest first, at most kFramesInFlight
    std::uint32_t disocclusions_ = 0;     ///< of the last finished frame
};

} // namespace pointrt
