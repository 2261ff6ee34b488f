// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/render_progress.h"

#include <cstdio>

#include "format/os/descriptor.h"
#include "format/os/terminal.h"

namespace pointrt {
namespace {

using Seconds = std::chrono::duration<double>;
// Shorter renders show nothing; redrawing more often would only flicker.
constexpr Seconds kPatience{0.5}, kRedraw{0.1};
constexpr const char* kWipe = "\r\033[K";

} // namespace

RenderProgress::RenderProgress(bool quiet, bool verbose, bool for_programs, const char* doing)
    : doing_(doing), start_(std::chrono::steady_clock::now()), drawn_(start_) {
    if (for_programs) style_ = Style::kForPrograms;
    if (quiet || for_programs) return;
    if (isTerminal(kStandardError))
        style_ = Style::kRedrawn;
    else if (verbose)
        style_ = Style::kTenths;
}

void RenderProgress::update(double share, const std::string& detail) {
    if (style_ == Style::kNone || !(share > 0)) return;
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = Seconds(now - start_).count(), left = elapsed / share - elapsed;
    if (style_ == Style::kRedrawn && now - start_ >= kPatience && now - drawn_ >= kRedraw) {
        const std::string left_text = leftText(left_.update(elapsed, share));
        std::fprintf(stderr, "%s%s %3.0f%%%s%s%s", kWipe, doing_, 100 * share, left_text.c_str(),
                     detail.empty() ? "" : ", ", detail.c_str());
        drawn_ = now;
        on_screen_ = true;
    }
    if (style_ == Style::kForPrograms && now - drawn_ >= kRedraw) {
        std::fprintf(stderr, "progress %.4f %s\n", share, detail.c_str());
        drawn_ = now;
    }
    const int tenths = static_cast<int>(10 * share);
    if (style_ == Style::kTenths && tenths > tenths_) {
        std::fprintf(stderr, "%s %d%%, %.1f s left%s%s\n", doing_, 10 * tenths, left, detail.empty() ? "" : ", ",
                     detail.c_str());
        tenths_ = tenths;
    }
}

void RenderProgress::finish() {
    if (on_screen_) std::fputs(kWipe, stderr);
    on_screen_ = false;
}

} // namespace pointrt
