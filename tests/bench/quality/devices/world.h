// SPDX-License-Identifier: Apache-2.0
// What devices scan: synthetic meshes or files, in metres, with a label for each triangle.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tests/bench/quality/tracing.h"

namespace pointrt::quality {

enum class Part : std::uint8_t {
    kOther,
    kWall, ///< flat and wide: walls, floors, roofs, roads
    kLeaf
};

/// The ellipsoid around a tree's leaves.
struct Crown {
    Vec3d center, radii;
};

/// The mesh's frame is the world's: metres around the origin.
struct World {
    Mesh mesh;
    std::vector<Part> parts; ///< [triangles]
    std::vector<Crown> crowns;
    Vec3d up = Vec3d::UnitZ();
};

/// Adds surfaces to a world; corners counter-clockwise as seen from outside.
class WorldBuilder {
public:
    explicit WorldBuilder(World& world) : world_(world) {}

    void addQuad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d, Part part);
    void addTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, Part part);
    /// Rotated about the vertical through its centre.
    void addBox(const Vec3d& center, const Vec3d& size, Part part, double yaw_deg = 0);
    /// Without end caps.
    void addCylinder(const Vec3d& from, const Vec3d& to, double from_radius, double to_radius, int sides = 12);
    void addBall(const Vec3d& center, double radius);
    /// A vertical wall between two points of the ground, facing right as seen along it, with windows: recessed panes.
    struct WindowGrid {
        int across = 0, rows = 0;
        double width = 1.0, height = 1.4, sill = 0.9, storey = 3.0, depth = 0.15;
    };
    void addFacade(const Vec3d& from, const Vec3d& to, double height, const WindowGrid& windows);

private:
    std::uint32_t addVertex(const Vec3d& position, const Vec3d& normal);
    void addFace(std::uint32_t a, std::uint32_t b, std::uint32_t c, Part part);

    World& world_;
};

/// Reads a mesh and centres it at the origin, Y up (Z or Y in the file), the longest edge of its bounding box this
/// long. Throws Error.
World modelWorld(const std::string& path, double longest, bool z_up);

/// variant: 1 for tuning, 2 held out; sizes and positions differ.
World roomWorld(int variant);   ///< 5 m, furniture, a window, a doorway
World houseWorld(int variant);  ///< a house with a gable roof, chimney and windows, three trees, uneven ground
World streetWorld(int variant); ///< two rows of facades, kerbs, poles, wires, parked cars, trees

/// The world in a device's frame: to_frame maps world to frame, without scaling.
World transformed(const World& world, const Eigen::Isometry3d& to_frame);

/// Any number of threads may call it. world must outlive it.
class WorldTracing {
public:
    explicit WorldTracing(const World& world) : world_(world), tracing_(world.mesh) {}
    struct Hit {
        double range;
        double cosine; ///< between the ray and the face's normal, unsigned
        Vec3d normal;  ///< of the face, unit length, towards the ray's origin
        std::uint32_t triangle;
    };
    /// direction: unit length
    std::optional<Hit> firstHit(const Vec3d& origin, const Vec3d& direction) const;
    /// Whether nothing is between two points.
    bool isFree(const Vec3d& from, const Vec3d& to) const;
    const World& world() const { return world_; }
    const Tracing& tracing() const { return tracing_; }

private:
    const World& world_;
    Tracing tracing_;
};

} // namespace pointrt::quality
