// SPDX-License-Identifier: Apache-2.0
// The browser of folders, to choose files to open.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "format/base/printable.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/ui_style.h"

namespace pointrt {
namespace {

/// Design units.
constexpr float kBrowserWidth = 520, kBrowserHeight = 420;

void chooseAlone(FileBrowser& browser, FileBrowser::Entry& chosen, bool with_others) {
    const bool was_chosen = chosen.chosen;
    if (!with_others)
        for (FileBrowser::Entry& entry : browser.entries) entry.chosen = false;
    chosen.chosen = !with_others || !was_chosen;
}

void drawEntry(Workspace& w, FileBrowser& browser, FileBrowser::Entry& entry) {
    const std::string name = printable(entry.name, std::string::npos) + (entry.is_folder ? "/" : "");
    if (!ImGui::Selectable(name.c_str(), entry.chosen, ImGuiSelectableFlags_AllowDoubleClick)) return;
    const std::string path = (std::filesystem::path(browser.folder) / entry.name).string();
    const bool is_second = ImGui::IsMouseDoubleClicked(0);
    if (entry.is_folder) {
        // the first click of a double click has opened a folder, so the second would fall on one of its entries
        if (!is_second) w.requests.browse = path;
    } else if (is_second && entry.chosen)
        w.requests.open_files = {path};
    else
        chooseAlone(browser, entry, ImGui::GetIO().KeyCtrl);
}

void drawEntries(Workspace& w, FileBrowser& browser) {
    if (!browser.error.empty()) return dimText(printable(browser.error, std::string::npos).c_str());
    for (std::size_t n = 0; n < browser.entries.size(); ++n) {
        ImGui::PushID(static_cast<int>(n));
        drawEntry(w, browser, browser.entries[n]);
        ImGui::PopID();
    }
}

/// Lists the folder that the user typed or pasted, or opens the file.
void takeTyped(Workspace& w, const std::string& path) {
    if (isToOpen(path))
        w.requests.open_files = {path};
    else
        w.requests.browse = path;
}

void drawFolder(Workspace& w, FileBrowser& browser) {
    if (ImGui::Button("Up")) w.requests.browse = std::filesystem::path(browser.folder).parent_path().string();
    tooltip("go to the parent folder");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputText("##folder", &browser.folder, ImGuiInputTextFlags_EnterReturnsTrue))
        takeTyped(w, browser.folder);
    tooltip("a folder to list, or a file to open");
}

} // namespace

void drawBrowser(Workspace& w, FreeArea area) {
    if (!w.browser) return;
    FileBrowser& browser = *w.browser;
    ImGui::SetNextWindowPos(ImVec2(area.width / 2, area.height / 2), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(
        ImVec2(std::min(kBrowserWidth * uiScale(), area.width), std::min(kBrowserHeight * uiScale(), area.height)));
    ImGui::SetNextWindowBgAlpha(1);
    bool open = true;
    if (ImGui::Begin("Open", &open,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize)) {
        drawFolder(w, browser);
        const float below = ImGui::GetFrameHeightWithSpacing();
        ImGui::BeginChild("entries", ImVec2(0, -below), true);
        drawEntries(w, browser);
        ImGui::EndChild();
        const std::vector<std::string> chosen = chosenFiles(browser);
        ImGui::BeginDisabled(chosen.empty());
        if (columnButton("Open", 2, false, "Ctrl + click chooses several")) w.requests.open_files = chosen;
        ImGui::EndDisabled();
        ImGui::SameLine();
        if (columnButton("Cancel", 2)) open = false;
    }
    ImGui::End();
    if (!open) w.browser.reset();
}

} // namespace pointrt
