// SPDX-License-Identifier: GPL-3.0-or-later
// Interrupts: at once while computing, ignored once the output is being written.
#pragma once

namespace pointrt {

/// Ends the process with 128 + signal on SIGINT, SIGTERM, SIGHUP and SIGXCPU (a batch system's time is up); nothing is
/// on disk before the output is written.
void installInterruptHandlers();

/// Has an interrupted process say that the same command goes on where it stopped.
void sayThatWorkStays();

/// From here on interrupts are ignored, for good: a run that writes its output is as good as done, and one that has
/// written it must not end as if it had not.
void ignoreInterrupts();

} // namespace pointrt
