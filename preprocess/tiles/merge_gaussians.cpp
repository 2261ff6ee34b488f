// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/merge_gaussians.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "preprocess/cloud/gaussians.h"
#include "preprocess/tiles/gaussian_tiles.h"
#include "preprocess/tiles/level_coding.h"
#include "preprocess/tiles/merge_cells.h"
#include "preprocess/tiles/merge_input.h"
#include "preprocess/tiles/select_splats.h"

namespace pointrt {
namespace {

/// Gaussians at least this many times as long as the median one are giants.
constexpr double kGiant = 8;

/// Radius of a disc for readers without Gaussian support, in standard deviations, as viewers of captures draw it.
constexpr double kDiscDeviations = 2.2;

/// The error covers this share of the merged area, as for discs.
constexpr double kErrorShare = 0.95;

/// Shortest allowed axis as a share of the longest one, as in captures.
constexpr double kThinnest = 1.0 / 1024;

using Floats = std::vector<const float*>; ///< [children] values of one attribute

/// The attributes of all children.
struct GaussianValues {
    Floats opacity, deviation, rotation, color, fraction;
    std::vector<Floats> harmonics;

    explicit GaussianValues(const std::vector<MergeChild>& children, const std::vector<Attribute>& schema) {
        const auto find = [&](const std::string& name) {
            Floats values;
            for (std::size_t a = 0; a < schema.size(); ++a)
                for (const MergeChild& child : children)
                    if (schema[a].name == name)
                        values.push_back(reinterpret_cast<const float*>(child.splats.attributes[a].data));
            return values;
        };
        opacity = find(kGaussianOpacity);
        deviation = find(kGaussianDeviation);
        rotation = find(kGaussianRotation);
        color = find(kGaussianColor);
        fraction = find(kGaussianFraction);
        for (int h = 1; h <= kMostGaussianHarmonics; ++h) {
            Floats values = find(gaussianHarmonicName(h));
            if (values.empty()) break;
            harmonics.push_back(std::move(values));
        }
    }
};

Eigen::Map<const Eigen::Vector3f> vectorAt(const Floats& values, const MergeSource& source) {
    return Eigen::Map<const Eigen::Vector3f>(values[source.tile] + 3 * std::size_t{source.splat});
}

/// Mean in units of the parent's edge, from its core's corner.
Vec3d meanOf(const TileKey& parent, const TileKey& child, const PositionCode& code, const Vec3f& fraction) {
    Vec3d mean;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::int64_t corner = child.cell[a] - 2 * std::int64_t{parent.cell[a]};
        const double step = static_cast<double>(corner * kCoreSteps + code[a]) + double{fraction[axis]};
        mean[axis] = step / (2.0 * kCoreSteps);
    }
    return mean;
}

/// Standard deviations and axes of a covariance, the shortest first.
struct Axes {
    Vec3d deviations;
    Eigen::Matrix3d directions; ///< columns, right-handed
};

Axes axesOf(const Eigen::Matrix3d& covariance) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    Axes axes{solver.eigenvalues().cwiseMax(0).cwiseSqrt(), solver.eigenvectors()};
    axes.deviations = axes.deviations.cwiseMax(kThinnest * axes.deviations[2]);
    if (axes.directions.determinant() < 0) axes.directions.col(0) *= -1;
    return axes;
}

class GaussianMerger {
public:
    GaussianMerger(const TileKey& parent, const std::vector<MergeChild>& children, const std::vector<Attribute>& schema,
                   double edge, double share)
        : parent_(parent), children_(children), schema_(schema), values_(children, schema), edge_(edge),
          input_(takeMergeInput(parent, children, edge)) {
        for (const MergeChild& child : children) views_.push_back(child.splats);
        moments_.resize(input_.sources.size());
        tbb::parallel_for(std::size_t{0}, moments_.size(), [&](std::size_t i) { moments_[i] = momentsOf(i); });
        makeGroups(share);
    }

    TileSplats merge() {
        const std::size_t count = first_.size() - 1;
        merged_.resize(count);
        errors_.resize(count);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t g) { mergeGroup(g); });
        std::vector<PositionCode> codes(count);
        for (std::size_t g = 0; g < count; ++g) codes[g] = codeAt(inCore(g).cast<float>());
        const std::vector<std::uint32_t> order = orderAlongCurve(codes);
        for (const Attribute& each : schema_) {
            splats_.attributes.push_back({each.name, each.type, each.components, {}});
            splats_.attributes.back().values.resize(count * each.bytesEach());
        }
        splats_.positions.resize(count);
        splats_.normals.resize(count);
        splats_.radii.resize(count);
        splats_.colors.resize(count);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) { fill(order[k], k); });
        splats_.spacing = spacingOf(splats_.positions, edge_ / kCoreSteps);
        splats_.error = std::max({commonError(), splats_.spacing / 4, edge_ / kCoreSteps});
        return std::move(splats_);
    }

