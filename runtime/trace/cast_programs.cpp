// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/cast_programs.h"

#include <span>
#include <vector>

#include "runtime/util/on_error.h"
#include "shaders/cast.spv.h"
#include "shaders/cast_paged.spv.h"
#include "shaders/occlude.spv.h"
#include "shaders/occlude_paged.spv.h"

namespace pointrt {
namespace {

void build(Device& device, const InstanceTraits& traits, CastPair& pair) {
    using Words = std::span<const std::uint32_t>;
    const std::vector<SpecConstant> constants = traitConstants(traits);
    const bool paged = isPaged(traits.pages);
    pair.first_hit = createProgram(device, "cast", paged ? Words(cast_paged_spv) : Words(cast_spv), constants);
    pair.any_hit = createProgram(device, "occlude", paged ? Words(occlude_paged_spv) : Words(occlude_spv), constants);
}

} // namespace

CastPrograms createCastPrograms(Device& device, const DeviceScene& scene) {
    CastPrograms programs;
    const OnError undo([&] { destroyCastPrograms(device, programs); });
    for (const Instance& instance : scene.instances) {
        const auto [variant, is_new] = programs.try_emplace(traitsOf(scene, instance));
        if (is_new) build(device, variant->first, variant->second);
    }
    return programs;
}

void destroyCastPrograms(Device& device, CastPrograms& programs) {
    for (auto& [traits, pair] : programs)
        for (Program* program : {&pair.first_hit, &pair.any_hit}) destroyProgram(device, *program);
    programs.clear();
}

} // namespace pointrt
