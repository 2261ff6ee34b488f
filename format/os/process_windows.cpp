// SPDX-License-Identifier: Apache-2.0
#include "format/os/process.h"

#include "format/os/wide_path_windows.h"

#include <fcntl.h>
#include <io.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "format/os/descriptor.h"
#include "format/os/exit_code.h"
#include "format/os/terminal.h"

namespace pointrt {
namespace {

const char* running_tool = "pointrt";
std::terminate_handler default_terminate = nullptr;

void printWord(const char* text) { printFromHandler(text, std::strlen(text)); }

/// Reports a page of a mapped file that cannot be read: the file was truncated, or its disk or network failed.
LONG WINAPI onFault(EXCEPTION_POINTERS* fault) {
    if (fault->ExceptionRecord->ExceptionCode != EXCEPTION_IN_PAGE_ERROR) return EXCEPTION_CONTINUE_SEARCH;
    printWord(running_tool);
    printWord(": error: a file was truncated while being read, or its disk failed\n");
    TerminateProcess(GetCurrentProcess(), static_cast<UINT>(ExitCode::kBadInput));
    return EXCEPTION_CONTINUE_SEARCH;
}

[[noreturn]] void onTerminate() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        printWord(running_tool);
        printWord(": error: out of memory\n");
        TerminateProcess(GetCurrentProcess(), static_cast<UINT>(ExitCode::kCannotRun));
    } catch (...) {
    }
    default_terminate();
    std::abort();
}

/// Streams carry bytes, and terminals UTF-8 with control sequences.
void prepareStream(int descriptor, DWORD name) {
    _setmode(descriptor, _O_BINARY);
    DWORD mode = 0;
    const HANDLE handle = GetStdHandle(name);
    if (GetConsoleMode(handle, &mode) != 0 && name != STD_INPUT_HANDLE)
        SetConsoleMode(handle, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

} // namespace

void prepareProcess(const char* tool_name) {
    running_tool = tool_name;
    prepareStream(kStandardInput, STD_INPUT_HANDLE);
    prepareStream(kStandardOutput, STD_OUTPUT_HANDLE);
    prepareStream(kStandardError, STD_ERROR_HANDLE);
    SetConsoleOutputCP(CP_UTF8);
    AddVectoredExceptionHandler(1, onFault);
    default_terminate = std::set_terminate(onTerminate);
}

void keepWorkingWithoutReaders() {} // Windows has no SIGPIPE

void endProcess(int exit_code) {
    std::fflush(nullptr);
    TerminateProcess(GetCurrentProcess(), static_cast<UINT>(exit_code));
    std::abort(); // not reached
}

} // namespace pointrt