private:
    GaussianMoments momentsOf(std::size_t i) const {
        const MergeSource& source = input_.sources[i];
        const MergeChild& child = children_[source.tile];
        GaussianMoments moments;
        moments.mean =
            meanOf(parent_, child.tile, child.splats.positions[source.splat], vectorAt(values_.fraction, source));
        const float* const turn = values_.rotation[source.tile] + 4 * std::size_t{source.splat};
        const Eigen::Matrix3d axes =
            Eigen::Quaterniond(turn[0], turn[1], turn[2], turn[3]).normalized().toRotationMatrix();
        const Vec3d deviations = vectorAt(values_.deviation, source).cast<double>() / edge_;
        moments.covariance = axes * deviations.cwiseAbs2().asDiagonal() * axes.transpose();
        moments.opacity = values_.opacity[source.tile][source.splat];
        return moments;
    }

    float longest(std::size_t i) const { return vectorAt(values_.deviation, input_.sources[i]).maxCoeff(); }

    /// Giants, each in a group of its own, come last.
    void makeGroups(double share) {
        std::vector<float> lengths(moments_.size());
        for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i] = longest(i);
        const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
        std::nth_element(lengths.begin(), middle, lengths.end());
        const double giant = kGiant * double{*middle};
        MergeDiscs discs;
        std::vector<std::uint32_t> small, giants;
        for (std::uint32_t i = 0; i < moments_.size(); ++i) {
            const bool is_giant = double{longest(i)} > giant;
            (is_giant ? giants : small).push_back(i);
            if (is_giant) continue;
            discs.positions.push_back(input_.discs.positions[i]);
            discs.normals.push_back(input_.discs.normals[i]);
            discs.radii.push_back(input_.discs.radii[i]);
        }
        const MergeGroups groups = findMergeGroups(discs, share, false);
        first_ = groups.first;
        for (const std::uint32_t member : groups.members) members_.push_back(small[member]);
        for (const std::uint32_t each : giants) {
            members_.push_back(each);
            first_.push_back(static_cast<std::uint32_t>(members_.size()));
        }
    }

    std::span<const std::uint32_t> membersOf(std::size_t g) const {
        return std::span(members_).subspan(first_[g], first_[g + 1] - first_[g]);
    }

    std::vector<double> sharesOf(std::size_t g) const {
        std::vector<GaussianMoments> group;
        for (const std::uint32_t i : membersOf(g)) group.push_back(moments_[i]);
        return mergeShares(group);
    }

    /// The error is the deviation of the members' means from the common one.
    void mergeGroup(std::size_t g) {
        std::vector<GaussianMoments> group;
        for (const std::uint32_t i : membersOf(g)) group.push_back(moments_[i]);
        const std::vector<double> shares = mergeShares(group);
        merged_[g] = mergeMoments(group, shares);
        double squares = 0;
        for (std::size_t k = 0; k < group.size(); ++k)
            squares += shares[k] * (group[k].mean - merged_[g].mean).squaredNorm();
        errors_[g] = std::sqrt(squares);
    }

    /// The mean, kept within the core.
    Vec3d inCore(std::size_t g) const { return merged_[g].mean.cwiseMax(0).cwiseMin(1 - 0.5 / kCoreSteps); }

    double commonError() const {
        std::vector<std::pair<double, double>> errors; // errors and their areas
        double area = 0, reached = 0;
        for (std::size_t g = 0; g < merged_.size(); ++g) {
            errors.emplace_back(errors_[g], merged_[g].opacity * meanShadow(merged_[g].covariance));
            area += errors.back().second;
        }
        std::sort(errors.begin(), errors.end());
        for (const auto& [error, each] : errors)
            if ((reached += each) >= kErrorShare * area) return error * edge_;
        return 0;
    }

    template <typename Vector>
    void store(std::size_t attribute, std::size_t k, const Vector& vector) {
        const Eigen::Matrix<float, Vector::RowsAtCompileTime, 1> values = vector.template cast<float>();
        std::memcpy(splats_.attributes[attribute].values.data() + k * sizeof values, values.data(), sizeof values);
    }

    Vec3d meanOfValues(const Floats& values, std::size_t g, const std::vector<double>& shares) const {
        Vec3d sum = Vec3d::Zero();
        const auto members = membersOf(g);
        for (std::size_t k = 0; k < members.size(); ++k)
            sum += shares[k] * vectorAt(values, input_.sources[members[k]]).template cast<double>();
        return sum;
    }

    void fill(std::size_t g, std::size_t k) {
        const Axes axes = axesOf(merged_[g].covariance);
        const std::vector<double> shares = sharesOf(g);
        const Vec3d at = inCore(g) * double{kCoreSteps}, color = meanOfValues(values_.color, g, shares);
        splats_.positions[k] = codeAt(inCore(g).cast<float>());
        splats_.normals[k] = normalWord(axes.directions.col(0).cast<float>());
        const double radius = kDiscDeviations * std::cbrt(axes.deviations[1] * axes.deviations[1] * axes.deviations[2]);
        splats_.radii[k] = static_cast<float>(std::min(radius, kRadiusPerEdge) * edge_);
        Vec3d fraction;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            fraction[axis] = std::clamp(at[axis] - splats_.positions[k][a], 0.0, 1.0);
            splats_.colors[k][a] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[axis], 0.0, 1.0)));
        }
        const Eigen::Quaterniond turn(axes.directions);
        std::size_t harmonic = 0;
        for (std::size_t a = 0; a < schema_.size(); ++a) {
            const std::string& name = schema_[a].name;
            if (name == kGaussianOpacity)
                store(a, k, Eigen::Matrix<double, 1, 1>(merged_[g].opacity));
            else if (name == kGaussianDeviation)
                store(a, k, Vec3d(axes.deviations * edge_));
            else if (name == kGaussianRotation)
                store(a, k, Eigen::Vector4d(turn.w(), turn.x(), turn.y(), turn.z()));
            else if (name == kGaussianColor)
                store(a, k, color);
            else if (name == kGaussianFraction)
                store(a, k, fraction);
            else if (isGaussianHarmonic(name))
                store(a, k, meanOfValues(values_.harmonics[harmonic++], g, shares));
            else
                mergeOther(a, k, g, shares);
        }
    }

    void mergeOther(std::size_t attribute, std::size_t k, std::size_t g, const std::vector<double>& shares) {
        std::vector<MergeSource> members;
        for (const std::uint32_t i : membersOf(g)) members.push_back(input_.sources[i]);
        const std::vector<float> areas(shares.begin(), shares.end());
        Attribute& to = splats_.attributes[attribute];
        mergeValue(views_, attribute, to, {members, areas}, to.values.data() + k * to.bytesEach());
    }

    const TileKey parent_;
    const std::vector<MergeChild>& children_;
    const std::vector<Attribute>& schema_;
    const GaussianValues values_;
    const double edge_;
    const MergeInput input_;
    std::vector<SplatsView> views_;
    std::vector<GaussianMoments> moments_, merged_; ///< of the sources and of the groups, in units of the edge
    std::vector<double> errors_;                    ///< of the groups, in units of the edge
    std::vector<std::uint32_t> first_, members_;    ///< see MergeGroups
    TileSplats splats_;
};

} // namespace

