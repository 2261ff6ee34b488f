// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/shapes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>

#include "format/base/error.h"
#include "tests/bench/quality/angles.h"

namespace pointrt::quality {

namespace {

using std::numbers::pi;
using Triangle = std::array<std::uint32_t, 3>;

constexpr double kTubeRadius = 0.3;

/// The surface nearest to a place: its distance, and its normal there.
struct OnSurface {
    double distance;
    Vec3d normal;
};
using Surface = std::function<OnSurface(const Vec3d&)>;

std::uint32_t addVertex(Cloud& mesh, const Vec3d& position, const Vec3d& normal) {
    mesh.positions.push_back(position.cast<float>());
    mesh.normals.push_back(normal.cast<float>());
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// A grid of columns x rows cells, two triangles each. vertex(i, j): index of a grid point.
template <typename VertexAt>
void addCells(Cloud& mesh, std::uint32_t columns, std::uint32_t rows, VertexAt&& vertex) {
    for (std::uint32_t i = 0; i < columns; ++i)
        for (std::uint32_t j = 0; j < rows; ++j) {
            const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
}

Cloud icosahedron() {
    Cloud mesh;
    const double golden = std::numbers::phi;
    for (const double one : {-1.0, 1.0})
        for (const double phi : {-golden, golden})
            for (int axis = 0; axis < 3; ++axis) {
                Vec3d corner = Vec3d::Zero();
                corner[axis] = one;
                corner[(axis + 1) % 3] = phi;
                addVertex(mesh, corner.normalized(), corner.normalized());
            }
    // Three corners make a face if all are adjacent: a cosine of 1 / sqrt(5) = 0.447.
    const auto adjacent = [&](std::uint32_t a, std::uint32_t b) {
        return std::abs(mesh.positions[a].dot(mesh.positions[b]) - 0.447f) < 0.01f;
    };
    for (std::uint32_t a = 0; a < 12; ++a)
        for (std::uint32_t b = a + 1; b < 12; ++b)
            for (std::uint32_t c = b + 1; c < 12; ++c) {
                if (!adjacent(a, b) || !adjacent(b, c) || !adjacent(c, a)) continue;
                const float volume = mesh.positions[a].dot(mesh.positions[b].cross(mesh.positions[c]));
                mesh.triangles.push_back(volume > 0 ? Triangle{a, b, c} : Triangle{a, c, b});
            }
    return mesh;
}

/// Splits every triangle into four, with new corners on the unit sphere.
void subdivide(Cloud& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), 0u);
        if (fresh) {
            const Vec3d between = (mesh.positions[a] + mesh.positions[b]).cast<double>().normalized();
            place->second = addVertex(mesh, between, between);
        }
        return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const Triangle& part : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
            finer.push_back(part);
    }
    mesh.triangles.swap(finer);
}

Cloud sphere() {
    constexpr int kLevels = 7; // 327,680 facets with edges of 0.009
    Cloud mesh = icosahedron();
    for (int level = 0; level < kLevels; ++level) subdivide(mesh);
    return mesh;
}

OnSurface onSphere(const Vec3d& place) { return {std::abs(place.norm() - 1), place.normalized()}; }

Cloud torus() {
    constexpr std::uint32_t kAround = 1024, kAcross = 512; // cells of 0.004 x 0.008 at most
    Cloud mesh;
    for (std::uint32_t i = 0; i < kAround; ++i)
        for (std::uint32_t j = 0; j < kAcross; ++j) {
            const double ring = 2 * pi * i / kAround, tube = 2 * pi * j / kAcross;
            const Vec3d outward(std::cos(ring), std::sin(ring), 0);
            const Vec3d normal = std::cos(tube) * outward + std::sin(tube) * Vec3d::UnitZ();
            addVertex(mesh, outward + kTubeRadius * normal, normal);
        }
    addCells(mesh, kAround, kAcross,
             [](std::uint32_t i, std::uint32_t j) { return i % kAround * kAcross + j % kAcross; });
    return mesh;
}

OnSurface onTorus(const Vec3d& place) {
    const Vec3d from_ring = place - Vec3d(place.x(), place.y(), 0).normalized();
    return {std::abs(from_ring.norm() - kTubeRadius), from_ring.normalized()};
}

/// The face of a box on the side sign of axis, in square cells of a hundredth of the longest edge.
void addBoxFace(Cloud& mesh, const Vec3d& edges, int axis, double sign) {
    constexpr double kCells = 100; // many, so that samples are spread as over other meshes
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto cells = [&](int along) {
        return static_cast<std::uint32_t>(std::max(1.0, std::round(kCells * edges[along] / edges.maxCoeff())));
    };
    const std::uint32_t columns = cells(u), rows = cells(v), first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t i = 0; i <= columns; ++i)
        for (std::uint32_t j = 0; j <= rows; ++j) {
            Vec3d share = Vec3d::Zero();
            share[axis] = sign / 2;
            share[u] = sign * (static_cast<double>(i) / columns - 0.5); // mirrored with the face, to face outwards
            share[v] = static_cast<double>(j) / rows - 0.5;
            addVertex(mesh, share.cwiseProduct(edges), sign * Vec3d::Unit(axis));
        }
    addCells(mesh, columns, rows, [&](std::uint32_t i, std::uint32_t j) { return first + i * (rows + 1) + j; });
}

