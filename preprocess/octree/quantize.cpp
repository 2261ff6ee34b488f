// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/quantize.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>

#include "preprocess/cloud/bounds.h"
#include "preprocess/cloud/curve_key.h"
#include "preprocess/cloud/morton.h"

namespace pointrt {

namespace {

/// Margin around the discs relative to the extent: float rounding must not push a disc out of the cube.
constexpr double kCubeMargin = 1.0 / 1024;

/// log2 of the number of radius codes per octave. At the coarsest, 255 codes span 15.9 octaves (62,000 : 1), and
/// smaller radii are raised to the smallest code; at the finest, one code is 1/6000 of the radius.
constexpr int kCoarsestRadiusBits = 4, kFinestRadiusBits = 12;

/// Half extents of the disc's or ball's bounding box.
Vec3d discExtent(const Vec3f& normal, float radius) {
    return radius * (1.0 - normal.cast<double>().array().square()).max(0.0).sqrt().matrix();
}

/// The smallest cube edge of at least extent that is kLeafEdgeRadii median radii times a power of two, so that the same
/// fraction of discs crosses leaf borders for any size of scan. Positions lose at most one bit by this.
double cubeEdge(double extent, const std::vector<float>& radii) {
    std::vector<float> sorted = radii;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double leaf_edge = kLeafEdgeRadii * static_cast<double>(*middle);
    return std::ldexp(leaf_edge, static_cast<int>(std::ceil(std::log2(extent / leaf_edge))));
}

void fillFrame(const Splats& splats, pro_info& frame) {
    surface::Bounds centers, discs;
    float radius_min = splats.radii.front(), radius_max = radius_min;
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        const Vec3d p = splats.positions[i].cast<double>();
        const Vec3d extent = discExtent(splats.normals[i], splats.radii[i]);
        centers.add(p);
        discs.add(p - extent);
        discs.add(p + extent);
        radius_min = std::min(radius_min, splats.radii[i]);
        radius_max = std::max(radius_max, splats.radii[i]);
    }
    frame.scale = cubeEdge(discs.longestEdge() * (1.0 + 2.0 * kCubeMargin), splats.radii);
    const Vec3d corner = splats.origin + 0.5 * (discs.low + discs.high) - Vec3d::Constant(0.5 * frame.scale);
    for (int axis = 0; axis < 3; ++axis) {
        frame.origin[axis] = corner[axis];
        frame.bounds_min[axis] = splats.origin[axis] + centers.low[axis];
        frame.bounds_max[axis] = splats.origin[axis] + centers.high[axis];
    }
    const RadiusCoding coding = radiusCoding(radius_min, radius_max);
    frame.radius_max = static_cast<float>(coding.max / frame.scale);
    frame.radius_step = coding.step;
    frame.blend_slab = kBlendSlab;
    const bool balls = std::any_of(splats.normals.begin(), splats.normals.end(), [](auto& n) { return n.isZero(0); });
    frame.flags = (splats.colors.empty() ? 0u : PRO_FLAG_COLOR) | (splats.oriented ? PRO_FLAG_ORIENTED : 0u) |
                  (balls ? PRO_FLAG_BALLS : 0u);
}

/// The decoded position: the middle of a step, in the unit cube. Computed in double, since a float can hold that
/// middle, but not the intermediate results.
Vec3f cubePosition(const Vec3f& position, const Vec3d& shift, double scale) {
    const Vec3d steps = ((position.cast<double>() + shift) * (PRO_POSITION_STEPS / scale)).array().floor();
    const Vec3d code = steps.cwiseMax(0.0).cwiseMin(static_cast<double>(PRO_POSITION_MASK));
    return ((code.array() + 0.5) * PRO_POSITION_STEP).cast<float>();
}

std::uint64_t mortonOf(const Vec3f& cube_position) {
    const auto code = [](float v) { return static_cast<std::uint32_t>(v * PRO_POSITION_STEPS); };
    return mortonCode(code(cube_position.x()), code(cube_position.y()), code(cube_position.z()));
}

/// Sets noise and filled splats of packed. @param keys the packed splats as indices in splats
void packSampling(const Splats& splats, const std::vector<CurveKey>& keys, PackedSplats& packed) {
    packed.input_count = splats.input_count;
    packed.filled_from = splats.filled_from;
    for (const CurveKey& key : keys) packed.filled += key.fills;
    packed.noise.resize(splats.noise.empty() ? 0 : keys.size());
    tbb::parallel_for(std::size_t{0}, packed.noise.size(), [&](std::size_t k) {
        packed.noise[k] = noiseCode(splats.noise[keys[k].index], packed.discs[k].radius, packed.frame.scale);
    });
    dropCleanNoise(packed);
}

} // namespace

