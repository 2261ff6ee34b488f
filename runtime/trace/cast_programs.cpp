// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/cast_programs.h"

#include <span>
#include <vector>

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

CastPrograms::~CastPrograms() {
    for (auto& [traits, pair] : pairs_)
        for (Program* program : {&pair.first_hit, &pair.any_hit}) destroyProgram(device_, *program);
}

const CastPair& CastPrograms::of(const InstanceTraits& traits) {
    const std::lock_guard lock(mutex_);
    const auto [pair, is_new] = pairs_.try_emplace(traits);
    if (!pair->second.any_hit.pipeline) build(device_, traits, pair->second);
    return pair->second;
}

} // namespace pointrt
