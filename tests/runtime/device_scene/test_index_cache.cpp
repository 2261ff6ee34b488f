// SPDX-License-Identifier: Apache-2.0
// The index cache returns the built words, for the same file only, and stays below its size limit.
#include "runtime/device_scene/index_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "format/base/error.h"
#include "format/index/build_index.h"
#include "pointrt/pro.hpp"
#include "tests/format/file_bytes.h"
#include "tests/format/scene_builder.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
    void operator()(pro_file* file) const { pro_close(file); }
};
using File = std::unique_ptr<pro_file, CloseFile>;

File openFile(const std::string& path) {
    pro_file* file = nullptr;
    pro_message message{};
    checkPro(pro_open(path.c_str(), PRO_OPEN_TRACE, &file, &message), path, message);
    return File(file);
}

/// Discs on a sheet, different for each seed.
test::Scene sheet(unsigned seed) {
    std::vector<pro_splat> splats;
    for (unsigned k = 0; k < 2000; ++k) {
        // primes, which spread the splats over the sheet
        const unsigned x = (k * 7919 + seed) % 1000, y = k * 104729 % 1000;
        splats.push_back({{float(x) / 1024, float(y) / 1024, 0.5f}, {0, 0, 1}, 0.02f, {}, 0});
    }
    return test::sceneOf(splats);
}

/// A file without an index, its index, and a cache folder.
struct Kept {
    explicit Kept(unsigned seed = 1) : scene(sheet(seed)), path(folder.file("scan.pro")) {
        writePro(path, scene.info, scene.view());
        file = openFile(path);
        built = buildTracingIndex(scene.info, scene.view());
    }
    std::string keep() const { return cacheIndex(store, file.get(), indexView(built)); }
    File open() const { return File(openCachedIndex(store, file.get())); }
    /// The path of the only cached file.
    std::string keptPath() const { return fs::directory_iterator(store.folder)->path().string(); }

    test::TemporaryFolder folder;
    test::Scene scene;
    std::string path;
    File file;
    TracingIndex built;
    FileCache store{folder.file("a/b"), ".pro", std::uint64_t{64} << 20};
};

void expectWords(const Words& words, const std::uint32_t* kept) {
    EXPECT_TRUE(std::equal(words.begin(), words.end(), kept));
}

TEST(IndexCache, CachedIndex_IsTheBuiltOne) {
    const Kept kept;
    EXPECT_EQ(kept.open(), nullptr) << "the cache is empty";
    ASSERT_EQ(kept.keep(), "");
    const File again = kept.open();
    ASSERT_NE(again, nullptr);
    pro_index index;
    ASSERT_EQ(pro_get_index(again.get(), &index), 1);
    const pro_index built = indexView(kept.built);
    EXPECT_EQ(index.brick_count, built.brick_count);
    EXPECT_EQ(index.cell_count, built.cell_count);
    EXPECT_EQ(index.near_count, built.near_count);
    EXPECT_EQ(index.blending_count, built.blending_count);
    expectWords(kept.built.grid.words, index.grid);
    expectWords(kept.built.bricks.words, index.bricks);
    expectWords(kept.built.bricks.cells, index.cells);
    expectWords(kept.built.bricks.slabs, index.slabs);
    expectWords(kept.built.bricks.near, index.near_splats);
    expectWords(kept.built.bricks.listed, index.listed);
    expectWords(kept.built.bricks.blending, index.blending);
}

TEST(IndexCache, Folders_AreForTheUserOnly) {
    const Kept kept;
    ASSERT_EQ(kept.keep(), "");
    for (const char* each : {"a", "a/b"})
        EXPECT_EQ(fs::status(kept.folder.file(each)).permissions(), fs::perms::owner_all) << each;
}

TEST(IndexCache, DamagedFiles_AreIgnored) {
    const Kept kept;
    ASSERT_EQ(kept.keep(), "");
    const std::string path = kept.keptPath();
    const test::Bytes good = test::readBytes(path);
    for (const std::uint32_t kind : {PRO_KIND_ENTR, PRO_KIND_BRKS, PRO_KIND_CELS, PRO_KIND_DSPL, PRO_KIND_BLDS}) {
        test::Bytes bytes = good;
        test::storeAt(bytes, test::sectionOf(bytes, kind), 0xFFFFFFF0u);
        test::writeBytes(path, bytes);
        EXPECT_EQ(kept.open(), nullptr) << "a checksum does not match";
    }
    for (const std::uint32_t kind : {PRO_KIND_ENTR, PRO_KIND_BRKS, PRO_KIND_CELS, PRO_KIND_DSPL}) {
        test::Bytes bytes = good;
        test::storeAt(bytes, test::sectionOf(bytes, kind), 0xFFFFFFF0u);
        test::fixChecksums(bytes);
        test::writeBytes(path, bytes);
        EXPECT_EQ(kept.open(), nullptr) << "an index is out of range";
    }
    for (const std::size_t bytes : {std::size_t{0}, std::size_t{100}, good.size() / 2, good.size() - 1}) {
        test::writeBytes(path, test::Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(bytes)));
        EXPECT_EQ(kept.open(), nullptr) << "truncated";
    }
    ASSERT_EQ(kept.keep(), "") << "a rebuilt index replaces it";
    EXPECT_NE(kept.open(), nullptr);
}

