// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/classify.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "format/base/error.h"

namespace pointrt::quality {

namespace {

/// Slope between two pixels that counts as a depth jump: that of a surface at 79 degrees to the view.
constexpr float kSteepest = 5;

std::size_t at(int row, int column) {
    return static_cast<std::size_t>(row) * kViewSize + static_cast<std::size_t>(column);
}

/// Calls visit with the (up to) four adjacent pixels.
template <typename Visit>
void forNext(int row, int column, Visit&& visit) {
    if (row > 0) visit(at(row - 1, column));
    if (column > 0) visit(at(row, column - 1));
    if (row + 1 < kViewSize) visit(at(row + 1, column));
    if (column + 1 < kViewSize) visit(at(row, column + 1));
}

/// Pixels without mesh, or beside a depth jump.
std::vector<std::uint8_t> flagContours(const View& view) {
    std::vector<std::uint8_t> contour(view.size());
    for (int row = 0; row < kViewSize; ++row)
        for (int column = 0; column < kViewSize; ++column) {
            const float t = view[at(row, column)].mesh_t;
            std::uint8_t& flag = contour[at(row, column)];
            flag = !std::isfinite(t);
            forNext(row, column,
                    [&](std::size_t next) { flag = flag || !(std::abs(view[next].mesh_t - t) <= kSteepest * kPixel); });
        }
    return contour;
}

/// Flags all pixels within kInsidePixels, along rows (step 1) or columns (step kViewSize).
std::vector<std::uint8_t> widen(const std::vector<std::uint8_t>& flags, bool along_rows) {
    std::vector<std::uint8_t> wide(flags.size());
    for (int row = 0; row < kViewSize; ++row)
        for (int column = 0; column < kViewSize; ++column) {
            const int place = along_rows ? column : row;
            const int first = std::max(0, place - kInsidePixels), last = std::min(kViewSize - 1, place + kInsidePixels);
            std::uint8_t& flag = wide[at(row, column)];
            for (int i = first; i <= last && !flag; ++i) flag = flags[along_rows ? at(row, i) : at(i, column)];
        }
    return wide;
}

bool onSilhouette(const View& view, int row, int column) {
    bool silhouette = false;
    forNext(row, column, [&](std::size_t next) { silhouette = silhouette || !std::isfinite(view[next].mesh_t); });
    return silhouette;
}

PixelClass classify(const PixelHits& pixel, bool inside, float median_radius) {
    const bool mesh = std::isfinite(pixel.mesh_t), splat = std::isfinite(pixel.splat_t);
    if (!mesh && !splat) return PixelClass::kEmpty;
    if (splat && pixel.splat_distance > median_radius) return PixelClass::kBridge;
    if (inside && !((pixel.splat_t - pixel.mesh_t) * pixel.mesh_cos <= median_radius)) return PixelClass::kHole;
    if (!splat) return PixelClass::kMissing;
    return mesh ? PixelClass::kMatch : PixelClass::kExcess;
}

void count(const PixelHits& pixel, PixelClass kind, bool inside, float median_radius, ViewErrors& errors) {
    const bool mesh = std::isfinite(pixel.mesh_t), splat = std::isfinite(pixel.splat_t);
    errors.mesh_pixels += mesh;
    errors.splat_pixels += splat;
    errors.inside_pixels += inside;
    errors.excess += splat && !mesh;
    errors.missing += kind == PixelClass::kMissing;
    errors.holes += kind == PixelClass::kHole;
    errors.bridges += kind == PixelClass::kBridge;
    if (splat) errors.surface_distance.push_back(pixel.splat_distance / median_radius);
    if (inside && splat && kind != PixelClass::kHole)
        errors.inside_depth.push_back(std::abs(pixel.splat_t - pixel.mesh_t) / median_radius);
}

} // namespace

std::vector<PixelClass> classifyView(const View& view, float median_radius, ViewErrors& errors) {
    const std::vector<std::uint8_t> near_contour = widen(widen(flagContours(view), true), false);
    std::vector<PixelClass> classes(view.size());
    for (int row = 0; row < kViewSize; ++row)
        for (int column = 0; column < kViewSize; ++column) {
            const std::size_t i = at(row, column);
            const bool inside = !near_contour[i];
            classes[i] = classify(view[i], inside, median_radius);
            count(view[i], classes[i], inside, median_radius, errors);
            errors.silhouette_pixels += std::isfinite(view[i].mesh_t) && onSilhouette(view, row, column);
        }
    return classes;
}

void writeClasses(const std::string& path, const std::vector<PixelClass>& classes) {
    static constexpr char kColors[6][3] = {{'\0', '\0', '\0'},     {'\x60', '\x60', '\x60'}, {'\x20', '\x60', '\xff'},
                                           {'\xff', '\xe0', '\0'}, {'\xff', '\0', '\0'},     {'\xff', '\0', '\xff'}};
    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << kViewSize << ' ' << kViewSize << "\n255\n";
    for (const PixelClass kind : classes) file.write(kColors[static_cast<std::size_t>(kind)], 3);
    if (!file.flush()) throw Error(ExitCode::kCannotWrite, path + ": cannot be written");
}

} // namespace pointrt::quality