double meanShadow(const Eigen::Matrix3d& covariance) {
    constexpr double kThomsen = 1.6075;
    const Vec3d raised = axesOf(covariance).deviations.array().pow(kThomsen);
    const double mean = (raised[0] * raised[1] + raised[0] * raised[2] + raised[1] * raised[2]) / 3;
    return EIGEN_PI * std::pow(mean, 1 / kThomsen);
}

std::vector<double> mergeShares(std::span<const GaussianMoments> members) {
    std::vector<double> shares;
    double sum = 0;
    for (const GaussianMoments& each : members) sum += shares.emplace_back(each.opacity * meanShadow(each.covariance));
    for (double& each : shares) each = sum > 0 ? each / sum : 1 / static_cast<double>(members.size());
    return shares;
}

GaussianMoments mergeMoments(std::span<const GaussianMoments> members, std::span<const double> shares) {
    if (members.size() == 1) return members.front();
    GaussianMoments merged;
    double hidden = 0, passes = 1;
    for (std::size_t k = 0; k < members.size(); ++k) {
        merged.mean += shares[k] * members[k].mean;
        hidden += members[k].opacity * meanShadow(members[k].covariance);
        passes *= 1 - members[k].opacity;
    }
    for (std::size_t k = 0; k < members.size(); ++k) {
        const Vec3d off = members[k].mean - merged.mean;
        merged.covariance += shares[k] * (members[k].covariance + off * off.transpose());
    }
    merged.opacity = std::min(hidden / meanShadow(merged.covariance), 1 - passes);
    return merged;
}

TileSplats mergeGaussians(const TileKey& parent, std::vector<MergeChild> children, const std::vector<Attribute>& schema,
                          double edge, std::uint64_t tile_splats) {
    std::sort(children.begin(), children.end(), [](const auto& a, const auto& b) { return a.tile < b.tile; });
    double error = 0;
    std::uint64_t count = 0;
    for (const MergeChild& child : children) {
        count += child.splats.positions.size();
        error = std::max(error, child.error);
    }
    const double share = std::min(kMergedShare, static_cast<double>(tile_splats) / static_cast<double>(count));
    TileSplats merged = GaussianMerger(parent, children, schema, edge, share).merge();
    merged.error += error;
    return merged;
}

} // namespace pointrt
