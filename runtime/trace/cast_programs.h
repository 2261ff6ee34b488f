// SPDX-License-Identifier: Apache-2.0
// The programs for batches of rays, built for what targets are like.
#pragma once

#include <map>
#include <mutex>

#include "runtime/gpu/program.h"
#include "runtime/tracer/instance_traits.h"

namespace pointrt {

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
    const CastPair& of(const InstanceTraits& traits);

private:
    Device& device_;
    std::mutex mutex_;
    std::map<InstanceTraits, CastPair> pairs_;
};

} // namespace pointrt
