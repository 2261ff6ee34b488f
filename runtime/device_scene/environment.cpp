// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "shaders/shared/luminance.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kMaxTexels = 4096; // per side: 256 MiB of RGBA32F at 4096 x 4096
constexpr std::uint32_t kMaxColumns = 512, kMaxRows = 256;

/// A row-major grid with `parts` interleaved channels.
struct Grid {
    std::uint32_t width = 0, height = 0, parts = 1;
    std::vector<float> values;
};

/// Resamples `from` groups of `group` numbers each to `to` groups, with a box filter.
void averageGroups(const float* source, std::uint32_t from, float* target, std::uint32_t to, std::size_t group) {
    const double step = static_cast<double>(from) / to;
    std::vector<double> sums(group);
    for (std::uint32_t i = 0; i < to; ++i, target += group) {
        const double begin = i * step, end = std::min((i + 1) * step, static_cast<double>(from));
        std::fill(sums.begin(), sums.end(), 0.0);
        for (auto j = static_cast<std::uint32_t>(begin); j < end; ++j) {
            const double share = (std::min(end, j + 1.0) - std::max(begin, static_cast<double>(j))) / (end - begin);
            const float* values = source + j * group;
            for (std::size_t k = 0; k < group; ++k) sums[k] += share * values[k];
        }
        for (std::size_t k = 0; k < group; ++k) target[k] = static_cast<float>(sums[k]);
    }
}

Grid averageColumns(const Grid& grid, std::uint32_t width) {
    const std::size_t from = std::size_t{grid.width} * grid.parts, to = std::size_t{width} * grid.parts;
    Grid result{width, grid.height, grid.parts, std::vector<float>(to * grid.height)};
    for (std::size_t y = 0; y < grid.height; ++y)
        averageGroups(&grid.values[y * from], grid.width, &result.values[y * to], width, grid.parts);
    return result;
}

Grid averageRows(const Grid& grid, std::uint32_t height) {
    const std::size_t row = std::size_t{grid.width} * grid.parts;
    Grid result{grid.width, height, grid.parts, std::vector<float>(row * height)};
    averageGroups(grid.values.data(), grid.height, result.values.data(), height, row);
    return result;
}

/// Downsamples to at most max_width x max_height cells with a box filter.
Grid averageTo(Grid grid, std::uint32_t max_width, std::uint32_t max_height) {
    if (grid.width > max_width) grid = averageColumns(grid, max_width);
    if (grid.height > max_height) grid = averageRows(grid, max_height);
    return grid;
}

/// The solid angle of a band of rows, over pi.
double bandShare(std::size_t y, std::uint32_t height) {
    const double step = std::numbers::pi / height;
    return std::cos(static_cast<double>(y) * step) - std::cos(static_cast<double>(y + 1) * step);
}

/// Light of a row of texels, over pi: the integral of sin(theta) times the row's weight in bilinear interpolation,
/// which rises from the row above, falls to the row below and stays 1 up to the poles.
double rowShare(std::size_t y, std::uint32_t height) {
    const double step = std::numbers::pi / height, centre = (static_cast<double>(y) + 0.5) * step;
    const double above = centre - step, below = centre + step;
    const double rise = y == 0 ? 1 - std::cos(centre) : (std::sin(centre) - std::sin(above)) / step - std::cos(centre);
    const double fall =
        y + 1 == height ? std::cos(centre) + 1 : std::cos(centre) - (std::sin(below) - std::sin(centre)) / step;
    return rise + fall;
}

double luminanceOf(const float* rgb) { return luminance<double>(rgb[0], rgb[1], rgb[2]); }

/// Luminance averaged over each texel as bilinear interpolation fills it, times the solid angle. Along each axis the
/// texel itself has the weight 3/4, its two neighbours 1/8 each.
Grid lightOfTexels(const Grid& map) {
    const std::size_t width = map.width, height = map.height;
    Grid luminance{map.width, map.height, 1, std::vector<float>(width * height)};
    Grid light = luminance;
    for (std::size_t i = 0; i < width * height; ++i)
        luminance.values[i] = static_cast<float>(luminanceOf(&map.values[3 * i]));
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            double sum = 0;
            for (int dy = -1; dy <= 1; ++dy) {
                const std::size_t row = dy < 0 ? y - (y > 0) : std::min(y + static_cast<std::size_t>(dy), height - 1);
                const float* line = &luminance.values[row * width];
                const double average =
                    0.75 * line[x] + 0.125 * (line[x == 0 ? width - 1 : x - 1] + line[x + 1 == width ? 0 : x + 1]);
                sum += average * (dy == 0 ? 0.75 : 0.125);
            }
            light.values[y * width + x] = static_cast<float>(sum * bandShare(y, map.height));
        }
    return light;
}

