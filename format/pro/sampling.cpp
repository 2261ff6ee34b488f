// SPDX-License-Identifier: Apache-2.0
#include "format/pro/sampling.h"

#include <algorithm>

namespace pointrt::format {

float medianNoise(const pro_info& info, const Content& content) {
    const std::uint8_t* noise = content.sampling.noise;
    if (!noise || !content.view.splats || info.splat_count == 0) return 0;
    std::vector<float> sigmas(info.splat_count);
    for (std::size_t i = 0; i < sigmas.size(); ++i) {
        pro_splat splat;
        pro_splat_decode(content.view.splats + i * PRO_SPLAT_WORDS, info.radius_max, info.radius_step, &splat);
        sigmas[i] = static_cast<float>(noise[i]) / PRO_NOISE_STEPS * splat.radius;
    }
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::nth_element(sigmas.begin(), middle, sigmas.end());
    return static_cast<float>(double{*middle} * info.scale);
}

} // namespace pointrt::format
