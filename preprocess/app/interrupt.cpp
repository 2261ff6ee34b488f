// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/interrupt.h"

#include <csignal>
#include <initializer_list>
#include <unistd.h>

namespace pointrt {

namespace {

constexpr int kSignalExitBase = 128; // the shells' convention

volatile std::sig_atomic_t guarded = 0;

extern "C" void onInterrupt(int signal) {
    if (!guarded) _exit(kSignalExitBase + signal);
}

} // namespace

void installInterruptHandlers() {
    struct sigaction action {};
    action.sa_handler = onInterrupt;
    action.sa_flags = SA_RESTART; // a write that is put through must not fail half-way
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr); // nohup stays in force
    }
}

InterruptGuard::InterruptGuard() { guarded = 1; }

InterruptGuard::~InterruptGuard() { guarded = 0; }

} // namespace pointrt
