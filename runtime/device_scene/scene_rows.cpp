// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/scene_rows.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "format/base/error.h"
#include "runtime/device_scene/clip_planes.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/scene/kept.h"

namespace pointrt {

namespace {

using gpu::uint; // the masks of FEATURE_* cast to it

/// A row of a .pro as a material.
MaterialDescription materialOfRow(const float* row, const RenderSettings& settings, bool is_colored) {
    MaterialDescription material;
    material.color = {row[PRO_MAT_BASE_COLOR], row[PRO_MAT_BASE_COLOR + 1], row[PRO_MAT_BASE_COLOR + 2]};
    if (is_colored) material.color = {1, 1, 1}; // shows the map's colours unchanged
    material.splat_color = true;
    material.mirror_share = settings.reflectivity.value_or(row[PRO_MAT_REFLECTIVITY]);
    material.specular = row[PRO_MAT_SPECULAR];
    material.shininess = std::max(row[PRO_MAT_SHININESS], 1.0f);
    return material;
}

std::uint32_t packColor(const std::array<std::uint8_t, 3>& c) { return c[0] | c[1] << 8 | std::uint32_t{c[2]} << 16; }

MaterialKind kindOf(const gpu::Material& material) {
    return kMaterialKinds.at(static_cast<std::size_t>(materialKind(material))).kind;
}

class RowMaker {
public:
    RowMaker(const DeviceScene& scene, const SceneDescription& description, const RenderSettings& settings)
        : scene_(scene), hides_splats_(hidesSplats(description.filters)), settings_(settings) {
        for (const MaterialDescription& material : description.materials) add(material);
        for (const ShapeDescription& shape : description.shapes) addShape(shape);
        const bool is_ambient = hasTrait(settings.integrator, INTEGRATOR_IS_AMBIENT);
        if (!is_ambient)
            for (const LightDescription& light : description.lights) addLight(light);
        for (const Instance& instance : scene.instances) {
            const InstanceDescription& described = description.instances.at(instance.number);
            if (!sharesRows(instance)) addInstance(described, instance);
            setClipPlanes(keptOf(description.clips, described), described.placement, scene.files[instance.file],
                          rows.instances.back());
        }
        if (description.sky && !description.sky->image.empty()) addSkyLight();
        if (is_ambient) rows.lights.resize(1); // the surroundings are sampled as one light
    }

    SceneRows rows;

private:
    /// Whether a material focuses light, as mirrors and glass do, if caustics are on.
    bool focusesLight(const gpu::Material& material) const {
        const MaterialKind kind = kindOf(material);
        const bool mirrors = hasTrait(kind, MATERIAL_MIRRORS_BY_SHARE) && mirrorShare(material) > 0;
        return settings_.caustics && (hasTrait(kind, MATERIAL_IS_CLEAR) || mirrors);
    }

    bool castsCaustics(std::uint32_t first, const gpu::InstanceParams& params) const {
        bool casts = std::any_of(rows.materials.begin() + first, rows.materials.end(),
                                 [&](const gpu::Material& material) { return focusesLight(material); });
        for (std::uint32_t r = 0; r < params.materials.z; ++r)
            casts |= focusesLight(rows.materials[params.color_range[r].z]);
        return casts;
    }

    /// Planes and boxes around the scene (rooms) cast no caustics: they are not a bounded target for photons.
    void addShape(const ShapeDescription& description) {
        if (!description.visible) return;
        gpu::Shape shape = packShape(scene_.space, description);
        const Vec3 half = 0.5 * (scene_.bounds.hi - scene_.bounds.lo);
        const double size = length(description.u) + length(description.v) + length(description.w);
        const bool room = description.kind == ShapeKind::kBox && size > 2 * length(half);
        const bool casts =
            description.kind != ShapeKind::kPlane && !room && focusesLight(rows.materials.at(description.material));
        if (casts) shape.kind.z |= SHAPE_CASTS_CAUSTICS;
        rows.casting_shapes.push_back(casts);
        rows.shapes.push_back(shape);
    }

