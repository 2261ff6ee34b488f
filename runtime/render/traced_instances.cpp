// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/traced_instances.h"

#include <algorithm>

#include "runtime/render/caustic_map.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/instance_culling.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

/// A pass over the list; with step bits, prepare's single lane.
void runOver(PassCommands& commands, const Program& program, const DescriptorSets& sets, const InstanceRayList& rays,
             std::uint32_t bits = 0) {
    gpu::PushParams push = rays.push;
    push.list = rays.list;
    push.step |= bits;
    if (bits != 0)
        commands.run({program, sets, pushBytes(push), PassLanes::kOne, 1});
    else
        commands.run({program, sets, pushBytes(push), PassLanes::kList, 0, rays.list});
}

/// Runs of composite_gaussians for rays that lavapipe cuts after 65,535 iterations of all loops. A ray through many
/// Gaussians walks again after each kWaiting of them, and tests all that are listed where it is. Hardly a ray lets
/// light pass behind 1,000 Gaussians, that is 64 walks; and as a group of 8 lanes takes longer than each of them, half
/// of the iterations count.
std::uint32_t gaussianRuns(std::uint32_t most_listed) {
    constexpr std::uint32_t kWalks = 64, kIterations = 65535 / 2, kMostRuns = 64;
    return std::min(1 + kWalks * most_listed / kIterations, kMostRuns);
}

} // namespace

TracedInstances bindTracedInstances(Device& device, const Programs& programs, const DeviceScene& scene,
                                    const FrameBuffers& buffers, const CausticMap& caustics) {
    TracedInstances instances;
    const OnError undo([&] { destroyTracedInstances(device, instances); });
    const std::vector<CullGroupBoxes> groups = makeCullGroups(scene);
    const std::size_t sets = 2 * (std::max<std::size_t>(scene.instances.size(), 1) + groups.size());
    instances.pool = createDescriptorPool(device, static_cast<std::uint32_t>(sets));
    const auto bind = [&](const Instance& instance, const Buffer& boxes) {
        return bindInstance(device, instances.pool, programs, scene, instance, buffers, caustics, boxes);
    };
    for (const Instance& instance : scene.instances)
        instances.each.push_back({&programsFor(programs, scene, instance), bind(instance, buffers.no_cull_boxes),
                                  scene.files[instance.file].is_gaussian,
                                  gaussianRuns(scene.files[instance.file].most_listed)});
    instances.sets = instances.each.empty() ? bind(scene.blank, buffers.no_cull_boxes) : instances.each.front().sets;
    for (const CullGroupBoxes& each : groups) {
        CullGroup& group = instances.cull_groups.emplace_back();
        group.first = each.first;
        group.count = each.count;
        group.programs = &programs.cull.at(cullProgramSize(each.count));
        group.boxes = createFilledBuffer(device, "cull boxes", &each.boxes, sizeof each.boxes,
                                         VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
        group.sets = bind(scene.instances[each.first], group.boxes);
    }
    return instances;
}

void destroyTracedInstances(Device& device, TracedInstances& instances) {
    destroyDescriptorPool(device, instances.pool);
    for (CullGroup& group : instances.cull_groups) destroyBuffer(device, group.boxes);
    instances = {};
}

void intersectInstances(PassCommands& commands, const Programs& programs, const TracedInstances& instances,
                        const InstanceRayList& rays, const IntersectInstance& intersect) {
    if (instances.cull_groups.empty())
        for (const TracedInstance& instance : instances.each)
            if (!instance.is_gaussian) intersect(instance, rays.list);
    for (const CullGroup& group : instances.cull_groups) {
        runOver(commands, group.programs->*rays.cull, group.sets, rays);
        runOver(commands, programs.prepare, group.sets, rays, STEP_CULLED);
        runOver(commands, programs.compact, group.sets, rays);
        for (std::size_t k = 0; k < group.count; ++k)
            if (!instances.each[group.first + k].is_gaussian)
                intersect(instances.each[group.first + k], static_cast<std::uint32_t>(LIST_CULLED + k));
    }
}

} // namespace pointrt
