// SPDX-License-Identifier: Apache-2.0
// Background jobs: threads, and child processes, which are scripts here.
#include "runtime/window/edit/job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <memory>
#include <thread>

#include "format/base/error.h"
#include "format/os/child_process.h"
#include "runtime/window/edit/bake_job.h"
#include "tests/format/tiny_scene.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// Waits for condition; false after ten seconds.
bool waitFor(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + 10s;
    while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
    return condition();
}

bool ends(const Job& job) {
    return waitFor([&] { return job.ended(); });
}

TEST(Job, ReportsProgress) {
    std::atomic<int> step = 0;
    Job job("Counting", [&](JobControl& control) {
        control.setDetail("first half");
        control.setProgress(0.5);
        control.setProgress(0.25);
        step = 1;
        while (step == 1) std::this_thread::sleep_for(1ms);
        control.setProgress(7);
    });
    ASSERT_TRUE(waitFor([&] { return step == 1; }));
    const JobStatus status = job.status();
    EXPECT_EQ(status.title, "Counting");
    EXPECT_EQ(status.detail, "first half");
    EXPECT_EQ(status.progress, 0.5) << "it never goes back";
    EXPECT_TRUE(status.can_cancel);
    EXPECT_EQ(job.state(), JobState::kRunning);
    step = 2;
    ASSERT_TRUE(ends(job));
    EXPECT_EQ(job.state(), JobState::kDone);
    EXPECT_EQ(job.status().progress, 1.0);
    EXPECT_EQ(job.error(), "");
}

TEST(Job, KeepsTheError) {
    const auto errorOf = [](Job::Work work) {
        Job job("Failing", std::move(work));
        EXPECT_TRUE(ends(job));
        EXPECT_EQ(job.state(), JobState::kFailed);
        return job.error();
    };
    EXPECT_EQ(errorOf([](JobControl&) { throw Error(ExitCode::kBadInput, "scan.pro: is no scan"); }),
              "scan.pro: is no scan");
    EXPECT_EQ(errorOf([](JobControl&) { throw std::bad_alloc(); }), "out of memory");
    EXPECT_NE(errorOf([](JobControl&) { throw 7; }), "");
}

TEST(Job, CanBeCancelled) {
    Job job("Waiting", [](JobControl& control) {
        while (true) {
            control.throwIfCancelled();
            std::this_thread::sleep_for(1ms);
        }
    });
    job.cancel();
    ASSERT_TRUE(ends(job));
    EXPECT_EQ(job.state(), JobState::kCancelled);
    EXPECT_FALSE(job.status().can_cancel);
}

TEST(Job, DestructorCancels) {
    std::atomic<bool> left = false;
    {
        const Job job("Waiting", [&](JobControl& control) {
            while (!control.cancelled()) std::this_thread::sleep_for(1ms);
            left = true;
        });
    }
    EXPECT_TRUE(left);
}

TEST(Job, ExtrapolatesTheTimeLeft) {
    EXPECT_EQ(secondsLeft(0.25, 2, 2), 6.0);
    EXPECT_EQ(secondsLeft(0.25, 2, 5), 3.0) << "counted down until more is known";
    EXPECT_EQ(secondsLeft(0.25, 2, 50), 0.0);
    EXPECT_EQ(secondsLeft(1, 2, 2), 0.0);
    EXPECT_FALSE(secondsLeft(0.25, 0.1, 0.1)) << "too early to say";
    EXPECT_FALSE(secondsLeft(0.001, 2, 2)) << "too little to go by";
}

TEST(ChildProcess, ReadsStdoutAndStderr) {
    ChildProcess child({"/bin/sh", "-c", "cat; echo out; echo \"$1\" >&2; exit 3", "sh", "a 'b'\n$c"});
    std::string said;
    ASSERT_TRUE(waitFor([&] {
        said += child.read(1ms);
        return child.waitStatus().has_value();
    }));
    said += child.read(1ms);
    EXPECT_EQ(said, "out\na 'b'\n$c\n") << "standard input is empty, and arguments are not expanded";
    EXPECT_SAYS(describeExit(*child.waitStatus()), "*status 3");
}

