// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/app/interrupt.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>

#include "format/os/descriptor.h"
#include "format/os/interrupt.h"
#include "format/os/terminal.h"

namespace pointrt {

namespace {

/// Signals may arrive on any thread. If one thread starts writing while another is interrupted, the first of the two
/// changes wins.
enum class State { kComputing, kWriting, kEnding };
std::atomic<State> state = State::kComputing;
std::atomic<bool> work_is_kept = false;
static_assert(decltype(state)::is_always_lock_free &&
              decltype(work_is_kept)::is_always_lock_free); // for the signal handler

template <std::size_t kSize>
void print(const char (&line)[kSize]) {
    constexpr std::size_t kWipeBytes = 4; // erases the progress line on a terminal
    const std::size_t skipped = isTerminal(kStandardError) ? 0 : kWipeBytes;
    printFromHandler(line + skipped, kSize - 1 - skipped);
}

void onInterrupt(int signal) {
    State before = State::kComputing;
    if (!state.compare_exchange_strong(before, State::kEnding)) return;
    if (work_is_kept)
        print("\r\033[Kpointrt-bake: interrupted; run the same command to resume\n");
    else
        print("\r\033[Kpointrt-bake: interrupted, nothing was written\n");
    endInterrupted(signal);
}

} // namespace

void installInterruptHandlers() { handleInterrupts(onInterrupt); }

void keepWorkOnInterrupt() { work_is_kept = true; }

void ignoreInterrupts() {
    State before = State::kComputing;
    if (!state.compare_exchange_strong(before, State::kWriting) && before == State::kEnding)
        // the other thread reports it, and ends the process
        while (true) std::this_thread::sleep_for(std::chrono::hours(1));
}

} // namespace pointrt
