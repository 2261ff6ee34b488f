// SPDX-License-Identifier: Apache-2.0
// The programs for batches of rays, built for what targets are like.
#pragma once

#include <compare>
#include <map>
#include <mutex>

#include "runtime/gpu/program.h"
#include "runtime/render/instance_traits.h"

namespace pointrt {

/// How rays come to a program: packed by the host (shaders/cast/packed_rays.glsl), or as callers have them
/// (given_rays.glsl), for what takesGiven tells (runtime/cast/given_rays.h).
enum class RayForm { kPacked, kFloats, kDoubles };

/// What a pair of programs is built for.
struct CastKind {
    InstanceTraits traits;
    RayForm form = RayForm::kPacked;
    auto operator<=>(const CastKind&) const = default;
};

/// Both declare the same bindings.
struct CastPair {
    Program first_hit, any_hit;
};

/// Each pair is built when it is first asked for, and stays. From several threads.
class CastPrograms {
public:
    explicit CastPrograms(Device& device) : device_(device) {}
    ~CastPrograms();
    CastPrograms(const CastPrograms&) = delete;
    CastPrograms& operator=(const CastPrograms&) = delete;

    /// Throws Error kCannotRun where the driver refuses one.
    const CastPair& of(const CastKind& kind);

private:
    Device& device_;
    std::mutex mutex_;
    std::map<CastKind, CastPair> pairs_;
};

} // namespace pointrt
