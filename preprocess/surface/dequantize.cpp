// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/dequantize.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tbb/parallel_for.h>

#include "preprocess/cloud/clean_noise.h"
#include "preprocess/cloud/median.h"
#include "preprocess/surface/depth_frame.h"
#include "preprocess/surface/plane_windows.h"

namespace pointrt {
namespace {

/// Rows processed at once: sums over a few times as many fit a core's caches.
constexpr std::uint32_t kStripRows = 64;

/// Windows from the widest to the narrowest, in cells to each side: on a wall seen head-on, terraces are tens of pixels
/// wide.
constexpr std::array<int, 5> kRadii = {Arms::kLongest, 24, 12, 6, 3};

/// Window for measuring noise: wide enough for a plane to average it, narrow enough to be planar.
constexpr int kNoiseRadius = 6;

/// A plane fits if its residual is at most this many times the noise: edges and curvature add to that.
constexpr double kFits = 1.5;

/// Largest error of a sample in standard deviations.
constexpr double kMostDeviations = 3;

/// A frame to remove quantisation from; noise is in steps.
struct Dequantizer {
    const RangeGrid& grid;
    DepthFrame frame;
    DepthSteps steps;
    Arms arms = {};
    double noise = 1 / std::sqrt(12.0); ///< of uniform quantisation

    /// Limit of a point's movement, in steps.
    double bound() const { return std::max(1.0, kMostDeviations * noise); }
};

/// Calls use(first, last) for strips of rows, on all threads.
template <typename Use>
void forStrips(const DepthFrame& frame, const Use& use) {
    tbb::parallel_for(std::uint32_t{0}, (frame.rows + kStripRows - 1) / kStripRows, [&](std::uint32_t strip) {
        use(strip * kStripRows, std::min(frame.rows, (strip + 1) * kStripRows));
    });
}

/// Noise in steps, from second differences along the rows; used to find jumps.
double roughNoise(const DepthFrame& frame, const DepthSteps& steps) {
    std::vector<float> seconds;
    for (std::uint32_t row = 0; row < frame.rows; ++row)
        for (std::uint32_t column = 0; column + 2 < frame.columns; ++column) {
            const double* const at = frame.inverse.data() + frame.cell(row, column);
            if (at[0] > 0 && at[1] > 0 && at[2] > 0)
                seconds.push_back(float(std::abs(at[0] - 2 * at[1] + at[2]) / steps.at(at[1])));
        }
    return deviationBySecondDifferences(std::move(seconds));
}

/// Noise in steps: the median residual of small planes.
double measuredNoise(const Dequantizer& dequantizer) {
    std::vector<float> residuals(dequantizer.frame.inverse.size(), -1);
    forStrips(dequantizer.frame, [&](std::uint32_t first, std::uint32_t last) {
        std::vector<PlaneValue> planes;
        fitPlanes(dequantizer.frame, dequantizer.arms, kNoiseRadius, first, last, planes);
        const std::size_t from = dequantizer.frame.cell(first, 0);
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const double inverse = dequantizer.frame.inverse[from + i];
            if (inverse > 0 && std::isfinite(planes[i].residual))
                residuals[from + i] = float(planes[i].residual / dequantizer.steps.at(inverse));
        }
    });
    std::erase_if(residuals, [](float residual) { return residual < 0; });
    return double(medianOf(std::move(residuals)));
}

/// Fits 1 / depth by planes, for rows [first, last): each cell on the widest plane that fits.
std::vector<double> planeDepths(const Dequantizer& dequantizer, std::uint32_t first, std::uint32_t last) {
    const std::size_t from = dequantizer.frame.cell(first, 0), count = dequantizer.frame.cell(last, 0) - from;
    const double* const inverse = dequantizer.frame.inverse.data() + from;
    std::vector<double> fitted(inverse, inverse + count);
    std::vector<std::uint8_t> done(count);
    std::vector<PlaneValue> planes;
    for (const int radius : kRadii) {
        // curved surfaces: accepts a worse fit of the narrowest plane
        const double worst = (radius == kRadii.back() ? 2 : 1) * kFits * dequantizer.noise;
        fitPlanes(dequantizer.frame, dequantizer.arms, radius, first, last, planes);
        for (std::size_t i = 0; i < count; ++i) {
            if (done[i] || inverse[i] == 0) continue;
            const double step = dequantizer.steps.at(inverse[i]), change = planes[i].value - inverse[i];
            const double most = std::min(dequantizer.bound() * step, inverse[i] / 2);
            if (!(planes[i].residual <= worst * step && std::abs(change) <= most)) continue;
            fitted[i] = planes[i].value;
            done[i] = 1;
        }
    }
    return fitted;
}

/// Standard deviation along the line of sight.
double noiseAt(const Dequantizer& dequantizer, const Vec3d& from_sensor, double inverse) {
    return dequantizer.noise * dequantizer.steps.at(inverse) / inverse * from_sensor.norm();
}

double noiseOverSpacing(const Dequantizer& dequantizer, const Cloud& cloud) {
    const DepthFrame& frame = dequantizer.frame;
    std::vector<float> ratios;
    for (std::uint32_t row = 0; row < frame.rows; ++row)
        for (std::uint32_t column = 1; column < frame.columns; ++column) {
            const std::uint32_t a = dequantizer.grid.at(row, column - 1), b = dequantizer.grid.at(row, column);
            const double before = frame.inverse[frame.cell(row, column - 1)],
                         inverse = frame.inverse[frame.cell(row, column)];
            if (before == 0 || inverse == 0) continue;
            const Vec3d u = cloud.positions[a].cast<double>() - frame.sensor,
                        v = cloud.positions[b].cast<double>() - frame.sensor;
            const double spacing = u.cross(v).norm() / u.norm();
            if (spacing > 0) ratios.push_back(float(noiseAt(dequantizer, v, inverse) / spacing));
        }
    return double(medianOf(std::move(ratios)));
}

/// Moves the points of rows [first, last) along the line of sight. Returns the number of points that moved.
std::size_t movePoints(const Dequantizer& dequantizer, std::uint32_t first, std::uint32_t last, Cloud& cloud) {
    const std::vector<double> fitted = planeDepths(dequantizer, first, last);
    const std::size_t from = dequantizer.frame.cell(first, 0);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < fitted.size(); ++i) {
        const std::uint32_t point = dequantizer.grid.point_of_cell[from + i];
        const double inverse = dequantizer.frame.inverse[from + i];
        if (inverse == 0) continue;
        const Vec3d from_sensor = cloud.positions[point].cast<double>() - dequantizer.frame.sensor;
        cloud.noise[point] = float(noiseAt(dequantizer, from_sensor, inverse));
        if (fitted[i] == inverse) continue;
        const Vec3f place = (dequantizer.frame.sensor + inverse / fitted[i] * from_sensor).cast<float>();
        moved += place != cloud.positions[point];
        cloud.positions[point] = place;
    }
    return moved;
}

