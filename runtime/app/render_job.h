// SPDX-License-Identifier: Apache-2.0
// Renders a loaded scene to picture files: a single picture, a benchmark, or a turntable.
#pragma once

#include "runtime/session/options.h"
#include "runtime/session/render_session.h"
#include "runtime/session/report.h"

namespace pointrt {

/// Renders options.output, repeatedly for a benchmark, and fills report. If interrupted, writes the samples so far; a
/// second interrupt ends at once. Throws Error kCannotWrite "PATH: reason", kCannotRun if memory is insufficient, and
/// as filmToResume does.
void renderPicture(RenderSession& session, const Options& options, Report& report);

/// Renders the options.turntable pictures of options.output, starting from session.camera, which it changes. If
/// interrupted, the finished pictures remain. Throws Error kCannotWrite "PATH: reason".
void renderTurntable(RenderSession& session, const Options& options, Report& report);

} // namespace pointrt
