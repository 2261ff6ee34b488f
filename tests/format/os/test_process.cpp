// SPDX-License-Identifier: Apache-2.0
// Processes end with a reason on stderr.
#include "format/os/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <barrier>
#include <csignal>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "format/os/mapped_file.h"
#include "pointrt/pro.hpp"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

using format::MappedFile;

constexpr std::size_t kPage = 4096;

/// Maps a file of two pages, truncates it and reads the second page.
int readPastTheEnd(const std::string& path) {
    prepareProcess("test-tool");
    MappedFile mapped;
    if (!mapped.map(path.c_str()) || truncate(path.c_str(), kPage) != 0) return 99;
    return static_cast<int>(mapped.bytes()[kPage]);
}

TEST(ProcessDeathTest, NamesTheTruncatedFile) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("cut.pro", std::string(2 * kPage, 'x'));
    EXPECT_EXIT(exit(readPastTheEnd(path)), testing::ExitedWithCode(1),
                "^test-tool: error: .*/cut\\.pro: .*truncated.*\n$");
}

/// The same on several threads at once, as when a scan is read.
int readPastTheEndOnAllThreads(const std::string& path) {
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

TEST(ProcessDeathTest, NamesTheTruncatedFileOnceForAllThreads) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("cut.pro", std::string(2 * kPage, 'x'));
    EXPECT_EXIT(exit(readPastTheEndOnAllThreads(path)), testing::ExitedWithCode(1),
                "^test-tool: error: .*/cut\\.pro: .*truncated.*\n$");
}

TEST(ProcessDeathTest, DoesNotBlameFilesForOtherErrors) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("shared", std::string(2 * kPage, 'x'));
    const auto write_past_the_end = [&] {
        prepareProcess("test-tool");
        const int file = open(path.c_str(), O_RDWR);
        void* const shared = mmap(nullptr, 2 * kPage, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (ftruncate(file, kPage) != 0) exit(99);
        static_cast<volatile char*>(shared)[kPage] = 1;
        exit(0);
    };
    EXPECT_EXIT(write_past_the_end(), testing::KilledBySignal(SIGBUS), "");
}

TEST(ProcessDeathTest, FilesDoNotGetTheNumbersOfClosedStreams) {
    const auto open_after_close = [] {
        close(STDOUT_FILENO);
        prepareProcess("test-tool");
        const int file = open("/dev/null", O_WRONLY);
        exit(file > STDERR_FILENO && write(STDOUT_FILENO, "x", 1) < 0 ? 7 : 8);
    };
    EXPECT_EXIT(open_after_close(), testing::ExitedWithCode(7), "");
}

TEST(ProcessDeathTest, WritesPastTheFileSizeLimitFail) {
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

TEST(ProcessDeathTest, ReportsBadAllocOfOtherThreads) {
    const auto throw_in_thread = [] {
        prepareProcess("test-tool");
        std::thread([] { throw std::bad_alloc(); }).join();
    };
    EXPECT_EXIT(throw_in_thread(), testing::ExitedWithCode(3), "^test-tool: error: out of memory\n$");
}

TEST(ProcessDeathTest, CrashesStayCrashes) {
    const auto crash = [] {
        const rlimit limit{rlim_t{1} << 47, RLIM_INFINITY}; // room for AddressSanitizer
        setrlimit(RLIMIT_AS, &limit);
        prepareProcess("test-tool");
        signal(SIGSEGV, SIG_DFL); // AddressSanitizer has a handler
        raise(SIGSEGV);
    };
    EXPECT_EXIT(crash(), testing::KilledBySignal(SIGSEGV), "^$");
    const auto throw_in_thread = [] {
        prepareProcess("test-tool");
        signal(SIGABRT, SIG_DFL);
        std::thread([] { throw 1; }).join();
    };
    EXPECT_EXIT(throw_in_thread(), testing::KilledBySignal(SIGABRT), "");
}

TEST(MappedFile, ReportsLackOfMemoryAsSuch) {
    const int file = memfd_create("vast", MFD_CLOEXEC);
    ASSERT_EQ(ftruncate(file, off_t{1} << 50), 0) << "more than the address space";
    const std::string path = "/proc/self/fd/" + std::to_string(file);
    pro_file* opened = nullptr;
    EXPECT_EQ(pro_open(path.c_str(), 0, &opened, nullptr), PRO_OUT_OF_MEMORY);
    close(file);
}

} // namespace
} // namespace pointrt
