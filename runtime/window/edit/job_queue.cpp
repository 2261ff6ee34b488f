// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/job_queue.h"

#include <algorithm>
#include <utility>

namespace pointrt {

JobQueue::~JobQueue() {
    for (Slot& each : slots_)
        if (each.running) each.running->job->cancel(); // all of them first: their threads end in parallel
}

bool JobQueue::start(JobKind kind, const JobStart& start) {
    for (std::size_t other = 0; other < kJobKinds; ++other)
        if (kScheduling[static_cast<std::size_t>(kind)][other] != Scheduling::kConcurrent &&
            has(static_cast<JobKind>(other)))
            return false;
    slot(kind).running = start();
    return true;
}

void JobQueue::enqueue(JobKind kind, JobStart start) {
    slot(kind).waiting = std::move(start);
    for (std::size_t other = 0; other < kJobKinds; ++other)
        if (kScheduling[static_cast<std::size_t>(kind)][other] == Scheduling::kReplaces && slots_[other].running)
            slots_[other].running->job->cancel();
}

void JobQueue::end(Slot& slot) {
    const StartedJob over = *std::exchange(slot.running, std::nullopt);
    if (over.ended) over.ended(*over.job);
    if (over.job->state() == JobState::kDone) over.done();
    if (over.job->state() == JobState::kFailed && !over.fails_silently) notify_(over.job->error(), true);
    if (over.job->state() == JobState::kCancelled) notify_(over.job->status().title + ": cancelled", false);
}

bool JobQueue::mayStart(std::size_t kind) const {
    for (std::size_t other = 0; other < kJobKinds; ++other)
        if (kScheduling[kind][other] != Scheduling::kConcurrent && slots_[other].running) return false;
    return true;
}

void JobQueue::poll() {
    // in reverse order, since a finished bake enqueues a load
    for (auto each = slots_.rbegin(); each != slots_.rend(); ++each)
        if (each->running && each->running->job->ended()) end(*each);
    for (std::size_t kind = 0; kind < kJobKinds; ++kind)
        if (slots_[kind].waiting && mayStart(kind)) slots_[kind].running = std::exchange(slots_[kind].waiting, {})();
}

bool JobQueue::has(JobKind kind) const { return slot(kind).running || slot(kind).waiting; }

bool JobQueue::any() const {
    return std::any_of(slots_.begin(), slots_.end(), [](const Slot& each) { return each.running || each.waiting; });
}

std::optional<JobStatus> JobQueue::status(JobKind kind) const {
    if (!slot(kind).running) return std::nullopt;
    return slot(kind).running->job->status();
}

const JobQueue::Slot* JobQueue::shown() const {
    for (std::size_t kind = 0; kind < static_cast<std::size_t>(JobKind::kTiles); ++kind)
        if (slots_[kind].running) return &slots_[kind];
    return nullptr;
}

std::optional<JobStatus> JobQueue::status() const {
    const Slot* slot = shown();
    return slot ? std::optional(slot->running->job->status()) : std::nullopt;
}

void JobQueue::cancel() {
    const Slot* slot = shown();
    if (slot && slot->running->job->status().can_cancel) slot->running->job->cancel();
}

} // namespace pointrt
