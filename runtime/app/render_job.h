// SPDX-License-Identifier: Apache-2.0
// From a loaded scene to picture files: one, a benchmark's, or those of a turntable.
#pragma once

#include "runtime/session/options.h"
#include "runtime/session/render_session.h"
#include "runtime/session/report.h"

namespace pointrt {

/// Renders options.output, over and over for a benchmark, and fills report. Interrupted, the file gets the samples
/// there are; a second interrupt ends at once. Throws Error kCannotWrite "PATH: reason", kCannotRun where there is not
/// the memory for it, and as filmToResume does.
void renderPicture(RenderSession& session, const Options& options, Report& report);

/// Renders the options.turntable pictures of options.output, the first from session.camera, which moves. Interrupted,
/// it leaves those that were finished. Throws Error kCannotWrite "PATH: reason".
void renderTurntable(RenderSession& session, const Options& options, Report& report);

} // namespace pointrt
