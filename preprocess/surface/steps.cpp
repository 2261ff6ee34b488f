// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/steps.h"

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

/// Rows that are worked on at once: sums over a few times as many fit a core's caches.
constexpr std::uint32_t kStripRows = 64;

/// Windows from the widest to the narrowest, in cells to each side: terraces of a wall that is seen straight on are
/// tens of pixels wide.
constexpr std::array<int, 5> kRadii = {Arms::kLongest, 24, 12, 6, 3};

/// The window that noise is measured in: wide enough for a plane to average it, narrow enough to be one.
constexpr int kNoiseRadius = 6;

/// A plane fits that leaves no more than so many times the noise: an edge or a curve adds to that.
constexpr double kFits = 1.5;

/// Standard deviations that a sample may be off.
constexpr double kMostDeviations = 3;

/// What is known of one frame; noise in steps.
struct Leveller {
    const RangeGrid& grid;
    DepthFrame frame;
    DepthSteps steps;
    Arms arms = {};
    double noise = 1 / std::sqrt(12.0); ///< what even steps alone make

    /// How far, in steps, a point may move or be from what it lies on.
    double bound() const { return std::max(1.0, kMostDeviations * noise); }
};

/// Calls use(first, last) for strips of rows, on all threads.
template <typename Use>
void forStrips(const DepthFrame& frame, const Use& use) {
    tbb::parallel_for(std::uint32_t{0}, (frame.rows + kStripRows - 1) / kStripRows, [&](std::uint32_t strip) {
        use(strip * kStripRows, std::min(frame.rows, (strip + 1) * kStripRows));
    });
}

/// From second differences along the rows, before it is known where jumps are; in steps.
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

/// The median residual of small planes, in steps.
double measuredNoise(const Leveller& leveller) {
    std::vector<float> residuals(leveller.frame.inverse.size(), -1);
    forStrips(leveller.frame, [&](std::uint32_t first, std::uint32_t last) {
        std::vector<PlaneValue> planes;
        fitPlanes(leveller.frame, leveller.arms, kNoiseRadius, first, last, planes);
        const std::size_t from = leveller.frame.cell(first, 0);
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const double inverse = leveller.frame.inverse[from + i];
            if (inverse > 0 && std::isfinite(planes[i].residual))
                residuals[from + i] = float(planes[i].residual / leveller.steps.at(inverse));
        }
    });
    std::erase_if(residuals, [](float residual) { return residual < 0; });
    return double(medianOf(std::move(residuals)));
}

/// 1 / depth on the planes, of rows [first, last): each cell on the widest one that fits.
std::vector<double> onPlanes(const Leveller& leveller, std::uint32_t first, std::uint32_t last) {
    const std::size_t from = leveller.frame.cell(first, 0), count = leveller.frame.cell(last, 0) - from;
    const double* const inverse = leveller.frame.inverse.data() + from;
    std::vector<double> levelled(inverse, inverse + count);
    std::vector<std::uint8_t> settled(count);
    std::vector<PlaneValue> planes;
    for (const int radius : kRadii) {
        // what no plane fits is curved: the narrowest one is the best there is
        const double worst = (radius == kRadii.back() ? 2 : 1) * kFits * leveller.noise;
        fitPlanes(leveller.frame, leveller.arms, radius, first, last, planes);
        for (std::size_t i = 0; i < count; ++i) {
            if (settled[i] || inverse[i] == 0) continue;
            const double step = leveller.steps.at(inverse[i]), change = planes[i].value - inverse[i];
            const double most = std::min(leveller.bound() * step, inverse[i] / 2);
            if (!(planes[i].residual <= worst * step && std::abs(change) <= most)) continue;
            levelled[i] = planes[i].value;
            settled[i] = 1;
        }
    }
    return levelled;
}

/// Standard deviation along the sight.
double noiseAt(const Leveller& leveller, const Vec3d& from_sensor, double inverse) {
    return leveller.noise * leveller.steps.at(inverse) / inverse * from_sensor.norm();
}

