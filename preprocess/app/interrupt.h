// SPDX-License-Identifier: GPL-3.0-or-later
// Interrupts end the process while it computes, and are ignored once it writes the output.
#pragma once

namespace pointrt {

/// SIGINT, SIGTERM, SIGHUP and SIGXCPU (the time limit of a batch system) end the process with 128 + signal. Nothing is
/// on disk before the output is written.
void installInterruptHandlers();

/// Makes an interrupted process say that the same command resumes the bake.
void keepWorkOnInterrupt();

/// Ignores interrupts from now on: a run that writes its output is almost done, and one that has written it must not
/// end as if it had failed.
void ignoreInterrupts();

} // namespace pointrt
