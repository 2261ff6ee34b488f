// SPDX-License-Identifier: Apache-2.0
#include "runtime/staged_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

#include "pointrt/tool.hpp"
#include "runtime/environment.h"
#include "runtime/ggx_albedo.h"
#include "runtime/staging.h"
#include "shaders/ggx_table.h"

namespace pointrt {

namespace {

/// The number of path's file, opened once.
std::uint32_t fileNumber(Device& device, StagedScene& scene, const std::string& path, bool verbose) {
    const auto known =
        std::find_if(scene.files.begin(), scene.files.end(), [&](const Scene& f) { return f.path == path; });
    if (known == scene.files.end()) {
        scene.files.push_back(loadScene(device, path, verbose));
        scene.device_bytes += scene.files.back().device_bytes;
        return static_cast<std::uint32_t>(scene.files.size() - 1);
    }
    return static_cast<std::uint32_t>(known - scene.files.begin());
}

/// What does not depend on the materials.
gpu::InstanceParams placeInstance(const Stage& stage, const Scene& file, const Placement& placement,
                                  std::uint32_t number) {
    const std::array<gpu::vec4, 3> rows = cubeFromStage(stage, placement, file.info);
    const EntryGrid& grid = file.grid_frame;
    const float cells = std::ldexp(1.0f, static_cast<int>(PRO_POSITION_BITS - grid.shift));
    gpu::InstanceParams params{};
    params.row_x = rows[0];
    params.row_y = rows[1];
    params.row_z = rows[2];
    params.splat = {file.info.radius_max, file.info.radius_step, file.info.blend_slab,
                    std::sqrt(rows[0].x * rows[0].x + rows[0].y * rows[0].y + rows[0].z * rows[0].z)};
    params.grid_scale = {cells, static_cast<float>(grid.size[0]),
                         static_cast<float>(grid.size[0]) * static_cast<float>(grid.size[1]),
                         cells * PRO_POSITION_STEP};
    params.grid_origin = {grid.origin[0], grid.origin[1], grid.origin[2], 0};
    params.grid_size = {grid.size[0], grid.size[1], grid.size[2], grid.size[0] * grid.size[1] * grid.size[2] - 1};
    params.materials = {number, 0, 0, 0};
    return params;
}

/// Of the instances; without any, of the bounded shapes.
Bounds findBounds(const StagedScene& scene) {
    std::optional<Bounds> all;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const pro_info& info = scene.files[scene.instances[i].file].info;
        const Bounds bounds = placedBounds(scene.description.instances[i].placement, info);
        all = all ? joined(*all, bounds) : bounds;
    }
    if (!all) all = boundsOfShapes(scene.description);
    return all.value_or(Bounds{{-1, -1, -1}, {1, 1, 1}});
}

/// What rough metal and plastic read; others only where it makes no difference, which zeros tell sooner.
std::vector<GgxAlbedo> ggxAlbedoFor(std::uint32_t features) {
    const bool rough = (features & (FEATURE_MATERIAL(MATERIAL_METAL) | FEATURE_MATERIAL(MATERIAL_PLASTIC))) != 0;
    return rough ? ggxAlbedoTable() : std::vector<GgxAlbedo>(GGX_TABLE_ENTRIES);
}

/// A row of a .pro as a material.
MaterialDescription materialOfRow(const float* row, const RenderSettings& settings) {
    MaterialDescription material;
    material.color = {row[PRO_MAT_BASE_COLOR], row[PRO_MAT_BASE_COLOR + 1], row[PRO_MAT_BASE_COLOR + 2]};
    material.splat_color = true;
    material.mirror_share = settings.reflectivity.value_or(row[PRO_MAT_REFLECTIVITY]);
    material.specular = row[PRO_MAT_SPECULAR];
    material.shininess = std::max(row[PRO_MAT_SHININESS], 1.0f);
    return material;
}

std::uint32_t packColor(const std::array<std::uint8_t, 3>& c) { return c[0] | c[1] << 8 | std::uint32_t{c[2]} << 16; }

/// Everything of a scene as rows for the device.
class Furnisher {
public:
    Furnisher(const StagedScene& scene, const RenderSettings& settings) : scene_(scene), settings_(settings) {
        for (const MaterialDescription& material : scene.description.materials) add(material);
        for (const ShapeDescription& shape : scene.description.shapes) addShape(shape);
        for (const LightDescription& light : scene.description.lights) addLight(light);
    }

