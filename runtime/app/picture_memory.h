// SPDX-License-Identifier: Apache-2.0
// The memory that a picture needs, checked before rendering.
#pragma once

#include <cstdint>

#include "runtime/session/options.h"
#include "runtime/session/render_session.h"

namespace pointrt {

/// True if the picture is written row by row while it is rendered: PNGs without limits. With a time or noise limit the
/// whole picture is refined repeatedly instead.
bool writesAsItRenders(const Options& options);

/// True if the report includes the picture's noise.
bool reportsNoise(const Options& options);

/// Bytes in addition to the session's: the film or a band of it, the denoiser, and the noise estimate.
std::uint64_t pictureBytes(const RenderSession& session, const Options& options);

/// Throws Error kCannotRun "PATH: reason" if less memory is available.
void requirePictureMemory(const RenderSession& session, const Options& options);

} // namespace pointrt
