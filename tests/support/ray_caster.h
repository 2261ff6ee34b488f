// SPDX-License-Identifier: Apache-2.0
// Casts arbitrary rays with the product's shaders: shaders/trace/intersect_closest.comp.glsl unchanged, then
// shaders/trace/blend.glsl.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/scene/render_settings.h"
#include "tests/support/rays.h"

namespace pointrt::test {

constexpr std::uint32_t kNoSplat = 0xFFFFFFFFu;

/// Distances are in cube units along the ray. For a miss only splat is set.
struct CastHit {
    double t_flat = 0; ///< to the first disc
    std::uint32_t splat = kNoSplat;
    double t_blended = 0; ///< to the blended surface there
    Vec3 normal;          ///< of the blended surface, unit vector facing the ray's origin
    float radius = 0;     ///< blended radius of the splats, cube units
    bool back = false;    ///< the surface is seen from behind
    bool hit() const { return splat != kNoSplat; }
};

/// A scene on a device, ready for rays.
class RayCaster {
public:
    /// Rays per batch. At 136 bytes each they stay well below the 128 MiB that some drivers allow for a storage buffer.
    static constexpr std::uint32_t kBatchRays = 1u << 18;

    /// Opens the .pro at path on the device that request selects; up to batch_rays go to the device at once.
    /// Throws Error kBadInput or kCannotRun.
    explicit RayCaster(const std::string& path, const DeviceRequest& request = {},
                       std::uint32_t batch_rays = kBatchRays);
    ~RayCaster();
    RayCaster(const RayCaster&) = delete;
    RayCaster& operator=(const RayCaster&) = delete;

    /// A hit for each ray, in their order. Any number of rays, traced in batches.
    std::vector<CastHit> cast(std::span<const Ray> rays);

    /// The product's camera rays for the default view of size x size pixels, through pixel centres, in the order of its
    /// lanes (shaders/trace/intersect_camera.comp.glsl). size must be a multiple of 8, size * size at most batch_rays.
    /// The default fov_deg frames the scene like pointrt-view; a smaller one zooms in from the same position.
    std::vector<Ray> cameraRays(std::uint32_t size, double fov_deg = CameraRequest{}.fov_deg);
    /// The same for a given camera, in input coordinates.
    std::vector<Ray> cameraRays(std::uint32_t size, const CameraRequest& request);
    /// Traces the rays of the last cameraRays as the product does: beams, then closest hits, generating rays on the
    /// fly. Returns seconds from submission to completion.
    double traceCamera();
    /// Hits of the last traceCamera, not blended, in the order of cameraRays.
    std::vector<CastHit> cameraHits();
    /// Position of the product's only light in that view; outside the sphere around all splats.
    Vec3 lightPosition() const;

    /// Uploads rays, at most batch_rays, replacing earlier ones.
    void load(std::span<const Ray> rays);
    /// Traces the loaded rays: closest hits by intersect_closest.comp.glsl, or any hits, of which only the occlusion is
    /// stored, as for shadow rays. Returns seconds from submission to completion.
    double traceLoaded(bool any_hit = false);
    /// Hits of the loaded rays in the last trace, not blended: t_flat and splat only. After an any-hit trace splat only
    /// differs from kNoSplat.
    std::vector<CastHit> loadedHits();

    /// Blends the surfaces at the closest hits of the loaded rays in the last trace (or in traceCamera, if its rays
    /// have been loaded since), as cast does. Returns seconds from submission to completion.
    double blendHits();

    /// Total seconds of trace dispatches so far, including submission and waiting.
    double traceSeconds() const;
    const std::string& deviceName() const;
    /// Edge of the cells of a brick, the largest cells, in cube units.
    double cellEdge() const;
    /// Whether cells with many splats are subdivided.
    bool isUneven() const;
    /// Device memory of the scene in bytes, without rays.
    std::uint64_t sceneDeviceBytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace pointrt::test
