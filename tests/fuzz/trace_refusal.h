// SPDX-License-Identifier: Apache-2.0
// Converts errors of the library pointrt::trace.
#pragma once

#include "format/base/error.h"
#include "pointrt/trace.hpp"

namespace pointrt::fuzz {

/// Calls read and rethrows TraceError as Error with the same code.
template <typename Read>
void asError(const Read& read) {
    try {
        read();
    } catch (const TraceError& error) {
        throw Error(static_cast<ExitCode>(error.kind), error.what());
    }
}

} // namespace pointrt::fuzz
