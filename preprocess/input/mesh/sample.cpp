// SPDX-License-Identifier: GPL-3.0-or-later
// Samples points on the faces of a mesh.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "preprocess/cloud/morton.h"
#include "preprocess/cloud/split_mix.h"
#include "preprocess/input/mesh/mesh.h"

namespace pointrt {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// A vertex normal that deviates more than this from the face's belongs to a sharp edge, not to a smooth surface.
const double kSharpEdgeCos = std::cos(40 * std::numbers::pi / 180);

/// Orders faces along a Morton curve through their centres, so that strata of equal area are compact patches.
std::vector<std::uint32_t> coherentOrder(const Cloud& cloud) {
    Eigen::AlignedBox3f box;
    for (const Vec3f& position : cloud.positions) box.extend(position);
    const double scale = 0x1fffff / std::max<double>(box.sizes().maxCoeff(), 1e-300);
    std::vector<std::uint64_t> keys;
    keys.reserve(cloud.triangles.size());
    for (const auto& [a, b, c] : cloud.triangles) {
        const Vec3d centre = (cloud.positions[a].cast<double>() + cloud.positions[b].cast<double>() +
                              cloud.positions[c].cast<double>()) /
                             3;
        const Vec3d cell = (centre - box.min().cast<double>()).cwiseMax(0) * scale;
        const auto whole = [&](int axis) { return static_cast<std::uint64_t>(cell[axis]); };
        keys.push_back(mortonCode(whole(0), whole(1), whole(2)));
    }
    std::vector<std::uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    return order;
}

Vec3d faceNormal(const Cloud& cloud, const Triangle& face) {
    const Vec3d corner = cloud.positions[face[0]].cast<double>();
    return (cloud.positions[face[1]].cast<double>() - corner).cross(cloud.positions[face[2]].cast<double>() - corner);
}

/// Area-preserving map of the unit square to barycentric coordinates (Heitz, "A low-distortion map between triangle and
/// square", 2019).
Vec3d barycentric(double u, double v) {
    if (v > u) {
        u *= 0.5;
        v -= u;
    } else {
        v *= 0.5;
        u -= v;
    }
    return {u, v, 1 - u - v};
}

/// The normals at the corners of a face; the face's own if the vertex has none or lies on a sharp edge.
std::array<Vec3d, 3> cornerNormals(const Cloud& cloud, const Triangle& face) {
    Vec3d flat = faceNormal(cloud, face).stableNormalized();
    std::array<Vec3d, 3> normals;
    for (int i = 0; i < 3; ++i) normals[i] = cloud.normals[face[i]].cast<double>().stableNormalized();
    // Files may give normals that contradict the winding of their faces.
    if (flat.dot(normals[0] + normals[1] + normals[2]) < 0) flat = -flat;
    for (Vec3d& normal : normals)
        if (!(normal.dot(flat) >= kSharpEdgeCos)) normal = flat;
    return normals;
}

/// Copies the values of the corner with the largest weight.
void addAttributes(const Cloud& mesh, const Triangle& face, const Vec3d& weights, Cloud& samples) {
    int nearest = 0;
    weights.maxCoeff(&nearest);
    for (std::size_t i = 0; i < mesh.attributes.size(); ++i) {
        const std::size_t size = mesh.attributes[i].bytesEach();
        const char* const value = mesh.attributes[i].values.data() + face[nearest] * size;
        samples.attributes[i].values.insert(samples.attributes[i].values.end(), value, value + size);
    }
}

/// index: of the face
void addSample(const Cloud& mesh, const MeshPaint& paint, std::size_t index, const Vec3d& weights, Cloud& samples) {
    const Triangle& face = mesh.triangles[index];
    const std::array<Vec3d, 3> corner_normals = cornerNormals(mesh, face);
    Vec3d position = Vec3d::Zero(), normal = Vec3d::Zero(), color = Vec3d::Constant(0.5);
    for (int i = 0; i < 3; ++i) {
        position += weights[i] * mesh.positions[face[i]].cast<double>();
        normal += weights[i] * corner_normals[i];
        if (mesh.colors.empty()) continue;
        const Rgb8& rgb = mesh.colors[face[i]];
        color += weights[i] * Vec3d(rgb[0], rgb[1], rgb[2]);
    }
    samples.positions.push_back(position.cast<float>());
    samples.normals.push_back(normal.stableNormalized().cast<float>());
    if (!mesh.colors.empty()) {
        const auto rounded = color.cast<std::uint8_t>();
        samples.colors.push_back(paint.has(index) ? paint.at(index, weights)
                                                  : Rgb8{rounded[0], rounded[1], rounded[2]});
    }
    if (!mesh.radii.empty()) samples.radii.push_back(0); // gets an estimated radius later
    if (!mesh.sensor_of_point.empty()) samples.sensor_of_point.push_back(mesh.sensor_of_point[face[0]]);
    addAttributes(mesh, face, weights, samples);
}

/// Takes one point from each of `count` strata of equal area, jittered along the order of the faces; within faces by
/// the R2 sequence (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018), whose consecutive points
/// spread evenly.
/// @param name of the file, for messages
/// @param report is called with the face of each sample
template <typename Report>
void addSamples(const std::string& name, const Cloud& mesh, const MeshPaint& paint, std::uint64_t count,
                std::uint64_t seed, const Report& report, Cloud& samples) {
    constexpr double kStepU = 0.7548776662466927, kStepV = 0.5698402909980532;
    const std::vector<std::uint32_t> order = coherentOrder(mesh);
    std::vector<double> area_up_to;
    double area = 0;
    for (const std::uint32_t face : order)
        area_up_to.push_back(area += faceNormal(mesh, mesh.triangles[face]).stableNorm() / 2);
    if (!(area > 0)) throw Error(ExitCode::kBadInput, name + ": its faces have no area to sample");
    const double start_u = unitShare(mixBits(seed)), start_v = unitShare(mixBits(seed + 1));
    std::size_t at = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const double jitter = unitShare(mixBits(mixBits(seed) ^ i));
        const double target = (static_cast<double>(i) + jitter) / static_cast<double>(count) * area;
        while (at + 1 < order.size() && area_up_to[at] <= target) ++at;
        const auto index = static_cast<double>(i);
        double whole = 0;
        const Vec3d weights =
            barycentric(std::modf(start_u + index * kStepU, &whole), std::modf(start_v + index * kStepV, &whole));
        addSample(mesh, paint, order[at], weights, samples);
        report(mesh.triangles[order[at]]);
    }
}

