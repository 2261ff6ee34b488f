// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/fill.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tbb/parallel_for.h>

#include "preprocess/surface/scan_lines.h"

namespace pointrt::surface {
namespace {

constexpr double kLeastShare = 1.0 / 50;
constexpr std::array<float, 2> kSides{1.0f, -1.0f};

/// The gaps on both sides of a point, and how many rows they ask for.
struct Gap {
    Facing facing;
    std::uint32_t rows = 0; ///< 0: none to fill
};
using Gaps = std::array<Gap, 2>;

/// Of the 2 rows + 1 steps between two lines a point fills the rows on its half.
std::uint32_t rowsFor(const Facing& facing, const ScanLine& line) {
    const float steps = facing.across.norm() / line.step;
    return std::clamp(std::uint32_t(std::lround((steps - 1) / 2)), std::uint32_t(1), kMostRows);
}

std::vector<Gaps> findGaps(const LineJob& job, const std::vector<float>& sheets, const StageShare& share) {
    std::vector<Gaps> gaps(job.points.size());
    forEach(job.points.size(), share, [&](std::size_t i) {
        if (!job.points.radii.empty() && job.points.radii[i] > 0) return;
        if (!sheets.empty() && sheets[i] < kSurface) return;
        const auto line = lineAt(job, i);
        if (!line) return;
        for (std::size_t side = 0; side < kSides.size(); ++side)
            if (const auto facing = facingLine(job, i, *line, kSides[side]))
                gaps[i][side] = {*facing, rowsFor(*facing, *line)};
    });
    return gaps;
}

/// First number of each point's filling points, and behind the last their number.
std::vector<std::uint32_t> countFilling(const std::vector<Gaps>& gaps, std::uint32_t most_rows) {
    std::vector<std::uint32_t> first(gaps.size() + 1, 0);
    for (std::size_t i = 0; i < gaps.size(); ++i)
        first[i + 1] = first[i] + std::min(gaps[i][0].rows, most_rows) + std::min(gaps[i][1].rows, most_rows);
    return first;
}

/// One point between two lines.
struct Between {
    std::size_t base, other;
    Vec3f across;
    float share; ///< of the way from base to the other line
};

/// Of a way across, the tangent of the surface at one end: as long as the way.
Vec3f tangentOf(const Vec3f& across, const Vec3f& normal) {
    const Vec3f flat = across - normal.dot(across) * normal;
    return flat * (across.norm() / flat.norm());
}

void place(Points& points, std::size_t at, const Between& between) {
    const Vec3f near_normal = points.normals[between.base];
    Vec3f far_normal = points.normals[between.other];
    if (near_normal.dot(far_normal) < 0) far_normal = -far_normal;
    const float s = between.share;
    const Vec3f &across = between.across, leave = tangentOf(across, near_normal),
                arrive = tangentOf(across, far_normal);
    points.positions[at] = points.positions[between.base] + s * s * (3 - 2 * s) * across +
                           s * (1 - s) * (1 - s) * leave - s * s * (1 - s) * arrive;
    const Vec3f slope = 6 * s * (1 - s) * across + (1 - s) * (1 - 3 * s) * leave - s * (2 - 3 * s) * arrive;
    const Vec3f normal = (1 - s) * near_normal + s * far_normal;
    points.normals[at] = (normal - normal.dot(slope) / slope.squaredNorm() * slope).normalized();
    if (points.colors.empty()) return;
    for (std::size_t channel = 0; channel < 3; ++channel)
        points.colors[at][channel] = std::uint8_t(std::lround((1 - s) * float(points.colors[between.base][channel]) +
                                                              s * float(points.colors[between.other][channel])));
}

/// Makes room behind the points; what is not placed is as at the base.
void extend(Points& points, const std::vector<std::uint32_t>& bases) {
    const auto append = [&](auto& values) {
        if (values.empty()) return;
        values.reserve(values.size() + bases.size());
        for (const std::uint32_t base : bases) values.push_back(values[base]);
    };
    append(points.positions);
    append(points.normals);
    append(points.colors);
    append(points.sensor_of_point);
    append(points.radii);
    append(points.noise);
    append(points.input_index);
}

std::vector<std::uint32_t> basesOf(const std::vector<std::uint32_t>& first) {
    std::vector<std::uint32_t> bases(first.back());
    tbb::parallel_for(std::size_t(0), first.size() - 1, [&](std::size_t i) {
        std::fill(bases.begin() + first[i], bases.begin() + first[i + 1], std::uint32_t(i));
    });
    return bases;
}

void placeAll(Points& points, const std::vector<Gaps>& gaps, const std::vector<std::uint32_t>& first,
              std::uint32_t most_rows) {
    tbb::parallel_for(std::size_t(0), gaps.size(), [&](std::size_t i) {
        std::size_t at = gaps.size() + first[i];
        for (const Gap& gap : gaps[i]) {
            const std::uint32_t rows = std::min(gap.rows, most_rows);
            for (std::uint32_t row = 1; row <= rows; ++row)
                place(points, at++, {i, gap.facing.point, gap.facing.across, float(row) / float(2 * rows + 1)});
        }
    });
}

FillCounts countGaps(const std::vector<Gaps>& gaps) {
    FillCounts counts{};
    for (const Gaps& sides : gaps) {
        counts[0] += sides[0].rows + sides[1].rows > 0;
        for (std::uint32_t rows = 1; rows <= kMostRows; ++rows)
            counts[rows] += std::min(sides[0].rows, rows) + std::min(sides[1].rows, rows);
    }
    return counts;
}

} // namespace

std::uint32_t rowsToFill(const FillCounts& counts, std::size_t points) {
    if (counts[0] == 0 || double(counts[0]) < kLeastShare * double(points)) return 0;
    std::uint32_t rows = kMostRows;
    while (rows > 1 && double(counts[rows]) > kMostFilling * double(points)) --rows;
    return rows;
}

std::vector<std::uint32_t> fillBetweenLines(Points& points, NeighborLists& lists, std::optional<NearestSearch>& search,
                                            const std::vector<float>& sheets, std::optional<std::uint32_t> rows,
                                            FillCounts& counts, const StageShare& share) {
    if (rows == 0u) return {};
    const std::vector<Gaps> gaps = findGaps({points, lists, *search}, sheets, share);
    counts = countGaps(gaps);
    const std::uint32_t most_rows = rows.value_or(rowsToFill(counts, points.size()));
    if (most_rows == 0 || counts[0] == 0) return {};
    const std::vector<std::uint32_t> first = countFilling(gaps, most_rows);

    std::vector<std::uint32_t> bases = basesOf(first);
    extend(points, bases);
    placeAll(points, gaps, first, most_rows);
    search.emplace(points.positions);
    lists = findNeighbors(points, *search, lists.k, {share.progress, share.stage, share.to, share.to});
    return bases;
}

} // namespace pointrt::surface