RadiusCoding radiusCoding(float radius_min, float radius_max) {
    if (!(radius_min < radius_max)) return {radius_max, 0};
    const double least = std::log2(double{radius_min}), most = std::log2(double{radius_max});
    int bits = kFinestRadiusBits;
    const auto top = [&] { return std::ceil(std::ldexp(most, bits)); };
    while (bits > kCoarsestRadiusBits && top() - std::ldexp(least, bits) > double{PRO_RADIUS_CODE_MAX}) --bits;
    const auto widest = static_cast<float>(std::exp2(std::ldexp(top(), -bits)));
    return {std::max(widest, radius_max), std::ldexp(1.0f, -bits)};
}

void packSplat(const pro_splat& splat, std::size_t k, PackedSplats& packed) {
    const pro_info& frame = packed.frame;
    pro_splat_encode(&splat, frame.radius_max, frame.radius_step, packed.words[k].data());
    pro_splat decoded;
    pro_splat_decode(packed.words[k].data(), frame.radius_max, frame.radius_step, &decoded);
    packed.discs[k] = {Vec3f(decoded.position), Vec3f(decoded.normal), decoded.radius};
    if (!Vec3f(splat.normal).isZero(0)) return;
    pro_splat_set_ball(packed.words[k].data());
    packed.discs[k].normal.setZero();
}

std::uint8_t noiseCode(float sigma, float radius, double scale) {
    const double steps = std::round(double{sigma} / (double{radius} * scale) * double{PRO_NOISE_STEPS});
    return static_cast<std::uint8_t>(std::clamp(steps, 0.0, double{PRO_NOISE_CODE_MAX}));
}

void dropCleanNoise(PackedSplats& packed) {
    const bool clean = std::all_of(packed.noise.begin(), packed.noise.end(), [](auto code) { return code == 0; });
    if (clean) std::vector<std::uint8_t>().swap(packed.noise);
}

PackedSplats quantizeSplats(Splats&& splats) {
    PackedSplats packed;
    fillFrame(splats, packed.frame);
    const pro_info& frame = packed.frame;
    const Vec3d shift = splats.origin - Vec3d(frame.origin[0], frame.origin[1], frame.origin[2]);

    std::vector<CurveKey> keys(splats.positions.size());
    tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
        keys[i] = {mortonOf(cubePosition(splats.positions[i], shift, frame.scale)), static_cast<std::uint32_t>(i),
                   fillsGap(splats, i)};
    });
    tbb::parallel_sort(keys);
    const auto last =
        std::unique(keys.begin(), keys.end(), [](const CurveKey& a, const CurveKey& b) { return a.code == b.code; });
    packed.merged = static_cast<std::size_t>(keys.end() - last);
    keys.erase(last, keys.end());

    const std::size_t count = keys.size();
    const bool has_colors = !splats.colors.empty();
    packed.words.resize(count);
    packed.discs.resize(count);
    packed.morton.resize(count);
    packed.input_index.resize(count);
    packed.colors.resize(has_colors ? count : 0);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        const std::uint32_t i = keys[k].index;
        const Vec3f position = cubePosition(splats.positions[i], shift, frame.scale);
        const Vec3f& normal = splats.normals[i];
        const Rgb8 color = has_colors ? splats.colors[i] : Rgb8{255, 255, 255};
        const float radius = static_cast<float>(splats.radii[i] / frame.scale);
        const pro_splat plain{{position.x(), position.y(), position.z()},
                              {normal.x(), normal.y(), normal.z()},
                              radius,
                              {color[0], color[1], color[2]},
                              0};
        packSplat(plain, k, packed);
        packed.morton[k] = keys[k].code;
        packed.input_index[k] = splats.input_index[i];
        if (has_colors) packed.colors[k] = color;
    });
    packSampling(splats, keys, packed);
    splats = {};
    return packed;
}

void freeBuildData(PackedSplats& splats) {
    std::vector<Disc>().swap(splats.discs); // assigning {} would keep the memory
    std::vector<Rgb8>().swap(splats.colors);
    std::vector<std::uint64_t>().swap(splats.morton);
}

} // namespace pointrt
