// SPDX-License-Identifier: Apache-2.0
// Rendering while the view moves, on devices that cannot trace a full frame in time: the last frame is reprojected, and
// the frame's time goes to pixels that are disoccluded, wrong or old.
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
#include "runtime/window/live/sample_priority.h"
#include "runtime/window/live/trace_speed.h"

namespace pointrt {

/// The view to render.
struct ReprojectionView {
    RenderSettings settings; ///< width, height: of the full frame
    Camera camera;
    double exposure = 0;                 ///< stops
    double focus_x = 0.5, focus_y = 0.5; ///< attention point, as fractions of the picture
    bool compresses_highlights = true;   ///< ToneMapping::compresses_highlights
};

/// Extra pixels in the device's film and first hits, beyond the full frame's, that hold the pixels traced in one frame.
constexpr std::uint32_t kMaxListedPixels = 1u << 16;

/// Statistics of a frame.
struct ReprojectedFrame {
    std::uint32_t traced = 0;        ///< pixels
    std::uint32_t disocclusions = 0; ///< empty pixels except gaps within a surface
};

class ReprojectionRenderer {
public:
    /// tracer and pixels must outlive it. tracer's film has room for size plus kMaxListedPixels. pixels receives the
    /// picture, 0xAARRGGBB each.
    ReprojectionRenderer(Device& device, BandTracer& tracer, Buffer& pixels, PixelSize size);

    /// Discards all points: the scene or the look has changed.
    void clear();
    /// Lights, materials or shapes have changed: points on moved shapes are removed, all colours become old.
    void invalidateLighting();
    /// Takes the colours from pixels, which hold a full picture of the last view.
    void readBackColors();

    /// Reprojects the last frame to view, if there is one, and traces as many pixels as fit in seconds in all. The
    /// tracer must be idle; its film is overwritten. The result is in pixels.
    ReprojectedFrame renderFrame(const ReprojectionView& view, double seconds);

    /// Traces the first hits of all of view into the cache, in slices of as many rows as fit in the list; true when
    /// complete. The film is kept.
    bool fillCache(const ReprojectionView& view);
    /// Whether the cache holds the picture of that camera.
    bool isValidFor(const Camera& camera) const { return camera_ == camera; }
    bool isFilled() const { return filled_rows_ >= cache_.size().height; }

    /// Blends the pixels [first, first + count) over the reprojected picture with weight share.
    void blendWithReprojection(std::uint32_t first, std::uint32_t count, float share);

    std::uint64_t bytes() const { return cache_.bytes(); }

private:
    std::uint32_t pixelBudget(double seconds) const;
    std::vector<TracedPixel> trace(const ReprojectionView& view, std::span<const std::uint32_t> numbers);
    std::vector<TracedPixel> readHits(std::span<const std::uint32_t> numbers, std::uint32_t first) const;
    void readLight(const ReprojectionView& view, std::span<TracedPixel> traced) const;
    void uploadPixelList(std::span<const std::uint32_t> numbers);
    ViewProjection projectionFor(const ReprojectionView& view) const;

    /// A fill in progress.
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
