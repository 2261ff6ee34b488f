// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/cast_programs.h"

#include <span>
#include <vector>

#include "shaders/cast.spv.h"
#include "shaders/cast_gaussians.spv.h"
#include "shaders/cast_gaussians_given.spv.h"
#include "shaders/cast_gaussians_paged.spv.h"
#include "shaders/cast_given.spv.h"
#include "shaders/cast_paged.spv.h"
#include "shaders/occlude.spv.h"
#include "shaders/occlude_gaussians.spv.h"
#include "shaders/occlude_gaussians_given.spv.h"
#include "shaders/occlude_gaussians_paged.spv.h"
#include "shaders/occlude_given.spv.h"
#include "shaders/occlude_paged.spv.h"

namespace pointrt {
namespace {

using Words = std::span<const std::uint32_t>;

struct PairWords {
    Words first_hit, any_hit;
};

PairWords gaussianWordsOf(const CastKind& kind) {
    if (kind.form != RayForm::kPacked) return {cast_gaussians_given_spv, occlude_gaussians_given_spv};
    if (isPaged(kind.traits.pages)) return {cast_gaussians_paged_spv, occlude_gaussians_paged_spv};
    return {cast_gaussians_spv, occlude_gaussians_spv};
}

PairWords wordsOf(const CastKind& kind) {
    if (kind.traits.is_gaussian) return gaussianWordsOf(kind);
    if (kind.form != RayForm::kPacked) return {cast_given_spv, occlude_given_spv};
    if (isPaged(kind.traits.pages)) return {cast_paged_spv, occlude_paged_spv};
    return {cast_spv, occlude_spv};
}

void build(Device& device, const CastKind& kind, CastPair& pair) {
    std::vector<SpecConstant> constants = traitConstants(kind.traits);
    constants.push_back({SPEC_CAST_DOUBLES, kind.form == RayForm::kDoubles});
    const PairWords words = wordsOf(kind);
    pair.first_hit = createProgram(device, "cast", words.first_hit, constants);
    pair.any_hit = createProgram(device, "occlude", words.any_hit, constants);
}

} // namespace

CastPrograms::~CastPrograms() {
    for (auto& [kind, pair] : pairs_)
        for (Program* program : {&pair.first_hit, &pair.any_hit}) destroyProgram(device_, *program);
}

const CastPair& CastPrograms::of(const CastKind& kind) {
    const std::lock_guard lock(mutex_);
    const auto [pair, is_new] = pairs_.try_emplace(kind);
    if (!pair->second.any_hit.pipeline) build(device_, kind, pair->second);
    return pair->second;
}

} // namespace pointrt
