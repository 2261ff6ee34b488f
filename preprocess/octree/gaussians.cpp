// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/gaussians.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "format/base/error.h"
#include "format/base/harmonic_degree.h"
#include "format/index/gaussian_tree.h"
#include "preprocess/cloud/bounds.h"
#include "preprocess/cloud/curve_key.h"
#include "preprocess/cloud/median.h"
#include "preprocess/cloud/morton.h"
#include "preprocess/octree/exact_gaussians.h"

namespace pointrt {

namespace {

/// Gaussians whose ellipsoids are longer than this share of the box of all centres may extend out of the cube:
/// otherwise a sky of a few giants would leave little of it to the scene.
constexpr double kLargestShare = 0.25;

/// Margin of the cube relative to its edge, so that rounding cannot put an ellipsoid outside.
constexpr double kGaussianCubeMargin = 1.0 / 1024;

/// Members of a leaf of the octree of centres. Nothing traverses it, so its lists may be long.
constexpr std::uint32_t kCentersPerLeaf = 64;

/// Steps between the lowest and the highest code: of a deviation, of red and green (blue has half as many), of
/// harmonics.
constexpr double kDeviationCodes = 4095, kColorCodes = 510, kHarmonicCodes = 127;

/// The largest disc, in cube units: readers without support for Gaussians show larger ones of a sky at this size.
constexpr float kLargestDisc = 0.25f;

/// A Gaussian in the frame of the cloud, input units.
pro_gaussian gaussianAt(const GaussianCloud& cloud, std::size_t i) {
    const GaussianColumns& columns = cloud.columns;
    pro_gaussian gaussian{};
    for (int axis = 0; axis < 3; ++axis) gaussian.mean[axis] = cloud.points.positions[i][axis];
    std::copy_n(columns.deviation + 3 * i, 3, gaussian.deviation);
    std::copy_n(columns.rotation + 4 * i, 4, gaussian.rotation);
    std::copy_n(columns.color + 3 * i, 3, gaussian.color);
    gaussian.opacity = columns.opacity[i];
    return gaussian;
}

/// Half extents of the ellipsoid's bounding box.
Vec3d reachOf(const GaussianEllipsoid& ellipsoid) {
    Vec3d squares = Vec3d::Zero();
    for (const auto& axis : ellipsoid.half_axes)
        for (int i = 0; i < 3; ++i) squares[i] += double{axis[i]} * axis[i];
    return squares.cwiseSqrt();
}

/// Origin, scale and bounds.
void placeCube(const GaussianCloud& cloud, pro_info& frame) {
    const surface::Bounds centers = surface::boundsOf(cloud.points.positions);
    surface::Bounds all = centers;
    for (std::size_t i = 0; i < cloud.points.positions.size(); ++i) {
        const Vec3d center = cloud.points.positions[i].cast<double>(),
                    reach = reachOf(ellipsoidOf(gaussianAt(cloud, i)));
        if (2 * reach.maxCoeff() > kLargestShare * centers.longestEdge()) continue;
        all.add(center - reach);
        all.add(center + reach);
    }
    const double edge = all.longestEdge();
    frame.scale = (edge > 0 ? edge : 1) * (1 + 2 * kGaussianCubeMargin);
    const Vec3d corner = cloud.points.origin + 0.5 * (all.low + all.high) - Vec3d::Constant(0.5 * frame.scale);
    for (int axis = 0; axis < 3; ++axis) {
        frame.origin[axis] = corner[axis];
        frame.bounds_min[axis] = cloud.points.origin[axis] + centers.low[axis];
        frame.bounds_max[axis] = cloud.points.origin[axis] + centers.high[axis];
    }
}

float discRadius(const GaussianCloud& cloud, std::size_t i, double scale) {
    const auto radius = static_cast<float>(cloud.points.radii[i] / scale);
    return std::isfinite(radius) ? std::clamp(radius, 1e-9f, kLargestDisc) : kLargestDisc;
}

void codeRadii(const GaussianCloud& cloud, pro_info& frame) {
    float least = kLargestDisc, most = 0;
    for (std::size_t i = 0; i < cloud.points.radii.size(); ++i) {
        const float radius = discRadius(cloud, i, frame.scale);
        least = std::min(least, radius);
        most = std::max(most, radius);
    }
    const RadiusCoding coding = radiusCoding(least, most);
    frame.radius_max = coding.max;
    frame.radius_step = coding.step;
    frame.blend_slab = kBlendSlab;
    frame.flags = PRO_FLAG_COLOR;
}

/// The centre in cube units.
Vec3d cubeCenter(const GaussianCloud& cloud, std::size_t i, const pro_info& frame) {
    const Vec3d corner(frame.origin[0], frame.origin[1], frame.origin[2]);
    return (cloud.points.positions[i].cast<double>() + (cloud.points.origin - corner)) / frame.scale;
}

std::uint32_t stepOf(double coordinate) {
    return static_cast<std::uint32_t>(
        std::clamp(std::floor(coordinate * double{PRO_POSITION_STEPS}), 0.0, static_cast<double>(PRO_POSITION_MASK)));
}

std::uint64_t mortonAt(const Vec3d& center) {
    return mortonCode(stepOf(center.x()), stepOf(center.y()), stepOf(center.z()));
}

pro_splat discOf(const GaussianCloud& cloud, std::size_t i, const pro_info& frame) {
    const Vec3d center = cubeCenter(cloud, i, frame);
    const Vec3f& given = cloud.points.normals[i];
    const Vec3f normal = given.squaredNorm() > 0 ? given.normalized() : Vec3f::UnitZ();
    const Rgb8& color = cloud.points.colors[i];
    pro_splat splat{};
    for (int axis = 0; axis < 3; ++axis) {
        splat.position[axis] = static_cast<float>((stepOf(center[axis]) + 0.5) * double{PRO_POSITION_STEP});
        splat.normal[axis] = normal[axis];
        splat.color[axis] = color[axis];
    }
    splat.radius = discRadius(cloud, i, frame.scale);
    return splat;
}

/// Lowest and highest of some numbers.
struct NumberRange {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// Log2 of deviations, limited to those that the file can hold. Beyond the limits they look the same: as wide as a
/// billion scenes, or a billionth of a position step.
/// @param range log2 of deviations in cube units
NumberRange codedDeviations(const NumberRange& range) {
    constexpr double kWidest = PRO_DEVIATION_LOG2_MAX - 1; // the largest code's deviation is rounded
    const double low = std::clamp(range.low, double{PRO_DEVIATION_LOG2_MIN}, double{PRO_DEVIATION_LOW_MAX});
    return {low, std::clamp(range.high, low, kWidest)};
}

/// Sets the ranges of the codes.
void chooseCodes(const GaussianCloud& cloud, double scale, pro_gaussians& coding) {
    NumberRange deviations, colors;
    const std::size_t count = cloud.points.positions.size();
    for (std::size_t k = 0; k < 3 * count; ++k) {
        deviations.add(std::log2(cloud.columns.deviation[k] / scale));
        colors.add(cloud.columns.color[k]);
    }
    coding.degree = static_cast<std::uint32_t>(cloud.columns.degree);
    const NumberRange coded = codedDeviations(deviations);
    coding.deviation_low = static_cast<float>(coded.low);
    coding.deviation_step = static_cast<float>(std::max((coded.high - coded.low) / kDeviationCodes, 1e-6));
    coding.color_low = static_cast<float>(colors.low);
    coding.color_step = static_cast<float>((colors.high - colors.low) / kColorCodes);
    for (std::uint32_t h = 0; h < pro_harmonic_count(coding.degree); ++h) {
        float& most = coding.harmonic_max[degreeOfHarmonic(h) - 1];
        for (std::size_t k = 0; k < 3 * count; ++k) most = std::max(most, std::abs(cloud.columns.harmonics[h][k]));
    }
}

void packHarmonics(const GaussianCloud& cloud, std::size_t i, const pro_gaussians& coding, std::int8_t* codes) {
    for (std::uint32_t h = 0; h < pro_harmonic_count(coding.degree); ++h) {
        const float most = coding.harmonic_max[degreeOfHarmonic(h) - 1];
        const float* const values = cloud.columns.harmonics[h] + 3 * i;
        for (std::uint32_t c = 0; c < 3; ++c)
            codes[3 * h + c] = static_cast<std::int8_t>(most > 0 ? std::lround(kHarmonicCodes * values[c] / most) : 0);
    }
}

/// A Gaussian in cube units, as pro_gaussian_encode requires.
pro_gaussian inCube(const GaussianCloud& cloud, std::size_t i, const pro_info& frame) {
    pro_gaussian gaussian = gaussianAt(cloud, i);
    const Vec3d center = cubeCenter(cloud, i, frame);
    for (int axis = 0; axis < 3; ++axis) {
        gaussian.mean[axis] = center[axis];
        gaussian.deviation[axis] = static_cast<float>(gaussian.deviation[axis] / frame.scale);
    }
    return gaussian;
}

/// The median of the deviations of their longest axes, input units.
double usualDeviation(const GaussianCloud& gaussians) {
    std::vector<float> longest(gaussians.points.positions.size());
    for (std::size_t i = 0; i < longest.size(); ++i) {
        const float* const deviations = gaussians.columns.deviation + 3 * i;
        longest[i] = *std::max_element(deviations, deviations + 3);
    }
    return double{medianInPlace(longest)};
}

/// The exact parameters of the Gaussians whose codes would change the picture visibly, in the order of the splats.
/// @param coding includes the words of GAUS
std::vector<pro_exact_gaussian> exactWhereCodesShow(const GaussianCloud& gaussians, const PackedSplats& splats,
                                                    const pro_gaussians& coding) {
    const std::size_t count = splats.words.size();
    const double usual = usualDeviation(gaussians) / splats.frame.scale;
    const auto exactAt = [&](std::size_t k) {
        return exactOf(inCube(gaussians, splats.input_index[k], splats.frame), static_cast<std::uint32_t>(k));
    };
    std::vector<char> shows(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        pro_gaussian decoded;
        pro_gaussian_decode(&coding, splats.words[k].data(), coding.words + k * PRO_GAUSSIAN_WORDS, &decoded);
        shows[k] = codesShow(exactAt(k), decoded, usual);
    });
    std::vector<pro_exact_gaussian> exact;
    for (std::size_t k = 0; k < count; ++k)
        if (shows[k]) exact.push_back(exactAt(k));
    return exact;
}

/// The ellipsoids that readers decode. @param gaussians with words and exact parameters
std::vector<GaussianEllipsoid> ellipsoidsOf(const pro_gaussians& gaussians, const PackedSplats& splats) {
    std::vector<GaussianEllipsoid> ellipsoids(splats.words.size());
    tbb::parallel_for(std::size_t{0}, ellipsoids.size(), [&](std::size_t k) {
        pro_gaussian gaussian;
        pro_gaussian_at(&gaussians, splats.words[0].data(), static_cast<std::uint32_t>(k), &gaussian);
        ellipsoids[k] = ellipsoidOf(gaussian);
    });
    return ellipsoids;
}

} // namespace

GaussianCloud takeGaussians(Cloud& cloud) {
    GaussianCloud taken;
    taken.points.origin = cloud.origin;
    taken.points.positions = std::exchange(cloud.positions, {});
    taken.points.normals = std::exchange(cloud.normals, {});
    taken.points.radii = std::exchange(cloud.radii, {});
    taken.points.colors = std::exchange(cloud.colors, {});
    const auto is_other = [](const Attribute& each) { return !isGaussianAttribute(each.name); };
    const auto own = std::stable_partition(cloud.attributes.begin(), cloud.attributes.end(), is_other);
    std::move(own, cloud.attributes.end(), std::back_inserter(taken.points.attributes));
    cloud.attributes.erase(own, cloud.attributes.end());
    taken.columns = gaussianColumns(taken.points).value();
    for (std::size_t i = 0; i < taken.points.positions.size(); ++i)
        if (std::isnan(taken.columns.opacity[i]))
            throw Error(ExitCode::kBadInput,
                        "some inputs hold Gaussians and some points: bake them separately and show "
                        "them together, or bake the Gaussians as discs with --splat disc");
    return taken;
}

PackedSplats packGaussianSplats(const GaussianCloud& gaussians) {
    PackedSplats packed;
    placeCube(gaussians, packed.frame);
    codeRadii(gaussians, packed.frame);
    const std::size_t count = gaussians.points.positions.size();
    std::vector<CurveKey> keys(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        keys[i] = {mortonAt(cubeCenter(gaussians, i, packed.frame)), static_cast<std::uint32_t>(i), false};
    });
    tbb::parallel_sort(keys);
    packed.words.resize(count);
    packed.discs.resize(count);
    packed.morton.resize(count);
    packed.input_index.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        packSplat(discOf(gaussians, keys[k].index, packed.frame), k, packed);
        packed.morton[k] = keys[k].code;
        packed.input_index[k] = keys[k].index;
    });
    packed.input_count = static_cast<std::uint32_t>(count);
    return packed;
}

