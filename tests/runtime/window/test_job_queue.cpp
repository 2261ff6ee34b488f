// SPDX-License-Identifier: Apache-2.0
// Scheduling of jobs.
#include "runtime/window/edit/job_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace pointrt {
namespace {

using namespace std::chrono_literals;

enum class Gate { kClosed, kOpen, kBroken };

/// Work that runs until its gate opens.
class GatedWork {
public:
    GatedWork(std::string name, std::atomic<Gate>& gate, bool can_cancel = true)
        : job_(
              std::move(name), [&gate](JobControl& control) { wait(gate, control); }, can_cancel) {}
    Job& job() { return job_; }

private:
    static void wait(const std::atomic<Gate>& gate, const JobControl& control) {
        while (gate == Gate::kClosed) {
            control.throwIfCancelled();
            std::this_thread::sleep_for(1ms);
        }
        if (gate == Gate::kBroken) throw Error(ExitCode::kBadInput, "broken");
    }
    Job job_;
};

class JobQueueTest : public testing::Test {
protected:
    /// A job that reports when it is done.
    JobStart work(const std::string& name, bool can_cancel = true) {
        return [this, name, can_cancel] {
            events.push_back("start " + name);
            return startedJob<GatedWork>(
                std::make_unique<GatedWork>(name, gate, can_cancel),
                [this, name](GatedWork&) { events.push_back("done " + name); },
                [this, name](const Job&) { events.push_back("end " + name); });
        };
    }
    std::string shown() const { return queue.status() ? queue.status()->title : "nothing"; }

    /// Polls until something is reported.
    std::vector<std::string> next() {
        events.clear();
        const auto end = std::chrono::steady_clock::now() + 10s;
        while (events.empty() && std::chrono::steady_clock::now() < end) {
            queue.poll();
            std::this_thread::sleep_for(1ms);
        }
        return events;
    }

    using Events = std::vector<std::string>;
    Events events;
    std::atomic<Gate> gate = Gate::kClosed;
    JobQueue queue{[this](const std::string& text, bool error) { events.push_back((error ? "error " : "") + text); }};
};

TEST_F(JobQueueTest, RunsCallbacksWhenDone) {
    EXPECT_FALSE(queue.any());
    EXPECT_TRUE(queue.start(JobKind::kBake, work("bake")));
    EXPECT_EQ(events, Events{"start bake"});
    EXPECT_TRUE(queue.any());
    EXPECT_EQ(shown(), "bake");
    queue.poll();
    EXPECT_EQ(events.size(), 1u) << "it is under way";
    gate = Gate::kOpen;
    EXPECT_EQ(next(), (Events{"end bake", "done bake"}));
    EXPECT_FALSE(queue.any());
    EXPECT_EQ(shown(), "nothing");
}

TEST_F(JobQueueTest, ReportsErrors) {
    queue.start(JobKind::kSave, work("save"));
    gate = Gate::kBroken;
    EXPECT_EQ(next(), (Events{"end save", "error broken"}));
}

TEST_F(JobQueueTest, EndedCallbackMayThrow) {
    queue.start(JobKind::kLoad, [&] {
        return startedJob<GatedWork>(std::make_unique<GatedWork>("load", gate), {},
                                     [](const Job& job) { throw Error(job.errorCode(), job.error()); });
    });
    gate = Gate::kBroken;
    EXPECT_THROW(next(), Error);
    EXPECT_EQ(events, Events{}) << "the error is reported once";
    EXPECT_FALSE(queue.any());
}

TEST_F(JobQueueTest, CancelsTheDisplayedJob) {
    queue.start(JobKind::kBake, work("bake"));
    queue.start(JobKind::kTurntable, work("turn"));
    EXPECT_EQ(shown(), "bake");
    queue.cancel();
    EXPECT_FALSE(queue.status()->can_cancel);
    EXPECT_EQ(next(), (Events{"end bake", "bake: cancelled"}));
    EXPECT_EQ(shown(), "turn");
}

TEST_F(JobQueueTest, IgnoresCancelOfUncancellableJobs) {
    queue.start(JobKind::kSave, work("save", false));
    queue.cancel();
    EXPECT_EQ(queue.status()->detail, "") << "it must not claim to be cancelling";
    gate = Gate::kOpen;
    EXPECT_EQ(next(), (Events{"end save", "done save"}));
}

TEST_F(JobQueueTest, StartsOneJobOfAKind) {
    EXPECT_TRUE(queue.start(JobKind::kBake, work("bake")));
    EXPECT_FALSE(queue.start(JobKind::kBake, work("another")));
    EXPECT_TRUE(queue.start(JobKind::kSave, work("save")));
    EXPECT_EQ(events, (Events{"start bake", "start save"}));
    EXPECT_EQ(queue.status(JobKind::kBake)->title, "bake");
    EXPECT_FALSE(queue.status(JobKind::kLoad));
}

TEST_F(JobQueueTest, LastLoadReplacesEarlierOnes) {
    queue.enqueue(JobKind::kLoad, work("a"));
    EXPECT_TRUE(queue.has(JobKind::kLoad));
    EXPECT_EQ(shown(), "nothing");
    EXPECT_EQ(next(), Events{"start a"});
    queue.enqueue(JobKind::kLoad, work("b"));
    queue.enqueue(JobKind::kLoad, work("c"));
    EXPECT_EQ(next(), (Events{"end a", "a: cancelled", "start c"}));
    gate = Gate::kOpen;
    EXPECT_EQ(next(), (Events{"end c", "done c"}));
}

TEST_F(JobQueueTest, LoadsAfterSceneUpdate) {
    queue.start(JobKind::kSceneUpdate, work("update"));
    queue.enqueue(JobKind::kLoad, work("load"));
    EXPECT_FALSE(queue.start(JobKind::kSceneUpdate, work("again"))) << "a waiting load replaces it";
    queue.poll();
    EXPECT_TRUE(queue.status()->can_cancel) << "it is not cancelled";
    gate = Gate::kOpen;
    EXPECT_EQ(next(), (Events{"end update", "done update", "start load"}));
    EXPECT_FALSE(queue.start(JobKind::kSceneUpdate, work("early")));
}

TEST_F(JobQueueTest, BakeCallbackStartsALoadInTheSamePoll) {
    queue.start(JobKind::kBake, [&] {
        return startedJob<GatedWork>(std::make_unique<GatedWork>("bake", gate),
                                     [this](GatedWork&) { queue.enqueue(JobKind::kLoad, work("load")); });
    });
    gate = Gate::kOpen;
    EXPECT_EQ(next(), Events{"start load"});
}

TEST_F(JobQueueTest, DestructorCancelsJobs) {
    JobQueue other([](const std::string&, bool) {});
    other.start(JobKind::kLoad, work("load"));
    other.start(JobKind::kBake, work("bake"));
    other.enqueue(JobKind::kLoad, work("next"));
    EXPECT_EQ(events, (Events{"start load", "start bake"}));
}

} // namespace
} // namespace pointrt
