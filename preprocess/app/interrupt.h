// SPDX-License-Identifier: GPL-3.0-or-later
// Interrupts: at once while computing, put off while the output is being written.
#pragma once

namespace pointrt {

/// Ends the process with 128 + signal on SIGINT, SIGTERM, SIGHUP and SIGXCPU (a batch system's time is up); nothing is
/// on disk before the output is written.
void installInterruptHandlers();

/// Has an interrupted process say that the same command goes on where it stopped.
void sayThatWorkStays();

/// While one lives interrupts are ignored: once writing has begun the run is as good as done, and ends with its file.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

} // namespace pointrt
