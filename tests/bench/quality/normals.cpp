// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/normals.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "tests/bench/quality/angles.h"

namespace pointrt::quality {

namespace {

/// Faces nearest within this share of a median radius tie: at an edge, or on two sheets that touch. Rounding to the
/// .pro's grid is far less.
constexpr float kTie = 0.01f;

/// Errors of one splat.
struct Comparison {
    double face_degrees = 90, smooth_degrees = 90;
    bool flipped = true;
};

Comparison compareOne(const Mesh& mesh, const std::vector<NearFace>& faces, const Vec3d& normal) {
    Comparison best;
    for (const NearFace& face : faces) {
        const Vec3d flat = mesh.faceNormal(face.triangle);
        if (flat.isZero(0)) continue;
        Vec3d smooth = Vec3d::Zero();
        for (int i = 0; i < 3; ++i)
            smooth += face.weights[i] * mesh.normals[mesh.triangles[face.triangle][i]].cast<double>();
        best.face_degrees = std::min(best.face_degrees, degreesBetweenLines(normal, flat));
        best.smooth_degrees = std::min(best.smooth_degrees, degreesBetweenLines(normal, smooth));
        best.flipped = best.flipped && normal.dot(flat) < 0;
    }
    return best;
}

double shareOf(std::size_t count, std::size_t all) { return static_cast<double>(count) / static_cast<double>(all); }

} // namespace

SplatErrors compareSplats(const Mesh& mesh, const Tracing& truth, const Discs& discs) {
    const std::size_t count = discs.centers.size();
    std::vector<float> face_degrees(count), smooth_degrees(count), distances(count), radii(count);
    std::vector<std::uint8_t> flipped(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
        std::vector<NearFace> faces;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            truth.nearestFaces(discs.centers[i], kTie * discs.median_radius, faces);
            const Comparison comparison = compareOne(mesh, faces, discs.normals[i].cast<double>());
            face_degrees[i] = static_cast<float>(comparison.face_degrees);
            smooth_degrees[i] = static_cast<float>(comparison.smooth_degrees);
            flipped[i] = comparison.flipped;
            const auto nearest = std::min_element(faces.begin(), faces.end(),
                                                  [](const auto& a, const auto& b) { return a.distance < b.distance; });
            distances[i] = nearest->distance / discs.median_radius;
            radii[i] = discs.radii[i] / discs.median_radius;
        }
    });
    const auto wrong =
        std::count_if(face_degrees.begin(), face_degrees.end(), [](float d) { return d > kWrongDegrees; });
    const auto turned = std::count(flipped.begin(), flipped.end(), 1);
    return {summarize(std::move(face_degrees)),
            summarize(std::move(smooth_degrees)),
            shareOf(static_cast<std::size_t>(wrong), count),
            shareOf(static_cast<std::size_t>(turned), count),
            summarize(std::move(distances)),
            summarize(std::move(radii))};
}

} // namespace pointrt::quality
