// SPDX-License-Identifier: Apache-2.0
#include "tests/trace/gaussian_file.h"

#include <cstdio>
#include <cstring>

#include "preprocess/cloud/gaussians.h"
#include "preprocess/octree/gaussians.h"
#include "preprocess/octree/write.h"
#include "tests/gaussians/gaussian_pro.h"
#include "tests/gaussians/srgb.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {

namespace {

/// Converts rows of floats to an attribute. rowOf: appends the values of one Gaussian
template <typename RowOf>
void addColumn(Cloud& cloud, const std::string& name, std::uint32_t components,
               const std::vector<OracleGaussian>& gaussians, const RowOf& rowOf) {
    std::vector<float> values;
    for (const OracleGaussian& each : gaussians)
        for (std::uint32_t k = 0; k < components; ++k) values.push_back(static_cast<float>(rowOf(each)[k]));
    Attribute column{name, Scalar::kF32, components, std::vector<char>(values.size() * sizeof(float))};
    std::memcpy(column.values.data(), values.data(), column.values.size());
    cloud.attributes.push_back(std::move(column));
}

Cloud cloudOf(const std::vector<OracleGaussian>& gaussians) {
    Cloud cloud;
    for (const OracleGaussian& each : gaussians) {
        cloud.positions.push_back(Vec3d(each.mean[0], each.mean[1], each.mean[2]).cast<float>());
        cloud.normals.push_back(Vec3f::UnitZ());
        cloud.radii.push_back(static_cast<float>(each.deviation[0]));
        cloud.colors.push_back({});
    }
    addColumn(cloud, kGaussianOpacity, 1, gaussians, [](const auto& g) { return std::array{g.opacity}; });
    addColumn(cloud, kGaussianDeviation, 3, gaussians, [](const auto& g) { return g.deviation; });
    addColumn(cloud, kGaussianRotation, 4, gaussians, [](const auto& g) {
        const auto& [w, x, y, z] = g.rotation;
        const double size = std::sqrt(w * w + x * x + y * y + z * z);
        return std::array{w / size, x / size, y / size, z / size};
    });
    addColumn(cloud, kGaussianColor, 3, gaussians, [](const auto& g) { return g.color; });
    for (int k = 0; k < gaussianHarmonicCount(gaussians.front().degree()); ++k)
        addColumn(cloud, gaussianHarmonicName(k + 1), 3, gaussians,
                  [&](const auto& g) { return g.harmonics[static_cast<std::size_t>(k)]; });
    return cloud;
}

} // namespace

GaussianFile::GaussianFile(const std::vector<OracleGaussian>& gaussians) {
    static int count = 0;
    path = temporaryPath("gaussians_" + std::to_string(count++) + ".pro");
    Cloud cloud = cloudOf(gaussians);
    const GaussianCloud taken = takeGaussians(cloud);
    PackedSplats packed = packGaussianSplats(taken);
    const Octree octree = buildCenterOctree(packed);
    const GaussianSections sections = packGaussians(taken, packed);
    ProContent content;
    content.materials = {matteRow(1, 1, 1)};
    content.metadata = "{}";
    writePro(path, true, makeSections(packed, octree, content), nullptr, &sections.view);
    scene = oracleScene(readGaussianPro(path));
}

GaussianFile::~GaussianFile() { std::remove(path.c_str()); }

OracleGaussian roundGaussian(const Double3& mean, double sigma, double opacity, const Double3& color) {
    OracleGaussian gaussian;
    gaussian.mean = mean;
    gaussian.deviation = {sigma, sigma, sigma};
    gaussian.opacity = opacity;
    gaussian.color = color;
    return gaussian;
}

OracleComposite compositeAlong(const OracleScene& scene, Vec3 origin, Vec3 direction, double t_max) {
    const OracleRay ray{{origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}, t_max};
    return composite(scene, ray, hitsAlong(scene, ray));
}

Color lightOf(const OracleComposite& composite) {
    Color light{};
    for (std::size_t c = 0; c < 3; ++c) light[c] = static_cast<float>(linearFromSrgb(composite.radiance[c]));
    return light;
}

Color lightBefore(const OracleComposite& composite) {
    Color light{};
    const double covered = 1 - composite.transmittance;
    for (std::size_t c = 0; c < 3 && covered > 0; ++c)
        light[c] = static_cast<float>(covered * linearFromSrgb(composite.radiance[c] / covered));
    return light;
}

} // namespace pointrt::test
