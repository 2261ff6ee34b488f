// SPDX-License-Identifier: Apache-2.0
// The instances of a scene with the programs and descriptor sets that intersect them, and the passes that intersect a
// list of rays with all instances.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/render/pass_commands.h"
#include "runtime/render/programs.h"

namespace pointrt {

/// An instance, or the tiles in a block, with their programs and descriptor sets.
struct TracedInstance {
    const InstancePrograms* programs = nullptr;
    DescriptorSets sets;
    std::vector<std::size_t> places; ///< indices of the instances among the scene's
    std::uint32_t beams = 1;         ///< per tile of pixels
    bool is_gaussian = false;
};

/// Consecutive instances for which rays are culled together.
struct CullGroup {
    std::size_t first = 0, count = 0; ///< in TracedInstances::each
    const CullPrograms* programs = nullptr;
    Buffer boxes; ///< gpu::CullBoxes
    DescriptorSets sets;
};

struct TracedInstances {
    VkDescriptorPool pool = VK_NULL_HANDLE;
    std::vector<TracedInstance> each;   ///< single instances in the order of the scene's, then tiles in blocks
    std::vector<CullGroup> cull_groups; ///< groups of all single instances; empty if each is intersected with all rays
    std::vector<Buffer> tables;         ///< for tiles in blocks: gpu::CullBoxes and gpu::PooledTile rows
    DescriptorSets sets;                ///< for programs that read no instance
};

/// programs, scene and the bound buffers must outlive the result. Free it with destroyTracedInstances.
TracedInstances bindTracedInstances(Device& device, const Programs& programs, const DeviceScene& scene,
                                    const FrameBuffers& buffers, const CausticMap& caustics);
/// Leaves instances empty. They may be empty already.
void destroyTracedInstances(Device& device, TracedInstances& instances);

/// A list of rays to intersect with all instances.
struct InstanceRayList {
    std::uint32_t list = 0;                ///< LIST_*: the list
    Program CullPrograms::*cull = nullptr; ///< the program that culls it
    gpu::PushParams push{};                ///< push constants of its passes
};
/// Records the passes that intersect an instance with a list: the given list, or what culling left of it.
using IntersectInstance = std::function<void(const TracedInstance& instance, std::uint32_t list)>;

/// Records the intersection of a list with all instances except Gaussians, preceded for each cull group by the culling.
/// The list must be complete (closed by prepare).
void intersectInstances(PassCommands& commands, const Programs& programs, const TracedInstances& instances,
                        const InstanceRayList& rays, const IntersectInstance& intersect);

} // namespace pointrt
