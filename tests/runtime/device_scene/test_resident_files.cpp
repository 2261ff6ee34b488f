// SPDX-License-Identifier: Apache-2.0
// Slots, byte accounting and eviction order of resident files, without a device.
#include "runtime/device_scene/resident_files.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace pointrt {
namespace {

DeviceScan scanAt(const std::string& path) {
    DeviceScan scan;
    scan.path = path;
    return scan;
}

std::vector<std::string> pathsOf(const ResidentFiles& files) {
    std::vector<std::string> paths;
    for (const DeviceScan& file : files) paths.push_back(file.path);
    return paths;
}

using Paths = std::vector<std::string>;
constexpr auto kAny = [](std::uint32_t) { return true; };

/// Three tiles of 1, 2 and 4 bytes.
class ResidentFilesTest : public testing::Test {
protected:
    std::uint32_t add(const std::string& path, std::uint64_t bytes, Eviction eviction = Eviction::kAllowed) {
        return files_.add(scanAt(path), bytes, eviction);
    }

    ResidentFiles files_;
    const std::uint32_t a_ = add("a", 1), b_ = add("b", 2), c_ = add("c", 4);
};

TEST_F(ResidentFilesTest, Removing_KeepsSlotsAndAddressesOfOthers) {
    const DeviceScan* const b = &files_[b_];
    const DeviceScan* const c = &files_[c_];
    EXPECT_EQ(files_.remove(a_).path, "a");
    for (int k = 0; k < 100; ++k) add("more", 0);
    EXPECT_EQ(&files_[b_], b);
    EXPECT_EQ(&files_[c_], c);
    EXPECT_EQ(files_[b_].path, "b");
    EXPECT_EQ(files_[c_].path, "c");
}

TEST_F(ResidentFilesTest, Adding_ReusesTheLowestFreeSlot) {
    files_.remove(b_);
    files_.remove(a_);
    EXPECT_EQ(add("d", 0), a_);
    EXPECT_EQ(add("e", 0), b_);
    EXPECT_EQ(add("f", 0), 3u);
    EXPECT_EQ(files_.find("e"), b_);
    EXPECT_EQ(files_.find("b"), std::nullopt);
}

TEST_F(ResidentFilesTest, Iteration_IsInTheOrderOfAdding) {
    files_.remove(a_);
    add("d", 0);
    EXPECT_EQ(pathsOf(files_), (Paths{"b", "c", "d"})) << "though d has the slot of a";
    for (DeviceScan& file : files_) file.path += "!";
    EXPECT_EQ(pathsOf(files_), (Paths{"b!", "c!", "d!"}));
}

TEST_F(ResidentFilesTest, Bytes_AreThoseOfResidentFiles) {
    EXPECT_EQ(files_.bytes(), 7u);
    add("pinned", 8, Eviction::kNever);
    EXPECT_EQ(files_.bytes(), 15u);
    files_.remove(b_);
    EXPECT_EQ(files_.bytes(), 13u);
    EXPECT_EQ(files_.size(), 3u);
    EXPECT_EQ(files_.evictable(), 2u);
}

TEST_F(ResidentFilesTest, Eviction_TakesTheLeastRecentlyUsedFirst) {
    EXPECT_EQ(files_.leastRecentlyUsed(kAny), a_) << "none was used: the first";
    files_.use(a_);
    EXPECT_EQ(files_.leastRecentlyUsed(kAny), b_) << "files never used go before others";
    files_.use(b_);
    files_.use(c_);
    EXPECT_EQ(files_.leastRecentlyUsed(kAny), a_);
    files_.use(a_);
    EXPECT_EQ(files_.leastRecentlyUsed(kAny), b_);
    EXPECT_EQ(files_.leastRecentlyUsed([&](std::uint32_t slot) { return slot != b_; }), c_);
}

TEST_F(ResidentFilesTest, Eviction_NeverTakesPinnedFiles) {
    ResidentFiles pinned;
    pinned.add(scanAt("scan"), 1, Eviction::kNever);
    EXPECT_EQ(pinned.leastRecentlyUsed(kAny), std::nullopt);
}

TEST_F(ResidentFilesTest, ReusedSlots_AreNotUsedYet) {
    for (const std::uint32_t slot : {a_, b_, c_}) files_.use(slot);
    files_.remove(c_);
    const std::uint32_t d = add("d", 0);
    EXPECT_EQ(d, c_);
    EXPECT_EQ(files_.leastRecentlyUsed(kAny), d);
}

TEST_F(ResidentFilesTest, FreeSlots_CannotBeRead) {
    files_.remove(b_);
    EXPECT_THROW(files_.at(b_), std::out_of_range);
    EXPECT_THROW(files_.at(3), std::out_of_range);
    EXPECT_EQ(files_.at(c_).path, "c");
}

} // namespace
} // namespace pointrt
