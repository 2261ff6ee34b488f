// SPDX-License-Identifier: Apache-2.0
// The work behind the window: what may be under way beside what, what is shown of it, and what comes after.
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

/// One of a kind at a time. The first one of these that is under way is the one that users see, and cancel.
/// But for tiles, which come all the time.
enum class JobKind : std::uint8_t { kLoad, kSceneUpdate, kBake, kTurntable, kSave, kTiles, kCount };
constexpr std::size_t kJobKinds = static_cast<std::size_t>(JobKind::kCount);

/// What becomes of work that is wanted while other work is under way.
enum class Scheduling : std::uint8_t {
    kConcurrent, ///< both go on
    kAfter,      ///< it must wait until the other one has ended
    kReplaces    ///< the other one is cancelled; it begins when that has ended
};

/// kScheduling[wanted][under way], columns as rows. The scene is loading's and relighting's alone; all else has what it
/// needs of it.
constexpr std::array<std::array<Scheduling, kJobKinds>, kJobKinds> kScheduling = [] {
    using enum Scheduling;
    return std::array<std::array<Scheduling, kJobKinds>, kJobKinds>{{
        /* load      */ {kReplaces, kAfter, kConcurrent, kConcurrent, kConcurrent, kAfter},
        /* relight   */ {kAfter, kAfter, kConcurrent, kConcurrent, kConcurrent, kAfter},
        /* bake      */ {kConcurrent, kConcurrent, kAfter, kConcurrent, kConcurrent, kConcurrent},
        /* turntable */ {kConcurrent, kConcurrent, kConcurrent, kAfter, kConcurrent, kConcurrent},
        /* save      */ {kConcurrent, kConcurrent, kConcurrent, kConcurrent, kAfter, kConcurrent},
        /* tiles     */ {kAfter, kAfter, kConcurrent, kConcurrent, kConcurrent, kAfter},
    }};
}();
/// One of each kind, and no two kinds that disagree on going on beside each other. False where a kind has no row.
constexpr bool isConsistent(const decltype(kScheduling)& meetings) {
    for (std::size_t a = 0; a < kJobKinds; ++a)
        for (std::size_t b = 0; b < kJobKinds; ++b) {
            const bool beside = meetings[a][b] == Scheduling::kConcurrent;
            if (beside != (meetings[b][a] == Scheduling::kConcurrent) || (beside && a == b)) return false;
        }
    return true;
}
static_assert(isConsistent(kScheduling));

/// A job that has been started, and what is to happen when it has ended.
struct StartedJob {
    std::shared_ptr<void> owner; ///< what the job is part of
    Job* job = nullptr;
    std::function<void()> done;            ///< once it is done: not after an error or a cancel
    std::function<void(const Job&)> ended; ///< before that, in whatever state; may throw in place of an error's telling
};

/// work: what has a job(), such as LoadJob. done may empty it. Both callbacks may be empty.
template <typename Work>
StartedJob startedJob(std::unique_ptr<Work> work, std::function<void(Work&)> done,
                      std::function<void(const Job&)> ended = {}) {
    const std::shared_ptr<Work> owner = std::move(work);
    return {owner, &owner->job(),
            [owner, done = std::move(done)] {
                if (done) done(*owner);
            },
            std::move(ended)};
}

/// Makes a job at the moment when it may begin.
using JobStart = std::function<StartedJob()>;

/// Callbacks run within poll, on the caller's thread; they may start more.
class JobQueue {
public:
    using Notify = std::function<void(const std::string& text, bool error)>;

    /// tell: to whom errors and cancelled jobs are reported.
    explicit JobQueue(Notify tell) : notify_(std::move(tell)) {}
    /// Cancels all, and waits for it; nothing is called back.
    ~JobQueue();
    JobQueue(const JobQueue&) = delete;
    JobQueue& operator=(const JobQueue&) = delete;

    /// Begins at once, or returns false with nothing done where kScheduling has other work, under way or waiting,
    /// before it. Throws what start throws.
    bool start(JobKind kind, const JobStart& start);
    /// Begins at a poll to come, the next one that kScheduling lets it; takes the place of one of its kind that waits.
    void enqueue(JobKind kind, JobStart start);

    /// Calls back for what has ended, then begins what has waited for it. Throws what callbacks and starts throw.
    void poll();

    /// Under way or waiting.
    bool has(JobKind kind) const;
    bool any() const;
    /// Of what is under way; of the kind, or of the one that users see.
    std::optional<JobStatus> status(JobKind kind) const;
    std::optional<JobStatus> status() const;
    /// Cancels the one that users see, where it can be.
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
