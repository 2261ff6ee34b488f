// SPDX-License-Identifier: Apache-2.0
#include "format/pro/checks.h"
#include "format/pro/sampling.h"

namespace pointrt::format {

void checkSampling(const pro_info& info, const pro_sampling& sampling, Findings& findings) {
    const bool few = sampling.filled_count <= info.splat_count;
    if (!few || (sampling.filled_count > 0 && sampling.input_count == 0))
        findings.add(Finding::kFilledCount, "%u of %u splats fill gaps between %u input points", sampling.filled_count,
                     info.splat_count, sampling.input_count);
    constexpr float kMost = 1e30f; // bound on the cube's edge
    if (!(sampling.noise_median >= 0 && sampling.noise_median <= kMost))
        findings.add(Finding::kNoiseMedian, "noise of %g input units is not in [0, 1e30]",
                     double{sampling.noise_median});
}

void checkSamplingSections(const pro_info& info, const Content& content, Findings& findings) {
    const pro_sampling& sampling = content.sampling;
    const float median = medianNoise(info, content);
    if (median != sampling.noise_median)
        findings.add(Finding::kNoiseValues, "noise of %g input units, but the median of NOIS is %g",
                     double{sampling.noise_median}, double{median});
    if (sampling.input_count == 0) return;
    std::uint32_t above = 0;
    for (std::size_t i = 0; i < info.splat_count && content.view.order; ++i)
        above += content.view.order[i] >= sampling.input_count;
    if (above != sampling.filled_count)
        findings.add(Finding::kFilledOrder, "%u splats fill gaps; the header says %u", above, sampling.filled_count);
}

} // namespace pointrt::format
