// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/raw/sights.h"

#include <tbb/parallel_for.h>

#include "format/base/error.h"
#include "runtime/image/exr_read.h"

namespace pointrt::quality {

namespace {

/// The interpolated vertex normal; the face's own if those cancel.
Vec3f smoothNormal(const Mesh& mesh, const RayHit& hit, const Vec3f& place) {
    const auto& [a, b, c] = mesh.triangles[hit.primitive];
    const Vec3f ab = mesh.positions[b] - mesh.positions[a], ac = mesh.positions[c] - mesh.positions[a];
    const Vec3f face = ab.cross(ac), to = place - mesh.positions[a];
    const float area = face.squaredNorm();
    const float at_b = to.cross(ac).dot(face) / area, at_c = ab.cross(to).dot(face) / area;
    const Vec3f normal = (1 - at_b - at_c) * mesh.normals[a] + at_b * mesh.normals[b] + at_c * mesh.normals[c];
    return normal.squaredNorm() > 0 && normal.allFinite() ? normal.normalized() : hit.normal.normalized();
}

} // namespace

UnitCamera::UnitCamera(const Pinhole& camera, const UnitFrame& frame)
    : rays_(camera), eye_(frame.unitFromInput(camera.eye)), size_(camera.size) {}

Vec3f UnitCamera::direction(std::size_t pixel) const {
    const auto size = static_cast<std::size_t>(size_);
    return rays_.direction(static_cast<int>(pixel / size), static_cast<int>(pixel % size)).cast<float>();
}

Sights castMesh(const Mesh& mesh, const Tracing& tracing, const UnitCamera& camera) {
    Sights sights(camera.pixels());
    tbb::parallel_for(std::size_t{0}, sights.size(), [&](std::size_t i) {
        const Vec3f direction = camera.direction(i);
        const auto hit = tracing.firstHit(camera.eye(), direction);
        if (!hit) return;
        const Vec3f normal = smoothNormal(mesh, *hit, camera.eye() + hit->t * direction);
        sights[i] = {hit->t, normal.dot(direction) > 0 ? Vec3f(-normal) : normal};
    });
    return sights;
}

Sights readSights(const std::string& path, const Pinhole& camera, const UnitFrame& frame) {
    const ExrPicture picture = readExr(path, ExrKind::kFilm);
    const auto size = static_cast<std::uint32_t>(camera.size);
    if (picture.width != size || picture.height != size)
        throw Error(ExitCode::kBadInput, path + ": is not " + std::to_string(size) + " pixels a side");
    const auto plane = [&](const char* channel) {
        const auto found = picture.floats.find(channel);
        if (found == picture.floats.end())
            throw Error(ExitCode::kBadInput, path + ": has no channel " + std::string(channel));
        return found->second;
    };
    const auto depth = plane("Z"), x = plane("N.X"), y = plane("N.Y"), z = plane("N.Z");
    Sights sights(camera.pixels());
    for (std::size_t i = 0; i < sights.size(); ++i)
        if (std::isfinite(depth[i]))
            sights[i] = {static_cast<float>(depth[i] / frame.radius), Vec3f(x[i], y[i], z[i]).normalized()};
    return sights;
}

} // namespace pointrt::quality
