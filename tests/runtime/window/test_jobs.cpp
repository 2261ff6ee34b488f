// SPDX-License-Identifier: Apache-2.0
// Background jobs: threads, and child processes, which are scripts here.
#include "runtime/window/edit/job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <memory>
#include <thread>

#include "format/base/error.h"
#include "runtime/window/edit/bake_job.h"
#include "runtime/window/edit/bake_sources.h"
#include "runtime/window/edit/child_process.h"
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

std::string refusal(const std::function<void()>& body) {
    try {
        body();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
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
        id = child.id();
        EXPECT_EQ(kill(id, 0), 0);
    }
    EXPECT_NE(kill(id, 0), 0);
    EXPECT_SAYS(describeExit(SIGKILL), "*9 (Killed)");
}

class Bake : public testing::Test {
protected:
    /// A script to run instead of pointrt-bake: $4 is the output, $5 the first input.
    std::string baker(const std::string& body) const {
        const std::string path = folder.write("pointrt-bake", "#!/bin/sh\n" + body + "\n");
        fs::permissions(path, fs::perms::owner_all);
        return path;
    }
    std::unique_ptr<BakeJob> start(const std::string& body) const {
        return std::make_unique<BakeJob>(BakePlan{{folder.file("a scan\n.ply")}, folder.file("out.pro")}, baker(body));
    }
    std::string failure(const std::string& body) const {
        const auto bake = start(body);
        EXPECT_TRUE(ends(bake->job()));
        EXPECT_EQ(bake->job().state(), JobState::kFailed);
        return bake->job().error();
    }

    const test::TemporaryFolder folder;
};

TEST_F(Bake, ShowsProgress) {
    const auto bake = start("printf 'hello\\nprogress 0.2500 nor' >&2; echo 'mals 1234567' >&2\n"
                            "while [ ! -e \"$0.go\" ]; do sleep 0.01; done; echo \"$@\" > \"$4\"");
    ASSERT_TRUE(waitFor([&] { return bake->job().status().progress.has_value(); }));
    const JobStatus status = bake->job().status();
    EXPECT_EQ(status.title, "Baking a scan\n.ply");
    EXPECT_EQ(status.detail, "normals, 1.2 M points/s");
    EXPECT_EQ(status.progress, 0.25);
    folder.write("pointrt-bake.go", "");
    ASSERT_TRUE(ends(bake->job()));
    EXPECT_EQ(bake->job().state(), JobState::kDone) << bake->job().error();
    std::ifstream output(bake->output());
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(output), {}),
              "--progress lines -o " + folder.file("out.pro") + " " + folder.file("a scan\n.ply") + "\n");
}

TEST_F(Bake, ReportsTheToolsReason) {
    EXPECT_EQ(failure("echo 'progress 0.1 read 0'; echo 'pointrt-bake: error: scan.ply: is empty' >&2; exit 1"),
              "scan.ply: is empty");
    EXPECT_EQ(failure("printf 'no end of line' >&2; exit 1"), "no end of line");
    EXPECT_SAYS(failure("exit 3"), "pointrt-bake *status 3");
    EXPECT_SAYS(failure("kill -9 $$"), "pointrt-bake *9 (Killed)");
    EXPECT_SAYS(failure("exit 0"), "pointrt-bake *write *" + folder.file("out.pro"));
    const BakePlan plan{{"scan.ply"}, "out.pro"};
    const BakeJob missing(plan, folder.file("none"));
    ASSERT_TRUE(ends(missing.job()));
    EXPECT_SAYS(missing.job().error(), folder.file("none") + ": *start: No such file or directory");
}

TEST_F(Bake, LimitsLongOutput) {
    EXPECT_EQ(failure("head -c 1000000 /dev/zero | tr '\\0' x >&2; echo >&2; echo last >&2; exit 1"), "last");
}

