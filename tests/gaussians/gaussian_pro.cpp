// SPDX-License-Identifier: Apache-2.0
#include "tests/gaussians/gaussian_pro.h"

#include <memory>
#include <stdexcept>

#include "pointrt/pro.h"

namespace pointrt::test {

namespace {

/// The largest code of a harmonic.
constexpr double kHarmonicCodes = 127;

using ProFile = std::unique_ptr<pro_file, decltype(&pro_close)>;

ProFile openPro(const std::string& path) {
    pro_file* file = nullptr;
    pro_message message;
    if (pro_open(path.c_str(), 0, &file, &message) != PRO_OK) throw std::runtime_error(path + ": " + message.text);
    return {file, pro_close};
}

std::size_t degreeOf(std::size_t coefficient) { return coefficient < 3 ? 1 : coefficient < 8 ? 2 : 3; }

std::vector<Double3> harmonicsOf(const pro_gaussians& all, std::size_t index) {
    const std::size_t count = (all.degree + 1) * (all.degree + 1) - 1;
    std::vector<Double3> harmonics(count);
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t c = 0; c < 3; ++c)
            harmonics[k][c] =
                all.harmonics[3 * (count * index + k) + c] / kHarmonicCodes * double{all.harmonic_max[degreeOf(k) - 1]};
    return harmonics;
}

/// Converts cube units to input units.
OracleGaussian placed(const pro_gaussian& gaussian, const pro_info& info) {
    OracleGaussian result;
    for (std::size_t k = 0; k < 3; ++k) {
        result.mean[k] = info.origin[k] + info.scale * gaussian.mean[k];
        result.deviation[k] = info.scale * double{gaussian.deviation[k]};
        result.color[k] = gaussian.color[k];
    }
    for (std::size_t k = 0; k < 4; ++k) result.rotation[k] = gaussian.rotation[k];
    result.opacity = gaussian.opacity;
    return result;
}

} // namespace

std::vector<OracleGaussian> readGaussianPro(const std::string& path) {
    const ProFile file = openPro(path);
    pro_info info;
    pro_view view;
    pro_gaussians all;
    pro_get_info(file.get(), &info);
    pro_get_view(file.get(), &view);
    if (!pro_get_gaussians(file.get(), &all)) throw std::runtime_error(path + ": has no Gaussians");
    std::vector<OracleGaussian> gaussians(info.splat_count);
    for (std::size_t k = 0; k < gaussians.size(); ++k) {
        pro_gaussian decoded;
        pro_gaussian_at(&all, view.splats, static_cast<std::uint32_t>(k), &decoded);
        gaussians[k] = placed(decoded, info);
        gaussians[k].harmonics = harmonicsOf(all, k);
    }
    return gaussians;
}

} // namespace pointrt::test
