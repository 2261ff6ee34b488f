// SPDX-License-Identifier: Apache-2.0
// Translates internal errors into those of the public library.
#pragma once

#include "format/base/error.h"
#include "pointrt/pro.hpp"
#include "pointrt/trace.hpp"

namespace pointrt {

static_assert(static_cast<int>(TraceError::Kind::kBadInput) == static_cast<int>(ExitCode::kBadInput) &&
              static_cast<int>(TraceError::Kind::kBadUsage) == static_cast<int>(ExitCode::kBadUsage) &&
              static_cast<int>(TraceError::Kind::kCannotRun) == static_cast<int>(ExitCode::kCannotRun));

/// Returns act(). Rethrows Error and ProError as TraceError.
template <typename Act>
auto translated(const Act& act) {
    try {
        return act();
    } catch (const Error& error) {
        throw TraceError(static_cast<TraceError::Kind>(error.code), error.what());
    } catch (const ProError& error) {
        throw TraceError(static_cast<TraceError::Kind>(exitCodeOf(error.result)), error.what());
    }
}

} // namespace pointrt
