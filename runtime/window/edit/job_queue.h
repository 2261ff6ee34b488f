// SPDX-License-Identifier: Apache-2.0
// The window's background jobs: which may run at the same time, which wait, and which one is displayed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "runtime/window/edit/job.h"

namespace pointrt {

/// At most one job of each kind runs. The window displays the first running job in this order, which Cancel cancels;
/// kTiles is left out, since tiles load all the time.
enum class JobKind : std::uint8_t { kLoad, kSceneUpdate, kBake, kStudy, kTurntable, kSave, kTiles, kCount };
constexpr std::size_t kJobKinds = static_cast<std::size_t>(JobKind::kCount);

/// How a new job is scheduled while another one runs.
enum class Scheduling : std::uint8_t {
    kConcurrent, ///< runs at the same time
    kAfter,      ///< waits until the running job has ended
    kReplaces    ///< cancels the running job, and starts when that has ended
};

/// kScheduling[new][running], rows and columns in the order of JobKind. Loading and updating the scene need exclusive
/// access to it; the other jobs have their own copies.
constexpr std::array<std::array<Scheduling, kJobKinds>, kJobKinds> kScheduling = [] {
    using enum Scheduling;
    return std::array<std::array<Scheduling, kJobKinds>, kJobKinds>{{
        /* load      */ {kReplaces, kAfter, kConcurrent, kConcurrent, kConcurrent, kConcurrent, kAfter},
        /* update    */ {kAfter, kAfter, kConcurrent, kConcurrent, kConcurrent, kConcurrent, kAfter},
        /* bake      */ {kConcurrent, kConcurrent, kAfter, kConcurrent, kConcurrent, kConcurrent, kConcurrent},
        /* study     */ {kConcurrent, kConcurrent, kConcurrent, kAfter, kConcurrent, kConcurrent, kConcurrent},
        /* turntable */ {kConcurrent, kConcurrent, kConcurrent, kConcurrent, kAfter, kConcurrent, kConcurrent},
        /* save      */ {kConcurrent, kConcurrent, kConcurrent, kConcurrent, kConcurrent, kAfter, kConcurrent},
        /* tiles     */ {kAfter, kAfter, kConcurrent, kConcurrent, kConcurrent, kConcurrent, kAfter},
    }};
}();
/// True if jobs of one kind never run at the same time and kConcurrent is symmetric. False if a row is missing.
constexpr bool isConsistent(const decltype(kScheduling)& table) {
    for (std::size_t a = 0; a < kJobKinds; ++a)
        for (std::size_t b = 0; b < kJobKinds; ++b) {
            const bool concurrent = table[a][b] == Scheduling::kConcurrent;
            if (concurrent != (table[b][a] == Scheduling::kConcurrent) || (concurrent && a == b)) return false;
        }
    return true;
}
static_assert(isConsistent(kScheduling));

/// A running job and its callbacks.
struct StartedJob {
    std::shared_ptr<void> owner; ///< keeps the job alive
    Job* job = nullptr;
    std::function<void()> done;            ///< after success only
    std::function<void(const Job&)> ended; ///< before done, in any final state; may throw instead of reporting an error
    bool fails_silently = false;           ///< another job will report the error
};

/// work: an object with a job(), such as LoadJob. done may move from it. Both callbacks may be empty.
template <typename Work>
StartedJob startedJob(std::unique_ptr<Work> work, std::function<void(Work&)> done,
                      std::function<void(const Job&)> ended = {}) {
    const std::shared_ptr<Work> owner = std::move(work);
    return {owner, &owner->job(),
            [owner, done = std::move(done)] {
                if (done) done(*owner);
            },
            std::move(ended), false};
}

/// Creates a job when it may start.
using JobStart = std::function<StartedJob()>;

/// Callbacks run in poll, on the caller's thread. They may start further jobs.
class JobQueue {
public:
    using Notify = std::function<void(const std::string& text, bool error)>;

    /// notify: receives errors and cancellations.
    explicit JobQueue(Notify notify) : notify_(std::move(notify)) {}
    /// Cancels all jobs and waits for them, without callbacks.
    ~JobQueue();
    JobQueue(const JobQueue&) = delete;
    JobQueue& operator=(const JobQueue&) = delete;

    /// Starts a job now. Returns false and does nothing if kScheduling puts it after a running or waiting job. Throws
    /// what start throws.
    bool start(JobKind kind, const JobStart& start);
    /// Starts a job at the first poll at which kScheduling allows it. Replaces a waiting job of the same kind.
    void enqueue(JobKind kind, JobStart start);

    /// Runs the callbacks of ended jobs, then starts waiting ones. Throws what these throw.
    void poll();

    /// Running or waiting.
    bool has(JobKind kind) const;
    bool any() const;
    /// Status of the running job of a kind; without a kind, of the displayed job.
    std::optional<JobStatus> status(JobKind kind) const;
    std::optional<JobStatus> status() const;
    /// Cancels the displayed job, if possible.
    void cancel();

private:
    struct Slot {
        std::optional<StartedJob> running;
        JobStart waiting;
    };

    Slot& slot(JobKind kind) { return slots_[static_cast<std::size_t>(kind)]; }
    const Slot& slot(JobKind kind) const { return slots_[static_cast<std::size_t>(kind)]; }
    const Slot* shown() const;
    bool mayStart(std::size_t kind) const;
    void end(Slot& slot);

    Notify notify_;
    std::array<Slot, kJobKinds> slots_; ///< by kind
};

} // namespace pointrt