    void add(const MaterialDescription& material) { rows.materials.push_back(packMaterial(scene_.space, material)); }

    /// An area light is also a shape, whose material names the light.
    void addLight(const LightDescription& light) {
        if (!isVisible(light)) return;
        gpu::Light row = packLight(scene_.space, light);
        if (const auto shape = lampShape(scene_.space, light, static_cast<std::uint32_t>(rows.materials.size()))) {
            LIGHT_SHAPE(row) = std::bit_cast<float>(static_cast<std::uint32_t>(rows.shapes.size()));
            rows.shapes.push_back(*shape);
            rows.materials.push_back(lampMaterial(light, static_cast<std::uint32_t>(rows.lights.size())).value());
        }
        rows.lights.push_back(row);
    }

    void addSkyLight() {
        rows.sky_light = static_cast<std::uint32_t>(rows.lights.size());
        gpu::Light light{};
        LIGHT_KIND(light) = LIGHT_SKY;
        rows.lights.push_back(light);
    }

    /// If instance is a tile with the material rows of the tile before it, reuses those and returns true.
    bool sharesRows(const Instance& instance) {
        if (!instance.tile || instance.place == 0) return false;
        const Instance& before = scene_.instances[instance.place - 1];
        const DeviceScan &file = scene_.files[instance.file], &other = scene_.files[before.file];
        const std::size_t floats = std::size_t{file.info.material_count} * PRO_MATERIAL_FLOATS;
        if (before.number != instance.number || file.info.material_count != other.info.material_count ||
            !std::equal(file.view.materials, file.view.materials + floats, other.view.materials))
            return false;
        gpu::InstanceParams params = instance.params;
        setDrawnRadius(file, params);
        params.materials = rows.instances.back().materials;
        std::copy_n(rows.instances.back().color_range, MAX_COLOR_RANGES, params.color_range);
        rows.instances.push_back(params);
        return true;
    }

    /// Sets the largest drawn radius. That of Gaussians is unchanged.
    void setDrawnRadius(const DeviceScan& file, gpu::InstanceParams& params) const {
        if (!file.is_gaussian) params.splat.x = file.info.radius_max * settings_.splat_size;
    }

    /// Appends the rows of an instance and sets its params to refer to them.
    void addInstance(const InstanceDescription& description, const Instance& instance) {
        const DeviceScan& file = scene_.files[instance.file];
        const auto first = static_cast<std::uint32_t>(rows.materials.size());
        for (std::uint32_t row = 0; row < file.info.material_count; ++row) {
            if (description.material)
                rows.materials.push_back(rows.materials.at(*description.material));
            else
                add(materialOfRow(file.view.materials + std::size_t{row} * PRO_MATERIAL_FLOATS, settings_,
                                  isColored(description, settings_)));
        }
        const bool painted = (hides_splats_ || isPainted(description, settings_)) && !file.is_gaussian;
        if (painted)
            for (const std::uint32_t material : paintedMaterials(description, file))
                rows.materials.push_back(rows.materials.at(material));
        gpu::InstanceParams params = instance.params;
        setDrawnRadius(file, params);
        params.materials.y = first;
        params.materials.z = 0;
        for (const MaterialOverride& each : description.overrides) applyOverride(each, file, painted, params);
        params.materials.w = castsCaustics(first, params) ? 1 : 0;
        rows.instances.push_back(params);
    }

    /// @param painted the splats have the rows of all overrides already, except overrides of whole rows
    void applyOverride(const MaterialOverride& each, const DeviceScan& file, bool painted,
                       gpu::InstanceParams& params) {
        if (const auto* row = std::get_if<MaterialOverride::Row>(&each.splats)) {
            if (row->row >= file.info.material_count)
                throw Error{ExitCode::kBadInput,
                            each.place + file.path + " has no material row " + std::to_string(row->row)};
            rows.materials[params.materials.y + row->row] = rows.materials.at(each.material);
            return;
        }
        if (painted) return;
        const auto& range = std::get<MaterialOverride::ColorRange>(each.splats);
        params.color_range[params.materials.z++] = {packColor(range.low), packColor(range.high), each.material, 0};
    }

