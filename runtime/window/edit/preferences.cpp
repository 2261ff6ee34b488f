// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/preferences.h"

#include <cstdint>
#include <fstream>

#include "format/base/error.h"
#include "format/os/user_folder.h"
#include "runtime/util/output_file.h"

namespace pointrt {
namespace {

std::string filePath(const std::string& folder) { return folder + "/window"; }

struct Flag {
    const char* name;
    bool Workspace::*value;
};
constexpr Flag kFlags[] = {
    {"light theme", &Workspace::light_theme}, {"panel", &Workspace::show_panel}, {"statistics", &Workspace::show_hud}};
constexpr const char* kSection = "section ";
constexpr const char* kOn = "on ";
constexpr const char* kOff = "off ";

void readLine(const std::string& line, Workspace& work) {
    const bool on = line.starts_with(kOn);
    if (!on && !line.starts_with(kOff)) return;
    const std::string name = line.substr(std::string(on ? kOn : kOff).size());
    for (const Flag& flag : kFlags)
        if (name == flag.name) work.*flag.value = on;
    if (name.starts_with(kSection)) work.open_sections[name.substr(std::string(kSection).size())] = on;
}

} // namespace

void readPreferences(const std::string& folder, Workspace& work) {
    if (folder.empty()) return;
    std::ifstream file(filePath(folder));
    constexpr int kMostLines = 1000; // limit for files that are not preferences
    int lines = 0;
    for (std::string line; lines < kMostLines && std::getline(file, line); ++lines) readLine(line, work);
}

void writePreferences(const std::string& folder, const Workspace& work) {
    if (folder.empty() || !makePrivateFolder(folder)) return;
    std::string text;
    for (const Flag& flag : kFlags) text += (work.*flag.value ? kOn : kOff) + std::string(flag.name) + "\n";
    for (const auto& [name, open] : work.open_sections) text += (open ? kOn : kOff) + (kSection + name) + "\n";
    try {
        writeFile(filePath(folder), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    } catch (const Error&) {
        return;
    }
}

} // namespace pointrt
