// SPDX-License-Identifier: Apache-2.0
// The running job and notices.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "format/base/printable.h"
#include "format/base/time_left.h"
#include "runtime/window/ui/panel_box.h"
#include "runtime/window/ui/panel_numbers.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Design units.
constexpr float kJobWidth = 440, kJobMargin = 12, kJobBarHeight = 6, kCancelWidth = 64, kWayBackWidth = 260;

/// A window whose lower edge is at bottom; returns its upper edge in the last frame.
float boxAbove(const char* name, FreeArea area, float bottom, ImGuiWindowFlags flags,
               const std::function<void()>& content) {
    const float width = std::min(kJobWidth * uiScale(), area.width);
    const BoxPlace place{ImVec2(area.width / 2, bottom), ImVec2(0.5f, 1)};
    return bottom - boxOnPicture(name, place, width, ImGuiWindowFlags_NoMove | flags, content);
}

/// An indeterminate progress bar: a part that moves across in 1.6 seconds.
void drawMovingBar(double time_s) {
    constexpr double period_s = 1.6;
    constexpr float part = 0.25f;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, kJobBarHeight * uiScale());
    const double phase = std::isfinite(time_s) ? std::fmod(std::abs(time_s), period_s) / period_s : 0;
    const auto from = static_cast<float>(phase) * (1 + part) - part;
    const float left = corner.x + size.x * std::max(0.0f, from);
    const float right = corner.x + size.x * std::min(1.0f, from + part);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float round = ImGui::GetStyle().FrameRounding;
    list.AddRectFilled(corner, ImVec2(corner.x + size.x, corner.y + size.y), ImGui::GetColorU32(ImGuiCol_FrameBg),
                       round);
    list.AddRectFilled(ImVec2(left, corner.y), ImVec2(right, corner.y + size.y),
                       ImGui::GetColorU32(ImGuiCol_PlotHistogram), round);
    ImGui::Dummy(size);
}

void drawShare(const JobStatus& job, double time_s) {
    if (!job.progress || !std::isfinite(*job.progress)) return drawMovingBar(time_s);
    const auto share = static_cast<float>(std::clamp(*job.progress, 0.0, 1.0));
    ImGui::ProgressBar(share, ImVec2(-1, kJobBarHeight * uiScale()), "");
}

std::string stateOf(const JobStatus& job) {
    std::string text = job.detail;
    const auto add = [&](const std::string& part) { text += std::string(text.empty() ? "" : "   ") + part; };
    if (job.progress && std::isfinite(*job.progress))
        add(std::to_string(static_cast<int>(100 * std::clamp(*job.progress, 0.0, 1.0))) + " %");
    if (job.seconds_left) add(durationText(*job.seconds_left) + " left");
    return text;
}

void drawJob(Workspace& w) {
    const JobStatus& job = *w.job;
    const float cancel = kCancelWidth * uiScale();
    const float right = ImGui::GetWindowContentRegionMax().x - cancel;
    ImGui::AlignTextToFramePadding();
    ImGui::PushClipRect(ImGui::GetWindowPos(), ImVec2(ImGui::GetWindowPos().x + right, 1e6f), true);
    ImGui::TextUnformatted(job.title.c_str());
    ImGui::PopClipRect();
    if (job.can_cancel) {
        ImGui::SameLine(right);
        if (ImGui::Button("Cancel", ImVec2(cancel, 0))) w.requests.cancel_job = true;
    }
    drawShare(job, w.time_s);
    const std::string state = stateOf(job);
    if (!state.empty()) dimText(state.c_str());
}

/// 1, fading to 0 at the end.
float opacityOf(const Notice& notice, double time_s) {
    constexpr double fade_s = 0.6;
    const double left = (notice.until_s - time_s) / fade_s;
    return left > 0 ? static_cast<float>(std::min(left, 1.0)) : 0; // NaN: 0
}

