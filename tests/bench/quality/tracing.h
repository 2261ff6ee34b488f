// SPDX-License-Identifier: Apache-2.0
// Embree over a mesh or discs: first hits and nearest faces.
#pragma once

#include <optional>
#include <vector>

#include "tests/bench/quality/scenes.h"
#include "tests/support/embree.h"

namespace pointrt::quality {

struct RayHit {
    float t = 0;                 ///< along a unit direction
    std::uint32_t primitive = 0; ///< triangle or disc
    Vec3f normal;                ///< of the primitive, any length and side
};

/// A point on a mesh.
struct NearFace {
    std::uint32_t triangle = 0;
    float distance = 0;
    Vec3f weights; ///< barycentric
};

/// Copies the geometry, except for the mesh, which must outlive it. Any number of threads may call it.
class Tracing {
public:
    explicit Tracing(const Mesh& mesh);
    explicit Tracing(const Discs& discs);
    ~Tracing();
    Tracing(const Tracing&) = delete;
    Tracing& operator=(const Tracing&) = delete;

    std::optional<RayHit> firstHit(const Vec3f& origin, const Vec3f& direction) const;

    /// Distance to the nearest triangle of a mesh, or limit if all are further away.
    float distanceWithin(const Vec3f& place, float limit) const;
    /// The triangles of a mesh at most tie further away than the nearest one.
    void nearestFaces(const Vec3f& place, float tie, std::vector<NearFace>& faces) const;

private:
    void commit(RTCGeometry geometry);

    RTCDevice device_;
    RTCScene scene_;
    const Mesh* mesh_ = nullptr;
};

} // namespace pointrt::quality
