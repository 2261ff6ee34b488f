// SPDX-License-Identifier: GPL-3.0-or-later
// Interrupts: at once while computing, put off while the output is being written.
#pragma once

namespace pointrt {

/// Ends the process with 128 + signal on SIGINT, SIGTERM and SIGHUP; nothing is on disk before the output is written.
void installInterruptHandlers();

/// While one lives, interrupts wait until it ends: the output is renamed into place or removed first.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

} // namespace pointrt
