// SPDX-License-Identifier: Apache-2.0
// The cache of baked scans; scripts replace pointrt-bake.
#include "runtime/session/bake_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "format/base/error.h"
#include "runtime/session/bake_key.h"
#include "runtime/session/find_tool.h"
#include "tests/format/tiny_scene.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string refusalOf(const std::function<void()>& body) {
    try {
        body();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

struct BakeCache : testing::Test {
    /// A script that runs body, then copies a .pro to the output. Each run adds a line with its arguments to the log.
    std::string baker(const std::string& body = "") const {
        const std::string path = folder.write("pointrt-bake", "#!/bin/sh\necho \"$*\" >> \"$0.log\"\n" + body +
                                                                  "\ncp \"$0.pro\" \"$5.tmp-$$\" && "
                                                                  "mv \"$5.tmp-$$\" \"$5\"\n");
        fs::permissions(path, fs::perms::owner_all);
        fs::last_write_time(path, fs::file_time_type{}); // so that all versions look the same, whatever they do
        test::tinyScene().write(path + ".pro");
        return path;
    }
    std::string bake(const ScanBake& scans, const std::string& tool) const {
        BakeMonitor monitor;
        monitor.progress = [](double, const std::string&) {};
        return bakeCached(cache, scans, tool, monitor);
    }
    std::string failure(const std::string& body) const {
        return refusalOf([&] { bake({{scan}, {}}, baker(body)); });
    }
    std::size_t runs() const {
        std::ifstream log(folder.file("pointrt-bake.log"));
        std::size_t lines = 0;
        for (std::string line; std::getline(log, line);) ++lines;
        return lines;
    }

    const test::TemporaryFolder folder;
    const std::string scan = folder.write("a scan.xyz", "0 0 0\n");
    FileCache cache{folder.file("cache"), ".pro", 1 << 20};
};

TEST_F(BakeCache, BakesOnceForTheSameContentAndOptions) {
    const std::string tool = baker(), first = bake({{scan}, {"--clean", "off"}}, tool);
    EXPECT_TRUE(isCachedBake(cache, first));
    EXPECT_FALSE(isCachedBake(cache, scan));
    std::string arguments;
    std::getline(std::ifstream(folder.file("pointrt-bake.log")), arguments);
    EXPECT_EQ(arguments, "--progress lines --force -o " + first + " --clean off -- " + scan);
    EXPECT_EQ(bake({{scan}, {"--clean", "off"}}, tool), first);
    fs::create_directory(folder.file("elsewhere"));
    fs::copy(scan, folder.file("elsewhere/a scan.xyz"));
    EXPECT_EQ(bake({{folder.file("elsewhere/a scan.xyz")}, {"--clean", "off"}}, tool), first) << "a moved copy";
    EXPECT_EQ(runs(), 1u);
    EXPECT_NE(bake({{scan}, {}}, tool), first) << "other options";
    EXPECT_NE(bake({{scan, scan}, {"--clean", "off"}}, tool), first) << "other scans";
    folder.write("a scan.xyz", "0 0 1\n");
    EXPECT_NE(bake({{scan}, {"--clean", "off"}}, tool), first) << "other content of the same size";
    EXPECT_EQ(runs(), 4u);
}

TEST_F(BakeCache, FilesThatScansAndOptionsNameCount) {
    fs::create_directory(folder.file("meshes"));
    const std::string tool = baker(), mesh = folder.write("meshes/a.obj", "mtllib a.mtl\n");
    folder.write("meshes/a.mtl", "Kd 1 1 1\n");
    const std::string turn = folder.write("turn.txt", "1 0 0 0\n");
    const ScanBake with_materials{{mesh}, {}}, turned{{scan}, {"--transform", turn}},
        joined{{scan}, {"--transform=" + turn}}, of_folder{{folder.file("meshes")}, {}};
    std::vector<std::string> before;
    for (const ScanBake& each : {with_materials, turned, joined, of_folder}) before.push_back(bake(each, tool));
    folder.write("meshes/a.mtl", "Kd 1 0 0 1\n");
    folder.write("turn.txt", "2 0 0 0\n");
    std::size_t at = 0;
    for (const ScanBake& each : {with_materials, turned, joined, of_folder}) EXPECT_NE(bake(each, tool), before[at++]);
    before[0] = bake(with_materials, tool);
    folder.write("meshes/scene.toml", "");
    EXPECT_EQ(bake(with_materials, tool), before[0]) << "what the viewer saves there";
}

TEST_F(BakeCache, DamagedBakesAreReplaced) {
    const std::string tool = baker(), path = bake({{scan}, {}}, tool);
    fs::resize_file(path, fs::file_size(path) / 2);
    EXPECT_EQ(bake({{scan}, {}}, tool), path);
    EXPECT_EQ(runs(), 2u);
    EXPECT_EQ(fs::file_size(path), fs::file_size(tool + ".pro"));
}

TEST_F(BakeCache, ReportsTheToolsReason) {
    EXPECT_EQ(failure("echo 'progress 0.1 read 0'; echo 'pointrt-bake: error: scan.ply: is empty' >&2; exit 1"),
              "scan.ply: is empty");
    EXPECT_EQ(failure("printf 'no end of line' >&2; exit 1"), "no end of line");
    EXPECT_EQ(failure("head -c 1000000 /dev/zero | tr '\\0' x >&2; echo >&2; echo last >&2; exit 1"), "last");
    EXPECT_SAYS(failure("exit 3"), "pointrt-bake *status 3");
    EXPECT_SAYS(failure("kill -9 $$"), "pointrt-bake *9 (Killed)");
    EXPECT_SAYS(failure("exit 0"), "pointrt-bake *write *" + folder.file("cache"));
    EXPECT_TRUE(fs::is_empty(folder.file("cache"))) << "no locks, nothing half-written";
    EXPECT_SAYS(refusalOf([&] {
                    bake({{folder.file("none.ply")}, {}}, baker());
                }),
                folder.file("none.ply") + ": No such file or directory");
    cache.folder.clear();
    EXPECT_SAYS(failure(""), scan + ": *cache*off*");
}

TEST_F(BakeCache, TwoProcessesBakeOnce) {
    const std::string tool = baker("sleep 0.3");
    std::string paths[2];
    {
        const std::jthread other([&] { paths[0] = bake({{scan}, {}}, tool); });
        paths[1] = bake({{scan}, {}}, tool);
    }
    EXPECT_EQ(paths[0], paths[1]);
    EXPECT_EQ(runs(), 1u);
    EXPECT_EQ(std::distance(fs::directory_iterator(cache.folder), {}), 1) << "no lock is left";
}

TEST_F(BakeCache, CancellingLeavesNothing) {
    std::atomic<bool> cancelled = false;
    BakeMonitor monitor;
    monitor.cancelled = [&] { return cancelled.load(); };
    monitor.progress = [&](double share, const std::string&) { cancelled = share > 0; };
    const std::string tool = baker("echo 'progress 0.5 octree 0'; sleep 100");
    EXPECT_EQ(bakeCached(cache, {{scan}, {}}, tool, monitor), "");
    EXPECT_TRUE(fs::is_empty(cache.folder));
    cancelled = true;
    EXPECT_EQ(bakeCached(cache, {{scan}, {}}, tool, monitor), "") << "while the scan is read";
}

TEST_F(BakeCache, KeepsTheLatestBakesThatFit) {
    const std::string tool = baker();
    cache.most_bytes = 5 * fs::file_size(tool + ".pro") / 2;
    std::vector<std::string> paths;
    for (const char* option : {"-1", "-2", "-3"}) {
        paths.push_back(bake({{scan}, {option}}, tool));
        std::this_thread::sleep_for(5ms); // file times must differ
    }
    EXPECT_FALSE(fs::exists(paths[0]));
    EXPECT_TRUE(fs::exists(paths[1]) && fs::exists(paths[2]));
    cache.most_bytes = 1;
    EXPECT_TRUE(fs::exists(bake({{scan}, {"-4"}}, tool))) << "never the one that is opened now";
    EXPECT_FALSE(fs::exists(paths[1]) || fs::exists(paths[2]));
}

TEST_F(BakeCache, FindsTheBakeTool) {
    for (const char* name : {"bin", "first", "second"}) fs::create_directory(folder.path / name);
    const std::string path = folder.file("first") + "::" + folder.file("second"), own = folder.file("bin");
    EXPECT_SAYS(refusalOf([&] { findTool(kBakeTool, own, path); }), "pointrt-bake*" + own + " *PATH (" + path + ")");
    folder.write("first/pointrt-bake", "no program");
    fs::permissions(folder.write("second/pointrt-bake", ""), fs::perms::owner_all);
    EXPECT_EQ(findTool(kBakeTool, own, path), folder.file("second/pointrt-bake"));
    fs::permissions(folder.write("bin/pointrt-bake", ""), fs::perms::owner_all);
    EXPECT_EQ(findTool(kBakeTool, own, path), folder.file("bin/pointrt-bake"));
}

TEST(QuickBake, UnpacksTwoMillionPointsAtMost) {
    const test::TemporaryFolder folder;
    const auto optionsFor = [&](const std::string& name, std::size_t bytes) {
        const std::optional<ScanBake> quick = quickBake({{folder.write(name, std::string(bytes, 'x'))}, {"--up", "z"}});
        return quick ? quick->options : std::vector<std::string>{};
    };
    using Options = std::vector<std::string>;
    const Options rough{"--clean", "off", "--prune", "off", "--up", "z"};
    const auto with = [&](Options options, const Options& more) {
        options.insert(options.end(), rough.begin(), rough.begin() + 4);
        options.insert(options.end(), more.begin(), more.end());
        options.insert(options.end(), rough.begin() + 4, rough.end());
        return options;
    };
    EXPECT_EQ(optionsFor("a.laz", 1'000'000), with({"--every", "10"}, {}));
    // 4 million points of 5 bytes: half of them are unpacked, and every fortieth of those leaves 50,000
    EXPECT_EQ(optionsFor("b.LAZ", 20'000'000), with({"--every", "40"}, {"--skim", "0.5"}));
    EXPECT_EQ(optionsFor("c.las", 20'000'000), with({"--every", "40"}, {}));
    EXPECT_TRUE(optionsFor("d.laz", 200'000).empty()) << "too small to be worth it";
}

} // namespace
} // namespace pointrt
