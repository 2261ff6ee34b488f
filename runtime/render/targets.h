// SPDX-License-Identifier: Apache-2.0
// The instances of a scene as rays are traced through them, each a target of its own, and how a list of rays asks all.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/render/pass_commands.h"
#include "runtime/render/programs.h"

namespace pointrt {

/// An instance with what it is traced by.
struct TracerTarget {
    const InstancePrograms* programs = nullptr;
    DescriptorSets sets;
};

/// Some of the targets, one behind the other, that rays are sifted for.
struct TargetSieve {
    std::size_t first = 0, count = 0;
    const SievePrograms* programs = nullptr;
    Buffer boxes; ///< gpu::Sieve
    DescriptorSets sets;
};

struct Targets {
    VkDescriptorPool pool = VK_NULL_HANDLE;
    std::vector<TracerTarget> each;  ///< in the order of the scene's instances
    std::vector<TargetSieve> sieves; ///< of all targets, or none: each is asked for all rays
    DescriptorSets sets;             ///< for what looks at no instance
};

/// programs, scene and what is bound must outlive what is returned: give it to destroyTargets.
Targets bindTargets(Device& device, const Programs& programs, const DeviceScene& scene, const FrameBuffers& buffers,
                    const CausticMap& caustics);
/// Leaves it empty, which it may have been.
void destroyTargets(Device& device, Targets& targets);

/// A list of rays that all targets are to be asked for.
struct AskedList {
    std::uint32_t list = 0;                 ///< LIST_*
    Program SievePrograms::*sift = nullptr; ///< what sifts it
    gpu::PushParams push{};                 ///< of its passes
};
/// Runs what asks a target for the rays of a list: the one that was given, or what was sifted of it.
using AskTarget = std::function<void(const TracerTarget& target, std::uint32_t list)>;

/// Records what asks all targets, and before that where there are sieves what sifts the list for them. The list must be
/// complete: prepare has taken it.
void askTargets(PassCommands& commands, const Programs& programs, const Targets& targets, const AskedList& asked,
                const AskTarget& ask);

} // namespace pointrt
