// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/devices/world.h"

#include <cmath>
#include <numbers>

namespace pointrt::quality {

using std::numbers::pi;

std::uint32_t WorldBuilder::addVertex(const Vec3d& position, const Vec3d& normal) {
    world_.mesh.positions.push_back(position.cast<float>());
    world_.mesh.normals.push_back(normal.cast<float>());
    return static_cast<std::uint32_t>(world_.mesh.positions.size() - 1);
}

void WorldBuilder::addFace(std::uint32_t a, std::uint32_t b, std::uint32_t c, Part part) {
    world_.mesh.triangles.push_back({a, b, c});
    world_.parts.push_back(part);
}

void WorldBuilder::addTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, Part part) {
    const Vec3d normal = (b - a).cross(c - a).normalized();
    const std::uint32_t first = addVertex(a, normal), second = addVertex(b, normal), third = addVertex(c, normal);
    addFace(first, second, third, part);
}

void WorldBuilder::addQuad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d, Part part) {
    addTriangle(a, b, c, part);
    addTriangle(a, c, d, part);
}

void WorldBuilder::addBox(const Vec3d& center, const Vec3d& size, Part part, double yaw_deg) {
    const Eigen::AngleAxisd turn(yaw_deg * pi / 180, Vec3d::UnitZ());
    const auto corner = [&](int i) {
        const Vec3d sign(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
        return Vec3d(center + turn * size.cwiseProduct(sign));
    };
    static constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : kFaces) addQuad(corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3]), part);
}

void WorldBuilder::addCylinder(const Vec3d& from, const Vec3d& to, double from_radius, double to_radius, int sides) {
    const Vec3d axis = (to - from).normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
    std::vector<std::uint32_t> low, high;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * pi * i / sides;
        const Vec3d out = std::cos(angle) * u + std::sin(angle) * v;
        low.push_back(addVertex(from + from_radius * out, out));
        high.push_back(addVertex(to + to_radius * out, out));
    }
    for (int i = 0; i < sides; ++i) {
        const auto here = static_cast<std::size_t>(i), next = static_cast<std::size_t>((i + 1) % sides);
        addFace(low[here], low[next], high[next], Part::kOther);
        addFace(low[here], high[next], high[here], Part::kOther);
    }
}

void WorldBuilder::addBall(const Vec3d& center, double radius) {
    constexpr int kAround = 32, kRings = 16;
    std::vector<std::uint32_t> vertices;
    for (int ring = 0; ring <= kRings; ++ring)
        for (int i = 0; i < kAround; ++i) {
            const double polar = pi * ring / kRings, around = 2 * pi * i / kAround;
            const Vec3d out(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
            vertices.push_back(addVertex(center + radius * out, out));
        }
    const auto at = [&](int ring, int i) { return vertices[static_cast<std::size_t>(ring * kAround + i % kAround)]; };
    for (int ring = 0; ring < kRings; ++ring)
        for (int i = 0; i < kAround; ++i) {
            addFace(at(ring, i), at(ring + 1, i), at(ring + 1, i + 1), Part::kOther);
            addFace(at(ring, i), at(ring + 1, i + 1), at(ring, i + 1), Part::kOther);
        }
}

void WorldBuilder::addFacade(const Vec3d& from, const Vec3d& to, double height, const WindowGrid& windows) {
    const Vec3d along = (to - from).normalized(), up = Vec3d::UnitZ(), out = along.cross(up);
    const double length = (to - from).norm();
    const auto at = [&](double x, double z, double deep) { return Vec3d(from + x * along + z * up - deep * out); };
    const auto panel = [&](double x0, double x1, double z0, double z1, double deep) {
        addQuad(at(x0, z0, deep), at(x1, z0, deep), at(x1, z1, deep), at(x0, z1, deep), Part::kWall);
    };
    double below = 0; // where the next part of the wall starts
    for (int row = 0; row < windows.rows; ++row) {
        const double z0 = windows.storey * row + windows.sill, z1 = z0 + windows.height;
        panel(0, length, below, z0, 0);
        double left = 0;
        for (int i = 0; i < windows.across; ++i) {
            const double x0 = length * (i + 0.5) / windows.across - windows.width / 2, x1 = x0 + windows.width;
            panel(left, x0, z0, z1, 0);
            panel(x0, x1, z0, z1, windows.depth);
            const double d = windows.depth;
            addQuad(at(x0, z0, d), at(x0, z1, d), at(x0, z1, 0), at(x0, z0, 0), Part::kOther);
            addQuad(at(x1, z0, 0), at(x1, z1, 0), at(x1, z1, d), at(x1, z0, d), Part::kOther);
            addQuad(at(x0, z0, 0), at(x1, z0, 0), at(x1, z0, d), at(x0, z0, d), Part::kOther);
            addQuad(at(x0, z1, d), at(x1, z1, d), at(x1, z1, 0), at(x0, z1, 0), Part::kOther);
            left = x1;
        }
        panel(left, length, z0, z1, 0);
        below = z1;
    }
    panel(0, length, below, height, 0);
}

World modelWorld(const std::string& path, double longest, bool z_up) {
    World world{loadMesh(path), {}, {}, Vec3d::UnitY()};
    const Eigen::AngleAxisf turn(z_up ? -std::numbers::pi_v<float> / 2 : 0, Vec3f::UnitX());
    Eigen::AlignedBox3f box;
    for (const Vec3f& position : world.mesh.positions) box.extend(position);
    const auto scale = static_cast<float>(longest / box.sizes().maxCoeff());
    for (Vec3f& position : world.mesh.positions) position = scale * (turn * (position - box.center()));
    for (Vec3f& normal : world.mesh.normals) normal = turn * normal;
    world.mesh.frame = {};
    world.parts.assign(world.mesh.triangles.size(), Part::kOther);
    return world;
}

World transformed(const World& world, const Eigen::Isometry3d& to_frame) {
    World moved = world;
    for (Vec3f& position : moved.mesh.positions) position = (to_frame * position.cast<double>()).cast<float>();
    for (Vec3f& normal : moved.mesh.normals) normal = (to_frame.linear() * normal.cast<double>()).cast<float>();
    moved.crowns.clear(); // cannot be rotated
    moved.up = to_frame.linear() * world.up;
    return moved;
}

std::optional<WorldTracing::Hit> WorldTracing::firstHit(const Vec3d& origin, const Vec3d& direction) const {
    const auto hit = tracing_.firstHit(origin.cast<float>(), direction.cast<float>());
    if (!hit) return std::nullopt;
    const Vec3d normal = hit->normal.cast<double>().normalized();
    const double cosine = -normal.dot(direction);
    return Hit{hit->t, std::abs(cosine), cosine < 0 ? Vec3d(-normal) : normal, hit->primitive};
}

bool WorldTracing::isFree(const Vec3d& from, const Vec3d& to) const {
    const double length = (to - from).norm();
    const auto hit = tracing_.firstHit(from.cast<float>(), ((to - from) / length).cast<float>());
    return !hit || hit->t > length;
}

} // namespace pointrt::quality
