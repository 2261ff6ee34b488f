// SPDX-License-Identifier: Apache-2.0
#include "tests/support/splat_scenes.h"

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/temporary_folder.h"

namespace pointrt::test {

namespace {

void add(Splats& splats, const Vec3f& position, const Vec3f& normal, float radius) {
    splats.input_index.push_back(static_cast<std::uint32_t>(splats.positions.size()));
    splats.positions.push_back(position);
    splats.normals.push_back(normal.normalized());
    splats.radii.push_back(radius);
}

} // namespace

Splats sphereSplats(std::size_t count, const Vec3f& center, float sphere_radius, float radius_factor) {
    Splats splats;
    splats.oriented = true;
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double spacing = sphere_radius * std::sqrt(4.0 * std::numbers::pi / static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
        const double ring = std::sqrt(1.0 - z * z), angle = golden * static_cast<double>(i);
        const Vec3f normal = Vec3d(ring * std::cos(angle), ring * std::sin(angle), z).cast<float>();
        add(splats, center + sphere_radius * normal, normal, static_cast<float>(radius_factor * spacing));
    }
    return splats;
}

Splats squareSplats(std::size_t side, const Vec3f& center, const Vec3f& u, const Vec3f& v, float radius_factor) {
    Splats splats;
    splats.oriented = true;
    const float spacing = 2.0f * u.norm() / static_cast<float>(side);
    const auto at = [&](std::size_t k) {
        return (2.0f * static_cast<float>(k) + 1.0f) / static_cast<float>(side) - 1.0f;
    };
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i)
            add(splats, center + at(i) * u + at(j) * v, u.cross(v), radius_factor * spacing);
    return splats;
}

Splats randomSplats(std::size_t count, unsigned seed, float radius_min, float radius_max) {
    Splats splats;
    splats.oriented = true;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::normal_distribution<float> gauss;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3f position(unit(random), unit(random), unit(random));
        const Vec3f normal(gauss(random), gauss(random), gauss(random));
        add(splats, position, normal, radius_min * std::pow(radius_max / radius_min, unit(random)));
    }
    return splats;
}

Splats joinSplats(Splats a, const Splats& b) {
    for (std::size_t i = 0; i < b.positions.size(); ++i) add(a, b.positions[i], b.normals[i], b.radii[i]);
    a.colors.insert(a.colors.end(), b.colors.begin(), b.colors.end());
    return a;
}

void paint(Splats& splats, Rgb8 color) { splats.colors.assign(splats.positions.size(), color); }

void makeBalls(Splats& splats) { splats.normals.assign(splats.normals.size(), Vec3f::Zero()); }

Built buildSplats(Splats splats, const BuildOptions& options) {
    Built built;
    built.packed = quantizeSplats(std::move(splats));
    built.octree = buildOctree(built.packed, options.octree);
    if (options.prune) built.pruning = pruneOctree(built.packed, options.probes, built.octree);
    return built;
}

MaterialRow matteRow(float r, float g, float b, float reflectivity) {
    MaterialRow row{};
    row[PRO_MAT_BASE_COLOR] = r;
    row[PRO_MAT_BASE_COLOR + 1] = g;
    row[PRO_MAT_BASE_COLOR + 2] = b;
    row[PRO_MAT_REFLECTIVITY] = reflectivity;
    row[PRO_MAT_SHININESS] = 1;
    return row;
}

Built writeScene(const std::string& path, Splats splats, const BuildOptions& options,
                 const std::vector<std::uint8_t>& material) {
    Built built = buildSplats(std::move(splats), options);
    for (std::size_t i = 0; i < built.packed.words.size() && !material.empty(); ++i)
        built.packed.words[i][2] |= static_cast<std::uint32_t>(material[built.packed.input_index[i]])
                                    << PRO_MATERIAL_SHIFT;
    ProContent content;
    content.materials = options.materials.empty() ? std::vector{matteRow(1, 1, 1)} : options.materials;
    content.metadata = "{}";
    content.pruned = options.prune;
    const ProSections sections = makeSections(built.packed, built.octree, content);
    writePro(path, true, sections, nullptr);
    return built;
}

std::string temporaryPath(const std::string& name) {
    static const TemporaryFolder folder; // deleted when the process ends
    return folder.file(name);
}

} // namespace pointrt::test
