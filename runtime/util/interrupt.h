// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and kill while something is worth saving.
#pragma once

namespace pointrt {

/// From now on the first SIGINT, SIGTERM, SIGHUP or SIGXCPU is only noted; a second one ends the process at once. A
/// signal that the process was started to ignore stays ignored.
void noteInterrupts();

/// True once one was noted. Cheap.
bool interrupted();

/// Ends the process as the noted signal would have, so that whoever started it sees that; nothing without one.
void passInterruptOn();

} // namespace pointrt