TEST(ChildProcess, IsKilledByTheDestructor) {
    pid_t id = 0;
    {
        const ChildProcess child({"/bin/sleep", "100"});
        id = static_cast<pid_t>(child.id());
        EXPECT_EQ(kill(id, 0), 0);
    }
    EXPECT_NE(kill(id, 0), 0);
    EXPECT_SAYS(describeExit(SIGKILL), "*9 (Killed)");
}

class Bake : public testing::Test {
protected:
    /// Runs a script instead of pointrt-bake: $5 is the output, $7 the scan, $0.pro a .pro to copy.
    std::unique_ptr<BakeJob> start(const std::string& body, BakeDetail detail = BakeDetail::kAll) const {
        const std::string path = folder.write("pointrt-bake", "#!/bin/sh\n" + body + "\n");
        fs::permissions(path, fs::perms::owner_all);
        // so that all versions look the same, whenever they are written
        fs::last_write_time(path, fs::file_time_type{});
        test::tinyScene().write(path + ".pro");
        const ScanBake bake{{folder.write("a scan\n.ply", std::string(scan_bytes, 'x'))}, {}};
        return std::make_unique<BakeJob>(bake, detail, FileCache{folder.file("cache"), ".pro", 1 << 20}, path);
    }

    const test::TemporaryFolder folder;
    std::size_t scan_bytes = 300'000;
};

TEST_F(Bake, ShowsProgress) {
    const auto bake = start("printf 'hello\\nprogress 0.2500 nor' >&2; echo 'mals 1234567' >&2\n"
                            "while [ ! -e \"$0.go\" ]; do sleep 0.01; done; cp \"$0.pro\" \"$5\"");
    ASSERT_TRUE(waitFor([&] { return bake->job().status().progress == 0.25; }));
    const JobStatus status = bake->job().status();
    EXPECT_EQ(status.title, "Baking a scan\n.ply");
    EXPECT_EQ(status.detail, "normals, 1.2 M points/s");
    folder.write("pointrt-bake.go", "");
    ASSERT_TRUE(ends(bake->job()));
    EXPECT_EQ(bake->job().state(), JobState::kDone) << bake->job().error();
    EXPECT_TRUE(bake->output().starts_with(folder.file("cache/")));
}

TEST_F(Bake, IsQuickUntilItIsCached) {
    const std::string copies = "echo \"$*\" >> \"$0.log\"; cp \"$0.pro\" \"$5\"";
    const auto run = [&](BakeDetail detail) {
        const auto bake = start(copies, detail);
        EXPECT_TRUE(ends(bake->job()));
        EXPECT_EQ(bake->job().state(), JobState::kDone) << bake->job().error();
        return std::pair(bake->isQuick(), bake->output());
    };
    const auto quick = run(BakeDetail::kQuick), full = run(BakeDetail::kAll);
    EXPECT_TRUE(quick.first);
    EXPECT_FALSE(full.first);
    EXPECT_NE(quick.second, full.second);
    EXPECT_EQ(run(BakeDetail::kQuick), std::pair(false, full.second)) << "there is no need any more";
    std::string arguments;
    std::getline(std::ifstream(folder.file("pointrt-bake.log")), arguments);
    EXPECT_SAYS(arguments, "*--every 10 *-- *");
    scan_bytes = 100'000;
    EXPECT_FALSE(run(BakeDetail::kQuick).first) << "too small to be worth it";
}

TEST_F(Bake, IsCancelled) {
    const auto bake = start("trap 'echo asked > \"$0.asked\"; exit 143' TERM; echo 'progress 0.5 octree 0'\n"
                            "while true; do sleep 0.01; done");
    ASSERT_TRUE(waitFor([&] { return bake->job().status().progress == 0.5; }));
    bake->job().cancel();
    ASSERT_TRUE(ends(bake->job()));
    EXPECT_EQ(bake->job().state(), JobState::kCancelled);
    EXPECT_TRUE(fs::exists(folder.file("pointrt-bake.asked")));
    EXPECT_TRUE(fs::is_empty(folder.file("cache")));
}

} // namespace
} // namespace pointrt