TEST_F(Bake, IsCancelled) {
    const auto bake = start("trap 'echo asked > \"$0.asked\"; exit 143' TERM; echo 'progress 0.5 octree 0'\n"
                            "while true; do sleep 0.01; done");
    ASSERT_TRUE(waitFor([&] { return bake->job().status().progress.has_value(); }));
    bake->job().cancel();
    ASSERT_TRUE(ends(bake->job()));
    EXPECT_EQ(bake->job().state(), JobState::kCancelled);
    EXPECT_TRUE(fs::exists(folder.file("pointrt-bake.asked")));
}

TEST_F(Bake, IsKilledAndLeavesNoFile) {
    const auto bake = start("trap '' TERM; echo half > \"$4.tmp-$$\"; echo 'progress 0.9 write 0'\n"
                            "while true; do sleep 0.01; done");
    ASSERT_TRUE(waitFor([&] { return bake->job().status().progress.has_value(); }));
    bake->job().cancel();
    ASSERT_TRUE(ends(bake->job()));
    EXPECT_EQ(bake->job().state(), JobState::kCancelled);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1) << "the script alone";
}

TEST_F(Bake, ParsesOnlyProgressLines) {
    Job job("Listening", [](JobControl& control) {
        EXPECT_FALSE(parseBakeProgress("progress", control));
        EXPECT_FALSE(parseBakeProgress("progress 0.5 read", control));
        EXPECT_FALSE(parseBakeProgress("progress 0.5 read 1 more", control));
        EXPECT_FALSE(parseBakeProgress("progress 2 read 1", control));
        EXPECT_FALSE(parseBakeProgress("progress nan read 1", control));
        EXPECT_TRUE(parseBakeProgress("progress 0.5 read 1", control));
    });
    ASSERT_TRUE(ends(job));
    EXPECT_EQ(job.status().detail, "read");
}

class Plan : public testing::Test {
protected:
    /// Adds a .pro with these sources, modified age seconds from now.
    void addPro(const char* name, const std::string& sources, std::chrono::seconds age) const {
        test::Scene scene = test::tinyScene();
        scene.metadata = "{\"writer\":\"pointrt-bake\",\"sources\":" + sources + "}";
        scene.write(folder.file(name));
        fs::last_write_time(folder.file(name), fs::file_time_type::clock::now() - age);
    }
    void addScan(const std::string& name, std::chrono::seconds age) const {
        fs::last_write_time(folder.write(name, "1 2 3\n"), fs::file_time_type::clock::now() - age);
    }
    /// "statue.pro", or "statue.pro is there" if it is up to date
    std::string plan(const std::vector<std::string>& names) const {
        std::vector<std::string> inputs;
        for (const std::string& name : names) inputs.push_back(folder.file(name));
        const BakePlan made = planBake(inputs);
        EXPECT_EQ(made.inputs, inputs);
        return fs::path(made.output).filename().string() + (made.is_up_to_date ? " is there" : "");
    }

    const test::TemporaryFolder folder;
};

TEST_F(Plan, OutputIsBesideTheScan) {
    addScan("statue.ply", 60s);
    EXPECT_EQ(plan({"statue.ply"}), "statue.pro");
    addPro("statue.pro", R"(["statue.ply"])", 30s);
    EXPECT_EQ(plan({"statue.ply"}), "statue.pro is there");
}

TEST_F(Plan, NeverOverwrites) {
    addScan("statue.ply", 60s);
    addScan("statue.xyz", 60s);
    addPro("statue.pro", R"(["statue.ply"])", 90s);
    EXPECT_EQ(plan({"statue.ply"}), "statue.1.pro") << "older than the scan";
    addPro("statue.1.pro", R"(["statue.xyz"])", 30s);
    EXPECT_EQ(plan({"statue.xyz"}), "statue.1.pro is there");
    EXPECT_EQ(plan({"statue.ply"}), "statue.2.pro") << "another scan's";
    folder.write("statue.2.pro", "no scene");
    fs::create_symlink("nowhere", folder.file("statue.3.pro"));
    fs::create_directory(folder.path / "statue.4.pro");
    EXPECT_EQ(plan({"statue.ply"}), "statue.5.pro");
    addPro("statue.6.pro", R"(["statue.ply"])", 30s);
    EXPECT_EQ(plan({"statue.ply"}), "statue.5.pro");
}

