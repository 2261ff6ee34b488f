// SPDX-License-Identifier: Apache-2.0
#include "format/os/interrupt.h"

#include <signal.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace pointrt {
namespace {

/// Not a sig_atomic_t: the signal may arrive on another thread.
std::atomic<int> caught = 0;
static_assert(decltype(caught)::is_always_lock_free); // needed within a signal handler

void onSignal(int number) { caught = number; }

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP,
                            SIGXCPU}; // the user, a batch system, a lost terminal, a time limit

/// SA_RESTART: reads and writes in progress must not fail.
void handle(void (*handler)(int), int flags) {
    for (const int number : kSignals) {
        struct sigaction before {};
        sigaction(number, nullptr, &before);
        if (before.sa_handler == SIG_IGN) continue; // keeps nohup working
        struct sigaction action {};
        action.sa_handler = handler;
        action.sa_flags = flags | SA_RESTART;
        sigaction(number, &action, nullptr);
    }
}

} // namespace

void catchInterrupts() { handle(onSignal, static_cast<int>(SA_RESETHAND)); }

void handleInterrupts(void (*handler)(int)) { handle(handler, 0); }

bool interrupted() { return caught != 0; }

void raiseInterrupt() {
    if (caught == 0) return;
    std::fflush(nullptr);
    struct sigaction action {};
    action.sa_handler = SIG_DFL;
    sigaction(caught, &action, nullptr);
    raise(caught);
}

void endInterrupted(int number) {
    constexpr int kSignalExitBase = 128;
    std::_Exit(kSignalExitBase + number);
}

} // namespace pointrt
