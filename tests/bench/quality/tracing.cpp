// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/tracing.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "format/base/error.h"

namespace pointrt::quality {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Point of a triangle nearest to p, as weights of its corners (Ericson, "Real-Time Collision Detection", 2005, 5.1.5).
Vec3f nearestWeights(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const Vec3f ab = b - a, ac = c - a;
    const float d1 = ab.dot(p - a), d2 = ac.dot(p - a), d3 = ab.dot(p - b), d4 = ac.dot(p - b);
    const float d5 = ab.dot(p - c), d6 = ac.dot(p - c);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const float over_c = d1 * d4 - d3 * d2, over_b = d5 * d2 - d1 * d6, over_a = d3 * d6 - d5 * d4;
    if (over_c <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    if (over_b <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    const float along = d4 - d3, back = d5 - d6;
    if (over_a <= 0 && along >= 0 && back >= 0) return {0, 1 - along / (along + back), along / (along + back)};
    const float sum = over_a + over_b + over_c;
    return {over_a / sum, over_b / sum, over_c / sum};
}

NearFace nearestOn(const Mesh& mesh, std::uint32_t triangle, const Vec3f& place) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Vec3f weights = nearestWeights(place, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    const Vec3f nearest =
        weights[0] * mesh.positions[a] + weights[1] * mesh.positions[b] + weights[2] * mesh.positions[c];
    return {triangle, (nearest - place).norm(), weights};
}

/// Calls visit(triangle, query) for the triangles that may be within the query's radius. visit may shrink that, and
/// returns whether it did.
template <typename Visit>
void queryFaces(RTCScene scene, const Vec3f& place, float radius, Visit visit) {
    RTCPointQuery query{place.x(), place.y(), place.z(), 0, radius};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    const auto call = [](RTCPointQueryFunctionArguments* arguments) {
        return (*static_cast<Visit*>(arguments->userPtr))(arguments->primID, *arguments->query);
    };
    rtcPointQuery(scene, &query, &context, call, &visit);
}

} // namespace

Tracing::Tracing(const Mesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)), mesh_(&mesh) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f),
                                              mesh.positions.size());
    std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f));
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              3 * sizeof(std::uint32_t), mesh.triangles.size());
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * 3 * sizeof(std::uint32_t));
    commit(geometry);
}

Tracing::Tracing(const Discs& discs) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    const std::size_t count = discs.centers.size();
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* spheres = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), count));
    auto* normals = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), count));
    for (std::size_t i = 0; i < count; ++i) {
        std::copy_n(discs.centers[i].data(), 3, spheres + 4 * i);
        spheres[4 * i + 3] = discs.radii[i];
        std::copy_n(discs.normals[i].data(), 3, normals + 3 * i);
    }
    commit(geometry);
}

Tracing::~Tracing() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void Tracing::commit(RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST); // no ray passes between two triangles
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw Error(ExitCode::kCannotRun, "Embree cannot hold the scene");
}

std::optional<RayHit> Tracing::firstHit(const Vec3f& origin, const Vec3f& direction) const {
    RTCRayHit query{};
    query.ray = {origin.x(), origin.y(), origin.z(), 0, direction.x(), direction.y(), direction.z(), 0,
                 kInfinity,  ~0u,        0,          0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embree::IntersectOptions options(embree::Coherence::kCoherent);
    embree::intersect1(scene_, options, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return RayHit{query.ray.tfar, query.hit.primID, {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}};
}

float Tracing::distanceWithin(const Vec3f& place, float limit) const {
    float least = limit;
    queryFaces(scene_, place, limit, [&](std::uint32_t triangle, RTCPointQuery& query) {
        const float distance = nearestOn(*mesh_, triangle, place).distance;
        if (distance >= least) return false;
        least = query.radius = distance;
        return true;
    });
    return least;
}

void Tracing::nearestFaces(const Vec3f& place, float tie, std::vector<NearFace>& faces) const {
    faces.clear();
    const float least = distanceWithin(place, kInfinity);
    queryFaces(scene_, place, least + tie, [&](std::uint32_t triangle, RTCPointQuery&) {
        const NearFace face = nearestOn(*mesh_, triangle, place);
        if (face.distance <= least + tie) faces.push_back(face);
        return false;
    });
}

} // namespace pointrt::quality
