// SPDX-License-Identifier: Apache-2.0
// What pictures take of memory, known before the work begins.
#pragma once

#include <cstdint>

#include "runtime/session/options.h"
#include "runtime/session/render_session.h"

namespace pointrt {

/// True where the picture is written as it is rendered, row by row, and never held whole: a PNG without limits. What
/// may end by its time or noise is refined all over, again and again.
bool writesAsItRenders(const Options& options);

/// Whether the report tells how noisy the picture is.
bool reportsNoise(const Options& options);

/// Bytes, beside what the session has already: the film, whole or a band of it, the filter, and what tells the noise.
std::uint64_t pictureBytes(const RenderSession& session, const Options& options);

/// Throws Error kCannotRun "PATH: reason" where there is less memory than that.
void requirePictureMemory(const RenderSession& session, const Options& options);

} // namespace pointrt
