// SPDX-License-Identifier: Apache-2.0
// Opening, dropping and stepping through files.
#include "runtime/window/edit/file_opener.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>

#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

struct NoWork {
    Job& job() { return job_; }
    Job job_{"Loading", [](JobControl& control) {
                 while (!control.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
             }};
};

class FileOpenerTest : public testing::Test {
protected:
    /// The next file to load, without its folder.
    std::string next() {
        loads.clear();
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (loads.empty() && std::chrono::steady_clock::now() < end) {
            jobs.poll();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return loads;
    }

    const test::TemporaryFolder folder;
    std::string loads, messages;
    JobQueue jobs{[](const std::string&, bool) {}};
    FileOpener opener{jobs,
                      [this](const std::string& text, bool error) { messages += (error ? "error: " : "") + text; },
                      [this](const SceneSource& scene, bool first) {
                          loads += std::filesystem::path(scene.path).filename().string() + (first ? " first" : "");
                          return startedJob<NoWork>(std::make_unique<NoWork>(), {});
                      }};
};

TEST_F(FileOpenerTest, OnlyTheFirstLoadIsFlagged) {
    opener.open({"a.pro", {}, false});
    EXPECT_EQ(loads, "") << "not before the queue is polled";
    EXPECT_EQ(next(), "a.pro first");
    opener.open({"b.pro", {}, false});
    EXPECT_EQ(next(), "b.pro");
}

TEST_F(FileOpenerTest, OpensTheFirstDroppedScene) {
    opener.drop({});
    EXPECT_FALSE(jobs.any());
    opener.drop({"a.toml"});
    EXPECT_EQ(messages, "");
    EXPECT_EQ(next(), "a.toml first");
    opener.drop({"b.pro", "c.pro"});
    EXPECT_SAYS(messages, "*first *2 files");
    EXPECT_EQ(next(), "b.pro");
}

TEST_F(FileOpenerTest, ReportsMissingScans) {
    opener.drop({folder.write("a.xyz", "0 0 0\n"), folder.file("none.ply")});
    EXPECT_EQ(messages, "error: " + folder.file("none.ply") + ": No such file or directory");
    EXPECT_FALSE(jobs.any());
}

TEST_F(FileOpenerTest, BakesOneScanAtATime) {
    const std::string scan = folder.write("a.xyz", "0 0 0\n");
    jobs.start(JobKind::kBake, [] { return startedJob<NoWork>(std::make_unique<NoWork>(), {}); });
    opener.drop({scan});
    EXPECT_SAYS(messages, "error: Loading *one scan");
}

TEST_F(FileOpenerTest, StepsThroughTheFolder) {
    for (const char* name : {"a.pro", "b.pro", "note.txt"}) folder.write(name, "");
    opener.openNeighbour(folder.file("b.pro"), 1);
    EXPECT_EQ(next(), "a.pro first");
    std::filesystem::remove(folder.file("b.pro"));
    opener.openNeighbour(folder.file("a.pro"), 1);
    EXPECT_FALSE(jobs.status()->detail == "cancelling") << "there is no other";
}

} // namespace
} // namespace pointrt
