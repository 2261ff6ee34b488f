// SPDX-License-Identifier: Apache-2.0
// How far a long render is, on standard error.
#pragma once

#include <chrono>
#include <string>

#include "format/base/time_left.h"

namespace pointrt {

/// One redrawn line on a terminal; elsewhere a line each ten percent when verbose, else nothing; nothing when quiet.
/// for_programs: lines "progress SHARE DETAIL", ten a second at most, whatever the rest says.
class RenderProgress {
public:
    RenderProgress(bool quiet, bool verbose, bool for_programs);
    /// share in [0, 1]; detail follows the time left. Cheap enough for every dispatch.
    void update(double share, const std::string& detail = {});
    /// Wipes the redrawn line.
    void finish();

private:
    enum class Style { kNone, kRedrawn, kTenths, kForPrograms };
    Style style_ = Style::kNone;
    std::chrono::steady_clock::time_point start_, drawn_;
    bool on_screen_ = false;
    int tenths_ = 0;
    TimeLeft left_;
};

} // namespace pointrt