    /// Appends the instance's rows, and names them in its params.
    void addInstance(const InstanceDescription& description, Instance& instance) {
        const Scene& file = scene_.files[instance.file];
        const auto first = static_cast<std::uint32_t>(materials.size());
        for (std::uint32_t row = 0; row < file.info.material_count; ++row) {
            if (description.material)
                materials.push_back(materials.at(*description.material));
            else
                add(materialOfRow(file.view.materials + std::size_t{row} * PRO_MATERIAL_FLOATS, settings_));
        }
        instance.params.materials.y = first;
        instance.params.materials.z = 0;
        for (const MaterialOverride& each : description.overrides) applyOverride(each, file, instance.params);
        instance.params.materials.w = castsCaustics(first, instance.params) ? 1 : 0;
    }

    std::uint32_t features() const {
        std::uint32_t bits = 0;
        for (const gpu::Light& light : lights) bits |= FEATURE_LIGHT(light.position.w);
        for (const gpu::Material& material : materials) bits |= FEATURE_MATERIAL(material.gloss.x);
        for (const gpu::Shape& shape : shapes) bits |= FEATURE_SHAPE(shape.kind.x);
        return bits;
    }

    std::vector<gpu::Material> materials;
    std::vector<gpu::Shape> shapes;
    std::vector<gpu::Light> lights;
    std::vector<bool> casting_shapes; ///< of the description's

private:
    /// Mirrors and glass do, and are asked to.
    bool bundlesLight(const gpu::Material& material) const {
        const auto kind = static_cast<int>(material.gloss.x);
        const bool mirrors = kind == MATERIAL_MATTE && material.gloss.w > 0;
        return settings_.caustics && (kind == MATERIAL_MIRROR || kind == MATERIAL_GLASS || mirrors);
    }

    bool castsCaustics(std::uint32_t first, const gpu::InstanceParams& params) const {
        bool casts = std::any_of(materials.begin() + first, materials.end(),
                                 [&](const gpu::Material& material) { return bundlesLight(material); });
        for (std::uint32_t r = 0; r < params.materials.z; ++r)
            casts |= bundlesLight(materials[params.color_range[r].z]);
        return casts;
    }

    /// Planes are endless, and boxes around the scene (rooms) throw no caustics: photons have to be sent somewhere.
    void addShape(const ShapeDescription& description) {
        gpu::Shape shape = packShape(scene_.stage, description);
        const Vec3 half = 0.5 * (scene_.bounds.hi - scene_.bounds.lo);
        const double size = length(description.u) + length(description.v) + length(description.w);
        const bool room = description.kind == ShapeKind::kBox && size > 2 * length(half);
        const bool casts =
            description.kind != ShapeKind::kPlane && !room && bundlesLight(materials.at(description.material));
        if (casts) shape.kind.z |= SHAPE_CASTS_CAUSTICS;
        casting_shapes.push_back(casts);
        shapes.push_back(shape);
    }

    void add(const MaterialDescription& material) { materials.push_back(packMaterial(scene_.stage, material)); }

    /// Lamps with an area are shapes as well, with a material that names their light.
    void addLight(const LightDescription& light) {
        gpu::Light row = packLight(scene_.stage, light);
        if (const auto shape = lampShape(scene_.stage, light, static_cast<std::uint32_t>(materials.size()))) {
            row.edge_v.w = std::bit_cast<float>(static_cast<std::uint32_t>(shapes.size()));
            shapes.push_back(*shape);
            materials.push_back(lampMaterial(light, static_cast<std::uint32_t>(lights.size())).value());
        }
        lights.push_back(row);
    }

    void applyOverride(const MaterialOverride& each, const Scene& file, gpu::InstanceParams& params) {
        if (const auto* row = std::get_if<MaterialOverride::Row>(&each.splats)) {
            if (row->row >= file.info.material_count)
                throw Error{ExitCode::kBadInput,
                            each.place + file.path + " has no material row " + std::to_string(row->row)};
            materials[params.materials.y + row->row] = materials.at(each.material);
            return;
        }
        const auto& range = std::get<MaterialOverride::ColorRange>(each.splats);
        params.color_range[params.materials.z++] = {packColor(range.low), packColor(range.high), each.material, 0};
    }

