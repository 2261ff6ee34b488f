// SPDX-License-Identifier: Apache-2.0
// Process-wide set-up of the tools: signals, standard streams, uncaught exceptions.
#pragma once

namespace pointrt {

/// To be called once, at the start of the tool tool_name (a string that outlives the process). Afterwards:
///  - closed standard streams are open but can be neither read nor written, so that no file of ours gets their
///    descriptor and with it our messages;
///  - writes past `ulimit -f` fail with EFBIG instead of ending the process silently;
///  - reading a mapped file that was truncated meanwhile, or whose disk fails, ends the process with a line that names
///    the file and exit code kBadInput;
///  - std::bad_alloc thrown in any thread ends the process with "out of memory" and exit code kCannotRun. Other
///    uncaught exceptions crash it as usual.
void prepareProcess(const char* tool_name);

/// From now on writing to a pipe without readers fails with EPIPE instead of ending the process: for programs whose
/// work matters more than their messages.
void keepWorkingWithoutReaders();

/// Ends the process as returning from main does. On Windows only streams are written out: destructors of static objects
/// may wait for ever for threads of TBB that are ending.
[[noreturn]] void endProcess(int exit_code);

} // namespace pointrt
