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

/// Signals arrive on any thread. If one thread starts writing while another is interrupted, the first change counts.
enum class State { kComputing, kWriting, kEnding };
std::atomic<State> state = State::kComputing;
std::atomic<bool> work_is_kept = false;
static_assert(decltype(state)::is_always_lock_free &&
              decltype(work_is_kept)::is_always_lock_free); // for the signal handler

template <std::size_t kSize>
void print(const char (&line)[kSize]) {
    constexpr std::size_t kWipeBytes = 4; // erases the progress line on a terminal
    const std::size_t skipped = isatty(STDERR_FILENO) ? 0 : kWipeBytes;
    const ssize_t written = write(STDERR_FILENO, line + skipped, kSize - 1 - skipped);
    static_cast<void>(written); // nothing else to report a failure to
}

extern "C" void onInterrupt(int signal) {
    State before = State::kComputing;
    if (!state.compare_exchange_strong(before, State::kEnding)) return;
    if (work_is_kept)
        print("\r\033[Kpointrt-bake: interrupted; run the same command to resume\n");
    else
        print("\r\033[Kpointrt-bake: interrupted, nothing was written\n");
    _exit(kSignalExitBase + signal);
}

} // namespace

void installInterruptHandlers() {
    struct sigaction action {};
    action.sa_handler = onInterrupt;
    action.sa_flags = SA_RESTART; // writes in progress must not fail
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr); // keep nohup working
    }
}

void keepWorkOnInterrupt() { work_is_kept = true; }

void ignoreInterrupts() {
    State before = State::kComputing;
    if (!state.compare_exchange_strong(before, State::kWriting) && before == State::kEnding)
        while (true) pause(); // another thread has reported that nothing was written, and ends the process
}

} // namespace pointrt