double noiseOverSpacing(const Leveller& leveller, const Cloud& cloud) {
    const DepthFrame& frame = leveller.frame;
    std::vector<float> ratios;
    for (std::uint32_t row = 0; row < frame.rows; ++row)
        for (std::uint32_t column = 1; column < frame.columns; ++column) {
            const std::uint32_t a = leveller.grid.at(row, column - 1), b = leveller.grid.at(row, column);
            const double before = frame.inverse[frame.cell(row, column - 1)],
                         inverse = frame.inverse[frame.cell(row, column)];
            if (before == 0 || inverse == 0) continue;
            const Vec3d u = cloud.positions[a].cast<double>() - frame.sensor,
                        v = cloud.positions[b].cast<double>() - frame.sensor;
            const double spacing = u.cross(v).norm() / u.norm();
            if (spacing > 0) ratios.push_back(float(noiseAt(leveller, v, inverse) / spacing));
        }
    return double(medianOf(std::move(ratios)));
}

/// Moves the points of rows [first, last) along the sight; returns how many are elsewhere then.
std::size_t movePoints(const Leveller& leveller, std::uint32_t first, std::uint32_t last, Cloud& cloud) {
    const std::vector<double> levelled = onPlanes(leveller, first, last);
    const std::size_t from = leveller.frame.cell(first, 0);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < levelled.size(); ++i) {
        const std::uint32_t point = leveller.grid.point_of_cell[from + i];
        const double inverse = leveller.frame.inverse[from + i];
        if (inverse == 0) continue;
        const Vec3d from_sensor = cloud.positions[point].cast<double>() - leveller.frame.sensor;
        cloud.noise[point] = float(noiseAt(leveller, from_sensor, inverse));
        if (levelled[i] == inverse) continue;
        const Vec3f place = (leveller.frame.sensor + inverse / levelled[i] * from_sensor).cast<float>();
        moved += place != cloud.positions[point];
        cloud.positions[point] = place;
    }
    return moved;
}

/// What it takes to level a grid; nothing where there are no steps that show.
std::optional<Leveller> levellerOf(const Cloud& cloud, const RangeGrid& grid, LevelReport& report) {
    auto frame = depthFrameOf(cloud, grid);
    const auto steps = frame ? findDepthSteps(cloud, grid, *frame) : std::nullopt;
    if (!steps) return std::nullopt;
    Leveller leveller{grid, std::move(*frame), *steps};
    // neighbours on one surface differ by the noise of two, four times at most, and by some steps where that is steep
    constexpr double kJump = 3, kNoisyJump = 4;
    leveller.arms = findArms(leveller.frame, leveller.steps,
                             std::max(kJump, kNoisyJump * roughNoise(leveller.frame, leveller.steps)));
    leveller.noise = std::max(leveller.noise, measuredNoise(leveller));
    const double noise_over_spacing = noiseOverSpacing(leveller, cloud);
    if (noise_over_spacing < double(kCleanNoise)) return std::nullopt;
    report.scans.push_back({grid.scan, noise_over_spacing});
    return leveller;
}

} // namespace

LevelReport levelSteps(Cloud& cloud) {
    LevelReport report;
    for (const RangeGrid& grid : cloud.grids) {
        const auto leveller = levellerOf(cloud, grid, report);
        if (!leveller) continue;
        cloud.noise.resize(cloud.positions.size(), 0);
        const std::uint32_t strips = (grid.rows + kStripRows - 1) / kStripRows;
        std::vector<std::size_t> moved(strips);
        forStrips(leveller->frame, [&](std::uint32_t first, std::uint32_t last) {
            moved[first / kStripRows] = movePoints(*leveller, first, last, cloud);
        });
        for (const std::size_t count : moved) report.moved += count;
    }
    return report;
}

} // namespace pointrt