void drawNotice(const Notice& notice, float opacity) {
    const ImVec4 red(0.96f, 0.45f, 0.40f, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, opacity);
    ImGui::PushStyleColor(ImGuiCol_Text, notice.error ? red : ImGui::GetStyleColorVec4(ImGuiCol_Text));
    ImGui::TextWrapped("%s", notice.text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

void drawRecentFiles(Workspace& w, FreeArea area, float top) {
    const float width = std::min(kJobWidth * uiScale(), area.width);
    boxOnPicture("Recent files", {ImVec2(area.width / 2, top), ImVec2(0.5f, 0)}, width, ImGuiWindowFlags_NoMove, [&] {
        dimText("Recent files");
        for (std::size_t n = 0; n < w.recent_files.size(); ++n) {
            ImGui::PushID(static_cast<int>(n));
            if (ImGui::Selectable(printable(w.recent_files[n], std::string::npos).c_str())) w.requests.open_recent = n;
            ImGui::PopID();
        }
    });
}

} // namespace

void drawJobAndNotices(Workspace& w, FreeArea area) {
    const float margin = kJobMargin * uiScale();
    float bottom = area.height - margin;
    if (w.job) bottom = boxAbove("Job", area, bottom, 0, [&] { drawJob(w); }) - margin / 2;
    int number = 0;
    for (auto notice = w.notices.rbegin(); notice != w.notices.rend() && bottom > 0; ++notice) {
        const float opacity = opacityOf(*notice, w.time_s);
        if (!(opacity > 0)) continue;
        const std::string name = std::string("Notice ") + std::to_string(number++);
        ImGui::SetNextWindowBgAlpha(0.85f * opacity);
        bottom =
            boxAbove(name.c_str(), area, bottom, ImGuiWindowFlags_NoInputs, [&] { drawNotice(*notice, opacity); }) -
            margin / 2;
    }
}

void drawEmptyState(Workspace& w, FreeArea area) {
    if (hasScene(w)) return;
    const std::string state = w.job ? stateOf(*w.job) : "";
    const std::string text = w.job ? w.job->title + (state.empty() ? "" : "\n" + state)
                                   : "Open scans or a scene with Ctrl + O, or drop them here";
    const float size = 1.6f * ImGui::GetFontSize();
    const ImVec2 extent = ImGui::GetFont()->CalcTextSizeA(size, area.width, area.width, text.c_str());
    const float top = (area.height - extent.y) / (w.job || w.recent_files.empty() ? 2 : 4);
    ImGui::GetBackgroundDrawList()->AddText(ImGui::GetFont(), size, ImVec2((area.width - extent.x) / 2, top),
                                            ImGui::GetColorU32(ImGuiCol_TextDisabled), text.c_str(), nullptr,
                                            area.width);
    if (!w.job && !w.recent_files.empty()) drawRecentFiles(w, area, top + 2 * extent.y);
}

void drawWayBack(Workspace& w, FreeArea area) {
    if (w.scan_in_view) return;
    const BoxPlace place{ImVec2(area.width / 2, area.height / 2), ImVec2(0.5f, 0.5f)};
    const float width = std::min(kWayBackWidth * uiScale(), area.width);
    boxOnPicture("Way back", place, width, ImGuiWindowFlags_NoMove, [&] {
        ImGui::TextWrapped("No part of the scan is in view.");
        if (ImGui::Button("Show the scan (Home)", ImVec2(-1, 0))) w.requests.home = true;
    });
}

void drawQuestion(Workspace& w) {
    constexpr const char* kName = "Question";
    if (!w.question) return;
    if (!ImGui::IsPopupOpen(kName)) ImGui::OpenPopup(kName);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(window.x / 2, window.y / 2), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(ImVec2(std::min(kJobWidth * uiScale(), window.x), 0));
    if (!ImGui::BeginPopupModal(kName, nullptr,
                                ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize))
        return;
    ImGui::TextWrapped("%s", w.question->text.c_str());
    ImGui::Dummy(ImVec2(0, 4 * uiScale()));
    const int count = static_cast<int>(w.question->answers.size());
    for (int n = 0; n < count; ++n) {
        if (n > 0) ImGui::SameLine();
        if (columnButton(w.question->answers[static_cast<std::size_t>(n)].c_str(), count))
            w.requests.answer = static_cast<std::size_t>(n);
    }
    if (w.requests.answer) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace pointrt