/// Keeps the faces of sampled meshes, with their colours.
template <typename IsSampled>
void keepSampledFaces(const IsSampled& isSampled, Cloud& cloud, MeshPaint& paint) {
    if (!paint.faces.empty()) paint.faces.resize(cloud.triangles.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < cloud.triangles.size(); ++i) {
        if (!isSampled(cloud.triangles[i][0])) continue;
        if (!paint.faces.empty()) paint.faces[kept] = paint.faces[i];
        cloud.triangles[kept++] = cloud.triangles[i];
    }
    cloud.triangles.resize(kept);
    if (!paint.faces.empty()) paint.faces.resize(kept);
}

void removeVertices(Cloud& cloud, const std::vector<ScanRange>& scans, const std::vector<bool>& sampled) {
    cloud.triangles.clear();
    std::erase_if(cloud.grids, [&](const RangeGrid& grid) { return sampled[grid.scan]; });
    std::vector<bool> keep;
    for (std::size_t i = 0; i < scans.size(); ++i) keep.insert(keep.end(), scans[i].position_count, !sampled[i]);
    keepPoints(cloud, keep);
}

template <typename Item>
void append(const std::vector<Item>& from, std::vector<Item>& to) {
    to.insert(to.end(), from.begin(), from.end());
}

void append(const Cloud& samples, Cloud& cloud) {
    append(samples.positions, cloud.positions);
    append(samples.normals, cloud.normals);
    append(samples.colors, cloud.colors);
    append(samples.radii, cloud.radii);
    append(samples.sensor_of_point, cloud.sensor_of_point);
    for (std::size_t i = 0; i < samples.attributes.size(); ++i)
        append(samples.attributes[i].values, cloud.attributes[i].values);
}

} // namespace

void refuseSampling(const std::string& file) { throw Error(ExitCode::kBadUsage, file + ": has no faces to sample"); }

std::vector<std::uint64_t> sampleMeshes(Cloud& cloud, const std::vector<ScanRange>& scans, const MeshSampling& sampling,
                                        std::uint64_t seed, MeshPaint& paint) {
    std::vector<std::uint64_t> counts(scans.size());
    if (sampling.points == 0) return counts;
    const auto isSampled = [&](std::size_t point) { return sampling.scans[scanOf(scans, point)]; };
    keepSampledFaces(isSampled, cloud, paint);
    const auto first = std::find(sampling.scans.begin(), sampling.scans.end(), true) - sampling.scans.begin();
    Cloud samples;
    for (const Attribute& each : cloud.attributes)
        samples.attributes.push_back({each.name, each.type, each.components, {}});
    addSamples(
        scans[static_cast<std::size_t>(first)].name, cloud, paint, sampling.points, seed,
        [&](const Triangle& face) { ++counts[scanOf(scans, face[0])]; }, samples);
    removeVertices(cloud, scans, sampling.scans);
    append(samples, cloud);
    return counts;
}

} // namespace pointrt
