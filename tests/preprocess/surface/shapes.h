// SPDX-License-Identifier: Apache-2.0
// Points on surfaces whose normals are known.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "preprocess/surface/estimate.h"

namespace pointrt::test {

/// Positions with outward unit normals.
struct Shape {
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;

    void add(const Vec3d& position, const Vec3d& normal) {
        positions.push_back(position.cast<float>());
        normals.push_back(normal.cast<float>());
    }
    void append(const Shape& other) {
        positions.insert(positions.end(), other.positions.begin(), other.positions.end());
        normals.insert(normals.end(), other.normals.begin(), other.normals.end());
    }
    Cloud cloud() const {
        Cloud cloud;
        cloud.positions = positions;
        return cloud;
    }
};

using Random = std::mt19937_64;

/// Uniform in [0, 1), the same on every machine.
inline double uniform(Random& random) { return double(random() >> 11) * 0x1p-53; }

/// Standard normal, by Box-Muller: the same on every machine, unlike the standard library's.
inline double gaussian(Random& random) {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(random)));
    return radius * std::cos(2 * std::numbers::pi * uniform(random));
}

/// Moves the points along their normals.
inline void addNoise(Shape& shape, double sigma, std::uint64_t seed = 11) {
    Random random(seed);
    for (std::size_t i = 0; i < shape.positions.size(); ++i)
        shape.positions[i] += float(sigma * gaussian(random)) * shape.normals[i];
}

inline Shape randomSphere(std::size_t count, const Vec3d& center = Vec3d::Zero(), double radius = 1,
                          std::uint64_t seed = 1) {
    Random random(seed);
    Shape shape;
    while (shape.positions.size() < count) {
        const Vec3d p = 2 * Vec3d(uniform(random), uniform(random), uniform(random)) - Vec3d::Ones();
        if (p.norm() > 1 || p.norm() < 0.1) continue;
        shape.add(center + radius * p.normalized(), p.normalized());
    }
    return shape;
}

inline Shape fibonacciSphere(std::size_t count) {
    Shape shape;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2 * double(i) + 1) / double(count);
        const double angle = 2 * std::numbers::pi * double(i) / std::numbers::phi;
        const double r = std::sqrt(1 - z * z);
        const Vec3d p(r * std::cos(angle), r * std::sin(angle), z);
        shape.add(p, p);
    }
    return shape;
}

/// Ring radius 1, tube radius 0.4, uniform over the area.
inline Shape randomTorus(std::size_t count) {
    Random random(2);
    Shape shape;
    while (shape.positions.size() < count) {
        const double u = 2 * std::numbers::pi * uniform(random), v = 2 * std::numbers::pi * uniform(random);
        if (uniform(random) * 1.4 > 1 + 0.4 * std::cos(v)) continue;
        const Vec3d out(std::cos(u), std::sin(u), 0), normal = std::cos(v) * out + std::sin(v) * Vec3d::UnitZ();
        shape.add(out + 0.4 * normal, normal);
    }
    return shape;
}

/// steps x steps points on [0, 1]^2 at height z.
inline Shape gridPlane(int steps, double z = 0, const Vec3d& normal = Vec3d::UnitZ()) {
    Shape shape;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) shape.add(Vec3d((i + 0.5) / steps, (j + 0.5) / steps, z), normal);
    return shape;
}

/// The same, each point at a random place in its square.
inline Shape jitteredPlane(int steps, double z, const Vec3d& normal, std::uint64_t seed) {
    Random random(seed);
    Shape shape;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double x = (i + uniform(random)) / steps, y = (j + uniform(random)) / steps;
            shape.add(Vec3d(x, y, z), normal);
        }
    return shape;
}

/// Two sheets back to back, so many spacings apart, open at their borders.
inline Shape thinPlate(int steps, double spacings) {
    Shape shape = jitteredPlane(steps, 0, -Vec3d::UnitZ(), 5);
    shape.append(jitteredPlane(steps, spacings / steps, Vec3d::UnitZ(), 6));
    return shape;
}

inline Shape hexPlane(int steps) {
    Shape shape;
    const double row = std::sqrt(0.75) / steps;
    for (int j = 0; j * row < 1; ++j)
        for (int i = 0; i < steps; ++i)
            shape.add(Vec3d((i + 0.25 + 0.5 * (j % 2)) / steps, j * row, 0), Vec3d::UnitZ());
    return shape;
}

inline Shape randomPlane(std::size_t count) {
    Random random(3);
    Shape shape;
    while (shape.positions.size() < count) {
        const double x = uniform(random), y = uniform(random);
        shape.add(Vec3d(x, y, 0), Vec3d::UnitZ());
    }
    return shape;
}

/// Random points at least distance apart: Poisson-disc sampling by dart throwing.
inline Shape poissonPlane(double distance) {
    Random random(4);
    Shape shape;
    const int cells = int(1 / distance);
    std::vector<std::vector<Vec3f>> grid(std::size_t((cells + 2) * (cells + 2)));
    const auto cell = [&](int x, int y) -> std::vector<Vec3f>& {
        return grid[std::size_t((y + 1) * (cells + 2) + x + 1)];
    };
    for (int dart = 0; dart < 60 * cells * cells; ++dart) {
        const Vec3f p(float(uniform(random)), float(uniform(random)), 0);
        const int x = std::min(int(p.x() * float(cells)), cells - 1),
                  y = std::min(int(p.y() * float(cells)), cells - 1);
        bool free = true;
        for (int dx = -1; dx <= 1; ++dx)
            for (int dy = -1; dy <= 1; ++dy)
                for (const Vec3f& q : cell(x + dx, y + dy)) free = free && (p - q).norm() >= distance;
        if (!free) continue;
        cell(x, y).push_back(p);
        shape.add(p.cast<double>(), Vec3d::UnitZ());
    }
    return shape;
}

/// The surface of [0, 1]^3: a steps x steps grid on each face, half a step from the edges.
inline Shape gridCube(int steps) {
    Shape shape;
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const int axis = face / 2;
                Vec3d p, n = Vec3d::Zero();
                p[axis] = face % 2;
                p[(axis + 1) % 3] = (i + 0.5) / steps;
                p[(axis + 2) % 3] = (j + 0.5) / steps;
                n[axis] = face % 2 ? 1 : -1;
                shape.add(p, n);
            }
    return shape;
}

inline double degreesBetween(const Vec3f& a, const Vec3f& b) {
    const double sine = a.cast<double>().cross(b.cast<double>()).norm(),
                 cosine = a.cast<double>().dot(b.cast<double>());
    return std::atan2(sine, cosine) * 180 / std::numbers::pi;
}

/// Angles in degrees to the shape's normals, sorted; two_sided ignores sides.
inline std::vector<double> normalErrors(const Splats& splats, const Shape& shape, bool two_sided = false) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        const std::uint32_t index = splats.input_index[i];
        const std::uint32_t point = index < splats.input_count ? index : splats.filled_from[index - splats.input_count];
        const double error = degreesBetween(splats.normals[i], shape.normals[point]);
        errors.push_back(two_sided ? std::min(error, 180 - error) : error);
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

inline Splats estimate(Cloud cloud, const SurfaceOptions& options = {}) {
    SurfaceReport report;
    return estimateSplats(std::move(cloud), options, report);
}

} // namespace pointrt::test
