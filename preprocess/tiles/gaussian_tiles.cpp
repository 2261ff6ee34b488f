// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/gaussian_tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "preprocess/cloud/gather.h"
#include "preprocess/surface/gaussian_surface.h"
#include "preprocess/tiles/bake_block.h"
#include "preprocess/tiles/buckets.h"
#include "preprocess/tiles/level_coding.h"
#include "preprocess/tiles/select_splats.h"

namespace pointrt {
namespace {

/// Gaussians sampled for the up direction: twice the number of discs that surfaceOfGaussians places on them.
constexpr std::size_t kSampled = 1 << 16;

constexpr std::uint32_t kRotationComponents = 4;

bool isRotation(const Attribute& each) {
    return each.name == kGaussianRotation && each.components == kRotationComponents && each.type == Scalar::kF32;
}

Vec3f discNormal(const Vec3f& given) { return given.squaredNorm() > 0 ? given : Vec3f(Vec3f::UnitZ()); }

/// Radius of the disc shown by readers that do not support Gaussians.
float discRadius(float given, double edge) {
    const auto widest = static_cast<float>(kRadiusPerEdge * edge);
    return std::isfinite(given) ? std::clamp(given, std::numeric_limits<float>::min(), widest) : widest;
}

Attribute floatsOf(const char* name, std::uint32_t components, const std::vector<float>& values) {
    Attribute attribute{name, Scalar::kF32, components, {}};
    attribute.values.resize(values.size() * sizeof(float));
    std::memcpy(attribute.values.data(), values.data(), attribute.values.size());
    return attribute;
}

/// Adds the part of a position that its code rounds off.
void addFraction(const TileSet& set, const TileKey& tile, const Vec3d& position, const PositionCode& code,
                 std::vector<float>& fractions) {
    const double step = edgeOf(set, tile.level) / kCoreSteps;
    // relative to the step's middle
    const Vec3d off = (position - positionOf(set, tile, code)) / step + Vec3d::Constant(0.5);
    for (int axis = 0; axis < 3; ++axis) fractions.push_back(std::clamp(static_cast<float>(off[axis]), 0.0f, 1.0f));
}

Attribute fractionsOf(const TileSet& set, const TileKey& tile, const Cloud& cloud,
                      const std::vector<PositionCode>& codes, const std::vector<std::uint32_t>& order) {
    std::vector<float> fractions;
    for (const std::uint32_t i : order)
        addFraction(set, tile, cloud.origin + cloud.positions[i].cast<double>(), codes[i], fractions);
    return floatsOf(kGaussianFraction, 3, fractions);
}

} // namespace

bool holdsGaussians(const std::vector<Attribute>& attributes) {
    return std::any_of(attributes.begin(), attributes.end(), isRotation);
}

bool holdsGaussians(const SetPlan& plan) {
    return std::any_of(plan.schema.attributes.begin(), plan.schema.attributes.end(), [](const PlanAttribute& each) {
        return isRotation({each.name, each.type, each.components, {}});
    });
}

TileSplats gaussiansOfTile(const SetPlan& plan, std::uint32_t number) {
    const TileSet set = latticeOf(plan);
    const TileKey tile = keyOf(plan.tiles.at(number));
    const Cloud cloud = readBucket(plan, number);
    std::vector<PositionCode> codes;
    for (const Vec3f& position : cloud.positions) {
        codes.push_back(codeOf(set, tile, cloud.origin + position.cast<double>()));
        for (std::int32_t& each : codes.back()) each = std::clamp(each, 0, kCoreSteps - 1);
    }
    const std::vector<std::uint32_t> order = orderAlongCurve(codes);
    const double edge = edgeOf(plan, tile.level);
    TileSplats splats;
    for (const std::uint32_t i : order) {
        splats.positions.push_back(codes[i]);
        splats.normals.push_back(normalWord(discNormal(cloud.normals[i])));
        splats.radii.push_back(discRadius(cloud.radii[i], edge));
        splats.colors.push_back(cloud.colors[i]);
    }
    for (const Attribute& from : cloud.attributes) {
        Attribute& to = splats.attributes.emplace_back(Attribute{from.name, from.type, from.components, {}});
        to.values.resize(order.size() * from.bytesEach());
        gatherValues(from.values.data(), from.bytesEach(), order, to.values.data());
    }
    splats.attributes.push_back(fractionsOf(set, tile, cloud, codes, order));
    splats.spacing = spacingOf(splats.positions, edge / kCoreSteps);
    return splats;
}

GaussianCloud takeGaussians(const TileSet& set, const TileKey& tile, TileSplats& splats) {
    const double step = edgeOf(set, tile.level) / kCoreSteps;
    Cloud cloud;
    cloud.origin = positionOf(set, tile, {0, 0, 0}) - Vec3d::Constant(0.5 * step); // the core's corner
    cloud.positions.resize(splats.positions.size());
    cloud.attributes = std::move(splats.attributes);
    splats.attributes.clear();
    const float* const fractions = floatAttribute(cloud, kGaussianFraction, 3);
    for (std::size_t i = 0; i < splats.positions.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const std::int32_t code = splats.positions[i][static_cast<std::size_t>(axis)];
            cloud.positions[i][axis] =
                static_cast<float>((code + double{fractions[3 * i + static_cast<std::size_t>(axis)]}) * step);
        }
    std::erase_if(cloud.attributes, [](const Attribute& each) { return each.name == kGaussianFraction; });
    GaussianCloud taken = takeGaussians(cloud);
    splats.attributes = std::move(cloud.attributes);
    return taken;
}

void GaussianSample::add(const Cloud& batch, const std::vector<Vec3d>& positions) {
    const std::optional<GaussianColumns> columns = gaussianColumns(batch);
    if (!columns) return;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (std::isnan(columns->opacity[i]) || gaussians_++ % step_ != 0) continue;
        Row& row = rows_.emplace_back(Row{positions[i], columns->opacity[i], {}, {}});
        std::copy_n(columns->deviation + 3 * i, 3, row.deviation.begin());
        std::copy_n(columns->rotation + 4 * i, 4, row.rotation.begin());
        if (rows_.size() < 2 * kSampled) continue;
        for (std::size_t k = 0; 2 * k < rows_.size(); ++k) rows_[k] = rows_[2 * k];
        rows_.resize((rows_.size() + 1) / 2);
        step_ *= 2;
    }
}

Splats GaussianSample::surface(const Vec3d& origin) const {
    Cloud cloud;
    cloud.origin = origin;
    std::vector<float> opacity, deviation, rotation;
    for (const Row& row : rows_) {
        cloud.positions.push_back((row.position - origin).cast<float>());
        opacity.push_back(row.opacity);
        deviation.insert(deviation.end(), row.deviation.begin(), row.deviation.end());
        rotation.insert(rotation.end(), row.rotation.begin(), row.rotation.end());
    }
    GaussianColumns columns;
    columns.opacity = opacity.data();
    columns.deviation = deviation.data();
    columns.rotation = rotation.data();
    return surfaceOfGaussians(cloud, columns);
}

} // namespace pointrt
