// SPDX-License-Identifier: Apache-2.0
// Any rays through the product's own shaders: shaders/trace/trace.comp.glsl as it stands, then
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

/// Distances are in cube units along the ray; nothing but splat is set where nothing is hit.
struct CastHit {
    double t_flat = 0; ///< to the first disc
    std::uint32_t splat = kNoSplat;
    double t_blended = 0; ///< to the blended surface there
    Vec3 normal;          ///< of the blended surface, unit length, towards the ray's origin
    float radius = 0;     ///< weighted mean of the splats' radii around, cube units
    bool back = false;    ///< the surface is seen from behind
    bool hit() const { return splat != kNoSplat; }
};

/// A scene on a device, ready for rays.
class RayCaster {
public:
    /// Rays in flight. Their 136 bytes each stay well below the 128 MiB that some drivers allow in a storage binding.
    static constexpr std::uint32_t kBatchRays = 1u << 18;

    /// Opens the .pro at path on the device that request selects; up to batch_rays go to the device at once.
    /// Throws Error kBadInput or kCannotRun.
    explicit RayCaster(const std::string& path, const DeviceRequest& request = {},
                       std::uint32_t batch_rays = kBatchRays);
    ~RayCaster();
    RayCaster(const RayCaster&) = delete;
    RayCaster& operator=(const RayCaster&) = delete;

    /// A hit for each ray, in their order. Any number of rays: they go to the device in chunks.
    std::vector<CastHit> cast(std::span<const Ray> rays);

    /// The product's camera rays for the default view of size x size pixels, through their centres, in the order in
    /// which its lanes take them (shaders/trace/trace_primary.comp.glsl). size is a multiple of 8, size * size at most
    /// batch_rays. fov_deg at its default frames the scene, as pointrt-view does; a smaller one stays where it is and
    /// zooms in.
    std::vector<Ray> cameraRays(std::uint32_t size, double fov_deg = CameraRequest{}.fov_deg);
    /// The same for a camera of the user's, in input coordinates.
    std::vector<Ray> cameraRays(std::uint32_t size, const CameraRequest& request);
    /// Traces the rays of the last cameraRays as the product does: beams, then first hits, each ray made where it is
    /// traced. Seconds from submission to the end.
    double traceCamera();
    /// The last traceCamera's hits, flat, in the order of cameraRays.
    std::vector<CastHit> cameraHits();
    /// Where the product puts the only light of that view; outside the sphere around all splats.
    Vec3 lightPosition() const;

    /// Puts rays, at most batch_rays, on the device, in place of those before.
    void load(std::span<const Ray> rays);
    /// Traces the loaded rays: first hits by the product's trace.comp.glsl, or any hits, of which nothing is kept but
    /// that there is one, as for the product's shadows. Seconds from submission to the end.
    double traceLoaded(bool any_hit = false);
    /// The last trace's hits of the loaded rays, flat: t_flat and splat only; of any hits, splat says no more than that
    /// it is not kNoSplat.
    std::vector<CastHit> loadedHits();

    /// Blends the surfaces at the loaded rays' hits of the last trace, of first hits (or of traceCamera, whose rays
    /// have been loaded since), as cast does. Seconds from submission to the end.
    double blendHits();

    /// Seconds that the trace dispatches alone have taken so far, submission and waiting included.
    double traceSeconds() const;
    const std::string& deviceName() const;
    /// Of a brick's cells, in cube units; none is larger.
    double cellEdge() const;
    /// Whether cells with many splats are cut further.
    bool isUneven() const;
    /// Of the scene, without rays.
    std::uint64_t sceneDeviceBytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace pointrt::test
