// SPDX-License-Identifier: Apache-2.0
// Catches Ctrl-C and kill, so that results can be saved.
#pragma once

namespace pointrt {

/// From now on the first SIGINT, SIGTERM, SIGHUP or SIGXCPU only sets a flag; a second one terminates the process.
/// Signals that the process was started to ignore stay ignored.
void catchInterrupts();

/// The same with a handler in place of the flag, which gets the number of each of these signals. It may call
/// printFromHandler and std::_Exit, little else.
void handleInterrupts(void (*handler)(int number));

/// Whether catchInterrupts caught a signal. Cheap.
bool interrupted();

/// Terminates the process by the caught signal, so that its parent sees it. Does nothing if none was caught.
void raiseInterrupt();

/// For handlers: ends the process at once, with status 128 + number as shells report signals; on Windows as Ctrl-C
/// does.
[[noreturn]] void endInterrupted(int number);

} // namespace pointrt
