// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/instance_traits.h"

namespace pointrt {

InstanceTraits traitsOf(const DeviceScan& file, bool oriented, bool is_tile, bool clipped) {
    const bool has_balls = (file.info.flags & PRO_FLAG_BALLS) != 0;
    return {file.index.uneven != 0,
            oriented,
            file.noisy,
            is_tile,
            clipped,
            has_balls,
            file.is_gaussian,
            file.reads_storage,
            file.queries_rays,
            0,
            file.harmonics_degree,
            isPaged(file.pages) ? file.pages : PageCounts{}};
}

InstanceTraits traitsOf(const DeviceScene& scene, const Instance& instance) {
    return traitsOf(scene.files[instance.file], instance.oriented, instance.tile.has_value(),
                    (scene.features & FEATURE_CLIPS) != 0);
}

std::vector<SpecConstant> traitConstants(const InstanceTraits& traits) {
    std::vector<SpecConstant> values{{SPEC_UNEVEN, traits.uneven},       {SPEC_ORIENTED, traits.oriented},
                                     {SPEC_NOISY, traits.noisy},         {SPEC_CLIPS_TO_CORE, traits.clips_to_core},
                                     {SPEC_HAS_BALLS, traits.has_balls}, {SPEC_HARMONICS, traits.harmonics},
                                     {SPEC_CLIPPED, traits.clipped},     {SPEC_READS_STORAGE, traits.reads_storage}};
    if (!isPaged(traits.pages)) return values;
    for (const SpecConstant& each : pageConstants(traits.pages)) values.push_back(each);
    return values;
}

} // namespace pointrt