    const StagedScene& scene_;
    const RenderSettings& settings_;
};

template <typename Row>
void replaceBuffer(Device& device, Buffer& buffer, const char* what, std::vector<Row> rows,
                   VkFormat format = VK_FORMAT_R32G32B32A32_UINT) {
    destroyBuffer(device, buffer);
    buffer = createTexelRows(device, what, std::move(rows), format);
}

/// The sky's picture, if it has one, with a light that stands for it.
void furnishSky(Device& device, StagedScene& scene, const RenderSettings& settings, std::vector<gpu::Light>& lights) {
    const SkyDescription sky = scene.description.sky.value_or(SkyDescription{});
    Environment picture;
    scene.sky_light = NO_LIGHT;
    if (!sky.image.empty()) {
        picture = makeEnvironment(readFloatImage(sky.image));
        const auto rows = mapFromWorld(sceneUp(scene.description, settings), sky.rotation_deg);
        scene.environment = environmentFrame(picture, rows, sky.strength);
        scene.sky_light = static_cast<std::uint32_t>(lights.size());
        gpu::Light light{};
        light.position.w = LIGHT_SKY;
        lights.push_back(light);
    }
    replaceBuffer(device, scene.environment_texels, "environment buffer", std::move(picture.texels),
                  VK_FORMAT_R32G32B32A32_SFLOAT);
    replaceBuffer(device, scene.environment_cdf, "environment distribution", std::move(picture.cdf),
                  VK_FORMAT_R32_SFLOAT);
}

/// All programs name an instance's buffers, those too that never read them.
void addBlank(Device& device, StagedScene& scene) {
    scene.blank.file = static_cast<std::uint32_t>(scene.files.size());
    scene.files.push_back(blankScene(device));
    scene.blank.params_buffer =
        createBuffer(device, "instance parameters", sizeof scene.blank.params, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

} // namespace

StagedScene openScene(Device& device, SceneDescription description, bool verbose) {
    StagedScene scene;
    scene.description = std::move(description);
    try {
        std::vector<pro_info> infos;
        for (const InstanceDescription& each : scene.description.instances) {
            Instance instance;
            instance.file = fileNumber(device, scene, each.path, verbose);
            const Scene& file = scene.files[instance.file];
            instance.oriented = (file.info.flags & PRO_FLAG_ORIENTED) != 0;
            scene.instances.push_back(instance);
            scene.splat_count += file.info.splat_count;
            infos.push_back(file.info);
        }
        scene.stage = chooseStage(scene.description, infos);
        scene.bounds = findBounds(scene);
        for (std::size_t i = 0; i < scene.instances.size(); ++i) {
            Instance& instance = scene.instances[i];
            instance.params = placeInstance(scene.stage, scene.files[instance.file],
                                            scene.description.instances[i].placement, static_cast<std::uint32_t>(i));
            instance.params_buffer =
                createBuffer(device, "instance parameters", sizeof instance.params, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        }
        if (scene.instances.empty()) addBlank(device, scene);
    } catch (...) {
        destroyStagedScene(device, scene);
        throw;
    }
    return scene;
}

void furnishScene(Device& device, StagedScene& scene, const RenderSettings& settings) {
    Furnisher rows(scene, settings);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        Instance& instance = scene.instances[i];
        rows.addInstance(scene.description.instances[i], instance);
        uploadBuffer(device, instance.params_buffer, &instance.params, sizeof instance.params);
    }
    scene.casting_shapes = rows.casting_shapes;
    scene.features = rows.features();
    scene.shape_count = static_cast<std::uint32_t>(rows.shapes.size());
    furnishSky(device, scene, settings, rows.lights);
    scene.light_rows = rows.lights;
    replaceBuffer(device, scene.materials, "material buffer", std::move(rows.materials));
    replaceBuffer(device, scene.shapes, "shape buffer", std::move(rows.shapes));
    replaceBuffer(device, scene.lights, "light buffer", std::move(rows.lights));
    replaceBuffer(device, scene.ggx_albedo, "GGX table", ggxAlbedoFor(scene.features), VK_FORMAT_R32G32_SFLOAT);
}

bool castsCaustics(const StagedScene& scene) {
    const auto casts = [](const Instance& instance) { return instance.params.materials.w != 0; };
    const std::vector<bool>& shapes = scene.casting_shapes;
    return !scene.light_rows.empty() && (std::any_of(scene.instances.begin(), scene.instances.end(), casts) ||
                                         std::find(shapes.begin(), shapes.end(), true) != shapes.end());
}

std::vector<BufferBinding> instanceBindings(const StagedScene& scene, const Instance& instance) {
    std::vector<BufferBinding> bindings = sceneBindings(scene.files[instance.file]);
    bindings.insert(bindings.end(), {{22, &instance.params_buffer},
                                     {5, &scene.materials},
                                     {23, &scene.shapes},
                                     {24, &scene.lights},
                                     {28, &scene.ggx_albedo},
                                     {29, &scene.environment_texels},
                                     {30, &scene.environment_cdf}});
    return bindings;
}

void destroyStagedScene(Device& device, StagedScene& scene) {
    for (Buffer* buffer : {&scene.materials, &scene.shapes, &scene.lights, &scene.ggx_albedo, &scene.environment_texels,
                           &scene.environment_cdf})
        destroyBuffer(device, *buffer);
    destroyBuffer(device, scene.blank.params_buffer);
    for (Instance& instance : scene.instances) destroyBuffer(device, instance.params_buffer);
    for (Scene& file : scene.files) destroyScene(device, file);
    scene = {};
}

} // namespace pointrt
