// SPDX-License-Identifier: Apache-2.0
// The programs for ray casts, specialised by the traits of instances.
#pragma once

#include <compare>
#include <map>
#include <mutex>

#include "runtime/gpu/program.h"
#include "runtime/render/instance_traits.h"

namespace pointrt {

/// The layout of a program's rays: packed by the host (shaders/cast/packed_rays.glsl), or the caller's
/// (given_rays.glsl) where takesGiven allows it (runtime/cast/given_rays.h).
enum class RayForm { kPacked, kFloats, kDoubles };

/// The traits that a pair of programs is specialised for.
struct CastKind {
    InstanceTraits traits;
    RayForm form = RayForm::kPacked;
    auto operator<=>(const CastKind&) const = default;
};

/// The programs for first hits and for occlusion, which declare the same bindings.
struct CastPair {
    Program first_hit, any_hit;
};

/// Builds each pair on first use and keeps it. Thread-safe.
class CastPrograms {
public:
    explicit CastPrograms(Device& device) : device_(device) {}
    ~CastPrograms();
    CastPrograms(const CastPrograms&) = delete;
    CastPrograms& operator=(const CastPrograms&) = delete;

    /// Throws Error kCannotRun if the driver cannot build a program.
    const CastPair& of(const CastKind& kind);

private:
    Device& device_;
    std::mutex mutex_;
    std::map<CastKind, CastPair> pairs_;
};

} // namespace pointrt
