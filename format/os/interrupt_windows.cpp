// SPDX-License-Identifier: Apache-2.0
// Windows calls console control handlers on a thread of their own.
#include "format/os/interrupt.h"

#include "format/os/wide_path_windows.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace pointrt {
namespace {

std::atomic<int> caught = 0;
std::atomic<void (*)(int)> installed = nullptr;

int numberOf(DWORD event) { return event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT ? SIGINT : SIGTERM; }

/// Not handled: the system's own handler ends the process.
BOOL WINAPI setFlag(DWORD event) { return caught.exchange(numberOf(event)) == 0 ? TRUE : FALSE; }

BOOL WINAPI callHandler(DWORD event) {
    installed.load()(numberOf(event));
    return TRUE;
}

} // namespace

void catchInterrupts() { SetConsoleCtrlHandler(setFlag, TRUE); }

void handleInterrupts(void (*handler)(int)) {
    installed = handler;
    SetConsoleCtrlHandler(callHandler, TRUE);
}

bool interrupted() { return caught != 0; }

void raiseInterrupt() {
    if (caught == 0) return;
    std::fflush(nullptr);
    ExitProcess(static_cast<UINT>(STATUS_CONTROL_C_EXIT)); // ends as the system's own handler does
}

/// Does not use ExitProcess, which waits for locks of threads that it has ended.
void endInterrupted(int) {
    TerminateProcess(GetCurrentProcess(), static_cast<UINT>(STATUS_CONTROL_C_EXIT));
    std::abort(); // not reached
}

} // namespace pointrt