Octree buildCenterOctree(PackedSplats& splats) {
    for (Disc& disc : splats.discs) disc.radius = 0; // so that none reaches into a neighbouring leaf
    Octree octree = buildOctree(splats, {kCentersPerLeaf, PRO_MAX_DEPTH});
    for (Leaf& leaf : octree.leaves) leaf.first_ref = leaf.ref_count = 0;
    std::erase_if(octree.leaves, [](const Leaf& leaf) { return leaf.member_count == 0; });
    octree.refs.clear();
    return octree;
}

GaussianSections packGaussians(const GaussianCloud& gaussians, const PackedSplats& splats) {
    GaussianSections sections;
    pro_gaussians& view = sections.view;
    chooseCodes(gaussians, splats.frame.scale, view);
    const std::size_t count = splats.words.size(), bytes = 3 * pro_harmonic_count(view.degree);
    sections.words.resize(count * PRO_GAUSSIAN_WORDS);
    sections.harmonics.resize(count * bytes);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        const std::size_t i = splats.input_index[k];
        const pro_gaussian gaussian = inCube(gaussians, i, splats.frame);
        pro_gaussian_encode(&gaussian, &view, splats.words[k].data(), &sections.words[k * PRO_GAUSSIAN_WORDS]);
        if (bytes > 0) packHarmonics(gaussians, i, view, &sections.harmonics[k * bytes]);
    });
    view.words = sections.words.data();
    sections.exact = exactWhereCodesShow(gaussians, splats, view);
    view.exact = sections.exact.data();
    view.exact_count = static_cast<std::uint32_t>(sections.exact.size());
    GaussianTree tree = buildGaussianTree(ellipsoidsOf(view, splats), kStoredFineness);
    sections.nodes = std::move(tree.nodes);
    sections.lists = std::move(tree.lists);
    view.harmonics = sections.harmonics.empty() ? nullptr : sections.harmonics.data();
    view.nodes = sections.nodes.data();
    view.lists = sections.lists.data();
    view.node_count = static_cast<std::uint32_t>(sections.nodes.size() / 2);
    view.list_count = static_cast<std::uint32_t>(sections.lists.size());
    return sections;
}

} // namespace pointrt
