// SPDX-License-Identifier: Apache-2.0
// How the C library's heap keeps freed memory.
#pragma once

namespace pointrt {

/// Makes the heap return blocks of 4 MiB and more to the system as soon as they are freed. Otherwise glibc, once the
/// first such block has been freed, keeps later ones, and small blocks fragment their space. Does nothing where the
/// heap is not glibc's. Call it before other threads start.
void returnLargeBlocks();

} // namespace pointrt
