// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/pass_commands.h"

#include <ctime>
#include <utility>

#include "runtime/util/clock.h"

namespace pointrt {
namespace {

/// Span of the time that profiling itself takes.
constexpr const char* kReadSpan = "profile: counters and clock read";

/// Offset in gpu::Control of the group count for a list.
std::size_t groupsOf(PassLanes lanes, std::uint32_t list) {
    switch (lanes) {
    case PassLanes::kTilesLeft:
        return offsetof(gpu::Control, tile_groups);
    case PassLanes::kList:
        return offsetof(gpu::Control, lists) + list * sizeof(gpu::RayList) + offsetof(gpu::RayList, groups);
    case PassLanes::kHits:
        return offsetof(gpu::Control, hit_groups);
    default:
        return offsetof(gpu::Control, ray_groups);
    }
}

} // namespace

PassCommands::PassCommands(Device& device, const Buffer& control, const Buffer& read, PassProfile* profile)
    : device_(device), control_(control), read_(read), profile_(profile) {
    if (!profile_) {
        commands_ = beginCommands(device_, "samples");
        return;
    }
    const HostSpan span(profile_, kReadSpan);
    counters_ = readControl();
}

void PassCommands::setParams(const Buffer& buffer, const gpu::FrameParams& params) {
    static_assert(sizeof params <= 65536 && sizeof params % 4 == 0, "limits of vkCmdUpdateBuffer");
    if (profile_) commands_ = beginCommands(device_);
    vkCmdUpdateBuffer(commands_, buffer.handle, 0, sizeof params, &params);
    recordBarrier(commands_);
    const HostSpan span(profile_, "parameters");
    if (profile_) submitAndWait(device_, commands_);
}

void PassCommands::run(const Pass& pass) {
    if (profile_)
        runTimed(pass);
    else
        record(pass);
}

void PassCommands::copyHitCounts(const Buffer& counts, const std::vector<std::size_t>& places) {
    if (profile_) return;
    std::vector<VkBufferCopy> copies;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const std::size_t of_tile =
            offsetof(gpu::Control, lists) + (LIST_CULLED + k) * sizeof(gpu::RayList) + offsetof(gpu::RayList, hits);
        copies.push_back({places.size() > 1 ? of_tile : offsetof(gpu::Control, hit_count),
                          places[k] * sizeof(std::uint32_t), sizeof(std::uint32_t)});
    }
    vkCmdCopyBuffer(commands_, control_.handle, counts.handle, static_cast<std::uint32_t>(copies.size()),
                    copies.data());
    recordBarrier(commands_);
}

void PassCommands::endSample() {
    if (profile_) {
        ended_.push_back(counters_);
        return;
    }
    const VkBufferCopy copy{0, samples_++ * sizeof(gpu::Control), sizeof(gpu::Control)};
    vkCmdCopyBuffer(commands_, control_.handle, read_.handle, 1, &copy);
}

void PassCommands::record(const std::function<void(VkCommandBuffer)>& commands) {
    if (profile_) commands_ = beginCommands(device_);
    commands(commands_);
    if (profile_) submitAndWait(device_, commands_);
}

std::vector<gpu::Control> PassCommands::finish() {
    if (profile_) return std::move(ended_);
    submitAndWait(device_, commands_);
    const auto* read = reinterpret_cast<const gpu::Control*>(hostBytes(device_, read_));
    return {read, read + samples_};
}

void PassCommands::record(const Pass& pass) {
    if (pass.groups != 0)
        recordDispatch(commands_, pass.program, pass.sets, pass.push, {pass.groups, 1, 1});
    else
        recordDispatchIndirect(commands_, pass.program, pass.sets, pass.push, control_,
                               groupsOf(pass.lanes, pass.list));
    recordBarrier(commands_);
}

void PassCommands::runTimed(const Pass& pass) {
    PassRun run{pass.program.name.c_str(), pass.lanes, tiles_, counters_, {}, 0, 0, {}, pass.list};
    const Clock::time_point start = Clock::now();
    const std::clock_t cpu = std::clock();
    commands_ = beginCommands(device_);
    recordTimerStart(commands_, profile_->clock);
    record(pass);
    recordTimerEnd(commands_, profile_->clock);
    submitAndWait(device_, commands_);
    run.cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    run.host_ms = millisecondsSince(start);
    const HostSpan span(profile_, kReadSpan);
    run.device_ms = elapsedMilliseconds(device_, profile_->clock);
    run.after = counters_ = readControl();
    addRun(*profile_, run);
}

gpu::Control PassCommands::readControl() {
    gpu::Control control{};
    downloadBuffer(device_, control_, &control, sizeof control);
    return control;
}

} // namespace pointrt
