// SPDX-License-Identifier: Apache-2.0
// The picture while things move, on devices that cannot trace all of it in a frame's time: the last one is carried
// along, and what is new, wrong or old is traced as far as the time goes.
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

namespace pointrt {

/// What a moving picture shows.
struct ReprojectionView {
    RenderSettings settings; ///< width, height: the picture's
    Camera camera;
    double exposure = 0;                 ///< stops
    double focus_x = 0.5, focus_y = 0.5; ///< where the eye rests, in parts of the picture
};

/// Pixels that the film and the first hits on the device must have besides the picture's: listed pixels go there.
constexpr std::uint32_t kMaxListedPixels = 1u << 16;

/// What became of a frame.
struct ReprojectedFrame {
    std::uint32_t traced = 0;        ///< pixels
    std::uint32_t disocclusions = 0; ///< pixels without a point, but for gaps between those of a surface
};

class ReprojectionRenderer {
public:
    /// tracer, whose film has room for size and kMaxListedPixels, and pixels, which get the picture, 0xAARRGGBB each,
    /// must outlive it.
    ReprojectionRenderer(Device& device, BandTracer& tracer, Buffer& pixels, PixelSize size);

    /// Nothing of it is of this scene or look.
    void clear();
    /// The scene has changed but for its scans: what shapes have moved is gone, and what is known of light is old.
    void invalidateLighting();
    /// pixels hold another picture of the last view, all of it: the next frame goes on from there.
    void readBackColors();

    /// Carries the picture, or nothing, to view and traces of it what fits in so many seconds, all in all. The tracer
    /// is idle, and its film is given up. pixels hold the picture then.
    ReprojectedFrame renderFrame(const ReprojectionView& view, double seconds);

    /// Finds the places of all that view shows, in slices of as many rows as fit in the list. True when it is done. The
    /// film stays.
    bool fillCache(const ReprojectionView& view);
    /// Whether there is a picture from that camera to be carried along.
    bool isValidFor(const Camera& camera) const { return camera_ == camera; }
    bool isFilled() const { return filled_rows_ >= cache_.size().height; }

    /// Puts share of pixels, count of them from first on, over the moving picture, into pixels.
    void blendWithReprojection(std::uint32_t first, std::uint32_t count, float share);

    std::uint64_t bytes() const { return cache_.bytes(); }

private:
    std::uint32_t pixelBudget(double seconds) const;
    std::vector<TracedPixel> trace(const ReprojectionView& view, std::span<const std::uint32_t> numbers);
    std::vector<TracedPixel> readHits(std::span<const std::uint32_t> numbers, std::uint32_t first) const;
    void readLight(const ReprojectionView& view, std::span<TracedPixel> traced) const;
    void uploadPixelList(std::span<const std::uint32_t> numbers);
    ViewProjection projectionFor(const ReprojectionView& view) const;

    /// Of a view, as far as it has come.
    struct CacheFill {
        PointCloud points; ///< one a pixel
        std::vector<float> depth;
    };

    Device& device_;
    BandTracer& tracer_;
    Buffer& pixels_;
    RenderCache cache_;
    ErrorMap errors_;
    CacheFill pending_fill_;
    std::optional<Camera> camera_;   ///< the picture's; none where there is none
    std::vector<gpu::Shape> shapes_; ///< the scene's when it was made
    std::uint32_t frame_ = 0, filled_rows_ = 0;
    double seconds_per_pixel_ = 1e-6; ///< a first guess: two cores on a scan of a million points
    double overhead_s_ = 0.01;        ///< of a frame, but for tracing; likewise
};

} // namespace pointrt
