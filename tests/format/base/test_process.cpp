// SPDX-License-Identifier: Apache-2.0
// What ends a process says why.
#include "format/base/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <barrier>
#include <string>
#include <thread>
#include <vector>

#include "format/base/mapped_file.h"
#include "pointrt/pro.hpp"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

using format::MappedFile;

constexpr std::size_t kPage = 4096;

/// Maps a file of two pages, cuts it, reads the second one.
int readBehindTheEnd(const std::string& path) {
    prepareProcess("test-tool");
    MappedFile mapped;
    if (!mapped.map(path.c_str()) || truncate(path.c_str(), kPage) != 0) return 99;
    return static_cast<int>(mapped.bytes()[kPage]);
}

TEST(ProcessDeathTest, NamesTheFileThatWasCutShort) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("cut.pro", std::string(2 * kPage, 'x'));
    EXPECT_EXIT(exit(readBehindTheEnd(path)), testing::ExitedWithCode(1),
                "^test-tool: error: .*/cut\\.pro: was cut short while it was read, or its disk fails\n$");
}

/// The same on several threads at once, as a scan is read.
int readTogetherBehindTheEnd(const std::string& path) {
    prepareProcess("test-tool");
    MappedFile mapped;
    if (!mapped.map(path.c_str()) || truncate(path.c_str(), kPage) != 0) return 99;
    constexpr std::ptrdiff_t kThreads = 8;
    std::barrier begin(kThreads);
    std::vector<std::jthread> readers;
    for (std::ptrdiff_t k = 0; k < kThreads; ++k)
        readers.emplace_back([&] {
            begin.arrive_and_wait();
            [[maybe_unused]] const volatile auto read = mapped.bytes()[kPage];
        });
    readers.clear();
    return 98;
}

TEST(ProcessDeathTest, NamesItOnceThoughAllThreadsReadIt) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("cut.pro", std::string(2 * kPage, 'x'));
    EXPECT_EXIT(exit(readTogetherBehindTheEnd(path)), testing::ExitedWithCode(1),
                "^test-tool: error: .*/cut\\.pro: was cut short while it was read, or its disk fails\n$");
}

TEST(ProcessDeathTest, DoesNotBlameFilesForOtherErrors) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("shared", std::string(2 * kPage, 'x'));
    const auto write_behind_the_end = [&] {
        prepareProcess("test-tool");
        const int file = open(path.c_str(), O_RDWR);
        void* const shared = mmap(nullptr, 2 * kPage, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (ftruncate(file, kPage) != 0) exit(99);
        static_cast<volatile char*>(shared)[kPage] = 1;
        exit(0);
    };
    EXPECT_EXIT(write_behind_the_end(), testing::KilledBySignal(SIGBUS), "");
}

TEST(ProcessDeathTest, GivesClosedStreamsNoFile) {
    const auto open_after_close = [] {
        close(STDOUT_FILENO);
        prepareProcess("test-tool");
        const int file = open("/dev/null", O_WRONLY);
        exit(file > STDERR_FILENO && write(STDOUT_FILENO, "x", 1) < 0 ? 7 : 8);
    };
    EXPECT_EXIT(open_after_close(), testing::ExitedWithCode(7), "");
}

TEST(ProcessDeathTest, FailsWritesPastTheLimit) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("large");
    const auto write_past_the_limit = [&] {
        prepareProcess("test-tool");
        const rlimit limit{kPage, kPage};
        setrlimit(RLIMIT_FSIZE, &limit);
        const int file = open(path.c_str(), O_WRONLY | O_CREAT, 0600);
        const std::string text(2 * kPage, 'x');
        while (write(file, text.data(), text.size()) > 0) {
        }
        exit(errno == EFBIG ? 7 : 8);
    };
    EXPECT_EXIT(write_past_the_limit(), testing::ExitedWithCode(7), "");
}

TEST(MappedFile, CallsLackOfMemoryWhatItIs) {
    const int file = memfd_create("vast", MFD_CLOEXEC);
    ASSERT_EQ(ftruncate(file, off_t{1} << 50), 0) << "more than there are addresses";
    const std::string path = "/proc/self/fd/" + std::to_string(file);
    pro_file* opened = nullptr;
    EXPECT_EQ(pro_open(path.c_str(), 0, &opened, nullptr), PRO_OUT_OF_MEMORY);
    close(file);
}

} // namespace
} // namespace pointrt
