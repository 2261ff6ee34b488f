// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_gaussians.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "format/info/gaussian_values.h"
#include "format/pointio/point_file.h"

namespace pointrt {
namespace {

constexpr std::size_t kGaussiansAtOnce = 16384; // takes some MiB for properties

/// Logits of 0 and 1 are infinite, so opacities stay a quarter of a step away from them, which is coded as 0 and 1
/// again.
constexpr double kLeastOpacity = 0.25 / double{PRO_OPACITY_STEPS};

std::string gaussianHeader(std::uint64_t count, std::uint32_t rest) {
    std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) + "\n";
    const auto property = [&](const std::string& name) { text += "property float " + name + "\n"; };
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"}) property(name);
    for (std::uint32_t k = 0; k < rest; ++k) property("f_rest_" + std::to_string(k));
    for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
        property(name);
    return text + "end_header\n";
}

float logitOf(float opacity) {
    const double clamped = std::clamp(double{opacity}, kLeastOpacity, 1 - kLeastOpacity);
    return static_cast<float>(std::log(clamped / (1 - clamped)));
}

/// All coefficients of red, then of green, then of blue; 0 beyond the degree of the file.
void appendHarmonics(const ProFile& file, std::size_t index, std::uint32_t degree, std::vector<float>& row) {
    const auto codes = file.harmonics(index);
    const std::uint32_t count = pro_harmonic_count(degree);
    for (std::uint32_t color = 0; color < 3; ++color)
        for (std::uint32_t k = 0; k < count; ++k)
            row.push_back(3 * k < codes.size() ? harmonicValue(file, codes[3 * k + color], k) : 0.0f);
}

void appendGaussian(const ProFile& file, std::size_t index, std::uint32_t degree, std::vector<float>& row) {
    const pro_gaussian gaussian = file.gaussian(index);
    for (int axis = 0; axis < 3; ++axis) row.push_back(static_cast<float>(inputCoordinate(file, gaussian, axis)));
    row.insert(row.end(), 3, 0.0f);
    for (const float color : gaussian.color) row.push_back(static_cast<float>(constantHarmonic(color)));
    appendHarmonics(file, index, degree, row);
    row.push_back(logitOf(gaussian.opacity));
    for (const float deviation : gaussian.deviation)
        row.push_back(static_cast<float>(std::log(double{deviation} * file.info().scale)));
    row.insert(row.end(), std::begin(gaussian.rotation), std::end(gaussian.rotation));
}

} // namespace

void exportGaussians(const ExportSource& source, const std::string& path, bool overwrite) {
    const std::uint32_t degree = source.harmonics_degree;
    PointFile out(path, overwrite ? format::Existing::kReplaced : format::Existing::kKept);
    const std::string text = gaussianHeader(source.outline.count.value(), 3 * pro_harmonic_count(degree));
    out.append(text.data(), text.size());
    std::vector<float> rows;
    source.forEachPart([&](const ProFile& file, std::span<const std::uint32_t> splats) {
        for (std::size_t first = 0; first < splats.size(); first += kGaussiansAtOnce) {
            rows.clear();
            for (const std::uint32_t index : splats.subspan(first, std::min(kGaussiansAtOnce, splats.size() - first)))
                appendGaussian(file, index, degree, rows);
            out.append(rows.data(), rows.size() * sizeof(float));
        }
    });
    out.commit();
}

} // namespace pointrt
