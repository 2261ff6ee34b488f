// SPDX-License-Identifier: Apache-2.0
// A scene as plain structs, filled by a scene file, the command line or the window; lengths and positions in the
// scene's units ("world").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/scene/clip.h"
#include "runtime/scene/filter.h"
#include "runtime/scene/layer.h"
#include "runtime/scene/light.h"
#include "runtime/scene/material_kinds.h"
#include "runtime/scene/measure.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/sun.h"
#include "runtime/util/color.h"
#include "runtime/util/vec.h"

namespace pointrt {

struct MaterialDescription {
    std::string name;
    MaterialKind kind = MaterialKind::kMatte;
    Color color{0.8f, 0.8f, 0.8f}; ///< reflectance; metal: at normal incidence; glass: transmittance of the surface
    bool splat_color = false;      ///< multiply color by each splat's colour
    float roughness = 0.3f;        ///< metal, plastic: 0 to 1
    float index = 1.5f;            ///< plastic, glass: 1 to 4
    float mirror_share = 0;        ///< matte: share of light reflected as by a mirror, 0 to 1
    float specular = 0;            ///< matte: weight of the Phong highlight in phong and whitted, 0 to 1
    float shininess = 50;          ///< its exponent, 1 to 1000
    bool thin = false;             ///< glass: a pane, not a solid
    Color absorption{0, 0, 0};     ///< glass: absorption coefficient, per unit of length inside
    Color emission{0, 0, 0};       ///< radiance
    bool operator==(const MaterialDescription&) const = default;
};

/// A material for some splats of an instance: those of a material row, in a range of sRGB colours, or with an attribute
/// value in one of several ranges.
struct MaterialOverride {
    struct Row {
        std::uint32_t row;
        bool operator==(const Row&) const = default;
    };
    struct ColorRange {
        std::array<std::uint8_t, 3> low, high;
        bool operator==(const ColorRange&) const = default;
    };
    std::variant<Row, ColorRange, SplatSelection> splats;
    std::uint32_t material = 0; ///< in SceneDescription::materials
    /// Place of the override in the scene file, to begin messages: only the scan shows whether it is valid.
    std::string place;
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
    std::optional<std::uint32_t> material;   ///< for all splats, instead of the scan's materials
    std::vector<MaterialOverride> overrides; ///< later ones take precedence; at most 8 colour ranges
    bool clipped = true;                     ///< whether the scene's clips cut it
    bool visible = true;                     ///< false: rays ignore it
    bool deleted = false;                    ///< in the window: hidden, and left out of the scene file
    Layer layer{};
    bool colored = true; ///< true: coloured by RenderSettings::color_by; false: keeps its own colours
    bool operator==(const InstanceDescription&) const = default;
};

enum class ShapeKind { kPlane, kDisc, kQuad, kBox, kSphere };

/// The unit form of kind (shaders/shared/scene_layout.h) at world = center + x * u + y * v + z * w.
/// Plane, disc: spanned by u and v; w is the unit normal. Sphere: u, v, w have the length of the radius.
struct ShapeDescription {
    ShapeKind kind = ShapeKind::kPlane;
    Vec3 center, u{1, 0, 0}, v{0, 0, -1}, w{0, 1, 0};
    std::uint32_t material = 0;
    bool seen_by_camera = true;
    bool backdrop = false;        ///< not part of the scene: no first hits, no coverage
    bool of_surroundings = false; ///< belongs to SceneDescription::surroundings
    bool visible = true;
    Layer layer{};
    bool operator==(const ShapeDescription&) const = default;
};

/// The environment light.
struct SkyDescription {
    Color zenith{0.46f, 0.52f, 0.62f}, horizon{0.82f, 0.83f, 0.84f}, ground{0.30f, 0.29f, 0.28f};
    std::string image;       ///< path of an equirectangular .hdr or .exr, instead of the colours; empty: none
    double rotation_deg = 0; ///< of the image about the up axis
    float strength = 1;      ///< factor
    /// Share of the sky's light that phong and whitted use as ambient light.
    float ambient = 0.16f;
    bool operator==(const SkyDescription&) const = default;
};

/// A camera with a name.
struct NamedView {
    std::string name; ///< unique, not empty
    CameraRequest camera;
    bool operator==(const NamedView&) const = default;
};

/// The room and lamps that addSurroundings has added. The scene lists their lights and shapes like any others; this
/// records which room the window shows as selected, and what to remove when the user selects another.
struct AddedSurroundings {
    std::optional<Room> room;           ///< none: the studio, or the defaults of a scene with its own lights
    std::optional<std::uint32_t> lamps; ///< RenderSettings::lights
    bool has_lights = false;            ///< whether all lights and the sky belong to the surroundings
    bool operator==(const AddedSurroundings&) const = default;
};

/// A sun with a known position in the sky, to be placed once the up direction is known.
struct SunInTheSky {
    std::uint32_t light = 0; ///< in SceneDescription::lights, a SunLight
    SunPosition position;
    std::optional<Vec3> north; ///< unit vector; none: defaultNorth
    std::string place;         ///< of the sun in the scene file; begins messages
    bool operator==(const SunInTheSky&) const = default;
};

/// The complete scene. Optionals that a scene file does not set are empty and left to the viewer's options.
struct SceneDescription {
    std::string path; ///< of the scene file, for messages
    std::vector<MaterialDescription> materials;
    std::vector<InstanceDescription> instances; ///< at most 254
    std::vector<ClipDescription> clips;         ///< cut the instances
    std::vector<FilterDescription> filters;     ///< each hides splats of the instances
    std::vector<MeasureDescription> measures;   ///< drawn over pictures
    std::vector<ShapeDescription> shapes;
    std::vector<LightDescription> lights;
    std::optional<SkyDescription> sky;
    std::optional<Vec3> up;        ///< unit vector, for rooms, sky and sun; none: taken from the scans
    std::vector<SunInTheSky> suns; ///< only while up is unknown: to be placed once it is known
    CameraRequest camera;
    std::vector<NamedView> views;
    RenderChoices render;
    /// The plain background that addSurroundings has given the sky; see pictureBackground of default_lighting.h.
    std::optional<Background> background;
    /// The eye for which the default room, lights or studio are placed; none: the camera's.
    std::optional<Vec3> staged_for;
    std::optional<AddedSurroundings> surroundings; ///< none: nothing is added yet
    bool operator==(const SceneDescription&) const = default;
};

} // namespace pointrt
