// SPDX-License-Identifier: Apache-2.0
#include "tests/gaussians/oracle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace pointrt::test {

namespace {

/// Margin of the reach, squared deviations: far more than rounding errors, even of the thinnest Gaussians.
constexpr double kReachMargin = 1e-4;

/// Columns of the rotation matrix of a unit quaternion: the axes.
std::array<Double3, 3> axesOf(const std::array<double, 4>& q) {
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    return {Double3{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
            Double3{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
            Double3{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
}

std::array<double, 4> normalized(std::array<double, 4> q) {
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& part : q) part /= norm;
    return q;
}

OracleTransform transformOf(const OracleGaussian& gaussian) {
    OracleTransform transform{gaussian.mean, axesOf(normalized(gaussian.rotation)), gaussian.opacity, -1};
    for (std::size_t k = 0; k < 3; ++k) transform.rows[k] = times(1 / gaussian.deviation[k], transform.rows[k]);
    if (gaussian.opacity > 0) transform.reach_squared = 2 * std::log(gaussian.opacity / kOracleAlphaMin) + kReachMargin;
    return transform;
}

bool isFinite(const Double3& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

void requireShape(const OracleGaussian& gaussian, const OracleTransform& transform, std::size_t index) {
    const bool has_rows = isFinite(transform.rows[0]) && isFinite(transform.rows[1]) && isFinite(transform.rows[2]);
    const bool is_spread = *std::min_element(gaussian.deviation.begin(), gaussian.deviation.end()) > 0;
    const bool is_opacity = gaussian.opacity >= 0 && gaussian.opacity <= 1;
    const std::size_t count = gaussian.harmonics.size();
    const bool is_colored = count == 0 || count == 3 || count == 8 || count == 15;
    if (isFinite(gaussian.mean) && has_rows && is_spread && is_opacity && is_colored) return;
    throw std::invalid_argument("Gaussian " + std::to_string(index) + " has no shape, opacity or colour");
}

bool comesBefore(const OracleHit& a, const OracleHit& b) { return a.t < b.t || (a.t == b.t && a.index < b.index); }

/// Appends the hit of a Gaussian if it counts.
void addHit(const OracleScene& scene, const OracleRay& ray, std::uint32_t index, std::vector<OracleHit>& hits) {
    const OraclePeak peak = peakAlong(scene.transforms[index], ray);
    if (peak.alpha >= kOracleAlphaMin && peak.t > 0 && peak.t < ray.t_max) hits.push_back({peak.t, peak.alpha, index});
}

void compositeOne(const OracleHit& hit, const Double3& color, OracleComposite& sum) {
    const double weight = sum.transmittance * hit.alpha;
    sum.radiance = plus(sum.radiance, times(weight, color));
    if (weight > sum.strongest_weight) {
        sum.strongest = hit.index;
        sum.strongest_weight = weight;
    }
    const double before = sum.transmittance;
    sum.transmittance *= 1 - hit.alpha;
    if (before > 0.5 && sum.transmittance <= 0.5) sum.depth = hit.t;
    ++sum.counted;
}

} // namespace

int OracleGaussian::degree() const {
    return harmonics.size() >= 15 ? 3 : harmonics.size() >= 8 ? 2 : harmonics.size() >= 3 ? 1 : 0;
}

OracleScene oracleScene(std::vector<OracleGaussian> gaussians) {
    OracleScene scene{std::move(gaussians), {}};
    scene.transforms.reserve(scene.gaussians.size());
    for (std::size_t k = 0; k < scene.gaussians.size(); ++k) {
        scene.transforms.push_back(transformOf(scene.gaussians[k]));
        requireShape(scene.gaussians[k], scene.transforms[k], k);
    }
    return scene;
}

OraclePeak peakAlong(const OracleTransform& transform, const OracleRay& ray) {
    const Double3 from_mean = minus(ray.origin, transform.mean);
    Double3 origin, direction;
    for (std::size_t k = 0; k < 3; ++k) {
        origin[k] = dot(transform.rows[k], from_mean);
        direction[k] = dot(transform.rows[k], ray.direction);
    }
    OraclePeak peak{-dot(origin, direction) / dot(direction, direction), 0};
    const Double3 nearest = plus(origin, times(peak.t, direction));
    const double squared = dot(nearest, nearest);
    if (squared > transform.reach_squared) return peak; // saves the exponential
    peak.alpha = std::min(transform.opacity * std::exp(-squared / 2), kOracleAlphaMax);
    return peak;
}

std::vector<OracleHit> hitsAlong(const OracleScene& scene, const OracleRay& ray) {
    std::vector<OracleHit> hits;
    for (std::uint32_t k = 0; k < scene.transforms.size(); ++k) addHit(scene, ray, k, hits);
    std::sort(hits.begin(), hits.end(), comesBefore);
    return hits;
}

std::vector<OracleHit> hitsAlong(const OracleScene& scene, const OracleRay& ray,
                                 std::span<const std::uint32_t> candidates) {
    std::vector<OracleHit> hits;
    for (const std::uint32_t k : candidates) addHit(scene, ray, k, hits);
    std::sort(hits.begin(), hits.end(), comesBefore);
    return hits;
}

std::array<double, 16> harmonicBasis(const Double3& direction) {
    // the constants are square roots of rational numbers over pi
    constexpr double kConstant = 0.28209479177387814, kLinear = 0.4886025119029199;
    constexpr double kQuadratic[] = {1.0925484305920792, 0.31539156525252005, 0.5462742152960396};
    constexpr double kCubic[] = {0.5900435899266435, 2.890611442640554, 0.4570457994644658, 0.3731763325901154,
                                 1.445305721320277};
    const auto [x, y, z] = direction;
    const double xx = x * x, yy = y * y, zz = z * z;
    return {kConstant,
            -kLinear * y,
            kLinear * z,
            -kLinear * x,
            kQuadratic[0] * x * y,
            -kQuadratic[0] * y * z,
            kQuadratic[1] * (2 * zz - xx - yy),
            -kQuadratic[0] * x * z,
            kQuadratic[2] * (xx - yy),
            -kCubic[0] * y * (3 * xx - yy),
            kCubic[1] * x * y * z,
            -kCubic[2] * y * (4 * zz - xx - yy),
            kCubic[3] * z * (2 * zz - 3 * xx - 3 * yy),
            -kCubic[2] * x * (4 * zz - xx - yy),
            kCubic[4] * z * (xx - yy),
            -kCubic[0] * x * (xx - 3 * yy)};
}

Double3 colorAlong(const OracleGaussian& gaussian, const std::array<double, 16>& basis) {
    Double3 color = gaussian.color;
    for (std::size_t k = 0; k < gaussian.harmonics.size(); ++k)
        color = plus(color, times(basis[k + 1], gaussian.harmonics[k]));
    for (double& channel : color) channel = std::max(channel, 0.0);
    return color;
}

OracleComposite composite(const OracleScene& scene, const OracleRay& ray, std::span<const OracleHit> hits,
                          double stop_below) {
    const std::array<double, 16> basis = harmonicBasis(ray.direction);
    OracleComposite sum;
    for (const OracleHit& hit : hits) {
        if (sum.transmittance < stop_below) break;
        compositeOne(hit, colorAlong(scene.gaussians[hit.index], basis), sum);
    }
    return sum;
}

} // namespace pointrt::test
