// SPDX-License-Identifier: Apache-2.0
// What a process must be told before it works: how to end when the system says no.
#pragma once

namespace pointrt {

/// Once, at the start of a program called tool_name (which must outlive it):
///  - standard streams that are closed are opened in a way in which they can be neither read nor written, so that no
///    file of ours gets their number and reports;
///  - a write past `ulimit -f` fails (EFBIG) instead of ending the process without a word;
///  - reading a mapped file that was cut short meanwhile, or that its disk cannot deliver, ends the process with a line
///    that names the file, and exit code kBadInput;
///  - where `ulimit -v` bounds its memory, a crash ends it with a line that says so, and exit code kCannotRun.
void prepareProcess(const char* tool_name);

/// For programs whose work is worth more than its reports: writing to a pipe that nobody reads fails (EPIPE) from now
/// on, instead of ending the process.
void keepWorkingWithoutReaders();

} // namespace pointrt
