// SPDX-License-Identifier: Apache-2.0
// Errors of the library pointrt::trace as those of its rooms.
#pragma once

#include "format/base/error.h"
#include "pointrt/trace.hpp"

namespace pointrt::fuzz {

/// Calls read; TraceError becomes Error of the same code.
template <typename Read>
void asError(const Read& read) {
    try {
        read();
    } catch (const TraceError& error) {
        throw Error(static_cast<ExitCode>(error.kind), error.what());
    }
}

} // namespace pointrt::fuzz
