// SPDX-License-Identifier: Apache-2.0
// Rendering while the view moves, on devices that cannot trace a full frame in time: the last frame is reprojected, and
// the time is spent on tracing pixels that are disoccluded, wrong or old.
#pragma once

#include <cstdint>
#include <memory>

#include "runtime/render/band_tracer.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/render_settings.h"
#include "runtime/util/pixel_size.h"

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

/// Points in the cache for every four pixels: the visible ones, and some that are hidden or outside the frame.
constexpr std::uint32_t kPointsOf4 = 5;
/// If more than this share of the pixels are gaps, points are resampled, one per pixel, since filling the gaps would
/// take too long. With one randomly placed point per pixel on average, a sixth of the pixels are empty; after zooming
/// in by a tenth, a fifth.
constexpr double kMaxGapShare = 0.2;

/// Statistics of a frame.
struct ReprojectedFrame {
    std::uint32_t traced = 0; ///< pixels
    /// Empty pixels except gaps within a surface; if frames overlap, those of an earlier frame.
    std::uint32_t disocclusions = 0;
};

/// A render cache (render_cache.h) and the tracing of its pixels, on the host or on the device.
class Reprojector {
public:
    Reprojector() = default;
    virtual ~Reprojector() = default;
    Reprojector(const Reprojector&) = delete;
    Reprojector& operator=(const Reprojector&) = delete;

    /// Discards all points: the scene or the look has changed.
    virtual void clear() = 0;
    /// Call it after lights, materials or shapes have changed: marks all colours as old; if shapes have changed,
    /// removes the points on shapes.
    virtual void invalidateLighting() = 0;
    /// Takes the colours from the window's pixels, which hold a full picture of the last view.
    virtual void readBackColors() = 0;

    /// Reprojects the last frame to view, if there is one, and traces as many pixels as fit in seconds in all.
    /// Overwrites the tracer's film; call ProgressiveRenderer::finish first. The result is in the window's pixels.
    virtual ReprojectedFrame renderFrame(const ReprojectionView& view, double seconds) = 0;
    /// Waits for frames that the device may still be tracing, before others use the tracer.
    virtual void finish() = 0;

    /// Traces the first hits of all of view into the cache, in slices of as many rows as fit in the list; true when
    /// complete. The film is kept.
    virtual bool fillCache(const ReprojectionView& view) = 0;
    virtual bool isFilled() const = 0;
    /// Whether the cache holds the picture of this camera.
    virtual bool isValidFor(const Camera& camera) const = 0;

    /// Blends the pixels [first, first + count) over the reprojected picture with weight share.
    virtual void blendWithReprojection(std::uint32_t first, std::uint32_t count, float share) = 0;

    /// The tracer's film has been reallocated.
    virtual void bindFilm() = 0;
    /// Memory in bytes, on the host or the device.
    virtual std::uint64_t bytes() const = 0;
};

/// Creates a reprojector on the device if that is a GPU; on a CPU device, which uses the same cores, the host is
/// faster. tracer and pixels must outlive the reprojector. tracer's film has room for size plus kMaxListedPixels.
/// pixels receives the picture, 0xAARRGGBB each.
std::unique_ptr<Reprojector> createReprojector(Device& device, BandTracer& tracer, Buffer& pixels, PixelSize size);

} // namespace pointrt
