// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/interrupt.h"

#include <signal.h>

#include <atomic>
#include <cstdio>

namespace pointrt {
namespace {

/// Not a sig_atomic_t: the signal may come to another thread than the one that asks.
std::atomic<int> noted = 0;
static_assert(decltype(noted)::is_always_lock_free); // within a signal handler

void note(int number) { noted = number; }

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU}; // the user, a batch system, a lost line, time's limit

} // namespace

void noteInterrupts() {
    for (const int number : kSignals) {
        struct sigaction before {};
        sigaction(number, nullptr, &before);
        if (before.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = note;
        action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
        sigaction(number, &action, nullptr);
    }
}

bool interrupted() { return noted != 0; }

void passInterruptOn() {
    if (noted == 0) return;
    std::fflush(nullptr);
    struct sigaction action {};
    action.sa_handler = SIG_DFL;
    sigaction(noted, &action, nullptr);
    raise(noted);
}

} // namespace pointrt
