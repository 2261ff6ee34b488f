// SPDX-License-Identifier: Apache-2.0
#include "format/os/process.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "format/os/exit_code.h"
#include "format/os/terminal.h"

namespace pointrt {

namespace {

const char* running_tool = "pointrt";

// The functions below run in signal handlers: they neither allocate nor lock.

/// A line of /proc/self/maps: FIRST-LAST PERMISSIONS OFFSET DEVICE INODE      PATH
struct MapsLine {
    static constexpr int kBytes = 4096 + 128; // PATH_MAX and the fields before it
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

/// The path in a line if it is a read-only file mapping that contains address; else null.
const char* fileOfLine(MapsLine& line, std::uintptr_t address) {
    line.text[line.length] = 0;
    const char* at = line.text;
    const std::uintptr_t first = readHex(at);
    if (*at++ != '-') return nullptr;
    const std::uintptr_t last = readHex(at);
    if (address < first || address >= last || std::strncmp(at, " r--", 4) != 0) return nullptr;
    return std::strchr(at, '/'); // device and inode are numbers
}

/// Calls use(path) if address lies in a read-only mapped file.
template <typename Use>
void withMappedFile(std::uintptr_t address, const Use& use) {
    static MapsLine line; // too large for the stack of a signal handler
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

void writeWord(const char* text) { printFromHandler(text, std::strlen(text)); }

/// A short form of printable() that may run in a signal handler.
void writePath(const char* path) {
    for (; *path; ++path) {
        const char shown = static_cast<unsigned char>(*path) < ' ' || *path == 0x7F ? '?' : *path;
        printFromHandler(&shown, 1);
    }
}

/// Lets the first thread continue and stops all others; the process ends with the first one.
void enterOnce(std::atomic_flag& entered) {
    while (entered.test_and_set()) pause();
}

void onBusError(int number, siginfo_t* info, void*) {
    static std::atomic_flag reported;
    enterOnce(reported); // all threads that read the file fail at once
    if (info->si_code == BUS_ADRERR)
        withMappedFile(reinterpret_cast<std::uintptr_t>(info->si_addr), [](const char* path) {
            writeWord(running_tool);
            writeWord(": error: ");
            writePath(path);
            writeWord(": was truncated while being read, or its disk failed\n");
            _exit(static_cast<int>(ExitCode::kBadInput));
        });
    signal(number, SIG_DFL); // not one of our files: the instruction runs again and ends the process
}

std::terminate_handler default_terminate = nullptr;

/// Reports std::bad_alloc of threads without runTool, such as a driver's own; other exceptions end in a crash.
[[noreturn]] void onTerminate() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        static std::atomic_flag reported;
        enterOnce(reported);
        writeWord(running_tool);
        writeWord(": error: out of memory\n");
        _exit(static_cast<int>(ExitCode::kCannotRun));
    } catch (...) {
    }
    default_terminate();
    std::abort();
}

void handle(int number, void (*handler)(int, siginfo_t*, void*)) {
    struct sigaction action {};
    action.sa_sigaction = handler;
    action.sa_flags = static_cast<int>(SA_SIGINFO);
    sigaction(number, &action, nullptr);
}

} // namespace

void prepareProcess(const char* tool_name) {
    running_tool = tool_name;
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number)
        if (fcntl(number, F_GETFD) < 0) // the lowest free number is the one that open returns
            if (::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) break;
    signal(SIGXFSZ, SIG_IGN);
    handle(SIGBUS, onBusError);
    default_terminate = std::set_terminate(onTerminate);
}

void keepWorkingWithoutReaders() { signal(SIGPIPE, SIG_IGN); }

void endProcess(int exit_code) { std::exit(exit_code); }

} // namespace pointrt