/// nullopt if depths are not quantised, or too finely to matter.
std::optional<Dequantizer> dequantizerOf(const Cloud& cloud, const RangeGrid& grid, DequantizeReport& report) {
    auto frame = depthFrameOf(cloud, grid);
    const auto steps = frame ? findDepthSteps(cloud, grid, *frame) : std::nullopt;
    if (!steps) return std::nullopt;
    Dequantizer dequantizer{grid, std::move(*frame), *steps};
    // Neighbours on one surface differ by up to four times the noise, and by a few steps on slopes.
    constexpr double kJump = 3, kNoisyJump = 4;
    dequantizer.arms = findArms(dequantizer.frame, dequantizer.steps,
                                std::max(kJump, kNoisyJump * roughNoise(dequantizer.frame, dequantizer.steps)));
    dequantizer.noise = std::max(dequantizer.noise, measuredNoise(dequantizer));
    const double noise_over_spacing = noiseOverSpacing(dequantizer, cloud);
    if (noise_over_spacing < double(kCleanNoise)) return std::nullopt;
    report.scans.push_back({grid.scan, noise_over_spacing});
    return dequantizer;
}

} // namespace

DequantizeReport dequantizeDepths(Cloud& cloud) {
    DequantizeReport report;
    for (const RangeGrid& grid : cloud.grids) {
        const auto dequantizer = dequantizerOf(cloud, grid, report);
        if (!dequantizer) continue;
        cloud.noise.resize(cloud.positions.size(), 0);
        const std::uint32_t strips = (grid.rows + kStripRows - 1) / kStripRows;
        std::vector<std::size_t> moved(strips);
        forStrips(dequantizer->frame, [&](std::uint32_t first, std::uint32_t last) {
            moved[first / kStripRows] = movePoints(*dequantizer, first, last, cloud);
        });
        for (const std::size_t count : moved) report.moved += count;
    }
    return report;
}

} // namespace pointrt
