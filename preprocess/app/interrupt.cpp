// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/interrupt.h"

#include <atomic>
#include <csignal>
#include <cstddef>
#include <initializer_list>
#include <unistd.h>

namespace pointrt {

namespace {

constexpr int kSignalExitBase = 128; // the shells' convention

/// Signals come to any thread: of one that begins to write and one that is interrupted at that moment, one is first.
enum class State { kComputing, kWriting, kEnding };
std::atomic<State> state = State::kComputing;
std::atomic<bool> work_stays = false;
static_assert(decltype(state)::is_always_lock_free && decltype(work_stays)::is_always_lock_free); // within a handler

template <std::size_t kSize>
void tell(const char (&line)[kSize]) {
    constexpr std::size_t kWipe = 4; // of the progress that is drawn on a terminal
    const std::size_t skipped = isatty(STDERR_FILENO) ? 0 : kWipe;
    const ssize_t told = write(STDERR_FILENO, line + skipped, kSize - 1 - skipped);
    static_cast<void>(told); // without a reader there is nobody to tell
}

extern "C" void onInterrupt(int signal) {
    State before = State::kComputing;
    if (!state.compare_exchange_strong(before, State::kEnding)) return;
    if (work_stays)
        tell("\r\033[Kpointrt-bake: interrupted; the same command goes on from here\n");
    else
        tell("\r\033[Kpointrt-bake: interrupted, nothing was written\n");
    _exit(kSignalExitBase + signal);
}

} // namespace

void installInterruptHandlers() {
    struct sigaction action {};
    action.sa_handler = onInterrupt;
    action.sa_flags = SA_RESTART; // a write that is put through must not fail half-way
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr); // nohup stays in force
    }
}

void sayThatWorkStays() { work_stays = true; }

void ignoreInterrupts() {
    State before = State::kComputing;
    if (!state.compare_exchange_strong(before, State::kWriting) && before == State::kEnding)
        while (true) pause(); // another thread has said that nothing was written, and ends the process
}

} // namespace pointrt
