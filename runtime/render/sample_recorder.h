// SPDX-License-Identifier: Apache-2.0
// The dispatches of a sample, in order.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/render/band_tracer.h"
#include "runtime/render/pass_commands.h"

namespace pointrt {

/// Records the dispatches that trace a sample of a band, pass by pass.
class SampleRecorder {
public:
    SampleRecorder(PassCommands& commands, const BandTracer& tracer, const BandSample& sample);

    /// First hits of the rays through pixel centres: depth, normal and ids.
    void firstHits();
    /// The camera pass: camera rays, their shading and direct light.
    void begin();
    /// Pass index, from 1 on: traces the rays that the previous pass queued.
    void pass(std::uint32_t index);

private:
    void intersectCamera(std::uint32_t bits);
    void intersectClosest(std::uint32_t bits);
    /// The programs that composite Gaussians: those of a single instance, or those for several instances together.
    struct GaussianPass {
        Program InstancePrograms::*composite;
        Program InstancePrograms::*gather;
        const Program& blend;
        std::uint32_t bits = 0; ///< bits for the program gather
    };
    void gaussianFirstHits(std::uint32_t bits);
    void compositeCamera(std::uint32_t bits);
    void compositeQueued(std::uint32_t bits);
    void compositeGaussians(const GaussianPass& pass, std::uint32_t bits);
    void runRound(const Program& program, const DescriptorSets& sets, std::uint32_t round, std::uint32_t bits);
    std::uint32_t roundsOf(const GaussianPass& pass) const;
    void compositeRound(const GaussianPass& pass, std::uint32_t round, std::uint32_t bits);
    void gatherRound(const GaussianPass& pass, std::uint32_t round, std::uint32_t bits);
    void catchShadows(const Program& query, std::uint32_t bits);
    void attenuateShadows(std::uint32_t list, Program InstancePrograms::*program, std::uint32_t bits);
    void shadeSurface(const Program& program, std::uint32_t bits);
    void megakernel(const Program& program, std::uint32_t bits);
    void directLight(std::uint32_t bits);
    enum class Attenuation { kNone, kByGaussians }; ///< of shadow rays
    void shadows(std::uint32_t first, std::uint32_t bits, Attenuation attenuation);
    void intersectShadow(std::uint32_t bits, Attenuation attenuation);
    void intersectShadowRay(std::uint32_t bits);
    void prepare(std::uint32_t bits);
    void closeList(std::uint32_t list, std::uint32_t bits);
    void intersectAll(std::uint32_t list, Program CullPrograms::*cull, std::uint32_t bits,
                      const IntersectInstance& intersect);
    void runOver(std::uint32_t list, const Program& program, const DescriptorSets& sets, std::uint32_t bits);
    void run(const Program& program, const DescriptorSets& sets, std::uint32_t bits, PassLanes lanes,
             std::uint32_t groups = 0);
    gpu::PushParams pushed(std::uint32_t bits, std::uint32_t list = 0) const;

    PassCommands& commands_;
    const BandTracer& tracer_;
    std::uint32_t tiles_, sample_, center_, preview_, pixel_list_;
    bool has_gaussians_;
    std::vector<const TracedInstance*> gaussians_; ///< instances of Gaussians, those near the eye first
    bool stores_first_hits_;                       ///< whether the camera rays that are shaded store them
    std::uint32_t first_light_sample_ = 0;         ///< of the shadow pass
    PassLanes rays_ = PassLanes::kPixels;          ///< the rays of the current pass
};

} // namespace pointrt