Cloud box(const Vec3d& edges) {
    Cloud mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) addBoxFace(mesh, edges, axis, sign);
    return mesh;
}

/// Measured at the centres of facets and of their edges.
FacetErrors measureFacets(const Cloud& mesh, const Surface& surface) {
    const Vec3d places[] = {Vec3d::Constant(1.0 / 3), {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}};
    FacetErrors errors;
    for (const auto& triangle : mesh.triangles) {
        Eigen::Matrix3d corners, normals;
        for (int i = 0; i < 3; ++i) {
            corners.col(i) = mesh.positions[triangle[i]].cast<double>();
            normals.col(i) = mesh.normals[triangle[i]].cast<double>();
            const OnSurface truth = surface(corners.col(i));
            errors.distance = std::max(errors.distance, truth.distance);
        }
        const Vec3d flat = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
        for (int i = 0; i < 3; ++i)
            errors.face_normal = std::max(errors.face_normal, degreesBetween(flat, surface(corners.col(i)).normal));
        for (const Vec3d& weights : places) {
            const OnSurface truth = surface(corners * weights);
            errors.distance = std::max(errors.distance, truth.distance);
            errors.smooth_normal = std::max(errors.smooth_normal, degreesBetween(normals * weights, truth.normal));
        }
    }
    return errors;
}

} // namespace

Shape makeShape(const std::string& name) {
    constexpr double kPlateThickness = 0.01;
    Shape shape;
    if (name == "cube" || name == "plate") {
        shape.mesh = box({1, 1, name == "cube" ? 1 : kPlateThickness});
    } else if (name == "sphere") {
        shape.mesh = sphere();
        shape.errors = measureFacets(shape.mesh, onSphere);
    } else if (name == "torus") {
        shape.mesh = torus();
        shape.errors = measureFacets(shape.mesh, onTorus);
    } else {
        throw Error(ExitCode::kBadUsage, name + ": no such shape; there are sphere, torus, plate and cube");
    }
    return shape;
}

void writeMesh(const std::string& path, const Cloud& mesh) {
    static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.positions.size() << '\n';
    for (const char* property : {"x", "y", "z", "nx", "ny", "nz"}) file << "property float " << property << '\n';
    file << "element face " << mesh.triangles.size() << "\nproperty list uchar uint vertex_indices\nend_header\n";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        file.write(reinterpret_cast<const char*>(mesh.positions[i].data()), 3 * sizeof(float));
        file.write(reinterpret_cast<const char*>(mesh.normals[i].data()), 3 * sizeof(float));
    }
    for (const auto& triangle : mesh.triangles) {
        file.put(3);
        file.write(reinterpret_cast<const char*>(triangle.data()), sizeof triangle);
    }
    if (!file.flush()) throw Error(ExitCode::kCannotWrite, path + ": cannot be written");
}

} // namespace pointrt::quality