    const DeviceScene& scene_;
    bool hides_splats_;
    const RenderSettings& settings_;
};

/// Whether paths may continue at the material. Stochastic integrators continue at every material; others at mirrors,
/// and those that trace glossy highlights also at matte materials with a highlight.
bool continuesPaths(const gpu::Material& material, Integrator integrator) {
    const bool mirrors = !hasTrait(kindOf(material), MATERIAL_MIRRORS_BY_SHARE) || mirrorShare(material) > 0;
    if (hasTrait(integrator, INTEGRATOR_IS_AMBIENT)) return false;
    return hasTrait(integrator, INTEGRATOR_IS_STOCHASTIC) || (mirrors && usesLights(integrator)) ||
           (highlightWeight(material) > 0 && hasTrait(integrator, INTEGRATOR_MIRRORS_HIGHLIGHTS));
}

/// Whether hits trace their shadow rays immediately. If paths continue, few of their hits sample all lights, and a
/// queue for those few costs more time than idle lanes.
bool canInlineNee(const SceneRows& rows, std::uint32_t features, Integrator integrator) {
    if (samplesOneLight(integrator)) return true;
    return (features & FEATURE_SECONDARY_RAYS) == 0 && rows.lights.size() <= SHADOW_RAYS_PER_PATH;
}

std::uint32_t featuresOf(const SceneRows& rows, Integrator integrator) {
    std::uint32_t bits = 0;
    for (const gpu::Light& light : rows.lights)
        if (LIGHT_KIND(light) != LIGHT_SKY) bits |= FEATURE_LIGHT(LIGHT_KIND(light));
    for (const gpu::Material& material : rows.materials) {
        bits |= FEATURE_MATERIAL(materialKind(material));
        if (continuesPaths(material, integrator)) bits |= FEATURE_SECONDARY_RAYS;
        if (highlightWeight(material) > 0) bits |= FEATURE_HIGHLIGHTS;
    }
    for (const gpu::Shape& shape : rows.shapes) bits |= FEATURE_SHAPE(shape.kind.x);
    if (canInlineNee(rows, bits, integrator)) bits |= FEATURE_INLINE_NEE;
    return bits;
}

} // namespace

std::uint32_t shapeKinds(std::span<const gpu::Shape> shapes) {
    if (shapes.size() > HELD_SHAPES) return 0;
    auto kinds = static_cast<std::uint32_t>(shapes.size()) + 1;
    for (std::size_t i = 0; i < shapes.size(); ++i)
        kinds |= shapes[i].kind.x << (SHAPE_COUNT_BITS + SHAPE_KIND_BITS * static_cast<std::uint32_t>(i));
    return kinds;
}

SceneRows makeSceneRows(const DeviceScene& scene, const SceneDescription& description, const RenderSettings& settings) {
    SceneRows rows = RowMaker(scene, description, settings).rows;
    rows.features = featuresOf(rows, settings.integrator);
    const bool noisy = std::any_of(scene.instances.begin(), scene.instances.end(),
                                   [&](const Instance& each) { return scene.files[each.file].noisy; });
    const bool noisy_set = std::any_of(scene.sets.begin(), scene.sets.end(),
                                       [](const SceneSet& each) { return each.opened.set.noise > 0; });
    if (hasGaussians(scene)) rows.features |= FEATURE_GAUSSIANS | (settings.relight ? FEATURE_RELIGHT : 0u);
    if (noisy || noisy_set) rows.features |= FEATURE_NOISE;
    if (cutsInstances(description)) rows.features |= FEATURE_CLIPS;
    return rows;
}

} // namespace pointrt
