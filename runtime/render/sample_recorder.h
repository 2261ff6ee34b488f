// SPDX-License-Identifier: Apache-2.0
// The dispatches of a sample, in order.
#pragma once

#include <cstdint>

#include "runtime/render/band_tracer.h"
#include "runtime/render/pass_commands.h"

namespace pointrt {

/// Records what traces sample's band, pass by pass.
class SampleRecorder {
public:
    SampleRecorder(PassCommands& commands, const BandTracer& tracer, const BandSample& sample);

    /// Depth, normal and ids of the rays through pixel centres.
    void firstHits();
    /// Camera rays up to where they ask for light.
    void begin();
    /// Pass index, 1 or more: the rays that the pass before has queued.
    void pass(std::uint32_t index);

private:
    void shade(const Program& program, std::uint32_t bits);
    void follow(const Program& program, std::uint32_t bits);
    void askInstances(std::uint32_t bits);
    void primary(std::uint32_t bits);
    void shadows(std::uint32_t first, std::uint32_t bits);
    void askForShadows(std::uint32_t bits);
    void shadowLight(std::uint32_t bits);
    void light(std::uint32_t bits);
    void surface(const Program& program, const DescriptorSets& sets, std::uint32_t bits);
    void prepare(std::uint32_t bits);
    void prepareList(std::uint32_t list, std::uint32_t bits);
    void askAll(std::uint32_t list, Program SievePrograms::*sift, std::uint32_t bits, const AskTarget& ask);
    void runOver(std::uint32_t list, const Program& program, const DescriptorSets& sets, std::uint32_t bits);
    void run(const Program& program, const DescriptorSets& sets, std::uint32_t bits, PassLanes lanes,
             std::uint32_t groups = 0);
    gpu::PushParams pushed(std::uint32_t bits, std::uint32_t list = 0) const;

    PassCommands& commands_;
    const BandTracer& tracer_;
    std::uint32_t tiles_, sample_, center_, preview_, places_;
    bool keeps_hits_;                     ///< of the rays that are shaded
    std::uint32_t first_turn_ = 0;        ///< of those that shadows asks
    PassLanes rays_ = PassLanes::kPixels; ///< those under way
};

} // namespace pointrt
