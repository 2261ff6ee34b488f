// SPDX-License-Identifier: Apache-2.0
// What a scene file says, as plain structs; lengths and positions in the scene's own units ("world"). The tracer gets
// everything from here, whether a scene file, the command line or the window filled it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/scene/light.h"
#include "runtime/scene/material_kinds.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/sun.h"
#include "runtime/util/color.h"
#include "runtime/util/vec.h"

namespace pointrt {

struct MaterialDescription {
    std::string name;
    MaterialKind kind = MaterialKind::kMatte;
    Color color{0.8f, 0.8f, 0.8f}; ///< reflectance; of metals at normal incidence; of glass what it lets through
    bool splat_color = false;      ///< multiplied by each splat's own colour
    float roughness = 0.3f;        ///< metal, plastic: 0 to 1
    float index = 1.5f;            ///< plastic, glass: 1 to 4
    float mirror_share = 0;        ///< matte: 0 to 1 reflected as by a mirror
    float specular = 0;            ///< matte: weight of the Phong highlight in phong and whitted, 0 to 1
    float shininess = 50;          ///< its exponent, 1 to 1000
    bool thin = false;             ///< glass: a pane, not a solid
    Color absorption{0, 0, 0};     ///< glass: per unit of length inside
    Color emission{0, 0, 0};       ///< radiance
    bool operator==(const MaterialDescription&) const = default;
};

/// Splats whose material is not the file's: of a material row, with each sRGB byte from low to high, or with a number
/// in one of some ranges.
struct MaterialOverride {
    struct Row {
        std::uint32_t row;
        bool operator==(const Row&) const = default;
    };
    struct ColorRange {
        std::array<std::uint8_t, 3> low, high;
        bool operator==(const ColorRange&) const = default;
    };
    struct Numbers {
        std::string attribute; ///< in the words of RenderSettings::color_by, but for rgb and normal
        std::vector<ValueRange> ranges;
        bool operator==(const Numbers&) const = default;
    };
    std::variant<Row, ColorRange, Numbers> splats;
    std::uint32_t material = 0; ///< in SceneDescription::materials
    std::string place;          ///< where it was said, to begin messages with: what is there, only files tell
    bool operator==(const MaterialOverride&) const = default;
};

/// A similarity: world = translation + scale * rotation * input. rotation has orthonormal rows.
struct Placement {
    std::array<Vec3, 3> rotation{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    double scale = 1; ///< above 0
    Vec3 translation;
    bool operator==(const Placement&) const = default;
};

struct InstanceDescription {
    std::string path; ///< of the .pro, ready to open
    Placement placement;
    std::optional<std::uint32_t> material;   ///< for all its splats, in place of the file's rows
    std::vector<MaterialOverride> overrides; ///< later ones win; at most 8 colour ranges
    bool operator==(const InstanceDescription&) const = default;
};

enum class ShapeKind { kPlane, kDisc, kQuad, kBox, kSphere };

/// The unit form of kind (shaders/shared/scene_layout.h) is put at world = center + x * u + y * v + z * w.
/// Plane and disc: u, v span it, w is the unit normal. Sphere: u, v, w have the radius as length.
struct ShapeDescription {
    ShapeKind kind = ShapeKind::kPlane;
    Vec3 center, u{1, 0, 0}, v{0, 0, -1}, w{0, 1, 0};
    std::uint32_t material = 0;
    bool seen_by_camera = true;
    bool backdrop = false; ///< not of the scene: first hits and coverage pass through it
    bool operator==(const ShapeDescription&) const = default;
};

/// Radiance from all around.
struct SkyDescription {
    Color zenith{0.46f, 0.52f, 0.62f}, horizon{0.82f, 0.83f, 0.84f}, ground{0.30f, 0.29f, 0.28f};
    std::string image;       ///< path of an equirectangular .hdr or .exr in place of the colours; empty: none
    double rotation_deg = 0; ///< of the image about the up axis
    float strength = 1;      ///< multiplies all of it
    /// Share of the sky's light that phong and whitted take as ambient.
    float ambient = 0.16f;
    bool operator==(const SkyDescription&) const = default;
};

/// A place to look from that the user gave a name.
struct NamedView {
    std::string name; ///< not empty; of one view only
    CameraRequest camera;
    bool operator==(const NamedView&) const = default;
};

/// A sun whose place in the sky is known before anybody knows what is up.
struct SunInTheSky {
    std::uint32_t light = 0; ///< in SceneDescription::lights, a SunLight
    SunPosition position;
    std::optional<Vec3> north; ///< unit vector; none: defaultNorth
    std::string place;         ///< where it was said, to begin messages with
    bool operator==(const SunInTheSky&) const = default;
};

/// Everything that is in the picture. Where a scene file is silent, optionals are empty and the viewer's options rule.
struct SceneDescription {
    std::string path; ///< of the file that this was read from, for messages
    std::vector<MaterialDescription> materials;
    std::vector<InstanceDescription> instances; ///< at most 254
    std::vector<ShapeDescription> shapes;
    std::vector<LightDescription> lights;
    std::optional<SkyDescription> sky;
    std::optional<Vec3> up; ///< unit vector, of the scene: rooms, sky and sun stand on it; none: as its scans say
    std::vector<SunInTheSky> suns; ///< where up is none: to be put up with it
    CameraRequest camera;
    std::vector<NamedView> views;
    RenderChoices render;
    /// The eye that the viewer's room, ring of lights or studio is put up for; else the camera's.
    std::optional<Vec3> staged_for;
    bool operator==(const SceneDescription&) const = default;
};

} // namespace pointrt
