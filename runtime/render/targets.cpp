// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/targets.h"

#include <algorithm>

#include "runtime/render/caustic_map.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/sieves.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

void runOver(PassCommands& commands, const Program& program, const DescriptorSets& sets, const AskedList& asked,
             std::uint32_t bits = 0) {
    gpu::PushParams push = asked.push;
    push.list = asked.list;
    push.step |= bits;
    if (bits != 0)
        commands.run({program, sets, pushBytes(push), PassLanes::kOne, 1});
    else
        commands.run({program, sets, pushBytes(push), PassLanes::kList, 0, asked.list});
}

} // namespace

Targets bindTargets(Device& device, const Programs& programs, const DeviceScene& scene, const FrameBuffers& buffers,
                    const CausticMap& caustics) {
    Targets targets;
    const OnError undo([&] { destroyTargets(device, targets); });
    const std::vector<InstanceSieve> sieves = makeSieves(scene);
    const std::size_t sets = 2 * (std::max<std::size_t>(scene.instances.size(), 1) + sieves.size());
    targets.pool = createDescriptorPool(device, static_cast<std::uint32_t>(sets));
    const auto bind = [&](const Instance& instance, const Buffer& sieve) {
        return bindInstance(device, targets.pool, programs, scene, instance, buffers, caustics, sieve);
    };
    for (const Instance& instance : scene.instances)
        targets.each.push_back({&programsFor(programs, scene, instance), bind(instance, buffers.blank_sieve)});
    targets.sets = targets.each.empty() ? bind(scene.blank, buffers.blank_sieve) : targets.each.front().sets;
    for (const InstanceSieve& each : sieves) {
        TargetSieve& sieve = targets.sieves.emplace_back();
        sieve.first = each.first;
        sieve.count = each.count;
        sieve.programs = &programs.sieves.at(sieveSize(each.count));
        sieve.boxes =
            createFilledBuffer(device, "sieve", &each.boxes, sizeof each.boxes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
        sieve.sets = bind(scene.instances[each.first], sieve.boxes);
    }
    return targets;
}

void destroyTargets(Device& device, Targets& targets) {
    destroyDescriptorPool(device, targets.pool);
    for (TargetSieve& sieve : targets.sieves) destroyBuffer(device, sieve.boxes);
    targets = {};
}

void askTargets(PassCommands& commands, const Programs& programs, const Targets& targets, const AskedList& asked,
                const AskTarget& ask) {
    if (targets.sieves.empty())
        for (const TracerTarget& target : targets.each) ask(target, asked.list);
    for (const TargetSieve& sieve : targets.sieves) {
        runOver(commands, sieve.programs->*asked.sift, sieve.sets, asked);
        runOver(commands, programs.prepare, sieve.sets, asked, STEP_SIFTED);
        runOver(commands, programs.place, sieve.sets, asked);
        for (std::size_t k = 0; k < sieve.count; ++k)
            ask(targets.each[sieve.first + k], static_cast<std::uint32_t>(LIST_SIFTED + k));
    }
}

} // namespace pointrt
