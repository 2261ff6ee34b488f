// SPDX-License-Identifier: Apache-2.0
// Progress of a render, or of the bake before it, on standard error.
#pragma once

#include <chrono>
#include <string>

#include "format/base/time_left.h"

namespace pointrt {

/// One redrawn line on a terminal; elsewhere a line per 10% if verbose; nothing if quiet.
/// for_programs: lines "progress SHARE DETAIL", at most ten per second, regardless of quiet and verbose.
class RenderProgress {
public:
    /// doing: what the line begins with
    RenderProgress(bool quiet, bool verbose, bool for_programs, const char* doing = "rendering");
    /// Cheap enough to call for every dispatch.
    /// @param share in [0, 1]
    /// @param detail text after the time left
    void update(double share, const std::string& detail = {});
    /// Erases the redrawn line.
    void finish();

private:
    enum class Style { kNone, kRedrawn, kTenths, kForPrograms };
    const char* doing_;
    Style style_ = Style::kNone;
    std::chrono::steady_clock::time_point start_, drawn_;
    bool on_screen_ = false;
    int tenths_ = 0;
    TimeLeft left_;
};

} // namespace pointrt