TEST(IndexCache, IndicesOfOtherFiles_AreIgnored) {
    const Kept kept, other(2);
    ASSERT_EQ(kept.keep(), "");
    ASSERT_EQ(other.keep(), "");
    fs::copy_file(other.keptPath(), kept.keptPath(), fs::copy_options::overwrite_existing);
    EXPECT_EQ(kept.open(), nullptr);
    fs::copy_file(kept.path, kept.keptPath(), fs::copy_options::overwrite_existing);
    EXPECT_EQ(kept.open(), nullptr) << "it has no index";
}

TEST(IndexCache, Failures_AreReported) {
    Kept kept;
    kept.store.most_bytes = 1000;
    EXPECT_HAS(kept.keep(), "no room");
    kept.store.most_bytes = std::uint64_t{64} << 20;
    kept.store.folder = kept.path + "/below/a/file";
    EXPECT_NE(kept.keep(), "");
    EXPECT_EQ(kept.open(), nullptr);
    kept.store.folder.clear();
    EXPECT_NE(kept.keep(), "");
    EXPECT_EQ(kept.open(), nullptr);
}

/// Creates a file of a size that was last used some hours ago.
std::string leave(const FileCache& kept, const std::string& name, std::size_t bytes, int hours) {
    const std::string path = kept.folder + "/" + name;
    test::writeBytes(path, test::Bytes(bytes));
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(hours));
    return path;
}

TEST(FileCache, LeastRecentlyUsed_IsDeletedFirst) {
    const test::TemporaryFolder folder;
    const FileCache kept{folder.path.string(), ".pro", 1000};
    const std::string old = leave(kept, "old.pro", 300, 3), oldest = leave(kept, "oldest.pro", 300, 4),
                      recent = leave(kept, "recent.pro", 300, 2), strange = leave(kept, "strange.txt", 5000, 9),
                      left = leave(kept, "new.pro.tmp-abcdefgh", 100, 5);
    EXPECT_TRUE(makeRoomFor(kept, 0));
    EXPECT_EQ(folder.entries(), 5u) << "all fit";
    markUsed(oldest);
    EXPECT_TRUE(makeRoomFor(kept, 350));
    EXPECT_FALSE(fs::exists(left));
    EXPECT_FALSE(fs::exists(old));
    EXPECT_TRUE(fs::exists(recent));
    EXPECT_TRUE(fs::exists(oldest)) << "it was used just now";
    EXPECT_TRUE(makeRoomFor(kept, 1000));
    EXPECT_EQ(folder.entries(), 1u);
    EXPECT_TRUE(fs::exists(strange)) << "not a file of the cache";
}

TEST(FileCache, TooLargeFiles_DeleteNothing) {
    const test::TemporaryFolder folder;
    const FileCache kept{folder.path.string(), ".pro", 1000};
    leave(kept, "a.pro", 900, 1);
    EXPECT_FALSE(makeRoomFor(kept, 1001));
    EXPECT_EQ(folder.entries(), 1u);
}

/// Sets an environment variable while it lives.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        value ? setenv(name, value, 1) : unsetenv(name);
    }
    ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
    std::optional<std::string> before_;
};

TEST(UserIndexCache, Folder_IsInTheCacheFolder) {
    const Variable home("HOME", "/home/me"), size("POINTRT_INDEX_CACHE", nullptr);
    {
        const Variable cache("XDG_CACHE_HOME", "/somewhere");
        EXPECT_EQ(userIndexCache().folder, "/somewhere/pointrt/index");
        EXPECT_EQ(userIndexCache().most_bytes, kIndexCacheBytes);
    }
    for (const char* none : {static_cast<const char*>(nullptr), "", "not/absolute"}) {
        const Variable cache("XDG_CACHE_HOME", none);
        EXPECT_EQ(userIndexCache().folder, "/home/me/.cache/pointrt/index");
    }
    const Variable cache("XDG_CACHE_HOME", nullptr), homeless("HOME", nullptr);
    EXPECT_EQ(userIndexCache().folder, "");
}

TEST(UserIndexCache, Size_IsSetByTheUser) {
    const Variable cache("XDG_CACHE_HOME", "/somewhere");
    {
        const Variable size("POINTRT_INDEX_CACHE", "20G");
        EXPECT_EQ(userIndexCache().most_bytes, std::uint64_t{20} << 30);
    }
    {
        const Variable size("POINTRT_INDEX_CACHE", "off");
        EXPECT_EQ(userIndexCache().folder, "");
    }
    const Variable size("POINTRT_INDEX_CACHE", "much");
    try {
        userIndexCache();
        FAIL() << "\"much\" was taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadUsage);
        EXPECT_SAYS(error.what(), "POINTRT_INDEX_CACHE: \"much\" *size*off");
    }
}

} // namespace
} // namespace pointrt
