// SPDX-License-Identifier: Apache-2.0
// Reprojection on the host, for CPU devices.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/render/band_tracer.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/render_settings.h"
#include "runtime/window/live/cache_update.h"
#include "runtime/window/live/render_cache.h"
#include "runtime/window/live/reprojector.h"
#include "runtime/window/live/sample_priority.h"
#include "runtime/window/live/trace_speed.h"

namespace pointrt {

/// The render cache on the host.
class ReprojectionRenderer final : public Reprojector {
public:
    ReprojectionRenderer(Device& device, BandTracer& tracer, Buffer& pixels, PixelSize size);

    void clear() override;
    void invalidateLighting() override;
    void readBackColors() override;
    ReprojectedFrame renderFrame(const ReprojectionView& view, double seconds) override;
    void finish() override {} // does nothing: each frame is complete when it returns
    bool fillCache(const ReprojectionView& view) override;
    bool isFilled() const override { return filled_rows_ >= cache_.size().height; }
    bool isValidFor(const Camera& camera) const override { return camera_ == camera; }
    void blendWithReprojection(std::uint32_t first, std::uint32_t count, float share) override;
    void bindFilm() override {} // does nothing: the film is read through the tracer
    std::uint64_t bytes() const override { return cache_.bytes(); }

private:
    std::vector<TracedPixel> trace(const ReprojectionView& view, std::span<const std::uint32_t> numbers);
    std::vector<TracedPixel> readHits(std::span<const std::uint32_t> numbers, std::uint32_t first) const;
    void readLight(const ReprojectionView& view, std::span<TracedPixel> traced) const;
    ViewProjection projectionFor(const ReprojectionView& view) const;

    /// Progress of filling the cache with a full picture.
    struct CacheFill {
        PointCloud points; ///< one per pixel
        std::vector<float> depth;
    };

    Device& device_;
    BandTracer& tracer_;
    Buffer& pixels_;
    RenderCache cache_;
    ErrorMap errors_;
    CacheFill pending_fill_;
    std::optional<Camera> camera_;   ///< of the cached picture; none: the cache is empty
    std::vector<gpu::Shape> shapes_; ///< of the cached picture
    std::uint32_t frame_ = 0, filled_rows_ = 0;
    ListCost cost_;
};

} // namespace pointrt