TEST_F(Plan, CombinesScans) {
    addScan("a.ply", 60s);
    addScan("b.ply", 20s);
    addPro("a.pro", R"(["a.ply","b.ply"])", 30s);
    EXPECT_EQ(plan({"a.ply", "b.ply"}), "a.1.pro") << "one scan is newer";
    EXPECT_EQ(plan({"a.ply"}), "a.1.pro");
    addPro("a.pro", R"(["a.ply","b.ply"])", 10s);
    EXPECT_EQ(plan({"a.ply", "b.ply"}), "a.pro is there");
}

TEST_F(Plan, HandlesEscapedNames) {
    const std::string name = "a \"b\"\\\n\x01\xc3\xa4.ply";
    addScan(name, 60s);
    addPro("a \"b\"\\\n\x01\xc3\xa4.pro", "[\"a \\\"b\\\"\\\\\\n\\u0001\xc3\xa4.ply\"]", 30s);
    EXPECT_EQ(plan({name}), "a \"b\"\\\n\x01\xc3\xa4.pro is there");
}

TEST_F(Plan, ReadsTheMetadataAsJson) {
    addScan("statue.ply", 60s);
    addPro("statue.pro", "[ \"st\\u0061tue.ply\" ]", 30s);
    EXPECT_EQ(plan({"statue.ply"}), "statue.pro is there") << "spaces and escapes are the writer's choice";
    addPro("statue.pro", R"([],"note":"\"sources\":[\"statue.ply\"]")", 30s);
    EXPECT_EQ(plan({"statue.ply"}), "statue.1.pro") << "a text that looks like it";
}

TEST(BakeSources, AcceptsAnyBytes) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(bakeSources(R"({"sources":["a.ply","b.ply"]})"), (Names{"a.ply", "b.ply"}));
    EXPECT_EQ(bakeSources(R"({"sources":[]})"), Names());
    for (const std::string text :
         {"", "{", "[1]", "7", "{}", R"({"sources":"a.ply"})", R"({"sources":["a.ply",1]})",
          R"({"more":{"sources":["a.ply"]}})", R"({"sources":["a.ply"]} more)", "{\"\xff\":1}"})
        EXPECT_EQ(bakeSources(text), std::nullopt) << text;
    EXPECT_EQ(bakeSources(std::string(100000, '[')), std::nullopt);
}

TEST_F(Plan, RejectsNonFiles) {
    fs::create_directory(folder.path / "scans");
    EXPECT_EQ(refusal([&] { plan({"none.ply"}); }), folder.file("none.ply") + ": No such file or directory");
    EXPECT_SAYS(refusal([&] { plan({"scans"}); }), folder.file("scans") + ": *folder");
    if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
    addScan("scans/statue.ply", 60s);
    fs::permissions(folder.path / "scans", fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_SAYS(refusal([&] { plan({"scans/statue.ply"}); }), folder.file("scans") + ": *write *Permission denied");
    fs::permissions(folder.path / "scans", fs::perms::owner_all);
}

TEST_F(Plan, FindsTheBakeTool) {
    for (const char* name : {"bin", "first", "second"}) fs::create_directory(folder.path / name);
    const std::string path = folder.file("first") + "::" + folder.file("second"), own = folder.file("bin");
    EXPECT_SAYS(refusal([&] { findBakeTool(own, path); }), "pointrt-bake*" + own + " *PATH (" + path + ")");
    folder.write("first/pointrt-bake", "no program");
    fs::permissions(folder.write("second/pointrt-bake", ""), fs::perms::owner_all);
    EXPECT_EQ(findBakeTool(own, path), folder.file("second/pointrt-bake"));
    fs::permissions(folder.write("bin/pointrt-bake", ""), fs::perms::owner_all);
    EXPECT_EQ(findBakeTool(own, path), folder.file("bin/pointrt-bake"));
}

} // namespace
} // namespace pointrt