/// Appends the cumulative distribution of the weights, from 0 to 1; a uniform one if all are 0.
double appendCdf(std::vector<float>& cdf, const std::vector<double>& weights) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    double sum = 0;
    cdf.push_back(0);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += total > 0 ? weights[i] / total : 1.0 / static_cast<double>(weights.size());
        cdf.push_back(std::min(static_cast<float>(sum), 1.0f));
    }
    // rounding must not leave a gap before 1; dark cells at the end keep density 0
    const float top = cdf.back();
    for (auto last = cdf.rbegin(); last != cdf.rend() && *last == top; ++last) *last = 1;
    return total;
}

void fillCdf(Environment& environment, const Grid& light) {
    std::vector<double> row_weights(light.height), weights(light.width);
    std::vector<float> columns;
    for (std::size_t y = 0; y < light.height; ++y) {
        const float* row = &light.values[y * light.width];
        std::copy(row, row + light.width, weights.begin());
        row_weights[y] = appendCdf(columns, weights);
    }
    if (std::accumulate(row_weights.begin(), row_weights.end(), 0.0) == 0)
        for (std::size_t y = 0; y < light.height; ++y) row_weights[y] = bandShare(y, light.height);
    appendCdf(environment.cdf, row_weights);
    environment.cdf.insert(environment.cdf.end(), columns.begin(), columns.end());
}

void fillTexels(Environment& environment, const Grid& map) {
    const std::size_t count = std::size_t{map.width} * map.height;
    environment.texels.resize(4 * count, 1.0f);
    for (std::size_t i = 0; i < count; ++i) {
        const double share = rowShare(i / map.width, map.height) / (2.0 * map.width);
        for (std::size_t c = 0; c < 3; ++c) {
            environment.texels[4 * i + c] = map.values[3 * i + c];
            environment.mean_radiance[c] += share * map.values[3 * i + c];
        }
    }
}

gpu::vec4 packRow(Vec3 row, float w) {
    return {static_cast<float>(row.x), static_cast<float>(row.y), static_cast<float>(row.z), w};
}

} // namespace

Environment makeEnvironment(FloatImage image) {
    if (image.width == 0 || image.height == 0) throw std::logic_error("makeEnvironment: the image is empty");
    const Grid map = averageTo({image.width, image.height, 3, std::move(image.rgb)}, kMaxTexels, kMaxTexels);
    const Grid light = averageTo(lightOfTexels(map), kMaxColumns, kMaxRows);
    Environment environment{map.width, map.height, light.width, light.height, {}, {}, {}};
    fillTexels(environment, map);
    fillCdf(environment, light);
    return environment;
}

gpu::EnvironmentFrame environmentFrame(const Environment& environment, const std::array<Vec3, 3>& map_from_world,
                                       float strength) {
    return {{environment.width, environment.height, environment.columns, environment.rows},
            packRow(map_from_world[0], strength),
            packRow(map_from_world[1], 0),
            packRow(map_from_world[2], 0)};
}

std::array<Vec3, 3> mapFromWorld(Vec3 up, double rotation_deg) {
    // the horizontal direction of the middle column without rotation: -z, or +y if up is closer to z
    const Vec3 reference = std::abs(up.z) > std::abs(up.y) ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
    const Vec3 ahead = normalize(reference - dot(reference, up) * up), right = cross(ahead, up);
    const double angle = rotation_deg * std::numbers::pi / 180;
    const Vec3 turned_ahead = std::cos(angle) * ahead - std::sin(angle) * right;
    return {cross(turned_ahead, up), up, -1.0 * turned_ahead};
}

} // namespace pointrt
