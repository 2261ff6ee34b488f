// SPDX-License-Identifier: Apache-2.0
#include "format/base/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "format/base/error.h"

namespace pointrt {

namespace {

const char* running_tool = "pointrt";

// Below is what runs within a signal handler: no memory is asked for, nothing is locked.

/// A line of /proc/self/maps: FIRST-LAST PERMISSIONS OFFSET DEVICE INODE      PATH
struct MapsLine {
    static constexpr int kBytes = 4096 + 128; // PATH_MAX, and what stands before it
    char text[kBytes];
    int length = 0;
};

std::uintptr_t readHex(const char*& at) {
    std::uintptr_t value = 0;
    for (;; ++at) {
        const char c = *at;
        const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
        if (digit < 0) return value;
        value = value * 16 + static_cast<std::uintptr_t>(digit);
    }
}

/// The path in a line whose mapping holds address, is read-only and of a file; null where it is another one.
const char* fileOfLine(MapsLine& line, std::uintptr_t address) {
    line.text[line.length] = 0;
    const char* at = line.text;
    const std::uintptr_t first = readHex(at);
    if (*at++ != '-') return nullptr;
    const std::uintptr_t last = readHex(at);
    if (address < first || address >= last || std::strncmp(at, " r--", 4) != 0) return nullptr;
    return std::strchr(at, '/'); // device and inode are numbers
}

/// Calls use(path) where address is of a mapped file.
template <typename Use>
void withMappedFile(std::uintptr_t address, const Use& use) {
    static MapsLine line; // too large for the stack of a signal
    line.length = 0;
    const int maps = ::open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
    if (maps < 0) return;
    char block[1024];
    for (ssize_t got; (got = ::read(maps, block, sizeof block)) > 0;)
        for (ssize_t i = 0; i < got; ++i) {
            if (block[i] != '\n') {
                if (line.length < MapsLine::kBytes - 1) line.text[line.length++] = block[i];
                continue;
            }
            if (const char* path = fileOfLine(line, address)) use(path);
            line.length = 0;
        }
    ::close(maps);
}

void writeAll(const char* text, std::size_t bytes) {
    if (::write(STDERR_FILENO, text, bytes) < 0) return; // there is nobody left to tell
}

void writeWord(const char* text) { writeAll(text, std::strlen(text)); }

/// As printable does, in as few words as fit here.
void writePath(const char* path) {
    for (; *path; ++path) {
        const char shown = static_cast<unsigned char>(*path) < ' ' || *path == 0x7F ? '?' : *path;
        writeAll(&shown, 1);
    }
}

/// Several threads may come here at once: the first one goes on, and the process ends with it.
void goAlone(std::atomic_flag& gone) {
    while (gone.test_and_set()) pause();
}

void onBusError(int number, siginfo_t* info, void*) {
    static std::atomic_flag told;
    goAlone(told); // all who read a file that is cut short
    if (info->si_code == BUS_ADRERR)
        withMappedFile(reinterpret_cast<std::uintptr_t>(info->si_addr), [](const char* path) {
            writeWord(running_tool);
            writeWord(": error: ");
            writePath(path);
            writeWord(": was cut short while it was read, or its disk fails\n");
            _exit(static_cast<int>(ExitCode::kBadInput));
        });
    signal(number, SIG_DFL); // no file of ours: the instruction runs again and ends the process
}

/// How large the process may become, for the message: there is no asking then.
char address_limit[64] = "";

[[noreturn]] void tellOfLackOfMemory() {
    static std::atomic_flag told;
    goAlone(told);
    writeWord(running_tool);
    writeWord(": error: crashed, most likely for lack of memory: ulimit -v allows ");
    writeWord(address_limit);
    writeWord(" MiB, and not every library looks whether it got what it asked for\n");
    _exit(static_cast<int>(ExitCode::kCannotRun));
}

void onCrash(int, siginfo_t*, void*) { tellOfLackOfMemory(); }

/// A driver's own threads have nobody to catch what they throw.
[[noreturn]] void onTerminate() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        tellOfLackOfMemory();
    } catch (...) {
    }
    signal(SIGABRT, SIG_DFL); // another reason
    std::abort();
}

void handle(int number, void (*handler)(int, siginfo_t*, void*)) {
    struct sigaction action {};
    action.sa_sigaction = handler;
    action.sa_flags = static_cast<int>(SA_SIGINFO);
    sigaction(number, &action, nullptr);
}

/// Mesa's drivers use memory without looking whether there was any, or free twice what they had before the lack: the C
/// library aborts then.
void blameAddressLimit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    std::snprintf(address_limit, sizeof address_limit, "%llu", static_cast<unsigned long long>(limit.rlim_cur >> 20));
    handle(SIGSEGV, onCrash);
    handle(SIGABRT, onCrash);
    std::set_terminate(onTerminate);
}

} // namespace

void prepareProcess(const char* tool_name) {
    running_tool = tool_name;
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number)
        if (fcntl(number, F_GETFD) < 0) // the lowest free number is the one that open returns
            if (::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) break;
    signal(SIGXFSZ, SIG_IGN);
    handle(SIGBUS, onBusError);
    blameAddressLimit();
}

void keepWorkingWithoutReaders() { signal(SIGPIPE, SIG_IGN); }

} // namespace pointrt
