// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/pass_commands.h"

#include <algorithm>
#include <cstring>
#include <ctime>
#include <utility>

#include "runtime/render/frame_buffers.h"
#include "runtime/util/clock.h"

namespace pointrt {
namespace {

/// Name of the host span for the time that profiling itself takes.
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

std::uint32_t stepOf(const Pass& pass) {
    gpu::PushParams params{};
    std::memcpy(&params, pass.push.data(), std::min(pass.push.size(), sizeof params));
    return params.step;
}

} // namespace

std::vector<gpu::Control> readCounters(const Device& device, const PassReadback& readback, std::uint32_t samples) {
    const auto* read = reinterpret_cast<const gpu::Control*>(hostBytes(device, readback.counters));
    read += readback.place * kSamplesAtOnce;
    return {read, read + samples};
}

PassCommands::PassCommands(Device& device, const Buffer& control, const PassReadback& readback, PassProfile* profile)
    : device_(device), control_(control), readback_(readback), profile_(profile) {
    if (submitsEach()) {
        const HostSpan span(profile_, kReadSpan);
        counters_ = readControl();
        return;
    }
    commands_ = beginCommands(device_, "samples");
    if (profile_) copyCounters(0);
    if (readback_.timer) recordTimerStart(commands_, *readback_.timer, readback_.place);
}

void PassCommands::setParams(const Buffer& buffer, const gpu::FrameParams& params) {
    static_assert(sizeof params <= 65536 && sizeof params % 4 == 0, "limits of vkCmdUpdateBuffer");
    const HostSpan span(profile_, "parameters");
    record([&](VkCommandBuffer commands) {
        vkCmdUpdateBuffer(commands, buffer.handle, 0, sizeof params, &params);
        recordBarrier(commands);
    });
}

void PassCommands::run(const Pass& pass) {
    if (submitsEach())
        runAlone(pass);
    else if (profile_)
        recordTimed(pass);
    else
        record(pass);
}

void PassCommands::copyHitCounts(const Buffer& counts, const std::vector<std::size_t>& places) {
    if (submitsEach()) return;
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
    if (submitsEach()) {
        ended_.push_back(counters_);
        return;
    }
    const VkBufferCopy copy{0, (readback_.place * kSamplesAtOnce + samples_++) * sizeof(gpu::Control),
                            sizeof(gpu::Control)};
    vkCmdCopyBuffer(commands_, control_.handle, readback_.counters.handle, 1, &copy);
}

void PassCommands::record(const std::function<void(VkCommandBuffer)>& commands) {
    if (submitsEach()) commands_ = beginCommands(device_);
    commands(commands_);
    if (submitsEach()) submitAndWait(device_, commands_);
}

std::vector<gpu::Control> PassCommands::finish() {
    if (submitsEach()) return std::move(ended_);
    if (profile_)
        readTimed();
    else
        waitFor(device_, submit());
    return readCounters(device_, readback_, samples_);
}

std::uint64_t PassCommands::submit() { return pointrt::submit(device_, end()); }

std::uint64_t PassCommands::submitLater() { return submitWithNext(device_, end()); }

VkCommandBuffer PassCommands::end() {
    if (readback_.timer) recordTimerEnd(commands_, *readback_.timer, readback_.place);
    return commands_;
}

void PassCommands::record(const Pass& pass) {
    const CommandLabel label(device_, commands_, pass.program.name.c_str());
    if (pass.groups != 0)
        recordDispatch(commands_, pass.program, pass.sets, pass.push, {pass.groups, 1, 1});
    else
        recordDispatchIndirect(commands_, pass.program, pass.sets, pass.push, control_,
                               groupsOf(pass.lanes, pass.list));
    if (!pass.overlaps) recordBarrier(commands_);
}

void PassCommands::runAlone(const Pass& pass) {
    PassRun run{pass.program.name.c_str(), pass.lanes, tiles_, counters_, {}, 0, 0, {}, pass.list, stepOf(pass)};
    const Clock::time_point start = Clock::now();
    const std::clock_t cpu = std::clock();
    commands_ = beginCommands(device_);
    recordTimerStart(commands_, profile_->clock.timer);
    record(pass);
    recordTimerEnd(commands_, profile_->clock.timer);
    submitAndWait(device_, commands_);
    run.cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    run.host_ms = millisecondsSince(start);
    const HostSpan span(profile_, kReadSpan);
    run.device_ms = elapsedMilliseconds(device_, profile_->clock.timer);
    run.after = counters_ = readControl();
    addRun(*profile_, run);
}

void PassCommands::recordTimed(const Pass& pass) {
    const GpuTimer& timer = profile_->clock.timer;
    if (timed_.size() == timer.ranges) {
        readTimed();
        commands_ = beginCommands(device_, "samples");
        copyCounters(0);
    }
    const Clock::time_point start = Clock::now();
    const auto range = static_cast<std::uint32_t>(timed_.size());
    recordTimerStart(commands_, timer, range);
    record(pass);
    recordTimerEnd(commands_, timer, range);
    copyCounters(range + 1);
    timed_.push_back({pass.program.name.c_str(),
                      pass.lanes,
                      tiles_,
                      {},
                      {},
                      millisecondsSince(start),
                      0,
                      {},
                      pass.list,
                      stepOf(pass)});
}

/// Copies the counters as they are before the next pass.
void PassCommands::copyCounters(std::size_t place) {
    const VkBufferCopy copy{0, place * sizeof(gpu::Control), sizeof(gpu::Control)};
    vkCmdCopyBuffer(commands_, control_.handle, profile_->clock.counters.handle, 1, &copy);
    recordBarrier(commands_); // because the next pass changes them
}

/// Submits the passes recorded since the last call, and adds them to the profile.
void PassCommands::readTimed() {
    {
        const HostSpan span(profile_, "wait for the device");
        submitAndWait(device_, commands_);
    }
    const HostSpan span(profile_, kReadSpan);
    const auto* counters = reinterpret_cast<const gpu::Control*>(hostBytes(device_, profile_->clock.counters));
    for (std::uint32_t i = 0; i < timed_.size(); ++i) {
        timed_[i].before = counters[i];
        timed_[i].after = counters[i + 1];
        timed_[i].device_ms = elapsedMilliseconds(device_, profile_->clock.timer, i);
        addRun(*profile_, timed_[i]);
    }
    timed_.clear();
}

gpu::Control PassCommands::readControl() {
    gpu::Control control{};
    downloadBuffer(device_, control_, &control, sizeof control);
    return control;
}

} // namespace pointrt
