// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/traced_instances.h"

#include <algorithm>

#include "runtime/render/caustic_map.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/instance_culling.h"
#include "runtime/render/pooled_tiles.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

/// A pass over the list; with step bits, a pass of prepare with a single lane.
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

/// Fills a TracedInstances.
class InstanceBinder {
public:
    InstanceBinder(Device& device, const Programs& programs, const DeviceScene& scene, const FrameBuffers& buffers,
                   const CausticMap& caustics, TracedInstances& instances)
        : device_(device), programs_(programs), scene_(scene), buffers_(buffers), caustics_(caustics),
          instances_(instances) {}

    void bindAll() {
        const std::vector<PooledGroup> pooled = makePooledGroups(scene_);
        const std::vector<std::size_t> apart = placesApart(scene_, pooled);
        const std::vector<CullGroupBoxes> groups = makeCullGroups(scene_, apart);
        const std::size_t sets = 2 * (std::max<std::size_t>(apart.size() + pooled.size(), 1) + groups.size());
        instances_.pool = createDescriptorPool(device_, static_cast<std::uint32_t>(sets));
        for (const std::size_t place : apart) addSingle(place);
        for (const PooledGroup& each : pooled) addPooled(each);
        instances_.sets =
            instances_.each.empty() ? bind(scene_.blank, buffers_.no_cull_boxes) : instances_.each.front().sets;
        for (const CullGroupBoxes& each : groups) addCullGroup(each);
    }

private:
    DescriptorSets bind(const Instance& instance, const Buffer& boxes) {
        return bindInstance(device_, instances_.pool, programs_, scene_, instance, buffers_, caustics_, boxes);
    }

    Buffer uploadBoxes(const gpu::CullBoxes& boxes) {
        return createFilledBuffer(device_, "cull boxes", &boxes, sizeof boxes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    }

    void addSingle(std::size_t place) {
        const Instance& instance = scene_.instances[place];
        const DeviceScan& file = scene_.files[instance.file];
        TracedInstance& single = instances_.each.emplace_back();
        single.programs = &programsFor(programs_, scene_, instance);
        single.sets = bind(instance, buffers_.no_cull_boxes);
        single.places = {place};
        single.is_gaussian = file.is_gaussian;
    }

    void addPooled(const PooledGroup& group) {
        std::vector<Buffer>& tables = instances_.tables;
        tables.push_back(uploadBoxes(makeCullBoxes(scene_, group.places)));
        tables.push_back(
            createTexelRows(device_, "pooled tiles", pooledTiles(scene_, group), VK_FORMAT_R32G32B32A32_UINT));
        const Buffer &boxes = tables[tables.size() - 2], &tiles = tables.back();
        TracedInstance& together = instances_.each.emplace_back();
        together.programs = &programs_.variants.at(group.traits);
        together.sets =
            bindPooled(device_, instances_.pool, programs_, scene_, group, {buffers_, caustics_, boxes, tiles});
        together.places = group.places;
        together.beams = group.traits.pooled_tiles;
    }

    void addCullGroup(const CullGroupBoxes& boxes) {
        std::vector<CullGroup>& groups = instances_.cull_groups;
        CullGroup group;
        group.first = groups.empty() ? 0 : groups.back().first + groups.back().count;
        group.count = boxes.places.size();
        group.programs = &programs_.cull.at(cullProgramSize(group.count));
        group.boxes = uploadBoxes(boxes.boxes);
        groups.push_back(group);
        groups.back().sets = bind(scene_.instances[boxes.places[0]], groups.back().boxes);
    }

    Device& device_;
    const Programs& programs_;
    const DeviceScene& scene_;
    const FrameBuffers& buffers_;
    const CausticMap& caustics_;
    TracedInstances& instances_;
};

} // namespace

TracedInstances bindTracedInstances(Device& device, const Programs& programs, const DeviceScene& scene,
                                    const FrameBuffers& buffers, const CausticMap& caustics) {
    TracedInstances instances;
    const OnError undo([&] { destroyTracedInstances(device, instances); });
    InstanceBinder(device, programs, scene, buffers, caustics, instances).bindAll();
    return instances;
}

void destroyTracedInstances(Device& device, TracedInstances& instances) {
    destroyDescriptorPool(device, instances.pool);
    for (CullGroup& group : instances.cull_groups) destroyBuffer(device, group.boxes);
    for (Buffer& table : instances.tables) destroyBuffer(device, table);
    instances = {};
}

void intersectInstances(PassCommands& commands, const Programs& programs, const TracedInstances& instances,
                        const InstanceRayList& rays, const IntersectInstance& intersect) {
    const std::size_t culled =
        instances.cull_groups.empty() ? 0 : instances.cull_groups.back().first + instances.cull_groups.back().count;
    for (std::size_t k = culled; k < instances.each.size(); ++k)
        if (!instances.each[k].is_gaussian) intersect(instances.each[k], rays.list);
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
