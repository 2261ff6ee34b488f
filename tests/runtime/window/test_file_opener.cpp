// SPDX-License-Identifier: Apache-2.0
// Opening, dropping and stepping through files.
#include "runtime/window/edit/file_opener.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>

#include "runtime/window/edit/recent_files.h"
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
                          for (const std::string& added : scene.added) loads += " + " + added;
                          return startedJob<NoWork>(std::make_unique<NoWork>(), {});
                      }};
};

TEST_F(FileOpenerTest, OnlyTheFirstLoadIsFlagged) {
    opener.openNamed({{"a.pro"}, {}});
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
    EXPECT_EQ(next(), "a.toml");
    opener.drop({"b.toml", "c.pro"});
    EXPECT_SAYS(messages, "*first *2 files");
    EXPECT_EQ(next(), "b.toml");
}

TEST_F(FileOpenerTest, OpensBakedScansTogether) {
    opener.drop({"b.pro", "c.pro"});
    EXPECT_EQ(next(), "b.pro + c.pro");
    EXPECT_EQ(messages, "");
    opener.openNamed({{"d.pro", "e.pro"}, {}});
    EXPECT_EQ(next(), "d.pro first + e.pro");
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
    EXPECT_EQ(next(), "a.pro");
    std::filesystem::remove(folder.file("b.pro"));
    opener.openNeighbour(folder.file("a.pro"), 1);
    EXPECT_FALSE(jobs.status()->detail == "cancelling") << "there is no other";
}

TEST(RecentFiles, AreListedOnceTheLatestFirst) {
    const test::TemporaryFolder folder;
    const std::string state = folder.file("state/pointrt");
    EXPECT_TRUE(recentFiles(state).empty());
    const std::string a = folder.write("a.laz", ""), b = folder.write("b.laz", "");
    for (const std::string& path : {a, b, a, folder.file("gone.laz")}) addRecentFile(state, path);
    EXPECT_EQ(recentFiles(state), (std::vector<std::string>{a, b}));
    for (int i = 0; i < 20; ++i) addRecentFile(state, folder.write(std::to_string(i) + ".laz", ""));
    EXPECT_EQ(recentFiles(state).size(), 10u);
    EXPECT_EQ(recentFiles(state).front(), folder.file("19.laz"));
    folder.write("state/pointrt/recent", std::string(100000, 'x') + "\n\n\x01\nrelative.laz\n" + a);
    EXPECT_EQ(recentFiles(state), std::vector<std::string>{a}) << "whatever else is in the list";
    addRecentFile("", a);
    EXPECT_TRUE(recentFiles("").empty());
}

} // namespace
} // namespace pointrt
